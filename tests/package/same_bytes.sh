#!/bin/sh
# Two builds of the libraries in different folders are the same, byte for byte: same_bytes.sh ROOT
#   as a release, whatever the way from one folder to the other
#   with debug information, for which the compiler has to be told to forget where the source lay
# Not optimised, in a third of the time: what tells folders apart is in paths, dates and archives.
set -eu
root=$1
version=$("$root/packaging/version.sh")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export CCACHE_DISABLE=1 # or the second build would be a copy of the first

# build SOURCE BUILD ARGUMENTS...: a copy of the tree, built
build() {
    source=$work/$1 build=$work/$2
    shift 2
    mkdir -p "$source"
    for part in include src tools python packaging bench tests README.md meson.build meson_options.txt; do
        cp -R "$root/$part" "$source"
    done
    "$MESON" setup "$build" "$source" -Dtests=disabled -Dbench=disabled -Dtools=disabled -Doptimization=0 "$@" >/dev/null
    "$MESON" compile -C "$build" >/dev/null
}

# same BUILD BUILD: what was built there
same() {
    for name in libtribox.a "libtribox.so.$version"; do
        cmp "$work/$1/src/$name" "$work/$2/src/$name" || exit 1
        if grep -q "$work" "$work/$1/src/$name"; then
            echo "$name has the folder that it was built in" >&2
            exit 1
        fi
        echo "$1: $name is the same"
    done
}

build release release/build
build release-longer/again build-elsewhere
same release/build build-elsewhere

build debug debug/build -Ddebug=true -Dc_args="-ffile-prefix-map=$work/debug=."
build debug-longer/again debug-longer/again/build -Ddebug=true \
    -Dc_args="-ffile-prefix-map=$work/debug-longer/again=."
same debug/build debug-longer/again/build
