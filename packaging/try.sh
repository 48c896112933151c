#!/bin/sh
# From a clone on a Debian machine to the demo: packages, build, run. The build stays in build/, the picture of the
# demo in the folder that this was started in.
set -eu
here=$PWD
cd "$(dirname "$0")/.."
packaging/packages.sh gcc libc6-dev meson ninja-build pkgconf libassimp-dev libpng-dev
test -d build || meson setup build -Dtools=enabled -Dtests=disabled -Dbench=disabled
meson compile -C build
program=$PWD/build/tools/tribox
cd "$here"
exec "$program" demo
