#!/bin/sh
# Builds this project another way and runs tests there: elsewhere.sh ROOT FOLDER NAME TESTS OPTION...
#   NAME     of the build, which is kept in a folder of that name in FOLDER
#   TESTS    their names, joined by commas; all: every one of the suites kernels and cross
#   OPTION   for meson setup: a cross file, an optimisation
# Skipped where the compiler or the emulator is not there. Wants $MESON.
set -eu
root=$1 folder=$2/$3 tests=$4
shift 4

# has_programs CROSS_FILE: the compiler that it names, its library where that is apart, and the emulator.
has_programs() {
    # shellcheck disable=SC2013
    for program in $(sed -nE "s/^(c|clang|libc|exe_wrapper) = \[?'([^']*)'.*/\2/p" "$1"); do
        command -v "$program" >/dev/null || test -e "$program" || { echo "no $program: skipped"; return 1; }
    done
}
for option; do
    case $option in --cross-file=*) has_programs "${option#--cross-file=}" || exit 77 ;; esac
done
command -v "${CC:-cc}" >/dev/null || { echo "no ${CC:-cc}: skipped"; exit 77; }

# In the folder itself: cmake, which meson asks for its version, writes into the current one, and others may run beside.
mkdir -p "$folder"
cd "$folder"
test -f build.ninja || "$MESON" setup . "$root" --werror -Dbench=disabled -Dtools=disabled -Dembree=disabled "$@"
set -- --suite kernels --suite cross
if test "$tests" != all; then
    set --
    IFS=,
    # shellcheck disable=SC2086
    set -- $tests
fi
"$MESON" test --print-errorlogs "$@"
