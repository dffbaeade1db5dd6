"""Runs every task of a plan as a task of HyperQueue, on a cluster of this machine.

hyperqueue_sweep.py MICROSIM PLAN STORE FOLDER
"""

import sys
import tempfile
from pathlib import Path

from hyperqueue import Job, LocalCluster
from hyperqueue.cluster import WorkerConfig

microsim, plan, store, folder = sys.argv[1:]
Path(folder).mkdir(exist_ok=True)
with LocalCluster() as cluster:
    for _ in range(2):
        cluster.start_worker(WorkerConfig(cores=1))
    client = cluster.client()
    job = Job()
    for line in Path(plan).read_text().splitlines():
        task = tempfile.NamedTemporaryFile("w", dir=folder, suffix=".jsonl", delete=False)
        task.write(line)
        task.close()
        job.program([microsim, "run", "--task", task.name, "--store", store, "--keep-going"])
    client.wait_for_jobs([client.submit(job)])
