#!/bin/sh
# tribox.hpp by a compiler: as C++17 and C++20 its test passes, and the examples compile without exceptions:
# compilers.sh ROOT LIBDIR COMPILER FLAG... STANDARDS names others, or none.
. "$(dirname "$0")/../package/parts.sh"
root=$1 libdir=$2
shift 2
for standard in ${STANDARDS-c++17 c++20}; do
    "$@" -Werror -std=$standard -I"$root/include" "$here/test_hpp.cc" -L"$libdir" -ltribox -Wl,-rpath,"$libdir" -o "$work/test_hpp"
    "$work/test_hpp"
done
for example in octree voxelize; do
    "$@" -Werror -std=c++17 -fno-exceptions -fno-rtti -fsyntax-only -I"$root/include" "$root/examples/$example.cpp"
done
