# Sourced: a Slurm cluster of one node, this machine, out of Debian's packages, with all its state in its own folder.
#
#     start_slurm FOLDER     starts munged, slurmctld and slurmd, and sets SLURM_CONF
#     stop_slurm             ends these three

slurm_daemons=()

# A daemon in the foreground, its output in FOLDER/NAME.log.
daemon() {
    local log=$1
    shift
    "$@" >>"$log" 2>&1 &
    slurm_daemons+=($!)
}

start_slurm() {
    local folder=$1 name
    name=$(hostname -s)
    mkdir -p "$folder/state" "$folder/spool"
    chmod 755 "$folder"
    head -c 128 /dev/urandom >"$folder/munge.key"
    chmod 600 "$folder/munge.key"
    daemon "$folder/munged.log" munged --foreground --force --num-threads=2 --key-file="$folder/munge.key" \
        --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" --seed-file="$folder/munged.seed" \
        --log-file="$folder/munged.out"
    cat >"$folder/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=0,bf_interval=1
MpiDefault=none
ReturnToService=2
KillWait=2
NodeName=$name NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
CONF
    export SLURM_CONF=$folder/slurm.conf
    # control groups belong to the system that this may run inside of. Before 23.02 they cannot be disabled, but v1 does
    # nothing unasked
    case $(slurmctld -V) in
    *\ 2[0-2].*) echo CgroupPlugin=cgroup/v1 ;;
    *) echo CgroupPlugin=disabled ;;
    esac >"$folder/cgroup.conf"
    daemon "$folder/slurmctld.log" slurmctld -D -i -f "$SLURM_CONF"
    daemon "$folder/slurmd.log" slurmd -D -f "$SLURM_CONF"
    for _ in $(seq 60); do
        if [ "$(sinfo --noheader --format=%T 2>/dev/null)" = idle ]; then return 0; fi
        sleep 0.5
    done
    tail -n 20 "$folder"/munged.log "$folder"/slurmctld.log "$folder"/slurmd.log
    return 1
}

stop_slurm() {
    [ ${#slurm_daemons[@]} -eq 0 ] || kill "${slurm_daemons[@]}" 2>/dev/null || true
    wait "${slurm_daemons[@]}" 2>/dev/null || true
    slurm_daemons=()
}
