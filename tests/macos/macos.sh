#!/bin/sh
# The library and the program compile for macOS, with system.h in place of its headers, and the library exports what it should:
# macos.sh ROOT. Nothing of it ever runs; parts of the program that need libraries are left out.
set -eu
root=$1 here=$(cd "$(dirname "$0")" && pwd)
for program in clang-19 ld64.lld-19 llvm-nm-19; do
    command -v $program >/dev/null || { echo "no $program: skipped"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$root"

mkdir -p "$work/headers/sys"
awk -v to="$work/headers/" '
    /^\/\* [a-z\/]+\.h/ {
        part++
        print "#pragma once\n#include \"part0.h\"" >(to "part" part ".h")
        for (rest = $0; match(rest, /[a-z\/]+\.h/); rest = substr(rest, RSTART + RLENGTH))
            print "#include \"part" part ".h\"" >(to substr(rest, RSTART, RLENGTH))
        next
    }
    { print >(to "part" part + 0 ".h") }' "$here/system.h"

# compile PROCESSOR FLAGS FILE...: each to an object in a folder of the processor's
compile() {
    processor=$1 own=$2
    shift 2
    mkdir -p "$work/$processor"
    printf '%s\n' "$@" | xargs -P 2 -I FILE sh -c 'exec clang-19 --target="$0-apple-macos11" -isysroot "$2" -isystem "$2/headers" \
        -std=c11 -U__OPTIMIZE__ -D_DARWIN_C_SOURCE -Wall -Wextra -Wconversion -Wshadow -Wno-enum-float-conversion -Werror \
        $(sed -n s/^all://p src/kernels.txt) -fvisibility=hidden -Iinclude -Isrc -Itools $3 -c "$1" -o "$2/$0/$(echo "$1" | tr / -).o"' \
        "$processor" FILE "$work" "$own"
}

# library PROCESSOR NAME: all that CMake and meson compile for it, which kernels.txt calls by that name
library() {
    defines=
    grep -E "^[a-z0-9]+ [a-z0-9]+ (any|$2):" src/kernels.txt >"$work/kernels"
    while IFS=': ' read -r kernel folder _ flags; do
        compile "$1" "$flags" "src/$folder"/*.c
        test "$kernel" = scalar || defines="$defines -DTRIBOX_$(echo "$kernel" | tr a-z A-Z)"
    done <"$work/kernels"
    # shellcheck disable=SC2046
    compile "$1" "$defines" $(find src -name '*.c' | grep -vE 'src/(scalar|sse|avx2|avx512|neon|wasm)/')
    ld64.lld-19 -arch "$1" -platform_version macos 11.0 11.0 -dylib -undefined dynamic_lookup "$work/$1"/src-*.o \
        -o "$work/$1/libtribox.dylib"
    llvm-nm-19 --defined-only --extern-only "$work/$1/libtribox.dylib" | sed -n 's/.* T _//p' | LC_ALL=C sort |
        diff - "$work/symbols" || { echo "$1: exports (<) other names than the functions of the headers (>)" >&2; exit 1; }
    ! llvm-nm-19 --undefined-only "$work/$1/libtribox.dylib" |
        grep -vE '(^| )_(mem(cpy|move|set)|bzero)$|dyld_stub_binder|___(cpu|stack)_' >&2 || { echo "$1: needs these too" >&2; exit 1; }
    echo "$1: compiled"
}

packaging/symbols.sh >"$work/symbols"
library arm64 aarch64
library x86_64 x86
# shellcheck disable=SC2046
compile arm64 '' $(find tools -name '*.c' ! -name '*windows*' ! -name wide_text.c -exec grep -LE '<(zlib|png|assimp/.*)\.h>' {} +)
echo 'the program: compiled'
