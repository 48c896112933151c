#!/bin/sh
# From a clone on a Debian machine to the sum of all tests: packages, build with every optional part, run.
# Arguments go to `meson setup`; BUILD names the build directory, SUITES the suites (all of them), CC and CXX the compilers,
# PACKAGES what else is to be installed. `run.sh packages` installs and ends there.
set -eu
cd "$(dirname "$0")/.."
# shellcheck disable=SC2086
packaging/packages.sh ${PACKAGES:-} gcc g++ libc6-dev meson ninja-build pkgconf cmake python3 qemu-user valgrind \
    libassimp-dev libpng-dev zlib1g-dev libopenvdb-dev \
    libcmocka-dev libgmp-dev libembree-dev libcgal-dev libmpfr-dev libbullet-dev \
    python3-numpy python3-cffi python3-cffi-backend mypy python3-dask python3-distributed python3-zarr \
    parallel openmpi-bin python3-mpi4py \
    libopenvdb-tools python3-openvdb python3-vtk9 teem-apps \
    git xz-utils mandoc groff man-db debhelper dh-python devscripts lintian fakeroot dpkg-dev \
    gcc-aarch64-linux-gnu libc6-dev-arm64-cross gcc-arm-linux-gnueabihf libc6-dev-armhf-cross \
    gcc-s390x-linux-gnu libc6-dev-s390x-cross
test "${1-}" != packages || exit 0
build=${BUILD:-build-tests}
# C++ is CGAL and OpenVDB, a minute of templates if it is optimised.
test -d "$build" || meson setup "$build" --werror -Dtools=enabled -Dtests=enabled -Dbench=enabled -Dembree=enabled -Dpeers=enabled \
    -Dpython=enabled -Dcpp_args=-O0 "$@"
status=0
suites=
for suite in ${SUITES:-}; do suites="$suites --suite $suite"; done
# It builds what these tests need: no benchmark, and no test of the suites that are left out. One more than there are processors:
# engines and servers wait for each other. A limit of time is for what hangs, not for a machine that has other work.
# shellcheck disable=SC2086
log=$build/meson-logs/testlog.json
rm -f "$log"
meson test -C "$build" --print-errorlogs --timeout-multiplier 3 --num-processes $(($(nproc) + 1)) $suites || status=$?
test -e "$log" || echo '{"name": "build", "result": "FAIL"}' >"$log"
python3 tests/sum.py "$log"
exit "$status"
