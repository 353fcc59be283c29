#!/usr/bin/env bash
# Runs a small study through the engines of docs/cluster for real, stops it on the way, and compares what comes out with
# an undisturbed run, bit by bit:
#
#     tests/cluster/run.sh [slurm] [hyperqueue]        all of them unless some are named; `make test-cluster`
#
# As root on Debian it installs what is missing (Slurm) and starts a Slurm cluster of this one node;
# HyperQueue comes from PyPI. What cannot be had is skipped, and said so; only wrong results fail. UPLIFT names another
# built program than that of `make build`.
set -euo pipefail
cd "$(dirname "$0")/../.."
repository=$PWD
parts=${*:-slurm hyperqueue}
uplift=$(realpath "${UPLIFT:-target/release/uplift}")
export NO_COLOR=1
# the folders of a cluster's daemons are opened by others
folder=$(mktemp -d /tmp/uplift-cluster.XXXXXX)
. tests/cluster/one-node-slurm.sh
ran=() skipped=()

finish() {
    # the workers end with their server; before stop_slurm, which without daemons of its own waits for all there is
    [ "${HQ_SERVER_DIR:-}" != "$folder/hq" ] || hq server stop >/dev/null 2>&1 || true
    stop_slurm
    rm -rf "$folder"
}
trap finish EXIT

skip() {
    echo "skipped: $1"
    skipped+=("$1")
}

fail() {
    [ ${#slurm_daemons[@]} -eq 0 ] || squeue >&2 || true
    tail -n 30 "$folder"/study/results/logs/*.log "$folder"/slurm/*.log 2>/dev/null >&2 || true
    ls -l "$folder"/study/results >&2 || true
    echo "FAILED: $1" >&2
    exit 1
}

# Something does not get on: that is the engine's, and skipped, unless the program has said anything in these logs.
stuck() {
    local what=$1
    shift
    if grep -qs . "$@"; then fail "$what"; fi
    rm -rf results
    skip "$what"
}

# Packages, if they are not there and we may.
provide() {
    local command=$1
    shift
    command -v "$command" >/dev/null && return 0
    [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null || return 1
    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@"; } \
        >"$folder/apt.log" 2>&1 && command -v "$command" >/dev/null
}

# Waits until a command succeeds, at most so many seconds.
until_true() {
    local tries=$((5 * $1))
    shift
    for ((; tries > 0; tries--)); do
        if "$@" >/dev/null 2>&1; then return 0; fi
        sleep 0.2
    done
    return 1
}

# Some analysis rows of a shard are written, and not yet all.
begun() { [ "$(cat results/study.shard-* 2>/dev/null | wc -c)" -gt 50000 ]; }

queue_is_empty() { local queue && queue=$(squeue --noheader) && [ -z "$queue" ]; }

# The result is whole and that of the undisturbed run, and nothing is left of the shards.
compare() {
    "$uplift" verify results/study.h5 >/dev/null || fail "$1: the result is not whole"
    "$repository/.venv/bin/python" "$repository/tests/cluster/same.py" whole.h5 results/study.h5 ||
        fail "$1: other numbers"
    cmp whole.sites.csv results/study.sites.csv || fail "$1: other spectra of the table of sites"
    ! ls results/study.s[hl]* 2>/dev/null || fail "$1: shards or slices are left"
    rm -r results
    ran+=("$1")
}

in_slurm() {
    provide sbatch slurmctld slurmd slurm-client munge && start_slurm "$folder/slurm" ||
        { skip "slurm: no cluster can be started here"; return; }
    local version first said
    version="slurm ($(sinfo --version))"
    export SBATCH_MEM_PER_NODE=400
    export SLICES=3
    said=$(CPUS=1 "$repository/docs/cluster/slurm.sh" study.toml 3)
    echo "$said"
    first=$(sed -n 's/.*stripes: job \([0-9]*\).*/\1/p' <<<"$said")
    until_true 60 begun || { stuck "$version: no task is started" results/logs/*.log; return; }
    scancel "$first"
    until_true 60 queue_is_empty ||
        { squeue; stuck "$version: a job that was cancelled, or its join, is still there" /dev/null; return; }
    local written
    written=$(cat results/study.shard-* | wc -c)
    [ ! -e results/study.h5 ] || fail "$version: a result of an array that was stopped"
    CPUS=1 "$repository/docs/cluster/slurm.sh" study.toml 3
    until_true 300 queue_is_empty || fail "$version: the jobs do not end"
    unset SLICES
    grep -qh "^known " results/logs/*.log || fail "$version: nothing was taken over of the $written bytes written"
    compare "$version, an array of 3 and 3 slices, cancelled and submitted again"
}

in_hyperqueue() {
    if command -v hq >/dev/null; then
        export HQ_SERVER_DIR=$folder/hq
        local line=(env CPUS=1 SLICES=3 "$repository/docs/cluster/hyperqueue.sh" study.toml 3) first
        hq server start >"$folder/hq.log" 2>&1 &
        until_true 30 hq server info || { skip "hyperqueue: hq does not start"; return; }
        hq worker start --cpus "$(nproc)" >"$folder/hq-worker.log" 2>&1 &
        timeout 30 hq worker wait 1 || { skip "hyperqueue: no worker starts"; return; }
        "${line[@]}" &
        first=$!
        until_true 60 begun ||
            { kill "$first" && stuck "hyperqueue: no task is started" results/logs/*.log; return; }
        hq job cancel last
        ! wait "$first" || fail "hyperqueue: exit code 0 of a job that was cancelled"
        [ ! -e results/study.h5 ] || fail "hyperqueue: a result of a cancelled job"
        timeout 300 "${line[@]}" || fail "hyperqueue: the job"
        grep -qh "^known " results/logs/*.log || fail "hyperqueue: nothing was taken over"
        compare "$(hq --version), an array of 3 and 3 slices, cancelled and submitted again"
        return
    fi
    # the wheel holds the server and the workers, but not the command hq: its tasks are submitted from Python
    local wheel=$folder/hq-venv/bin version
    { python3 -m venv "$folder/hq-venv" && "$wheel/pip" install --quiet hyperqueue; } >"$folder/pip.log" 2>&1 ||
        { skip "hyperqueue: neither hq nor its wheel"; return; }
    (cd "$folder" && UPLIFT=$uplift CPUS=1 "$wheel/python" "$repository/tests/cluster/hyperqueue_tasks.py" \
        "$repository/docs/cluster/hyperqueue.sh" "$folder/study" 3) >"$folder/hq.log" 2>&1 ||
        { tail -n 30 "$folder/hq.log"; stuck "hyperqueue: the tasks" results/logs/*.log; return; }
    version=$("$wheel/pip" list 2>/dev/null | sed -n 's/^hyperqueue *//p')
    compare "hyperqueue ($version from PyPI), an array of 3"
    skip "hyperqueue: hq is not here, so its line in docs/cluster/hyperqueue.sh was not run, only the tasks it submits"
}

.ci/provide-python
[ -x .venv/bin/python ] || { skip "everything: no Python to compare results with"; exit 0; }
mkdir "$folder/study"
cd "$folder/study"
# some ten seconds of one core
cat >study.toml <<STUDY
title = "cluster"
[records]
first = 30
[strengths]
values = "0:0.01:1"
[pgv]
levels_cm_s = ["1:1:10", "15:5:50", "60:20:200"]
[pga]
levels_g = [0.001, 0.01, "0.025:0.025:0.2", "0.25:0.05:0.5", "0.6:0.2:2"]
[hazard]
conversions = [{ from = "GMRotI50", to = "geometric mean", pgv = 1.0, pga = 1.0 }]
[[sites]]
name = "Athens"
pgv = "$repository/hazard/athens/pgv.csv"
pga = "$repository/hazard/athens/pga.csv"
[site_table]
pgv = "many.csv"
STUDY
awk 'BEGIN {
    print "#,,\"kind=\047mean\047, investigation_time=1.0, imt=\047PGV\047\""
    printf "lon,lat"
    for (level = 0.05; level < 400; level *= 2) printf ",poe-%.4f", level
    for (site = 1; site < 9; site++) {
        printf "\n%d,45", site
        for (level = 0.05; level < 400; level *= 2) printf ",%.6e", 1 - exp(-0.02 * site / level ^ 2)
    }
    print ""
}' >many.csv
"$uplift" run study.toml --quiet -o whole.h5
export UPLIFT=$uplift
for part in $parts; do
    begin=$SECONDS
    "in_$part"
    echo "$part: $((SECONDS - begin)) s"
done
printf 'passed: %s\n' "${ran[@]}"
[ ${#skipped[@]} -eq 0 ] || printf 'skipped: %s\n' "${skipped[@]}"
