#!/bin/sh
# A program in C and in C++ finds the installed library through CMake.
. "$(dirname "$0")/installed.sh"

test -n "$(find "$root" -name triboxConfig.cmake)" || die "no CMake package is installed"
export CC="${CC##* }" CXX="${CXX##* }" CFLAGS="$SANITIZER" CXXFLAGS="$SANITIZER"
cmake -S "$here/consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release
cmake --build "$work/build"
for program in consumer_c consumer_cxx; do
    LD_LIBRARY_PATH=$libdir "$work/build/$program" || die "$program: fails"
done
