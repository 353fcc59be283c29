"""The tasks of docs/cluster/hyperqueue.sh, in a HyperQueue server and worker of this process.

    python hyperqueue_tasks.py SCRIPT FOLDER SHARDS
"""

import os
import sys
from pathlib import Path

from hyperqueue import Job, LocalCluster
from hyperqueue.cluster import WorkerConfig
from hyperqueue.ffi.protocol import ResourceRequest

script, folder, shards = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3])
logs = folder / "results" / "logs"
logs.mkdir(parents=True)
environment = {name: os.environ[name] for name in ["UPLIFT", "CPUS", "PATH", "UPLIFT_CACHE"] if name in os.environ}
job = Job(default_workdir=folder, default_env=environment, name="uplift")


def task(name, step, deps):
    arguments = ["bash", script, "study.toml", str(shards), "results/study.h5", *step]
    log = str(logs / f"{name}.log")
    return job.program(arguments, stdout=log, stderr=log, deps=deps, resources=ResourceRequest(cpus=1))


# HyperQueue numbers the tasks of a job from 0 and tells each its number; shards are numbered from 1
first = job.program([os.environ["UPLIFT"], "check", "--quiet", "study.toml"])
stripes = [task(str(shard), ["stripes"], [first]) for shard in range(1, shards + 1)]
task("join", ["join"], stripes)
with LocalCluster(str(folder.parent / "hq"), worker_config=WorkerConfig(cores=os.cpu_count())) as cluster:
    client = cluster.client()
    client.wait_for_jobs([client.submit(job)])
