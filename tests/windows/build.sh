#!/bin/sh
# Builds this project for Windows, quickly rather than fast, and starts wine: build.sh ROOT FOLDER. Wants $MESON.
# Several may call it at once: one builds, and the others wait.
set -eu
root=$1 folder=$2 here=$(cd "$(dirname "$0")" && pwd)
for program in x86_64-w64-mingw32-gcc-posix /usr/lib/wine/wine64; do
    command -v "$program" >/dev/null || { echo "no $program: skipped"; exit 77; }
done
mkdir -p "$folder/wine"
cd "$folder"
exec 9>lock
flock 9
# The kernels compile in seconds where their words are not forced inline.
test -f build.ninja || "$MESON" setup . "$root" --cross-file="$root/tests/cross/windows.ini" --werror -Dbuildtype=plain \
    -Doptimization=1 -Dc_args=-U__OPTIMIZE__ -Dtools=enabled -Dopenvdb=disabled -Dbench=disabled -Dembree=disabled -Dpython=disabled
"$MESON" compile

# One server for all programs, or each would start its own, which keeps its pipes for seconds. It ends by itself.
WINEPREFIX=$folder/wine /usr/lib/wine/wineserver64 -p20 </dev/null >/dev/null 2>&1 9>&- || test $? -eq 2 # it runs already
"$here/wine.sh" "$folder" wineboot -i </dev/null >/dev/null 2>&1 9>&-
