#!/bin/sh
# The shared library has its name, and exports the public functions and nothing else: shared.sh NM READELF LIBRARY SYMBOLS
set -eu
nm=$1 readelf=$2 library=$3 symbols=$4

soname=$("$readelf" -d "$library" | sed -n 's/.*(SONAME).*\[\(.*\)\].*/\1/p')
if test "$soname" != libtribox.so.0; then
    echo "the SONAME is '$soname' and should be libtribox.so.0" >&2
    exit 1
fi
if ! "$nm" -D --defined-only "$library" | awk '{ print $NF }' | LC_ALL=C sort | diff -u "$symbols" -; then
    echo "the exported symbols (+) are not those of symbols.txt (-); a new public function belongs in both" >&2
    exit 1
fi
