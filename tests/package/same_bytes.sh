#!/bin/sh
# Two builds of the libraries in different folders are the same, byte for byte: same_bytes.sh ROOT
# With debug information, for which the compiler has to be told to forget where the source lay; without, see release.sh.
# Not optimised, in a third of the time: what tells folders apart is in paths, dates and archives.
. "$(dirname "$0")/parts.sh"
root=$1
version=$("$root/packaging/version.sh")
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

build debug debug/build -Ddebug=true -Dc_args="-ffile-prefix-map=$work/debug=."
build debug-longer/again debug-longer/again/build -Ddebug=true \
    -Dc_args="-ffile-prefix-map=$work/debug-longer/again=."
same_library "$work" "$version" "$work/debug/build" "$work/debug-longer/again/build"
