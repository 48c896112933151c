#!/bin/sh
# A job of slurm.sh, which submits it: slurm_job.sh STEP. Each writes a file of its own, under its name when it is whole.
# shellcheck disable=SC2154
i=${SLURM_ARRAY_TASK_ID:-} threads=${SLURM_CPUS_PER_TASK:-1}

# A folder is there already where the same job ran twice.
sort() {
    test -e "$jobs/$i.tiles" || {
        grid=$(python3 "$here/pieces.py" grid "$resolution" "$jobs"/*.bounds) || return
        # shellcheck disable=SC2086
        tribox partition "$jobs/$i".f?? $grid $ids --threads "$threads" --quiet -o "$jobs/$i.tiles" || test -e "$jobs/$i.tiles" || return
    }
    rm -f "$jobs/$i".f??
}

# The partitions in the order of the pieces: triangles are numbered from one to the next.
in_order() {
    for k in $(seq "$n"); do echo "$jobs/$k.tiles"; done
}

run() {
    case $1 in
    cut) python3 "$here/pieces.py" cut "$mesh" "$i/$n" "$jobs" ;;
    sort) sort ;;
    # shellcheck disable=SC2046,SC2086
    voxelize) tribox voxelize $(in_order) $ids --shard "$i/$n" --threads "$threads" --quiet -o "$jobs/$i.part" ;;
    merge) tribox merge "$jobs"/*.part --quiet -o "$out" ;;
    esac
}

code=0
run "$1" || code=$?
# What a signal has ended, as where memory was short. What fails otherwise would fail again.
test "$code" -le 128 || test "${SLURM_RESTART_COUNT:-0}" -ge 3 || scontrol requeue "$SLURM_JOB_ID"
exit "$code"
