#!/bin/sh
# Measures the machine it runs on, and leaves tables and charts in bench/results/<processor>: record.sh [MESH...]
# Run it while the machine is idle; without building it takes a quarter of an hour. NAME=... names the folder, BUILD=... the build.
set -eu
cd "$(dirname "$0")/.."
packaging/packages.sh gcc g++ libc6-dev meson ninja-build pkgconf gnuplot-nox libassimp-dev libcgal-dev libgmp-dev libmpfr-dev \
    libembree-dev libbullet-dev libcmocka-dev
processor=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1 | tr 'A-Z' 'a-z' | tr -cs 'a-z0-9' '-')
processor=${processor%-}
results=bench/results/${NAME:-${processor:-unknown}}
build=${BUILD:-build-bench}
test -d "$build" || meson setup "$build" -Dpeers=enabled
meson compile -C "$build" accuracy ratios cgal inputs doubles:executable voxels:executable index:executable scale peers
mkdir -p "$results"
bench/accuracy/chart.sh "$build/bench/accuracy" bench/accuracy/accuracy.gp "$results" "$@"
rm "$results/accuracy.json" "$results/accuracy.csv" "$results/accuracy.svg" # the repository keeps the table and the short chart, trade.svg
"$build/bench/ratios" >"$results/ratios.txt"
"$build/bench/cgal" >"$results/cgal.txt"
{ "$build/bench/inputs" && "$build/bench/inputs" --kernel avx2; } >"$results/inputs.txt"
{ "$build/bench/doubles" && "$build/bench/doubles" --kernel avx2; } >"$results/doubles.txt"
"$build/bench/voxels" --limit 1 "$@" >"$results/voxels.txt"
"$build/bench/index" "$@" >"$results/index.txt"
"$build/bench/scale" "$@" >"$results/scale.txt"
"$build/tests/peers/peers" --csv "$results/peers.csv" "$@" >"$results/peers.txt"
gnuplot -c bench/index/index.gp "$results/peers.csv" "$results/index.svg"
rm "$results/peers.csv"
echo "$results: done; tables that say 'disturbed' were not measured on a quiet machine"
