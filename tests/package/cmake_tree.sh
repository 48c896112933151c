#!/bin/sh
# CMake builds the library from its source, static and shared, for a project that takes it in any of CMake's ways:
# cmake_tree.sh ROOT LIBRARY
#   FetchContent, add_subdirectory, and find_package of what is installed and then moved
#   the kernels and the exported symbols are those of LIBRARY, meson's shared one, and the answers have the digests of tests/cross
# Not optimised, and compiled once: all ways share a build folder, as each is to give the same files the same flags.
. "$(dirname "$0")/parts.sh"
root=$1 library=$2
export CC="${CC##* }" CXX="${CXX##* }" CFLAGS="-Werror" # these warnings are the compiler's defaults

snapshot "$root" "$work/repository"
version=$("$root/packaging/version.sh")
git -C "$work/repository" -c user.name=test -c user.email=test@localhost -c commit.gpgsign=false commit -q --allow-empty -m later
git -C "$work/repository" tag "v$version"
$CC -I"$root/include" "$here/consumer/consumer.c" "$library" -Wl,-rpath,"${library%/*}" -o "$work/by_meson"
"$work/by_meson" kernels >"$work/kernels"

# build NAME OPTION...: the project, in the folder build
build() {
    name=$1
    shift
    cmake -S "$here/consumer" -B "$work/build" -DCMAKE_BUILD_TYPE=None "$@" >"$work/log" 2>&1 &&
        cmake --build "$work/build" --parallel 2 >>"$work/log" 2>&1 || { cat "$work/log"; die "$name: does not build"; }
}

# right TARGET...: the programs in C and C++ that are linked with these
right() {
    for target; do
        for program in "$target"_c "$target"_cxx; do
            printed=$("$work/build/$program") || die "$name: $program fails"
            test "$printed" = "$version" || die "$name: $program says version $printed, the header $version"
            "$work/build/$program" kernels | diff "$work/kernels" - || die "$name: other kernels (>) than meson's library (<)"
        done
    done
    echo "$name: right"
}

# install PREFIX: what was built, as a part of another project, and moved from where it was installed
install() {
    cmake --install "$work/build/_deps/tribox-build" --prefix "$work/first" >/dev/null
    mv "$work/first" "$1"
}

build FetchContent -DFETCHED="file://$work/repository" -DTAG="v$version"
right tribox static
cmake --install "$work/build" --prefix "$work/none" >/dev/null
test ! -e "$work/none" || die "$name: is installed with the project, which did not ask for it"
grep -q 'Building C object _deps/' "$work/log" || die "FetchContent: nothing was compiled"
test "$(git -C "$work/build/_deps/tribox-src" rev-list --count HEAD)" = 1 || die "FetchContent: the history is fetched"
build add_subdirectory -DTRIBOX_INSTALL=ON -DFETCHED= -DADDED="$work/build/_deps/tribox-src"
right tribox static
! grep 'Building C object _deps/' "$work/log" || die "add_subdirectory: compiled again"
build_digests "$work/masks" "$root" "$work/build/_deps/tribox-build/libtribox.a" $CC
"$work/masks" "$root/tests/cross/masks.txt" --short
install "$work/static"
build add_subdirectory,shared -DBUILD_SHARED_LIBS=ON
right tribox
install "$work/shared"
sh "$here/shared.sh" nm readelf "$work/shared/lib/libtribox.so" "$root"

for kind in static shared; do
    rm -r "$work/build"
    prefix=$work/$kind
    build "find_package,$kind" -DCMAKE_PREFIX_PATH="$prefix"
    test $kind = static && right tribox static || right tribox
    flags=$(PKG_CONFIG_PATH=$prefix/lib/pkgconfig pkg-config --cflags --libs tribox)
    $CC "$here/consumer/consumer.c" $flags -Wl,-rpath,"$prefix/lib" -o "$work/by_pkg_config"
    test "$("$work/by_pkg_config")" = "$version" || die "pkg-config,$kind: fails"
done
