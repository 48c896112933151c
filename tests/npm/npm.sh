#!/bin/sh
# Builds the npm package and tests it with node: npm.sh FOLDER ANSWERS
#   FOLDER   where the package is built, and what its tests need is installed
#   ANSWERS  the program of common/answers.c
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$1 TRIBOX_ANSWERS=$2
for program in "${WASM_CC:-clang-19}" node npm; do
    command -v "$program" >/dev/null || { echo "no $program: skipped"; exit 77; }
done
TRIBOX_PACKAGE=$folder/package TRIBOX_TYPESCRIPT=$folder/typescript
export TRIBOX_ANSWERS TRIBOX_PACKAGE TRIBOX_TYPESCRIPT
sh "$here/../../packaging/npm/build.sh" "$TRIBOX_PACKAGE"

mkdir -p "$TRIBOX_TYPESCRIPT"
cp "$here/package.json" "$TRIBOX_TYPESCRIPT"
(cd "$TRIBOX_TYPESCRIPT" && npm install --loglevel=error --no-audit --no-fund --no-package-lock --prefer-offline)
node --test "$here"
