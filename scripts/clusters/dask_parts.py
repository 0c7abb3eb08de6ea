"""Computes the parts of the studies of a script as tasks of Dask, and merges them.

    python scripts/clusters/dask_parts.py SCRIPT.rhai PARTS OUT [--slurm WORKERS]

Without --slurm, the workers are processes of this machine; with --slurm, they are jobs of Slurm (dask-jobqueue). A part that fails, or whose worker
is lost, is started again up to three times. Completed work is kept. All workers must share the folder.
"""

import argparse
import os
import subprocess

from distributed import Client, LocalCluster

WITHY = os.environ.get("WITHY", "withy")


def make(script, number, parts, folder):
    """Computes a part. A killed process raises an error, so that Dask starts the part again."""
    subprocess.run(
        [WITHY, "study", "--quiet", script, "--part", f"{number}/{parts}", "--out", folder], check=True
    )
    return number


def cluster(workers):
    """Cluster of Slurm jobs if a number of workers is given, otherwise of processes of this machine."""
    if workers is None:
        return LocalCluster(threads_per_worker=1)
    from dask_jobqueue import SLURMCluster

    jobs = SLURMCluster(cores=1, memory="2GB", walltime="01:00:00")
    jobs.scale(jobs=workers)
    return jobs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("script")
    parser.add_argument("parts", type=int)
    parser.add_argument("out")
    parser.add_argument("--slurm", type=int, metavar="WORKERS")
    given = parser.parse_args()
    folder = f"{given.out}.parts"
    with cluster(given.slurm) as jobs, Client(jobs) as client:
        numbers = range(1, given.parts + 1)
        tasks = [client.submit(make, given.script, n, given.parts, folder, retries=3, pure=False) for n in numbers]
        client.gather(tasks)
    subprocess.run([WITHY, "study", "--quiet", given.script, "--merge", folder, "--out", given.out], check=True)


if __name__ == "__main__":
    main()
