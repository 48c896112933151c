#!/bin/sh
# Builds the npm package: packaging/npm/build.sh FOLDER [SOURCE.c]... [FUNCTION]...
# Further sources are compiled as the library's are, and may include its headers. Further functions, theirs or the library's, are
# exported. Needs clang with wasm-ld, wasi-libc and clang's runtime for wasm32; WASM_CC is clang-19 by default.
set -eu
if test $# -eq 0; then
    sed -n '2,4s/^# //p' "$0" >&2
    exit 2
fi
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$root/packaging/npm/needs.sh"
lacks_compiler
check_missing
cc="${WASM_CC:-clang-19} --target=wasm32-wasi"
command -v ccache >/dev/null && cc="ccache $cc"
folder=$1 from=$PWD
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The calls that the module makes.
cat >"$work/functions" <<'END'
malloc free tribox_status_text tribox_kernel_name
tribox_overlap tribox_overlap_oriented tribox_find tribox_classify tribox_split
tribox_mesh_overlap tribox_mesh_overlap_oriented tribox_mesh_find tribox_mesh_classify tribox_mesh_split
tribox_index_bytes tribox_index_build tribox_index_update tribox_index_overlap tribox_index_words tribox_index_list tribox_index_any
tribox_soup_sort tribox_soup_gather tribox_mesh_sort
tribox_grid_cell tribox_voxelize tribox_voxelize_ids tribox_tile_lists tribox_cell_lists tribox_bricks_bytes tribox_bricks
sink_taker tribox_bricks_lists_bytes tribox_bricks_lists tribox_mesh_bricks_lists lists_taker
tribox_mesh_voxelize tribox_mesh_voxelize_ids tribox_mesh_tile_lists tribox_mesh_cell_lists tribox_mesh_bricks
tribox_voxelize_thin tribox_mesh_voxelize_thin tribox_fill_bytes tribox_fill_outside tribox_fill_parity tribox_mesh_fill_parity
END

# The kernel, and what hands pairs from one of its stages to the next, are compiled for speed; the walk over nodes and the cells of
# small triangles are as fast and smaller at -O2, where codes of vertices are told, too. The rest, which is four times as small so
# and no slower, for size.
{
    cd "$root/src"
    find wasm pairs/pairs.c -name '*.c' ! -name 'nodes_*' ! -name 'cells_*' -exec echo -O3 {} \;
    printf '%s\n' '-O2 wasm/nodes_wasm128.c' '-O2 wasm/cells_wasm128.c' '-O2 mesh/mesh_codes.c' "-Os $root/packaging/npm/sink.c"
    find ./*.c base order overlap grid tiles -name '*.c' -exec echo -Oz {} \;
    find pairs mesh index voxels fill exact -name '*.c' ! -name pairs.c ! -name mesh_codes.c -exec echo -Os {} \;
    cd "$from"
    for argument; do
        case $argument in
        *.c) echo -O3 "$(realpath "$argument")" ;;
        *) echo "$argument" >>"$work/functions" ;;
        esac
    done
} | sort | awk '{ printf "%03d.o %s\n", NR, $0 }' >"$work/sources"

# One object a source, as many at once as there are processors.
xargs -P "$(nproc)" -L 1 sh -c '
    cd "$1/src" && $3 -std=c11 -msimd128 -fvisibility=hidden -ffunction-sections -Wall -Wextra -Werror \
        -DTRIBOX_SMALL -I../include -I. "$5" -c "$6" -o "$2/$4"' sh "$root" "$work" "$cc" <"$work/sources"

# The stack lies first, where an overflow meets the end of the memory and not data.
$cc -nostartfiles -Wl,--no-entry -Wl,--gc-sections -Wl,--strip-all -Wl,--compress-relocations -Wl,-O2 -Wl,--stack-first \
    -Wl,-z,stack-size=262144 $(printf ' -Wl,--export=%s' $(cat "$work/functions")) "$work"/*.o -o "$work/tribox.wasm"
chmod 644 "$work/tribox.wasm"

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
