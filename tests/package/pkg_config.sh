#!/bin/sh
# A program in C and in C++ finds the installed library through pkg-config, shared and static, and gets right answers.
. "$(dirname "$0")/parts.sh"
install_build

export PKG_CONFIG_LIBDIR="$libdir/pkgconfig" PKG_CONFIG_SYSROOT_DIR="$root"
export PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 PKG_CONFIG_ALLOW_SYSTEM_LIBS=1
version=$($PKG_CONFIG --modversion tribox)

# build_and_run NAME COMPILER FLAGS...
build_and_run() {
    name=$1
    shift
    "$@" $SANITIZER -Wall -Wextra -Wpedantic -Werror $($PKG_CONFIG --cflags tribox) "$here/consumer/consumer.c" -o "$work/$name" \
        -x none $($PKG_CONFIG $static --libs tribox) || die "$name: does not build against the installed library"
    printed=$(LD_LIBRARY_PATH=$libdir "$work/$name") || die "$name: fails"
    test "$printed" = "$version" || die "$name: the header says version $printed, tribox.pc says $version"
    echo "$name: right, version $version"
}

both_languages() {
    build_and_run "$1-c11" $CC -std=c11
    if test -n "$CXX"; then
        build_and_run "$1-c++17" $CXX -std=c++17 -x c++
    fi
}

if ls "$libdir"/libtribox.so* >/dev/null 2>&1; then
    static=
    both_languages shared
    # BUILD.md's way to the static library where the shared one is installed too.
    if ls "$libdir"/libtribox.a >/dev/null 2>&1; then
        $CC $SANITIZER "$here/consumer/consumer.c" $($PKG_CONFIG --cflags --libs-only-L tribox) -l:libtribox.a -lm -o "$work/chosen"
        "$work/chosen" >"$work/printed" || die "static beside shared: fails"
    fi
    rm "$libdir"/libtribox.so*
fi
if ls "$libdir"/libtribox.a >/dev/null 2>&1; then
    static=--static
    both_languages static
fi
test -x "$work/shared-c11" || test -x "$work/static-c11" || die "no library is installed in $libdir"
