#!/bin/sh
# Builds the page and looks at it in chromium: run.sh [pictures FOLDER | film FOLDER | PART...], PART as in test_PART.mjs.
# TRIBOX_PROGRAM is the program whose answers the page's have to be. BUILD is a folder to build in, kept for the next time;
# PAGE, a page that is built already; CHROMIUM, the browser. Without a program that this takes, the exit code is 77.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
test -n "${PAGE:-}" && compiler= || compiler=${WASM_CC:-clang-19}
for program in node npm ${CHROMIUM:=chromium} $compiler; do
    command -v "$program" >/dev/null || { echo "no $program: skipped" >&2; exit 77; }
done
export CHROMIUM
if test -z "${BUILD:-}"; then
    BUILD=$(mktemp -d)
    trap 'rm -rf "$BUILD"' EXIT
fi
mkdir -p "$BUILD/browser"
if test -z "${PAGE:-}"; then
    PAGE=$BUILD/page.html
    BUILD=$BUILD/page sh "$here/../../examples/web/build.sh" "$PAGE"
fi
export PAGE
cd "$BUILD/browser"
cp "$here/package.json" .
npm install --loglevel=error --no-audit --no-fund --no-package-lock --prefer-offline
case ${1:-} in
pictures | film) PLAYWRIGHT=$PWD node "$here/pictures.mjs" "$@" ;;
*) PLAYWRIGHT=$PWD node "$here/run.mjs" "$@" ;;
esac
