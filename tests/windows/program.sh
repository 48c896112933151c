#!/bin/sh
# The program for Windows stands alone, and does under wine what HERE does on this machine: program.sh ROOT FOLDER PYTHON HERE
# Wants $MESON.
set -eu
root=$1 folder=$2 python=$3 program=$4 here=$(cd "$(dirname "$0")" && pwd)
"$here/build.sh" "$root" "$folder"
if x86_64-w64-mingw32-objdump -p "$folder/tools/tribox.exe" | sed -n 's/.*DLL Name: //p' |
    grep -vixE '(kernel32|advapi32|shell32|msvcrt|ucrtbase|api-ms-win-crt-.*)\.dll'; then
    echo "tribox.exe needs these beside the libraries of the system" >&2
    exit 1
fi
x86_64-w64-mingw32-gcc-posix -std=c11 -Wall -Wextra -Werror -D__USE_MINGW_ANSI_STDIO=1 "$here/in_console.c" \
    -o "$folder/in_console.exe"
exec "$python" -B "$here/program.py" "$program" "$here/wine.sh" "$folder"
