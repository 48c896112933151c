#!/bin/sh
# Builds the page: examples/web/build.sh OUT.html, one file that needs no server. It takes node, npm and what packaging/npm/build.sh
# takes. What is installed and compiled on the way stays in BUILD, by default a folder that is removed again.
set -eu
if test $# -ne 1; then
    echo 'usage: examples/web/build.sh OUT.html' >&2
    exit 2
fi
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../..
. "$root/packaging/npm/needs.sh"
lacks nodejs command -v node
lacks npm command -v npm
lacks_compiler
check_missing

mkdir -p "$(dirname "$1")"
out=$(realpath "$1")
if test -z "${BUILD:-}"; then
    BUILD=$(mktemp -d)
    trap 'rm -rf "$BUILD"' EXIT
fi
mkdir -p "$BUILD"
cd "$BUILD"
cp "$here/package.json" .
npm install --loglevel=error --no-audit --no-fund --no-package-lock --prefer-offline
sh "$root/packaging/npm/build.sh" tribox "$here/paper.c" paper_overlap
sh "$here/read/build.sh" read.wasm
node "$here/bundle.mjs" tribox read.wasm "$out"
