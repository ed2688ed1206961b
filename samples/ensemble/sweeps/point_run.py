"""One point: falling_particles, and its result as a line."""

import csv
import io
import os
import subprocess
import sys
import time
import tomllib

from .program import options_of_runs
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
    key, run = store.key(point), store.run_key(point)
    if store.result(key) is not None:
        return True
    with store.lock(run) as lock:
        if store.result(key) is not None:  # by who held the lock
            return True
        store.forget_failure(key)
        start = time.monotonic()
        failure = _simulate_point(sweep, point, store, run, program, lock)
        if failure is None:
            failure = _collect(sweep, point, store, key, run)
        if failure is not None:
            store.save_failure(key, failure)
            print(f"{point.describe()} FAILED: {failure}", file=sys.stderr)
            return False
    print(f"{point.describe()}: {time.monotonic() - start:.1f} s", file=sys.stderr)
    return True


# Runs a program and writes down how it ended, also where whoever started it has been killed meanwhile.
SUPERVISED = 'end=$1 log=$2; shift 2; "$@" >/dev/null 2>"$log"; code=$?; echo $code >"$end.new" && mv "$end.new" "$end"; exit $code'
INTERRUPTED = 130  # exit code of falling_particles; above 128, those of the shell for a program that a signal has ended
FIRST_SIGNAL = 128


def _results_folder(scene, store, run):
    return store.run_folder(run) / scene.stem


def _simulate_point(sweep, point, store, run, program, lock):
    """The run of a point, and of its start if nobody has done it yet. None, or why it failed."""
    assignments = sweep.assignments(point)
    if sweep.start:
        start = store.start_key(point)
        with store.lock(start) as start_lock:
            failure = _simulate(sweep, sweep.start.scene, sweep.start_assignments(point), store, start, program, start_lock)
        if failure is not None:
            return f"its start: {failure}"
        results = _results_folder(sweep.start.scene, store, start).absolute()
        bonds = f".file={toml_text(str(results / 'final_bonds.csv'))}"
        of_start = _bonds_in(sweep.start.scene)
        assignments = [f"bond[{name}]{bonds}" for name in _bonds_in(sweep.scene) if name in of_start] + assignments
        assignments += [f"start.file={toml_text(str(results / 'final_state.csv'))}"]
        if (results / "parts.csv").exists():
            assignments += [f"start.parts={toml_text(str(results / 'parts.csv'))}"]
    return _simulate(sweep, sweep.scene, assignments, store, run, program, lock)


def _bonds_in(scene):
    """The names of its sections [[bond]]; none of a scene that falling_particles refuses."""
    try:
        return [bond["name"] for bond in tomllib.loads(scene.read_text(encoding="utf-8")).get("bond", [])]
    except (tomllib.TOMLDecodeError, AttributeError, KeyError, TypeError):
        return []


def _simulate(sweep, scene, assignments, store, run, program, lock):
    """None, or why it failed. A run that has ended with exit code 0 before is not done again."""
    end = store.run_folder(run) / "exit_code"
    if end.exists() and end.read_text(encoding="utf-8").strip() == "0":
        return None
    end.unlink(missing_ok=True)
    end.parent.mkdir(parents=True, exist_ok=True)
    command = ["sh", "-c", SUPERVISED, "sh", str(end.absolute()), str(store.log(run).absolute())]
    command += [str(program.absolute()), "--scene", str(scene), *options_of_runs(store.run_folder(run)), *sweep.arguments]
    for assignment in assignments:
        command += ["--set", assignment]
    store.log(run).parent.mkdir(parents=True, exist_ok=True)
    threads = dict.fromkeys(["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"], "1")
    try:
        silent = dict.fromkeys(["stdin", "stdout", "stderr"], subprocess.DEVNULL)
        code = subprocess.run(command, **silent, pass_fds=[lock], env=os.environ | threads, check=False).returncode
    except OSError as error:
        return f"cannot start {program}: {error.strerror}"
    if code == 0:
        return None
    said = store.log(run).read_text(encoding="utf-8", errors="replace").strip().splitlines()
    if code > FIRST_SIGNAL and code != INTERRUPTED:
        code = FIRST_SIGNAL - code
    ended = f"exit code {code}" if code > 0 else f"signal {-code}"
    return f"{ended}: {said[-1] if said else 'it said nothing'}"


def _collect(sweep, point, store, key, run):
    """Saves the line. None, or why there is none; the run is kept then, for the next time."""
    folder = _results_folder(sweep.scene, store, run)
    try:
        numbers = [quantity.value(folder) for quantity in sweep.quantities]
    except NoValue as error:
        return str(error)
    values = [value if isinstance(value, str) else toml_text(value) for value in point.values.values()]
    seed = [] if point.seed is None else [point.seed]
    store.save_result(key, csv_line([*values, *seed, *(repr(number) for number in numbers)]))
    if not sweep.keep:
        store.remove_run(run)
    return None
