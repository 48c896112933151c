#!/bin/sh
# Kernels are chosen at build time, by meson and by CMake alike, and a name that is none is refused: kernels.sh ROOT FOLDER
# The build is kept in FOLDER. Wants $MESON.
. "$(dirname "$0")/parts.sh"
root=$1 folder=$2
test "$(uname -m)" = x86_64 || skip 'the kernels that are named here are those of x86-64'
export CC="${CC##* }"
here_are='scalar, sse2, avx2, avx512'

# refuses NAMES COMMAND...: and says which there are
refuses() {
    names=$1
    shift
    ! "$@" >"$work/log" 2>&1 || die "takes $names: $*"
    tr -s ' \n' ' ' <"$work/log" | grep -q 'no kernel "[A-Za-z0-9]*" for this processor: .* some of '"$here_are" ||
        { cat "$work/log" >&2; exit 1; }
}
for names in avx avx2,neon sse2,AVX2; do
    refuses "$names" "$MESON" setup "$work/refused" "$root" -Dtests=disabled "-Dkernels=$names"
    refuses "$names" cmake -S "$root" -B "$work/refused" "-DTRIBOX_KERNELS=$names"
    rm -rf "$work/refused"
done

# A project that sets them has them from the first configuration on.
mkdir "$work/project"
cat >"$work/project/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.16)
project(app C)
set(TRIBOX_KERNELS sse2)
add_subdirectory("$root" tribox)
END
if cmake --version | grep -Eq ' (3\.(2[1-9]|[3-9][0-9])|[4-9]\.)'; then # older ones take what is in the cache
    cmake -S "$work/project" -B "$work/project/build" >/dev/null
    grep -rq TRIBOX_WITHOUT_AVX2 "$work/project/build/tribox" || die 'set(TRIBOX_KERNELS sse2) is ignored'
fi

# Quickly rather than fast, as on other processors.
mkdir -p "$folder"
cd "$folder"
test -f build.ninja || "$MESON" setup . "$root" --werror -Dbuildtype=plain -Doptimization=1 -Dc_args=-U__OPTIMIZE__ -Dkernels=avx2 \
    -Dbench=disabled -Dtools=disabled -Dembree=disabled -Dpython=disabled
"$MESON" test --print-errorlogs 'masks in short' dispatch exactness

# A project of fast math has right answers.
cmake -S "$root" -B "$work/fast" -DTRIBOX_KERNELS=scalar -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_C_FLAGS='-O1 -U__OPTIMIZE__ -ffast-math -fno-finite-math-only' >/dev/null
cmake --build "$work/fast" --parallel 2 >/dev/null
build_digests "$work/masks" "$root" "$work/fast/libtribox.a" "${CC:-cc}"
"$work/masks" "$root/tests/cross/masks.txt" --short
"$MESON" compile tribox:static_library >/dev/null
${CC:-cc} -I"$root/include" "$here/consumer/consumer.c" src/libtribox.a -lm -o consumer
./consumer kernels | tr '\n' ' ' >"$work/kernels"
case $(cat "$work/kernels") in
'avx2 scalar ' | 'scalar ') echo 'kernels: right' ;;
*) cat "$work/kernels" >&2 && exit 1 ;;
esac
