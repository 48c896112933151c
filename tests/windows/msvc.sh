#!/bin/sh
# The library compiles in the shape of MSVC, as COFF and by clang-cl, with stub headers in place of MSVC's, and runs under wine:
# msvc.sh ROOT FOLDER clang-cl|cl. Wants $MESON.
#   cl   clang pretends to be cl.exe (msvc/as_cl.h), to CMake as well, so that what is for it runs too; cl.exe itself never does
# CMake builds it, by the flags that it gives clang-cl. mingw's linker puts it to programs: both follow Windows' calling convention.
root=$1 folder=$2 how=$3
. "$root/tests/package/parts.sh"
for program in cmake clang-cl-19 llvm-lib-19; do
    command -v $program >/dev/null || skip "no $program"
done
"$here/build.sh" "$root" "$folder"

ln -s "$root" "$work/root" # clang posing as cl takes a path that begins with /w for an option
flags="/Od /W4 /WX /GS- /Zl /imsvc $here/msvc/headers"
test "$how" = clang-cl || flags="$flags /FI$here/msvc/as_cl.h /clang:-ffp-contract=off -Wno-unknown-pragmas"
cmake -S "$work/root" -B "$work" -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY \
    -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_C_COMPILER=clang-cl-19 -DCMAKE_AR="$(command -v llvm-lib-19)" -DCMAKE_C_FLAGS="$flags"
cmake --build "$work" --parallel 2

# What MSVC's library gives under these names, mingw's has under others.
cc='x86_64-w64-mingw32-gcc-posix -D__USE_MINGW_ANSI_STDIO=1 -static -Wl,--defsym,__chkstk=___chkstk_ms -Wl,--defsym,_fltused=0'
for library in "$work/tribox.lib" "$folder/src/libtribox.a"; do
    # shellcheck disable=SC2086
    $cc -I"$root/include" "$root/tests/package/consumer/consumer.c" "$library" -o "$work/consumer.exe"
    "$here/wine.sh" "$folder" "$work/consumer.exe" kernels >"$work/$(basename "$library").txt"
done
diff "$work/libtribox.a.txt" "$work/tribox.lib.txt"
# shellcheck disable=SC2086
build_digests "$work/masks.exe" "$root" "$work/tribox.lib" $cc
"$here/wine.sh" "$folder" "$work/masks.exe" "$root/tests/cross/masks.txt" --short
