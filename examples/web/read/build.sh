#!/bin/sh
# Compiles the readers of the program for the page: examples/web/read/build.sh OUT.wasm. It takes what packaging/npm/build.sh takes.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../../..
out=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cc="${WASM_CC:-clang-19} --target=wasm32-wasi"
command -v ccache >/dev/null && cc="ccache $cc"

# All but what says nothing here: libassimp, lists of boxes, bars, and moving or warning about a mesh.
{
    echo "$here/read.c"
    echo "$root/src/base/status.c"
    echo "$root/tools/without.c"
    for name in decimal memory numbers written_number; do echo "$root/tools/console/$name.c"; done
    find "$root/tools/read" -name '*.c' ! -name 'assimp_plugin.c' ! -name 'read_by_assimp.c' ! -name boxes.c ! -name reading.c \
        ! -name mesh_shift.c
} | awk '{ printf "%03d.o %s\n", NR, $0 }' |
    xargs -P "$(nproc)" -L 1 sh -c '
        $3 -std=c11 -O2 -fvisibility=hidden -ffunction-sections -Wall -Wextra -Werror -DWITHOUT_ASSIMP -isystem "$1" \
            -I"$2/include" -I"$2/src" -I"$2/tools" -c "$6" -o "$4/$5"' sh "$here" "$root" "$cc" "$work"
$cc -nostartfiles -Wl,--no-entry -Wl,--gc-sections -Wl,--strip-all -Wl,-O2 -Wl,--stack-first -Wl,-z,stack-size=262144 \
    -Wl,--export=malloc "$work"/*.o -o "$work/read.wasm"
mv "$work/read.wasm" "$out"
