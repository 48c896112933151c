# installed.sh - read by the scripts beside it: installs the build BUILD into an empty folder.
# Sets $work, removed at exit, and $root, $prefix, $libdir in it. Wants $MESON.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

root=$work/root
"$MESON" install -C "$BUILD" --no-rebuild --quiet --destdir "$root"
header=$(find "$root" -name tribox.h)
prefix=${header%/include/tribox.h}
libdir=$(dirname "$(find "$root" -name 'libtribox.*' | head -n 1)")

die() {
    echo "$*" >&2
    exit 1
}
test -n "$header" || die "tribox.h is not installed"
