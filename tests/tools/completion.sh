#!/bin/sh
# The completion of bash knows the commands, options and words of the program: completion.sh PROGRAM COMPLETION
set -eu
command -v bash >/dev/null || { echo "no bash: skipped"; exit 77; }
exec bash -eu -s "$1" "$2" <<'END'
program=$1
source "$2"

# expect WORDS CHOICES: what the last word may become
expect()
{
    local choices=$2
    read -r -a COMP_WORDS <<<"$1"
    [[ $1 == *' ' ]] && COMP_WORDS+=('')
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _tribox
    if [[ ${COMPREPLY[*]} != "$choices" ]]; then
        echo "after '$1': '${COMPREPLY[*]}' instead of '$choices'" >&2
        exit 1
    fi
}

expect "$program vo" voxelize
expect "$program help me" merge
expect "$program --v" --version
expect "$program voxelize --re" --resolution
expect "$program overlap mesh.ply --l" --list
expect "$program merge a.npz" ''
expect "$program voxelize a.obj --out-format nr" nrrd
expect "$program voxelize a.obj --fill pa" parity
expect "$program voxelize a.obj --fill = pa" parity
expect "$program voxelize a.obj --fill =" 'outside parity middles'
expect "$program voxelize a.obj --preview a.png --up -" '-x -y -z'
expect "$program merge a.npz --up x" x
expect "$program overlap a.obj --kernel sc" scalar
expect "$program overlap a.obj --format f" 'f32 f64'
expect "$program voxelize a.obj --quiet --thi" --thin
expect "$program voxelize a.obj --json --" "$("$program" voxelize --help | sed -nE 's/^ +(-[a-zA-Z], )?(--[a-z-]+).*/\2/p' | xargs)"
expect "$program voxelize a.obj --out out" ''
END
