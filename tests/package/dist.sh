#!/bin/sh
# `meson dist` makes the same tarball twice, byte for byte, of what is committed and nothing else, and the library that builds from
# it is that of a clone: dist.sh ROOT
set -eu
root=$1
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. "$here/snapshot.sh"
. "$here/same_library.sh"
export CCACHE_DISABLE=1 # or the second library would be a copy of the first

only_library='-Dtests=disabled -Dbench=disabled -Dtools=disabled -Doptimization=0'
snapshot "$root" "$work/repository"
version=$("$root/packaging/version.sh")
name=tribox-$version

# tarball NAME UMASK: what meson dist writes from a clone of its own
tarball() (
    umask "$2"
    git clone -q "$work/repository" "$work/$1"
    "$MESON" setup "$work/$1-build" "$work/$1" $only_library >/dev/null
    "$MESON" dist -C "$work/$1-build" --no-tests >/dev/null
    mv "$work/$1-build/meson-dist/$name.tar.xz" "$work/$1.tar.xz"
)

tarball one 022
sleep 1.1 # the clock's next second, which must not be in the tarball
tarball two 077
if ! cmp "$work/one.tar.xz" "$work/two.tar.xz"; then
    for each in one two; do tar -tv -f "$work/$each.tar.xz" >"$work/$each.list"; done
    diff "$work/one.list" "$work/two.list" >&2 || true
    exit 1
fi

mkdir "$work/unpacked"
tar -x -C "$work/unpacked" -f "$work/one.tar.xz"
git -C "$work/repository" ls-files | sort >"$work/committed"
(cd "$work/unpacked/$name" && find . ! -type d | sed 's,^\./,,' | sort) | diff "$work/committed" - >&2 ||
    { echo "the tarball lacks (<) or adds (>) these files" >&2; exit 1; }
# The library wants a C compiler and meson: the CMake package needs no CMake to be made.
mkdir "$work/bin"
printf '#!/bin/sh\necho "CMake was run" >&2\ntouch "%s"\nexit 1\n' "$work/asked" >"$work/bin/cmake"
chmod +x "$work/bin/cmake"
PATH=$work/bin:$PATH "$MESON" setup "$work/build" "$work/unpacked/$name" $only_library >/dev/null
test ! -e "$work/asked" || { echo "configuring the library runs CMake" >&2; exit 1; }
"$MESON" compile -C "$work/build" >/dev/null
"$MESON" install -C "$work/build" --no-rebuild --quiet --destdir "$work/root"
test "$(find "$work/root" -name tribox.h -o -name tribox.3 -o -name tribox.pc -o -name triboxConfig.cmake | wc -l)" = 4
# As a release, whatever the way from one folder to the other.
"$MESON" compile -C "$work/one-build" >/dev/null
same_library "$work" "$version" "$work/build" "$work/one-build"
echo "$name.tar.xz: $(sha256sum <"$work/one.tar.xz")"
