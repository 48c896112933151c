#!/bin/sh
# A program in C and in C++ finds the installed library through CMake, shared and static, in a version that serves it.
. "$(dirname "$0")/parts.sh"
install_build

test -n "$(find "$root" -name triboxConfig.cmake)" || die "no CMake package is installed"
export CC="${CC##* }" CXX="${CXX##* }" CFLAGS="$SANITIZER" CXXFLAGS="$SANITIZER"

# The package finds its paths from its own place, so that the installed tree may move.
mv "$root" "$root.moved"
prefix=$root.moved${prefix#"$root"} libdir=$root.moved${libdir#"$root"}

# answer REQUEST: 1 and the version, if CMake takes the installed package for it
answer() {
    rm -rf "$work/versions"
    cmake -S "$here/versions" -B "$work/versions" -DCMAKE_PREFIX_PATH="$prefix" -DREQUEST="$1" >/dev/null
    cat "$work/versions/found"
}

version=$(sed -n 's/^Version: //p' "$libdir/pkgconfig/tribox.pc")
major=${version%%.*} minor=${version#*.}
minor=${minor%%.*}
for request in '' "$version" "$major" "$major.$minor" "$version EXACT" "0.0...$major.$minor.99" "$major.$minor...<99"; do
    test "$(answer "$request")" = "1 $version" || die "CMake does not find version '$request' where $version is installed"
done
for request in 0 99 "$major.$((minor + 1))" "$version.1 EXACT" "0.0...<$version" "$major.$((minor + 1))...99"; do
    ! answer "$request" | grep -q '^1 ' || die "CMake finds version '$request' where $version is installed"
done

cmake -S "$here/consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release
cmake --build "$work/build"

# built NAME: both programs that were linked with the target of that name give right answers
built() {
    for program in "$1_c" "$1_cxx"; do
        printed=$(LD_LIBRARY_PATH=$libdir "$work/build/$program") || die "$program: fails"
        test "$printed" = "$version" || die "$program: the header says version $printed, tribox.pc says $version"
        echo "$program: right, version $printed"
    done
}

if ls "$libdir"/libtribox.so* >/dev/null 2>&1; then
    built tribox
    rm "$libdir"/libtribox.so*
fi
if test -f "$libdir/libtribox.a"; then
    built static
fi
