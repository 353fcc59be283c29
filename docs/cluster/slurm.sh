#!/usr/bin/env bash
# A study on many nodes under Slurm: an array job, one task a shard of the stripes, and a job that joins them.
#
#     docs/cluster/slurm.sh STUDY.toml SHARDS [RESULT.h5]
#
# on a login node submits both, and says their numbers. RESULT is results/STUDY.h5 unless you name it. The folder you
# are in, the study, its records and its hazard curves must be there on every node under the same paths, as a home or a
# project folder is.
#
# Shards: any number; a task of some minutes is a good one. `uplift check STUDY.toml` says how long the stripes take on
# this machine.
#
# When something stops (a node fails, the time is up, scancel, a full disk), type the same line again: every shard goes
# on where it stopped, finished ones end at once, and the join waits for all of them. Keep SHARDS as it was: the
# division is part of a shard.
#
# A large table of sites is cut into SLICES as well: further jobs compute them, and the last one joins them.
#
# The program is `uplift` in your PATH, or what the variable UPLIFT says; a task has CPUS threads (8 unless you set it):
# more threads and fewer shards, or the other way, are the same to the result and almost so to the time. Account,
# partition and the like are Slurm's own variables (man sbatch, "INPUT ENVIRONMENT VARIABLES"), which go before the
# lines below:
#
#     CPUS=16 SBATCH_ACCOUNT=quakes SBATCH_PARTITION=short SBATCH_TIMELIMIT=20 \
#         docs/cluster/slurm.sh studies/europe.toml 40
#
# Records and stripes, for all threads of a task together: `uplift check` says how much.
#SBATCH --mem=2G
#SBATCH --time=01:00:00
# A task that was driven away or lost its node is started again by Slurm, and goes on.
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail

uplift=${UPLIFT:-uplift}
usage="usage: $0 STUDY.toml SHARDS [RESULT.h5]"
study=${1:?$usage} shards=${2:?$usage} result=${3:-results/$(basename "$study" .toml).h5} step=${4:-submit}
slices=${SLICES:-1}

# The files of a shard and of a slice, as `uplift run` names them.
shard() { printf '%s.shard-%0*d-of-%d' "${result%.h5}" "${#shards}" "$1" "$shards"; }
list_shards() {
    files=()
    for ((index = 1; index <= shards; index++)); do files+=("$(shard "$index")"); done
}
slice() { printf '%s.slice-%0*d-of-%d.h5' "${result%.h5}" "${#slices}" "$1" "$slices"; }

case $step in
submit)
    # a mistake is found here, not in the queue
    "$uplift" check --quiet "$study"
    mkdir -p "$(dirname "$result")/logs"
    log=$(dirname "$result")/logs/$(basename "$result" .h5)
    submit=(sbatch --parsable --cpus-per-task="${CPUS:-8}")
    stripes=$("${submit[@]}" --job-name=uplift --array="1-$shards" \
        --output="$log.%a.log" "$0" "$study" "$shards" "$result" stripes)
    # afterok: once every task has ended well; where one has not, the join is taken out of the queue
    join=$("${submit[@]}" --job-name=uplift-join --dependency="afterok:${stripes%%;*}" --kill-on-invalid-dep=yes \
        --output="$log.join.log" "$0" "$study" "$shards" "$result" join)
    if [ "$slices" != 1 ]; then
        sites=$("${submit[@]}" --job-name=uplift-sites --array="2-$slices" --dependency="afterok:${join%%;*}" \
            --kill-on-invalid-dep=yes --output="$log.sites.%a.log" "$0" "$study" "$shards" "$result" sites)
        join=$("${submit[@]}" --job-name=uplift-join --dependency="afterok:${sites%%;*}" --kill-on-invalid-dep=yes \
            --output="$log.join-sites.log" "$0" "$study" "$shards" "$result" join-sites)
    fi
    echo "stripes: job ${stripes%%;*}, $shards tasks; join: job ${join%%;*}. Logs: $log.*.log;" \
        "how far it is: $uplift status $result"
    ;;
stripes)
    # the number of shards is not SLURM_ARRAY_TASK_COUNT: that is smaller where only some tasks are submitted again
    # (--array=3,7)
    exec "$uplift" run "$study" --shard "$SLURM_ARRAY_TASK_ID/$shards" --output "$(shard "$SLURM_ARRAY_TASK_ID")" \
        --threads "$SLURM_CPUS_PER_TASK"
    ;;
join)
    list_shards
    joined=$result sites=()
    [ "$slices" = 1 ] || { joined=$(slice 1) && sites=(--sites "1/$slices"); }
    "$uplift" merge "$study" "${files[@]}" "${sites[@]}" --output "$joined" --threads "$SLURM_CPUS_PER_TASK"
    # all that was in them is in the result; repeated after a stop among the sites, this is joined again
    [ "$slices" != 1 ] || rm -f "${files[@]}"
    ;;
sites)
    exec "$uplift" run "$study" --sites "$SLURM_ARRAY_TASK_ID/$slices" --output "$(slice "$SLURM_ARRAY_TASK_ID")" \
        --threads "$SLURM_CPUS_PER_TASK"
    ;;
join-sites)
    files=()
    for ((index = 1; index <= slices; index++)); do files+=("$(slice "$index")"); done
    "$uplift" merge "$study" "${files[@]}" --output "$result" --threads "$SLURM_CPUS_PER_TASK"
    for file in "${files[@]}"; do rm -f "${file%.h5}".*; done
    list_shards
    rm -f "${files[@]}"
    ;;
*)
    echo "$usage" >&2
    exit 2
    ;;
esac
