#!/bin/sh
# The Debian packages build, lintian neither errs nor warns, and what is in them works: debian.sh ROOT [DEB_BUILD_OPTIONS]
# By default they are built without optimisation and tests, which take minutes: 'parallel=2' builds them as Debian would.
. "$(dirname "$0")/parts.sh"
root=$1
export DEB_BUILD_OPTIONS="${2-noopt nocheck}"

for program in dpkg-buildpackage dh lintian fakeroot; do
    command -v $program >/dev/null || skip "there is no $program"
done
snapshot "$root" "$work/repository"
cp -R "$root/packaging/debian" "$work/debian"
(cd "$work" && dpkg-checkbuilddeps) || skip "a package to build with is missing"

# The compilers and flags of a package are Debian's.
env -u CC -u CXX -u CFLAGS -u CXXFLAGS -u LDFLAGS "$work/repository/packaging/debian.sh" "$work/out" >"$work/log" 2>&1 || {
    tail -n 60 "$work/log" >&2
    exit 1
}
lintian --allow-root --fail-on error,warning "$work"/out/*.changes

# What Debian would test on a machine with the packages installed, with the packages unpacked.
for package in libtribox1 libtribox-dev tribox tribox-openvdb python3-tribox; do
    dpkg -x "$work/out/${package}_"*.deb "$work/unpacked"
done
libdir=$(dirname "$(find "$work/unpacked" -name libtribox.a)")
export PKG_CONFIG_LIBDIR="$libdir/pkgconfig" PKG_CONFIG_SYSROOT_DIR="$work/unpacked"
export PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 PKG_CONFIG_ALLOW_SYSTEM_LIBS=1
export PYTHONPATH="$work/unpacked/usr/lib/python3/dist-packages"
export CMAKE_PREFIX_PATH="$work/unpacked/usr" LD_LIBRARY_PATH="$libdir" PATH="$work/unpacked/usr/bin:$PATH"
cd "$work/repository"
for test in consumer program module; do
    mkdir "$work/$test"
    AUTOPKGTEST_TMP=$work/$test packaging/debian/tests/$test
done
