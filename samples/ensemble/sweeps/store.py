"""The folder of a sweep: results of points, each under a key made of all that it depends on, whole or not there at all.

results/KEY.csv    one line, the result of a point
failures/KEY.txt   why the last attempt at it failed
runs/RUN/          what falling_particles writes, and exit_code, until the result is there; of a start it stays
logs/RUN.log       what it said in the last attempt
locks/RUN          held by who works at it
program.txt        the version of falling_particles that has run the last point
sweep.txt          the sweep file whose points.csv and means.csv these are
"""

import contextlib
import fcntl
import hashlib
import json
import os
import pathlib
import shutil
import tomllib

from .errors import InputError


class Store:
    """Of a sweep. `program`: what falling_particles says of its version; None: as it was when the last point was run."""

    def __init__(self, folder, sweep, program=None):
        self.folder = pathlib.Path(folder)
        self.sweep = sweep
        self._claim()
        scenes = {sweep.scene, sweep.start.scene if sweep.start else sweep.scene}
        self._texts = {scene: _texts_of(_parsed(scene.read_bytes())) for scene in scenes}
        self._digests = {}
        if program is not None and program != self._last_program():
            _replace(self.folder / "program.txt", program + "\n")
        self._program = program or self._last_program()

    def key(self, point):
        """Of the result of a point: of its run, and of what is collected, so that no result is taken for another one's."""
        return _key([self.run_key(point), [repr(quantity) for quantity in self.sweep.quantities]])

    def run_key(self, point):
        """Of the run of a point: the scene, the files that it names, values, arguments, the program, and the run of its start."""
        sweep = self.sweep
        parts = self._parts(sweep.scene, [sweep.settings, point.values], sweep.assignments(point))
        return _key([*parts, *([self.start_key(point)] if sweep.start else [])])

    def start_key(self, point):
        """Of the run from whose end the run of a point starts."""
        start = self.sweep.start
        return _key(self._parts(start.scene, start.settings, self.sweep.start_assignments(point)))

    def _parts(self, scene, values, assignments):
        texts = self._texts[scene] | _texts_of(values)
        files = sorted((name, self._digest_of(scene, name)) for name in texts)
        used = [entry for entry in files if entry[1] is not None]
        return [self._digest_of(scene, scene.name), used, assignments, self.sweep.arguments, self._program]

    def _digest_of(self, scene, name):
        """Of a file beside the scene, where a text of it is the name of one; None where it is not."""
        path = scene.parent / name
        if path not in self._digests:
            try:
                self._digests[path] = _digest(path.read_bytes()) if path.is_file() else None
            except (OSError, ValueError):  # falling_particles complains
                self._digests[path] = None
        return self._digests[path]

    def _claim(self):
        """Raises InputError if the tables of the folder belong to another sweep file, which is still there."""
        own, path = str(self.sweep.path.resolve()), self.folder / "sweep.txt"
        owner = (_read(path) or "").strip()
        if owner not in ("", own) and pathlib.Path(owner).exists():
            raise InputError(f"{self.folder} has the results of {owner}; allowed for {self.sweep.path}: a folder of its own")
        if owner != own:
            _replace(path, own + "\n")

    def _last_program(self):
        return (_read(self.folder / "program.txt") or "").strip()

    def run_folder(self, key):
        return self.folder / "runs" / key

    def log(self, key):
        return self.folder / "logs" / f"{key}.log"

    def result(self, key):
        """The line of a point, None when there is none."""
        return _read(self.folder / "results" / f"{key}.csv")

    def failure(self, key):
        return _read(self.folder / "failures" / f"{key}.txt")

    def save_result(self, key, line):
        _replace(self.folder / "results" / f"{key}.csv", line)
        self.forget_failure(key)

    def save_failure(self, key, text):
        _replace(self.folder / "failures" / f"{key}.txt", text)

    def forget_failure(self, key):
        (self.folder / "failures" / f"{key}.txt").unlink(missing_ok=True)

    def remove_run(self, key):
        shutil.rmtree(self.run_folder(key), ignore_errors=True)

    @contextlib.contextmanager
    def lock(self, key):
        """Waits until nobody else works at the point. Gives the file descriptor of the lock: a child process that inherits it keeps the
        lock until it has ended too, so that after a kill nobody works beside a run that is still on its way.
        """
        path = self.folder / "locks" / key
        path.parent.mkdir(parents=True, exist_ok=True)
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX)
            yield descriptor
        finally:
            os.close(descriptor)


def _parsed(scene):
    """The scene as tables; what is no scene is for falling_particles to complain about."""
    try:
        return tomllib.loads(scene.decode())
    except (ValueError, RecursionError):
        return {}


def _texts_of(value):
    """All texts in tables and arrays."""
    texts, left = set(), [value]
    while left:
        value = left.pop()
        if isinstance(value, str):
            texts.add(value)
        elif isinstance(value, (dict, list)):
            left.extend(value.values() if isinstance(value, dict) else value)
    return texts


def _key(parts):
    return _digest(json.dumps(parts).encode())[:24]


def _digest(content):
    return hashlib.sha256(content).hexdigest()


def _read(path):
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return None


def _replace(path, text):
    """Writes the file in one move: a reader, or a kill or a power cut in between, finds the whole of it or nothing."""
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(f"{path.name}.unfinished-{os.uname().nodename}-{os.getpid()}")
    try:
        with open(unfinished, "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(unfinished, path)
    finally:
        unfinished.unlink(missing_ok=True)


def write_text(path, text):
    """The same for files that a user reads."""
    _replace(pathlib.Path(path), text)
