#!/bin/sh
# Makes all that is published of a version, from its tag alone and bit for bit again: packaging/release.sh TAG FOLDER, a new one.
# PARTS are those that are made, all by default: source two_files debian wheels npm rust windows. They take
# what tests/run.sh and .ci/run install. OPTIMIZATION=0 builds quickly, for the tests; DEB_BUILD_OPTIONS are those of debian.sh.
set -eu
umask 022
export LC_ALL=C TZ=UTC

die() {
    echo "release.sh: $*" >&2
    exit 1
}

test $# -eq 2 || die "usage: packaging/release.sh TAG FOLDER"
tag=$1 root=$(cd "$(dirname "$0")/.." && pwd)
test ! -e "$2" || rmdir "$2" 2>/dev/null || die "$2 is there already: remove it, or name another folder"
git -C "$root" rev-parse -q --verify "refs/tags/$tag" >/dev/null || die "there is no tag $tag: git tag -a $tag"
test -z "$(git -C "$root" status --porcelain)" || die "the tree has changes that are in no commit: see git status"
mkdir -p "$2"
folder=$(cd "$2" && pwd)
work=$(mktemp -d)
ended() {
    test "$1" -eq 0 || rmdir "$folder"
    test "$1" -eq 0 || test ! -s "$work/log" || tail -n 50 "$work/log" >&2
    rm -rf "$work"
}
trap 'ended $?' EXIT
git clone -q "$root" "$work/tribox"
git -C "$work/tribox" checkout -q "refs/tags/$tag"
version=$("$work/tribox/packaging/version.sh")
test "$tag" = "v$version" || die "$tag is version $version, whose tag is v$version"
SOURCE_DATE_EPOCH=$(git -C "$work/tribox" log -1 --format=%ct)
export SOURCE_DATE_EPOCH
out=$work/out name=tribox-$version
mkdir "$out"
cd "$work/tribox"

make_source() {
    git archive --prefix="$name/" HEAD | xz >"$out/$name.tar.xz"
}

# A folder in $work as an archive.
zip_of() {
    cp LICENSE "$work/$1"
    find "$work/$1" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
    (cd "$work" && python3 -m zipfile -c "$out/$1.zip" "$1")
}

make_two_files() {
    packaging/amalgamate.py "$work/$name-two-files"
    zip_of "$name-two-files"
}

# The rest of what dpkg-buildpackage writes says when it ran.
make_debian() {
    packaging/debian.sh "$work/debian"
    (cd "$work/debian" && mv ./*.deb ./*.dsc ./*.tar.xz "$out")
}

make_wheels() {
    for compiler in cc aarch64-linux-gnu-gcc x86_64-w64-mingw32-gcc-posix; do
        CC=$compiler CFLAGS=-O${OPTIMIZATION:-3} "${PYTHON:-/usr/bin/python3}" -m build --wheel --no-isolation --outdir "$out" .
    done
}

make_npm() {
    packaging/npm/build.sh "$work/npm"
    (cd "$out" && npm pack --silent "$work/npm")
}

make_rust() {
    packaging/rust/build.sh "$work/rust"
    (cd "$work/rust" && CARGO_TARGET_DIR=$work/target cargo package --offline --no-verify)
    mv "$work"/target/package/*.crate "$out"
}

make_windows() {
    meson setup "$work/windows" --cross-file tests/cross/windows.ini -Dprefix=/ -Dtests=disabled -Dbench=disabled -Dtools=enabled \
        -Dopenvdb=disabled -Dpython=disabled -Doptimization="${OPTIMIZATION:-3}" -Dc_link_args=-s
    meson compile -C "$work/windows"
    meson install -C "$work/windows" --no-rebuild --quiet --destdir "$work/$name-windows-x64"
    rm -r "$work/$name-windows-x64/share" # manual pages, and completion for shells that are not there
    zip_of "$name-windows-x64"
}

for part in ${PARTS:-source two_files debian wheels npm rust windows}; do
    "make_$part" >"$work/log" 2>&1
    echo "$part: made"
done
: >"$work/log"
cd "$out"
sha256sum -- * >SHA256SUMS
mv -- * "$folder"
