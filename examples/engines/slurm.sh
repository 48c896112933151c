#!/bin/sh
# A mesh into bricks on a Slurm cluster; no test runs it. Three arrays of N jobs: each cuts its piece out of the mesh; sorts it by
# tiles; voxelizes its share of the tiles, from all pieces. Then one job merges. Each starts when all before have succeeded.
#
#     sh slurm.sh MESH RESOLUTION N OUT.npz [--ids]
#
# MESH is a binary .stl or .ply, .f32 or .f64. With --ids OUT.npz has the lowest triangle of each cell too. OUT.npz.jobs, on a file system that all nodes see, holds what the jobs read and
# write, and their logs. A job whose program a signal ends is queued again, three times; where one fails, those that wait for it are
# cancelled, and the run ends with an error. The same command again goes on: it leaves out the jobs whose files are there, as a file
# has its name only when it is whole. Another command is refused, for those files are none of its own.
#
# OUT_SECONDS: how long OUT.npz may take to be seen here when the jobs have ended, 60 by default.
set -eu
mesh=$(realpath "$1") resolution=$2 n=$3 out=$4 jobs=$4.jobs ids=${5-} here=$(realpath "$(dirname "$0")")
export mesh resolution n out jobs ids here
test ! -e "$out" || { echo "$out exists" >&2; exit 2; }
mkdir -p "$jobs"

command="$mesh $(stat -Lc '%s %y' "$mesh") $resolution $n${ids:+ $ids}"
test -e "$jobs/command" || printf '%s\n' "$command" >"$jobs/command"
test "$(cat "$jobs/command")" = "$command" || {
    echo "$jobs is of another command, $(cat "$jobs/command"): repeat that one, remove $jobs, or give another OUT" >&2
    exit 2
}

# submit STEP OPTION...: a job, or an array, that starts when the one submitted before it has succeeded
last='' all=
submit() {
    step=$1
    shift
    last=$(sbatch --parsable --kill-on-invalid-dep=yes --requeue --open-mode=append ${last:+"--dependency=afterok:$last"} \
        --job-name="$step" "$@" "$here/slurm_job.sh" "$step")
    all=$all${all:+,}$last
}

# submit_missing STEP END: an array of the jobs whose files I.END are not there
submit_missing() {
    missing=$(for i in $(seq "$n"); do test -e "$jobs/$i.$2" || echo "$i"; done | paste -sd ,)
    test -z "$missing" || submit "$1" --array="$missing" --output="$jobs/$1.%a.log"
}

submit_missing cut bounds
submit_missing sort tiles
submit_missing voxelize part
submit merge --output="$jobs/merge.log"

# Whether all jobs are over, so that none still writes when this is run again. Where squeue fails for another reason, as when Slurm
# does not answer, the jobs may still run.
has_ended() {
    if found=$(squeue --noheader --jobs="$all" 2>"$jobs/squeue.log"); then
        test -z "$found"
    else
        grep -q "Invalid job id" "$jobs/squeue.log"
    fi
}

until test -e "$out" || has_ended; do
    sleep 1
done
for _ in $(seq "${OUT_SECONDS:-60}"); do
    test ! -e "$out" || break
    sleep 1
done
test -e "$out" || { echo "a job failed: $jobs/*.log say why; then run this again" >&2; exit 1; }
rm -r "$jobs"
