#!/bin/sh
# CMake builds the DLL for Windows as meson does, for a project that adds it or finds it installed; answers are right under wine:
# cmake.sh ROOT FOLDER. Wants $MESON.
root=$1 folder=$2 package=$1/tests/package
. "$package/parts.sh"
"$here/build.sh" "$root" "$folder"
command -v cmake >/dev/null || skip "no cmake"
toolchain='-DCMAKE_SYSTEM_NAME=Windows -DCMAKE_C_COMPILER=x86_64-w64-mingw32-gcc-posix -DCMAKE_BUILD_TYPE=None'
cc='x86_64-w64-mingw32-gcc-posix -D__USE_MINGW_ANSI_STDIO=1 -static'

# shellcheck disable=SC2086
python3 "$package/no_flags.py" files "$folder" "$root" $toolchain -DBUILD_SHARED_LIBS=ON

# runs NAME DLL: the consumer in the folder of that name finds those kernels of this build that it finds with meson's library
runs() {
    cp "$2" "$work/$1"
    "$here/wine.sh" "$folder" "$work/$1/tribox_c.exe" kernels | diff "$work/kernels" - || exit 1
    echo "$1: right"
}

# shellcheck disable=SC2086
$cc -I"$root/include" "$package/consumer/consumer.c" "$folder/src/libtribox.a" -o "$work/by_meson.exe"
"$here/wine.sh" "$folder" "$work/by_meson.exe" kernels | grep -E '^(avx2|scalar)' >"$work/kernels"

# shellcheck disable=SC2086
cmake -S "$package/consumer" -B "$work/added" $toolchain -DLANGUAGES=C -DADDED="$root" -DBUILD_SHARED_LIBS=ON -DTRIBOX_INSTALL=ON \
    -DTRIBOX_KERNELS=avx2 # one that has vectors of 32 bytes
cmake --build "$work/added" --parallel 2
dll=$work/added/_deps/tribox-build/libtribox-1.dll
runs added "$dll"
x86_64-w64-mingw32-objdump -p "$dll" | sed -n '/^\[Ordinal.Name Pointer/,/^$/s/^\t\[.*\] //p' | LC_ALL=C sort >"$work/exported"
"$root/packaging/symbols.sh" | diff - "$work/exported"

cmake --install "$work/added/_deps/tribox-build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/second"
# shellcheck disable=SC2086
cmake -S "$package/consumer" -B "$work/found" $toolchain -DLANGUAGES=C -DCMAKE_PREFIX_PATH="$work/second"
cmake --build "$work/found"
runs found "$work/second/bin/libtribox-1.dll"

find "$work/added/_deps" -name '*.obj' >"$work/objects"
# shellcheck disable=SC2086
build_digests "$work/masks.exe" "$root" "@$work/objects" $cc
"$here/wine.sh" "$folder" "$work/masks.exe" "$root/tests/cross/masks.txt" --short
