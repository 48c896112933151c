#!/bin/sh
# Sources refuse flags that would break their promises, say what to do, and refuse no others: refusals.sh ROOT x86|other COMPILER...
# After flags of fast math those of kernels.txt have the last word, also at link time; alone they are refused, or do no harm.
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

# digests FLAGS...: of flags.c
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
digests() {
    $compiler "$@" -Iinclude -Isrc tests/kernels/flags.c -lm -o "$work/flags" && "$work/flags"
}

flags=$(sed -n s/^all://p src/kernels.txt)
sources='src/grid/grid.c src/base/rounded_box.c'
# shellcheck disable=SC2086
digests -O0 $flags $sources >"$work/right"
while read -r unsafe; do
    : | $compiler -fsyntax-only -Werror $unsafe -x c - 2>/dev/null || continue
    if ! digests -O2 -Werror $unsafe $flags $sources | diff "$work/right" - >&2; then
        echo "'$unsafe' breaks arithmetic in spite of the flags after it" >&2
        status=1
    fi
    if ! digests -O2 $unsafe -ffp-contract=off $sources >"$work/alone" 2>&1; then
        refuses 'cannot be compiled with -ffast-math or parts of it' grid/grid.c $unsafe
    elif ! diff "$work/right" "$work/alone" >&2; then
        echo "'$unsafe' breaks arithmetic, and is not refused" >&2
        status=1
    fi
done <<END
-Ofast
-ffast-math -fno-finite-math-only
-funsafe-math-optimizations
-fassociative-math -fno-signed-zeros -fno-trapping-math
-freciprocal-math
-ffinite-math-only
-fno-signed-zeros
-fno-honor-nans -fno-honor-infinities
-march=native -ffp-contract=fast
END

# A user's program for processors with FMA, made at link time of what was compiled for others.
if test "$family $compiler" = 'x86 gcc' && grep -q ' fma ' /proc/cpuinfo; then
    for file in $sources; do
        $compiler -std=c11 -O3 -flto $flags -Iinclude -Isrc -c "$file" -o "$work/$(basename "$file").o"
    done
    digests -O3 -march=x86-64-v3 -flto "$work"/*.o | head -n 2 >"$work/linked"
    head -n 2 "$work/right" | diff - "$work/linked" >&2 || { echo 'LTO makes FMAs of the library' >&2; status=1; }
fi

if test "$family" = x86; then
    refuses 'compile this file with AVX2 and FMA' avx2/pairs_avx2.c
    refuses 'compile this file with AVX2 and FMA' avx2/pairs_avx2.c -mavx2
    refuses 'compile this file with AVX2 and FMA' avx2/pairs_avx2.c -mavx -mfma
    refuses 'compile this file with AVX-512F' avx512/pairs_avx512.c -mavx2 -mfma
    refuses 'little-endian AArch64' neon/pairs_neon.c
    refuses 'for WebAssembly with -msimd128' wasm/pairs_wasm128.c
    compiles scalar/pairs_scalar.c -std=gnu11 -march=sapphirerapids
    compiles dispatch.c -DTRIBOX_SSE2 -DTRIBOX_AVX2 -march=x86-64-v3
fi
exit $status
