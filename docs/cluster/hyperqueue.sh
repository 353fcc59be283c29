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
# cancel, a full disk), type the same line again, with the same SHARDS.
#
# A large table of sites is cut into SLICES as well: further tasks compute them, and the last one joins them.
#
# The program is `uplift` in your PATH, or what the variable UPLIFT says; a task has CPUS cores (4 unless you set it).
set -euo pipefail

uplift=${UPLIFT:-uplift} cpus=${CPUS:-4}
usage="usage: $0 STUDY.toml SHARDS [RESULT.h5]"
study=${1:?$usage} shards=${2:?$usage} result=${3:-results/$(basename "$study" .toml).h5} step=${4:-submit}
slices=${SLICES:-1}

# The files of a shard and of a slice, as `uplift run` names them.
shard() { printf '%s.shard-%0*d-of-%d' "${result%.h5}" "${#shards}" "$1" "$shards"; }
slice() { printf '%s.slice-%0*d-of-%d.h5' "${result%.h5}" "${#slices}" "$1" "$slices"; }

case $step in
submit)
    # a mistake is found here, not in the queue
    "$uplift" check --quiet "$study"
    mkdir -p "$(dirname "$result")/logs"
    log=$(dirname "$result")/logs/$(basename "$result" .h5)
    submit=(hq submit --wait --cpus "$cpus" --env "UPLIFT=$uplift" --env "CPUS=$cpus" --env "SLICES=$slices")
    "${submit[@]}" --name uplift --array "1-$shards" --stdout "$log.%{TASK_ID}.log" --stderr "$log.%{TASK_ID}.log" \
        -- bash "$0" "$study" "$shards" "$result" stripes
    # --wait ends badly where a task did, and then there is nothing to join
    "${submit[@]}" --name uplift-join --stdout "$log.join.log" --stderr "$log.join.log" \
        -- bash "$0" "$study" "$shards" "$result" join
    if [ "$slices" != 1 ]; then
        "${submit[@]}" --name uplift-sites --array "2-$slices" --stdout "$log.sites.%{TASK_ID}.log" \
            --stderr "$log.sites.%{TASK_ID}.log" -- bash "$0" "$study" "$shards" "$result" sites
        "${submit[@]}" --name uplift-join --stdout "$log.join.log" --stderr "$log.join.log" \
            -- bash "$0" "$study" "$shards" "$result" join-sites
    fi
    cat "$log.join.log"
    ;;
stripes)
    exec "$uplift" run "$study" --shard "$HQ_TASK_ID/$shards" --output "$(shard "$HQ_TASK_ID")" --threads "$cpus"
    ;;
join)
    files=()
    for ((index = 1; index <= shards; index++)); do files+=("$(shard "$index")"); done
    joined=$result sites=()
    [ "$slices" = 1 ] || { joined=$(slice 1) && sites=(--sites "1/$slices"); }
    "$uplift" merge "$study" "${files[@]}" "${sites[@]}" --output "$joined" --threads "$cpus"
    # all that was in them is in the result
    rm -f "${files[@]}"
    ;;
sites)
    exec "$uplift" run "$study" --sites "$HQ_TASK_ID/$slices" --output "$(slice "$HQ_TASK_ID")" --threads "$cpus"
    ;;
join-sites)
    files=()
    for ((index = 1; index <= slices; index++)); do files+=("$(slice "$index")"); done
    "$uplift" merge "$study" "${files[@]}" --output "$result" --threads "$cpus"
    for file in "${files[@]}"; do rm -f "${file%.h5}".*; done
    ;;
*)
    echo "$usage" >&2
    exit 2
    ;;
esac
