#!/usr/bin/env bash
# A study on many nodes under HyperQueue (https://it4innovations.github.io/hyperqueue): one task a shard of the stripes,
# then the join.
#
#     hq server start &                                    once, on a login node
#     hq alloc add slurm --time-limit 1h -- -p short       workers by Slurm or PBS as they are needed;
#                                                          or `hq worker start` on any machine
#     docs/cluster/hyperqueue.sh STUDY.toml SHARDS [RESULT.h5]
#
# waits for both, so call it in tmux or with nohup. RESULT is results/STUDY.h5 unless you name it. The folder you are
# in, the study, its records and its hazard curves must be there on every node under the same paths.
#
# Tasks are handed to workers as these are free, so there may be many more shards than cores, and workers may come and
# go: HyperQueue starts a task that lost its worker again, and it goes on where it stopped. After anything else (hq job
# cancel, Ctrl-C, a full disk), type the same line again, with the same SHARDS.
#
# A large table of sites is cut into SLICES as well: further tasks compute them, and the last one joins them.
#
# The program is `uplift` in your PATH, or what the variable UPLIFT says; a task has CPUS cores (4 unless you set it: a
# worker with fewer gets none, and `hq task explain last 1` says so).
set -euo pipefail

uplift=${UPLIFT:-uplift} cpus=${CPUS:-4}
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

# two files of one name write over each other in HyperQueue
[ "$step" = submit ] || exec 2>&1

case $step in
submit)
    # a mistake is found here, not in the queue
    "$uplift" check --quiet "$study"
    # a worker has the PATH of the shell it was started in
    uplift=$(command -v "$uplift")
    mkdir -p "$(dirname "$result")/logs"
    log=$(dirname "$result")/logs/$(basename "$result" .h5)
    # submit NAME LOG STEP [OPTION...]: one job, waited for. How its tasks ended is asked for, since waiting ends well
    # anyway (from HyperQueue 0.25 on); where one did not end well there is nothing to go on with.
    submit() {
        local all finished
        job=$(hq submit --output-mode quiet --name "$1" --cpus "$cpus" --crash-limit 100 --env "UPLIFT=$uplift" \
            --env "CPUS=$cpus" --env "SLICES=$slices" --stdout "$log.$2.log" --stderr none "${@:4}" \
            -- bash "$0" "$study" "$shards" "$result" "$3")
        echo "$1: job $job"
        hq job wait "$job" || true
        all=$(hq job task-ids "$job")
        finished=$(hq job task-ids "$job" --filter finished)
        [ "$all" = "$finished" ] ||
            { echo "not all tasks ended well: hq job info $job; logs: $log.*.log" >&2 && exit 1; }
    }
    # nothing is left in the queue that the same line, typed again, would run into
    job='' && trap '[ -z "$job" ] || hq job cancel "$job" >/dev/null 2>&1 || true' EXIT
    submit uplift '%{TASK_ID}' stripes --array "1-$shards"
    last=join
    submit uplift-join "$last" join
    if [ "$slices" != 1 ]; then
        submit uplift-sites 'sites.%{TASK_ID}' sites --array "2-$slices"
        last=join-sites
        submit uplift-join "$last" join-sites
    fi
    cat "$log.$last.log"
    ;;
stripes)
    exec "$uplift" run "$study" --shard "$HQ_TASK_ID/$shards" --output "$(shard "$HQ_TASK_ID")" --threads "$cpus"
    ;;
join)
    list_shards
    joined=$result sites=()
    [ "$slices" = 1 ] || { joined=$(slice 1) && sites=(--sites "1/$slices"); }
    "$uplift" merge "$study" "${files[@]}" "${sites[@]}" --output "$joined" --threads "$cpus"
    # all that was in them is in the result; repeated after a stop among the sites, this is joined again
    [ "$slices" != 1 ] || rm -f "${files[@]}"
    ;;
sites)
    exec "$uplift" run "$study" --sites "$HQ_TASK_ID/$slices" --output "$(slice "$HQ_TASK_ID")" --threads "$cpus"
    ;;
join-sites)
    files=()
    for ((index = 1; index <= slices; index++)); do files+=("$(slice "$index")"); done
    "$uplift" merge "$study" "${files[@]}" --output "$result" --threads "$cpus"
    for file in "${files[@]}"; do rm -f "${file%.h5}".*; done
    list_shards
    rm -f "${files[@]}"
    ;;
*)
    echo "$usage" >&2
    exit 2
    ;;
esac
