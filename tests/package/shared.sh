#!/bin/sh
# The shared library has its name, and exports the functions of the header and nothing else. Debian's list of symbols has the same.
# shared.sh NM READELF LIBRARY ROOT
. "$(dirname "$0")/parts.sh"
nm=$1 readelf=$2 library=$3 root=$4

soname=$("$readelf" -d "$library" | sed -n 's/.*(SONAME).*\[\(.*\)\].*/\1/p')
test "$soname" = libtribox.so.1 || die "the SONAME is '$soname' and should be libtribox.so.1"
"$root/packaging/symbols.sh" >"$work/header"
test -s "$work/header" || die "the header declares no function"
"$nm" -D --defined-only "$library" | awk '{ print $NF }' | LC_ALL=C sort | diff -u "$work/header" - ||
    die "the exported symbols (+) are not the functions of include/tribox.h (-)"
list=packaging/debian/libtribox1.symbols
sed -n 's/^ \(tribox_[a-z0-9_]*\)@.*/\1/p' "$root/$list" | diff -u "$work/header" - ||
    die "$list (+) does not list the functions of include/tribox.h (-)"
