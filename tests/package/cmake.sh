#!/bin/sh
# A program in C and in C++ finds the installed library through CMake.
. "$(dirname "$0")/installed.sh"

if test -z "$(find "$root" -iname 'tribox*config.cmake')"; then
    echo "no CMake package is installed: skipped"
    exit 77
fi
CC=${CC%% *} CXX=${CXX%% *} cmake -S "$here/consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release
cmake --build "$work/build"
for program in consumer_c consumer_cxx; do
    LD_LIBRARY_PATH=$libdir "$work/build/$program" || die "$program: fails"
done
