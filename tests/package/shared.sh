#!/bin/sh
# The shared library has its name, and exports the functions of the header and nothing else. Debian's list of symbols has the same.
# shared.sh NM READELF LIBRARY ROOT
set -eu
nm=$1 readelf=$2 library=$3 root=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

soname=$("$readelf" -d "$library" | sed -n 's/.*(SONAME).*\[\(.*\)\].*/\1/p')
if test "$soname" != libtribox.so.1; then
    echo "the SONAME is '$soname' and should be libtribox.so.1" >&2
    exit 1
fi
"$root/packaging/symbols.sh" >"$work/header"
test -s "$work/header" || { echo "the header declares no function" >&2; exit 1; }
if ! "$nm" -D --defined-only "$library" | awk '{ print $NF }' | LC_ALL=C sort | diff -u "$work/header" -; then
    echo "the exported symbols (+) are not the functions of include/tribox.h (-)" >&2
    exit 1
fi
list=packaging/debian/libtribox1.symbols
if ! sed -n 's/^ \(tribox_[a-z0-9_]*\)@.*/\1/p' "$root/$list" | diff -u "$work/header" -; then
    echo "$list (+) does not list the functions of include/tribox.h (-)" >&2
    exit 1
fi
