#!/bin/sh
# The DLL exports the functions of the header and nothing else, needs nothing but the system, and the tests pass under wine:
# library.sh ROOT FOLDER. Wants $MESON.
set -eu
root=$1 folder=$2 here=$(cd "$(dirname "$0")" && pwd)
"$here/build.sh" "$root" "$folder"
cd "$folder"
dll=src/libtribox-1.dll
x86_64-w64-mingw32-objdump -p "$dll" >dll.txt
sed -n '/^\[Ordinal.Name Pointer/,/^$/s/^\t\[.*\] //p' dll.txt | LC_ALL=C sort >exported
if ! "$root/packaging/symbols.sh" | diff -u - exported; then
    echo "$dll exports (+) other names than the functions of include/tribox.h (-)" >&2
    exit 1
fi
if sed -n 's/.*DLL Name: //p' dll.txt | grep -vixE 'kernel32.dll|msvcrt.dll|ucrtbase.dll|api-ms-win-crt-.*'; then
    echo "$dll needs these beside the libraries of the system" >&2
    exit 1
fi

# Windows keeps the stack at multiples of 16: no vector of 32 or 64 bytes may be moved there as if it were aligned (gcc bug 54412).
find src -name '*_avx*.c.obj' -exec x86_64-w64-mingw32-objdump -d {} + >kernels.txt
if ! grep -q 'vmovup.*[yz]mm.*%r[sb]p' kernels.txt || grep -m 9 -E 'vmov(ap|dqa).*[yz]mm.*%r[sb]p' kernels.txt; then
    echo "there are vectors moved on the stack as if it were aligned, or none at all" >&2
    exit 1
fi

# A user's program with the DLL, and with the static library.
prints_answers() {
    x86_64-w64-mingw32-gcc-posix -std=c11 -Wall -Wextra -Werror -D__USE_MINGW_ANSI_STDIO=1 -I"$root/include" \
        "$root/examples/one_box.c" "$@" -o src/one_box.exe
    "$here/wine.sh" "$folder" src/one_box.exe | tr -d '\r' | diff -u "$root/tests/examples/one_box.txt" - >&2
}
prints_answers -DTRIBOX_SHARED src/libtribox.dll.a
prints_answers src/libtribox.a

"$MESON" test --no-rebuild --print-errorlogs --suite kernels --suite calls --no-suite shortened
"$MESON" test --no-rebuild --print-errorlogs --logbase others 'masks in short' exactness 'calls environment' 'inputs bad_indices' \
    'inputs classify' 'index update' 'index gather'
