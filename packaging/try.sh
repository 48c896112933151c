#!/bin/sh
# From a clone on a Debian machine to the demo: installs packages, builds, runs. The build stays in build/; the demo leaves its
# picture in the current folder.
set -eu
here=$PWD
cd "$(dirname "$0")/.."
packaging/packages.sh gcc libc6-dev meson ninja-build pkgconf libpng-dev
test -d build || meson setup build -Dtools=enabled -Dtests=disabled -Dbench=disabled
meson compile -C build
program=$PWD/build/tools/tribox
cd "$here"
exec "$program" demo
