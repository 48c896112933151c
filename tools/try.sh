#!/bin/sh
# From a clone on a Debian machine to the demo: packages, build, run. The build stays in build/.
set -eu
cd "$(dirname "$0")/.."
tools/packages.sh gcc libc6-dev meson ninja-build pkgconf libassimp-dev
test -d build || meson setup build -Dtools=enabled -Dtests=disabled -Dbench=disabled
meson compile -C build
exec build/tools/tribox demo
