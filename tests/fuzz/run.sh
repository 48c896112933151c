#!/bin/sh
# Lets libFuzzer look for inputs that break a promise or the memory: tests/fuzz/run.sh SECONDS [TARGET...], two targets at a time.
#
# Needs clang and its runtime (libclang-rt-14-dev). BUILD names the build directory, FUZZ_OPTIONS further options for meson setup,
# CORPUS the folder of what is found on the way, where a later run goes on. An input that fails stays in $BUILD/found; the program,
# given that file, repeats the failure.
set -eu
seconds=${1:?'usage: run.sh SECONDS [TARGET...]'}
shift
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${BUILD:-$root/build-fuzz}
targets=${*:-triangles index cells grid files meshes}

# Kernels without forced inlining compile in seconds; counters of edges alone cost half of what comparisons would.
# shellcheck disable=SC2086
test -d "$build" || CC=${CC:-clang} meson setup "$build" "$root" -Dbuildtype=plain -Doptimization=2 -Ddefault_library=static \
    -Db_sanitize=address,undefined -Db_lundef=false -Dtests=enabled -Dbench=disabled -Dembree=disabled \
    ${FUZZ_OPTIONS:--Dtools=disabled} \
    "-Dc_args=-U__OPTIMIZE__ -fsanitize-coverage=inline-8bit-counters,pc-table -fno-sanitize-recover=all -gline-tables-only"
programs=tests/fuzz/seeds.txt
for target in $targets; do programs="$programs tests/fuzz/fuzz_$target"; done
# shellcheck disable=SC2086
ninja -C "$build" $programs

build=$(cd "$build" && pwd)
corpus=${CORPUS:-$build/corpus}
mkdir -p "$build/found" "$build/logs" "$corpus"
corpus=$(cd "$corpus" && pwd)
TMPDIR=$(mktemp -d)
export TMPDIR
running=
trap 'rm -rf "$TMPDIR"' EXIT
trap 'kill $running; exit 1' HUP INT TERM

# Of two at a time each may take twice its share.
# shellcheck disable=SC2086
set -- $targets
share=$((2 * seconds / $#))
test "$share" -gt 0 || share=1

# In the background, as a process of its own.
fuzz()
{
    mkdir -p "$corpus/$1"
    dictionary=
    case $1 in files | meshes) dictionary=-dict=$build/tests/fuzz/seeds/words ;; esac
    seeds=$build/tests/fuzz/seeds/$1
    test ! -d "$here/found/$1" || seeds="$seeds $here/found/$1"
    cd "$TMPDIR"
    # shellcheck disable=SC2086
    exec "$build/tests/fuzz/fuzz_$1" -max_total_time="$share" -max_len=1500 -len_control=0 -timeout=20 -rss_limit_mb=2000 \
        -print_final_stats=1 -artifact_prefix="$build/found/$1-" $dictionary "$corpus/$1" $seeds \
        >"$build/logs/$1" 2>&1 </dev/null
}

report()
{
    executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$build/logs/$1")
    coverage=$(sed -n 's/.*cov: \([0-9]*\) ft: .*/\1/p' "$build/logs/$1" | tail -n 1)
    printf '%-10s %9s executions, %5s edges\n' "$1" "${executions:-0}" "${coverage:-0}"
}

tell_failure()
{
    echo "FAILED: $build/tests/fuzz/fuzz_$1, for an input in $build/found"
    grep -E 'broken: |ERROR: |SUMMARY: |runtime error|Test unit written' "$build/logs/$1" || tail -n 20 "$build/logs/$1"
    status=1
}

status=0
while test $# -gt 0; do
    fuzz "$1" &
    first=$! second=
    running=$first
    test $# -eq 1 || { fuzz "$2" & second=$!; }
    running="$first $second"
    failed=
    wait "$first" || failed=$1
    test -z "$second" || wait "$second" || failed="$failed $2"
    report "$1"
    test $# -eq 1 || report "$2"
    for target in $failed; do tell_failure "$target"; done
    shift
    test $# -eq 0 || shift
done
exit "$status"
