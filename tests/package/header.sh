#!/bin/sh
# The header compiles alone, in C11 and in C++: header.sh INCLUDE
set -eu
alone() { echo '#include "tribox.h"' | "$@" -Wall -Wextra -Wpedantic -Wconversion -Werror -fsyntax-only -; }

alone $CC -std=c11 -I"$1" -x c
if test -n "$CXX"; then
    for standard in c++11 c++17; do
        alone $CXX -std=$standard -Wold-style-cast -I"$1" -x c++
    done
fi
