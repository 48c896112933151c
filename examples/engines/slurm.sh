#!/bin/sh
# A mesh into bricks on a Slurm cluster; no test runs this script. One job sorts the mesh by tiles, an array of N voxelizes a shard
# each, and the last merges. Each starts when the jobs before it have succeeded.
#
#     sh slurm.sh MESH RESOLUTION N OUT.npz [--ids]
#
# OUT.npz.jobs, on a file system that all nodes see, holds what the jobs read and write, and their logs. After a failure the same
# command continues from its files, which get their names only when they are whole. Remove it before you run another command.
set -eu
mesh=$(realpath "$1") resolution=$2 n=$3 out=$(realpath "$4") ids=${5-}
jobs=$out.jobs
export mesh resolution n out ids jobs
test ! -e "$out" || { echo "$out exists" >&2; exit 2; }
mkdir -p "$jobs"

submit() { sbatch --parsable --kill-on-invalid-dep=yes --output="$jobs/%x.%a.log" "$@"; }

# shellcheck disable=SC2016
sort=$(submit --job-name=sort --wrap='test -e "$jobs/tiles" || tribox partition "$mesh" -r "$resolution" $ids -q -o "$jobs/tiles"')
# shellcheck disable=SC2016
each=$(submit --job-name=voxelize --array="1-$n" --dependency="afterok:$sort" --wrap='part=$jobs/$SLURM_ARRAY_TASK_ID.npz
    test -e "$part" || tribox voxelize "$jobs/tiles" $ids --shard "$SLURM_ARRAY_TASK_ID/$n" \
        -t "${SLURM_CPUS_PER_TASK:-1}" -q -o "$part"')
# shellcheck disable=SC2016
submit --job-name=merge --dependency="afterok:$each" --wrap='tribox merge "$jobs"/*.npz -q -o "$out" && rm -r "$jobs"'
