#!/bin/sh
# The two files of packaging/amalgamate.py: the same bytes twice, nothing written over, no warning, no macro left, symbols of the
# header alone, and the answers of the library: two_files.sh ROOT here|O2|elsewhere
#   here       by gcc and clang for this machine; words are not forced inline, as that takes minutes; linked with C++ as well
#   O2         the same, as users compile them
#   elsewhere  for other processors and systems, emulated; for WebAssembly compiled alone
. "$(dirname "$0")/parts.sh"
root=$1 how=$2 level='-O1 -U__OPTIMIZE__' compiled=0
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

# compile PROGRAM...: an object, where there is such a compiler
compile() {
    command -v "$1" >/dev/null || return 1
    compiled=$((compiled + 1))
    # shellcheck disable=SC2086
    "$@" -std=c11 -Wall -Wextra -Wpedantic -Wconversion -Werror $level -c tribox.c -o "$1.o"
}

# answer EMULATOR COMPILER...: what the object of a compiler answers; the emulator is a command, or nothing
answer() {
    emulator=$1 name=$2
    shift
    build_digests "./$name.exe" "$root" "$name.o" "$@" -O1
    $emulator "./$name.exe" "$root/tests/cross/masks.txt" --short
}

if test "$how" = elsewhere; then
    ! compile aarch64-linux-gnu-gcc || answer 'qemu-aarch64 -L /usr/aarch64-linux-gnu' aarch64-linux-gnu-gcc
    ! compile i686-linux-gnu-gcc || answer 'qemu-i386 -L /usr/i686-linux-gnu -cpu Nehalem' i686-linux-gnu-gcc -msse2 -mfpmath=sse
    # The macro signbit of that system has a conversion that is not taken.
    ! compile x86_64-w64-mingw32-gcc-posix -Wno-float-conversion ||
        answer "$root/tests/windows/wine.sh $work" x86_64-w64-mingw32-gcc-posix
    ! compile clang-19 --target=wasm32-wasi -msimd128 || :
fi
test "$how" = elsewhere || for compiler in gcc clang; do
    compile "$compiler" -fPIC || continue
    answer '' "$compiler"

    "$compiler" -E -dM tribox.c | sed 's/^#define \([A-Za-z0-9_]*\).*/\1/' | sort >left
    sed -n 's/^#define \([A-Za-z0-9_]*\).*/\1/p' tribox.c | grep -v '^TRIBOX_WITHOUT' | sort -u | comm -12 - left >macros
    test ! -s macros || die "$compiler: macros that are left: $(tr '\n' ' ' <macros)"
    "$compiler" -shared "$compiler.o" -lm -o shared.so
    nm -D --defined-only shared.so | awk '{ print $NF }' | LC_ALL=C sort >exported
    "$root/packaging/symbols.sh" | diff - exported || die "exported (>) are not the functions of the header (<)"

    test -n "$CXX" || continue
    ! $CXX -fsyntax-only -x c++ tribox.c 2>log && grep -q 'error.*tribox.c is C' log || die 'as C++ it does not say that it is C'
    echo '#include "tribox.h"
        int main() { return tribox_mask_words(65) != 2 || tribox_fill_join(nullptr, nullptr, 0, nullptr, 0, 0); }' >main.cpp
    $CXX $SANITIZER -std=c++11 -Wall -Wextra -Wpedantic -Werror main.cpp "$compiler.o" -lm -o main
    ./main
done
test "$compiled" -gt 0 || skip 'no compiler'
