#!/bin/sh
# The two files of packaging/amalgamate.py: the same bytes twice, nothing written over, no warning, no macro left, symbols of the
# header alone, and the answers of the library: two_files.sh ROOT here|O2|elsewhere
#   here       by gcc at -O1, where words are not forced inline, as that takes minutes, and by clang at -O0; with C++ as well
#   O2         the same, as users compile them
#   elsewhere  for other processors and systems, emulated; for WebAssembly compiled alone
. "$(dirname "$0")/parts.sh"
root=$1 how=$2 level='-O1 -U__OPTIMIZE__' has_any=''
test "$how" != O2 || level=-O2

for folder in files again; do
    python3 "$root/packaging/amalgamate.py" "$work/$folder"
done
cd "$work/files"
for file in tribox.c tribox.h; do
    cmp "$file" "../again/$file"
done
touch -d @0 ./*
! python3 "$root/packaging/amalgamate.py" . 2>../log && grep -q 'there already' ../log || die 'it writes over what is there'
test -z "$(find . -type f -newermt @0)" || die 'it wrote over what was there'

compilers='gcc clang'
test "$how" != elsewhere || compilers='aarch64-linux-gnu-gcc i686-linux-gnu-gcc x86_64-w64-mingw32-gcc-posix clang-19'
for compiler in $compilers; do
    options=-fPIC of_digests='' emulator=env
    case $compiler in
    clang) test "$how" = O2 || level=-O0 ;; # a sixth of the time; what it warns of depends on no level
    aarch64*) emulator='qemu-aarch64 -L /usr/aarch64-linux-gnu' ;;
    i686*) emulator='qemu-i386 -L /usr/i686-linux-gnu -cpu Nehalem' of_digests='-msse2 -mfpmath=sse' ;;
    *mingw*) emulator="$root/tests/windows/wine.sh $work" options=-Wno-float-conversion ;; # of that system's macro signbit
    clang-19) options='--target=wasm32-wasi -msimd128' && test -e /usr/lib/wasm32-wasi/libc.a || continue ;;
    esac
    { command -v "$compiler" && command -v "${emulator%% *}"; } >/dev/null || continue
    has_any=1
    # shellcheck disable=SC2086
    $compiler $options -std=c11 -Wall -Wextra -Wpedantic -Wconversion -Werror $level -c tribox.c -o object.o
    test "$compiler" != clang-19 || continue
    # shellcheck disable=SC2086
    build_digests ./digests.exe "$root" object.o "$compiler" $of_digests -O1
    $emulator ./digests.exe "$root/tests/cross/masks.txt" --short
    test "$how" != elsewhere || continue

    "$compiler" -E -dM tribox.c | sed 's/^#define \([A-Za-z0-9_]*\).*/\1/' | sort >left
    sed -n 's/^#define \([A-Za-z0-9_]*\).*/\1/p' tribox.c | grep -v '^TRIBOX_WITHOUT' | sort -u | comm -12 - left >macros
    test ! -s macros || die "$compiler: macros that are left: $(tr '\n' ' ' <macros)"
    "$compiler" -shared object.o -lm -o shared.so
    nm -D --defined-only shared.so | awk '{ print $NF }' | LC_ALL=C sort >exported
    "$root/packaging/symbols.sh" | diff - exported || die "exported (>) are not the functions of the header (<)"

    test -n "$CXX" || continue
    ! $CXX -fsyntax-only -x c++ tribox.c 2>log && grep -q 'error.*tribox.c is C' log || die 'as C++ it does not say that it is C'
    echo '#include "tribox.h"
        int main() { return tribox_mask_words(65) != 2 || tribox_fill_join(nullptr, nullptr, 0, nullptr, 0, 0); }' >main.cpp
    $CXX $SANITIZER -std=c++11 -Wall -Wextra -Wpedantic -Werror main.cpp object.o -lm -o main
    ./main
done
test -n "$has_any" || skip 'no compiler'
