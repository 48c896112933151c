#!/bin/sh
# Builds the Debian packages of the commit that is checked out, source and binary, into a folder: debian.sh FOLDER
# They are described in packaging/debian/. Debian's tools look for it at the top, where a tarball from upstream should have none.
# DEB_BUILD_OPTIONS are Debian's: nocheck, noopt, parallel=N. Needs the packages debhelper, dpkg-dev, fakeroot.
set -eu
mkdir -p "$1"
out=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
version=$(packaging/version.sh)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

git archive --prefix="tribox-$version/" HEAD | xz >"$work/tribox_$version.orig.tar.xz"
tar -x -C "$work" -f "$work/tribox_$version.orig.tar.xz"
mkdir "$work/tribox-$version/debian"
git archive HEAD:packaging/debian | tar -x -C "$work/tribox-$version/debian"
(cd "$work/tribox-$version" && dpkg-buildpackage -us -uc)
find "$work" -maxdepth 1 -type f -exec mv {} "$out" \;
