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
cc=${WASM_CC:-clang-19}

# lacks PACKAGE COMMAND...: names the package unless the command succeeds.
missing=
lacks() {
    package=$1
    shift
    "$@" >/dev/null 2>&1 || missing="$missing $package"
}
lacks nodejs command -v node
lacks npm command -v npm
lacks "$cc" command -v "$cc"
lacks lld-19 command -v wasm-ld-19
lacks wasi-libc test -e /usr/include/wasm32-wasi/stdio.h
lacks libclang-rt-19-dev-wasm32 test -e /usr/lib/llvm-19/lib/clang/19/lib/wasi/libclang_rt.builtins-wasm32.a
if test -n "$missing"; then
    echo "build.sh: packages are missing: apt-get install$missing" >&2
    exit 1
fi

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
