#!/bin/sh
# Sources refuse flags that would break their promises, say what to do, and refuse no others: refusals.sh ROOT x86|other COMPILER...
set -eu
cd "$1"
family=$2
shift 2
compiler=$*

status=0
# refuses MESSAGE FILE FLAGS...
refuses() {
    message=$1 file=$2
    shift 2
    if printed=$($compiler -std=c11 -fsyntax-only -Iinclude -Isrc "$@" "src/$file" 2>&1); then
        echo "src/$file: compiles with '$*', and should refuse" >&2
        status=1
    elif ! printf '%s' "$printed" | grep -q "$message"; then
        echo "src/$file: with '$*' it does not say '$message', but:" >&2
        printf '%s\n' "$printed" >&2
        status=1
    fi
}

# compiles FILE FLAGS...: with a compiler that knows the flags
compiles() {
    file=$1
    shift
    if : | $compiler -fsyntax-only "$@" -x c - 2>/dev/null && ! $compiler -fsyntax-only -Iinclude -Isrc "$@" "src/$file"; then
        echo "src/$file: does not compile with '$*'" >&2
        status=1
    fi
}

refuses 'cannot be compiled with -ffast-math' scalar/pairs_scalar.c -ffast-math
refuses 'cannot be compiled with -ffast-math' overlap/overlap.c -ffast-math
if test "$family" = x86; then
    refuses 'compile this file with AVX2 and FMA' avx2/pairs_avx2.c
    refuses 'compile this file with AVX2 and FMA' avx2/pairs_avx2.c -mavx2
    refuses 'compile this file with AVX2 and FMA' avx2/pairs_avx2.c -mavx -mfma
    refuses 'compile this file with AVX-512F' avx512/pairs_avx512.c -mavx2 -mfma
    refuses 'little-endian AArch64' neon/pairs_neon.c
    refuses 'for WebAssembly with -msimd128' wasm/pairs_wasm128.c
    compiles scalar/pairs_scalar.c -std=gnu11 -march=sapphirerapids
    refuses 'for the baseline' dispatch.c -DTRIBOX_AVX2 -mavx
fi
exit $status
