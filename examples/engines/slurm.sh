#!/bin/sh
# A mesh into bricks on a Slurm cluster: one job that sorts it by tiles, an array of shards, and a merge when all of them are there.
#
#     sh slurm.sh MESH RESOLUTION SHARDS OUT.npz
#
# OUT.npz.jobs, on a file system that all nodes see, holds what they read and write, and their logs. Where a job fails, those that
# wait for it are cancelled, and the run ends with an error. The same command again goes on: it leaves out the jobs whose files are
# there, as a file has its name only when it is whole. Another command is refused, for those files are none of its own.
#
# OUT_SECONDS: how long OUT.npz may take to be seen here when the jobs have ended, 60 by default.
set -eu
mesh=$1 resolution=$2 shards=$3 out=$4 jobs=$4.jobs
export mesh resolution shards out jobs
test ! -e "$out" || { echo "$out exists" >&2; exit 2; }
mkdir -p "$jobs"

command="$(realpath "$mesh") $resolution $shards"
test -e "$jobs/command" || printf '%s\n' "$command" >"$jobs/command"
test "$(cat "$jobs/command")" = "$command" || {
    echo "$jobs is of another command, $(cat "$jobs/command"): repeat that one, remove $jobs, or give another OUT" >&2
    exit 2
}

# submit OPTION...: a job, its script on standard input, that starts when the job submitted before it has succeeded
last=
submit() {
    last=$(sbatch --parsable --kill-on-invalid-dep=yes ${last:+"--dependency=afterok:$last"} "$@")
}

test -e "$jobs/tiles" || submit --job-name=partition --output="$jobs/partition.log" <<'END'
#!/bin/sh
exec tribox partition "$mesh" --resolution "$resolution" --quiet -o "$jobs/tiles"
END

missing=$(for shard in $(seq "$shards"); do test -e "$jobs/$shard.part" || echo "$shard"; done | paste -sd ,)
test -z "$missing" || submit --job-name=shards --array="$missing" --output="$jobs/%a.log" <<'END'
#!/bin/sh
exec tribox voxelize "$jobs/tiles" --shard "$SLURM_ARRAY_TASK_ID/$shards" --threads "${SLURM_CPUS_PER_TASK:-1}" --quiet \
    -o "$jobs/$SLURM_ARRAY_TASK_ID.part"
END

submit --job-name=merge --output="$jobs/merge.log" <<'END'
#!/bin/sh
exec tribox merge "$jobs"/*.part --quiet -o "$out"
END

# Whether the last job is over. Where squeue fails for another reason, as when Slurm does not answer, the jobs may still run.
has_ended() {
    if found=$(squeue --noheader --jobs="$last" 2>"$jobs/squeue.log"); then
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
