#!/bin/sh
# Builds the npm package: packaging/npm/build.sh FOLDER [SOURCE.c]... [FUNCTION]...
# Further sources are compiled as the library's are and may include "tribox.h" and "kernel/..."; further functions, theirs or the
# library's, are exported. CC is clang-19 by default; it needs wasm-ld, wasi-libc and clang's runtime for wasm32.
set -eu
cc=${CC_WASM:-clang-19}
root=$(cd "$(dirname "$0")/../.." && pwd)
if test $# -eq 0; then
    sed -n 's/^# //p' "$0" | sed -n 2,4p >&2
    exit 2
fi
folder=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Of the calls in tribox.h those that the module uses.
functions='malloc free tribox_status_text tribox_kernel_name tribox_overlap tribox_overlap_oriented tribox_overlap_any
tribox_overlap_all tribox_classify tribox_index_bytes tribox_index_build tribox_index_update tribox_index_overlap
tribox_index_overlap_oriented tribox_index_words tribox_index_list tribox_index_list_oriented tribox_index_any tribox_soup_order
tribox_soup_gather tribox_voxelize tribox_voxelize_layers tribox_overlap_indexed_f64 tribox_overlap_any_f64
tribox_overlap_all_f64 tribox_classify_f64'

find "$root/src" -maxdepth 1 -name '*.c' >"$work/sources"
find "$root/src/exact" "$root/src/scalar" -name '*.c' >>"$work/sources"
for argument; do
    case $argument in
    *.c) realpath "$argument" >>"$work/sources" ;;
    *) functions="$functions $argument" ;;
    esac
done

# One object a source, as many at once as there are processors.
sort "$work/sources" | awk '{ print NR, $0 }' | xargs -P "$(nproc)" -L 1 sh -c '
    cc=$1 root=$2 work=$3
    $cc --target=wasm32-wasi -std=c11 -O3 -msimd128 -ffp-contract=off -fvisibility=hidden -ffunction-sections -Wall -Wextra -Werror \
        -I"$root/include" -I"$root/src" -c "$5" -o "$work/$4.o"' sh "$cc" "$root" "$work"

# The stack lies first, where an overflow meets the end of the memory and not data.
$cc --target=wasm32-wasi -nostartfiles -Wl,--no-entry -Wl,--gc-sections -Wl,--strip-all -Wl,--stack-first -Wl,-z,stack-size=262144 \
    $(printf ' -Wl,--export=%s' $functions) "$work"/*.o -o "$work/tribox.wasm"

mkdir -p "$folder/parts"
version=$("$root/packaging/version.sh")
here=$root/packaging/npm
for file in package.json tribox.mjs; do
    sed "s/@VERSION@/$version/" "$here/$file"* >"$work/$file"
done
cp "$here/tribox.d.ts" "$here/README.md" "$root/LICENSE" "$work"
cp "$here"/parts/*.mjs "$folder/parts"
for file in package.json tribox.mjs tribox.d.ts README.md LICENSE tribox.wasm; do
    mv "$work/$file" "$folder/$file"
done
