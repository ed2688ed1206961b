"""Runs the points of a sweep: by GNU parallel on this machine, by Slurm on many. Both call `ensemble point`, a process a point."""

import os
import shlex
import shutil
import subprocess
import sys

from .errors import InputError

# Slurm's own limit is MaxArraySize, 1001 if the cluster does not say otherwise: more points than this share tasks.
MOST_TASKS = 1000


def unfinished(sweep, store):
    return [point.index for point in sweep.points if store.result(store.key(point)) is None]


def run_parallel(entry, sweep, store, program, jobs):
    """As many points at once as `jobs`, each bound to a processor of its own while there are as many. Returns when all have ended."""
    if shutil.which("parallel") is None:
        raise InputError("GNU parallel is not installed; samples/ensemble/run installs it (Debian package parallel)")
    slot = " --slot {%}" if jobs <= len(os.sched_getaffinity(0)) else ""
    # The command comes through the environment, since GNU parallel replaces {} and runs {= … =} also in names of files. Its request to
    # cite it (--citation) is in README.md; on a terminal it would stop to make it.
    command = {"ENSEMBLE_POINT": shlex.join(_point_command(entry, sweep, store, program)), "PARALLEL_SHELL": "/bin/sh"}
    parallel = ["parallel", "--plain", "--will-cite", "--jobs", str(jobs), "--halt", "never", 'eval "$ENSEMBLE_POINT"' + slot + " {}"]
    points = "".join(f"{index}\n" for index in unfinished(sweep, store))
    subprocess.run(parallel, input=points, text=True, check=False, env=os.environ | command)


def submit_slurm(entry, sweep, store, program, jobs, options, wait):
    """An array with a task for each point that has no result; one task takes every MOST_TASKS-th point where there are more. `jobs`:
    tasks at once, None for as many as the cluster gives. Returns when all have ended, if it is to wait.
    """
    if shutil.which("sbatch") is None:
        raise InputError("Slurm is not installed; tests/run cluster installs one for a machine of its own (Debian package slurm-wlm)")
    stride = min(len(sweep.points), MOST_TASKS)
    tasks = sorted({index % stride for index in unfinished(sweep, store)})
    if not tasks:
        return
    command = [*_point_command(entry, sweep, store, program), "--stride", str(stride)]
    script = f"#!/bin/sh\nexec {shlex.join(command)} \"$SLURM_ARRAY_TASK_ID\"\n"
    logs = store.folder.resolve() / "logs"
    logs.mkdir(parents=True, exist_ok=True)
    array = ",".join(map(str, tasks)) + (f"%{jobs}" if jobs else "")
    log = str(logs).replace("%", "%%")  # Slurm replaces %x
    sbatch = ["sbatch", f"--array={array}", f"--job-name={sweep.path.stem}", f"--output={log}/slurm-%A_%a.log"]
    sbatch += ["--ntasks=1", "--cpus-per-task=1", "--requeue", *(["--wait"] if wait else []), *sweep.slurm_options, *options]
    submitted = subprocess.run(sbatch, input=script, text=True, check=False)
    if submitted.returncode != 0 and not wait:
        raise InputError("sbatch has refused the array")


def _point_command(entry, sweep, store, program):
    """With absolute paths: a task of Slurm starts where Slurm likes, and from a copy of its script."""
    paths = [str(entry.resolve()), "point", str(sweep.path.resolve()), "--out", str(store.folder.resolve()), "--program", str(program.resolve())]
    return [sys.executable, *paths]
