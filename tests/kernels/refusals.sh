#!/bin/sh
# Sources refuse flags that would break their promises, say what to do, and refuse no others: refusals.sh ROOT x86|other COMPILER...
# Flags of fast math do no harm, also at link time, or are refused: by the compiler, or by the library as it runs.
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

sources='src/grid/grid.c src/base/rounded_box.c'
# shellcheck disable=SC2086
digests -O0 $sources >"$work/right"
while read -r unsafe; do
    : | $compiler -fsyntax-only -Werror $unsafe -x c - 2>/dev/null || continue
    if digests -O2 $unsafe $sources >"$work/unsafe" 2>&1; then
        diff "$work/right" "$work/unsafe" >&2 || { echo "'$unsafe' breaks arithmetic, and is not refused" >&2; status=1; }
    elif ! grep -q 'products are not rounded' "$work/unsafe"; then
        refuses 'cannot be compiled with -ffast-math or parts of it' grid/grid.c $unsafe
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
        $compiler -std=c11 -O3 -flto -Iinclude -Isrc -c "$file" -o "$work/$(basename "$file").o"
    done
    digests -O3 -march=x86-64-v3 -flto "$work"/*.o | head -n 2 >"$work/linked"
    head -n 2 "$work/right" | diff - "$work/linked" >&2 || { echo 'LTO makes FMAs of the library' >&2; status=1; }
fi

if test "$family" = x86; then
    compiles scalar/pairs_scalar.c -std=gnu11 -march=sapphirerapids
    compiles dispatch.c -march=x86-64-v3
fi
exit $status
