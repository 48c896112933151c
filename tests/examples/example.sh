#!/bin/sh
# An example compiles by the line in its first comment, against the installed library, and prints what it should:
# example.sh EXAMPLE EXPECTED.txt
# In EXPECTED.txt "*" stands for a time or a word that differs between machines.
. "$(dirname "$0")/../package/parts.sh"
install_build

source=$1 expected=$2
name=$(basename "$source")
export PKG_CONFIG_LIBDIR="$libdir/pkgconfig" PKG_CONFIG_SYSROOT_DIR="$root"
export PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 PKG_CONFIG_ALLOW_SYSTEM_LIBS=1 LD_LIBRARY_PATH="$libdir"

line=$(sed -n 's/^ \*     \(cc .*\)/\1/p; s/^ \*     c++ \(.*\)/cxx \1/p' "$source")
test -n "$line" || die "$source does not say how it is compiled"
mkdir "$work/bin"
ln -s "$PKG_CONFIG" "$work/bin/pkg-config"
cp "$source" "$(dirname "$source")/large_pages.h" "$work"
cd "$work"
# The compiler of this build, and no warning from it.
warnings='-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror'
cc() { command $CC $SANITIZER $warnings -Wstrict-prototypes "$@"; }
cxx() { command $CXX $SANITIZER $warnings -Wold-style-cast "$@"; }
(PATH=$work/bin:$PATH && eval "$line") >printed || die "$line: fails"
test -s printed || die "$name prints nothing"

awk '
    NR == FNR { wanted[NR] = $0; lines = NR; next }
    {
        count = split(wanted[FNR], word)
        is_same = count == NF
        for (i = 1; i <= count; i++)
            is_same = is_same && (word[i] == "*" || word[i] == $i)
    }
    !is_same { print "line " FNR ": \"" $0 "\" and not \"" wanted[FNR] "\""; is_wrong = 1 }
    END {
        if (FNR != lines)
            print FNR " lines and not " lines
        exit is_wrong || FNR != lines
    }
' "$expected" printed >&2 || die "$name: a wrong answer"
