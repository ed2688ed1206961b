"""One point: falling_particles, and its result as a line."""

import csv
import io
import os
import subprocess
import sys
import time
import tomllib

from .quantity import NoValue
from .toml_text import toml_text


def csv_line(fields):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(fields)
    return text.getvalue()


def pin(slot):
    """Binds this process, and what it starts, to one processor: of those that it may use the one of its slot, from 1."""
    allowed = sorted(os.sched_getaffinity(0))
    os.sched_setaffinity(0, {allowed[(slot - 1) % len(allowed)]})


def run_point(sweep, point, store, program):
    """Runs a point that has no result yet, on one thread. Returns whether it has one now; a failure is saved with its reason, and told."""
    key = store.key(point)
    if store.result(key) is not None:
        return True
    with store.lock(key) as lock:
        if store.result(key) is not None:  # by who held the lock
            return True
        store.forget_failure(key)
        start = time.monotonic()
        failure = _simulate(sweep, point, store, key, program, lock)
        if failure is None:
            failure = _collect(sweep, point, store, key)
        if failure is not None:
            store.save_failure(key, failure)
            print(f"{point.describe()} FAILED: {failure}", file=sys.stderr)
            return False
    print(f"{point.describe()}: {time.monotonic() - start:.1f} s", file=sys.stderr)
    return True


def _results_folder(sweep, store, key):
    return store.run_folder(key) / sweep.scene.stem


def _is_finished(folder):
    """Whether a run that was started earlier is there in full; Ctrl-C leaves results of a part."""
    try:
        return tomllib.loads((folder / "summary.toml").read_text(encoding="utf-8"))["run"]["interrupted"] is False
    except (OSError, ValueError, KeyError):
        return False


def _simulate(sweep, point, store, key, program, lock):
    """None, or why it failed."""
    if _is_finished(_results_folder(sweep, store, key)):
        return None
    command = [str(program), "--quiet", "--no-pictures", "--threads", "1", "--scene", str(sweep.scene), "--out", str(store.run_folder(key))]
    command += sweep.arguments
    for assignment in sweep.assignments(point):
        command += ["--set", assignment]
    store.log(key).parent.mkdir(parents=True, exist_ok=True)
    threads = dict.fromkeys(["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"], "1")
    try:
        with open(store.log(key), "wb") as log:
            code = subprocess.run(
                command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=log, pass_fds=[lock], env=os.environ | threads
            ).returncode
    except OSError as error:
        return f"cannot start {program}: {error.strerror}"
    if code == 0:
        return None
    said = store.log(key).read_text(encoding="utf-8", errors="replace").strip().splitlines()
    ended = f"exit code {code}" if code > 0 else f"signal {-code}"
    return f"{ended}: {said[-1] if said else 'it said nothing'}"


def _collect(sweep, point, store, key):
    """Saves the line. None, or why there is none."""
    folder = _results_folder(sweep, store, key)
    try:
        numbers = [quantity.value(folder) for quantity in sweep.quantities]
    except NoValue as error:
        return str(error)
    values = [value if isinstance(value, str) else toml_text(value) for value in point.values.values()]
    seed = [] if point.seed is None else [point.seed]
    store.save_result(key, csv_line([*values, *seed, *(repr(number) for number in numbers)]))
    if not sweep.keep:
        store.remove_run(key)
    return None
