"""The folder of a sweep: results of points, each under a key made of all that it depends on, whole or not there at all.

results/KEY.csv    one line, the result of a point
failures/KEY.txt   why the last attempt at it failed
runs/KEY/          what falling_particles writes, until the result is there
logs/KEY.log       what it said in the last attempt
locks/KEY          held by who works at it
"""

import contextlib
import fcntl
import hashlib
import json
import os
import pathlib
import shutil
import tomllib


class Store:
    def __init__(self, folder, sweep):
        self.folder = pathlib.Path(folder)
        self.sweep = sweep
        self._scene = sweep.scene.read_bytes()

    def key(self, point):
        """Of a point: scene, catalogue, values and what is collected, so that no result is taken for another one's."""
        assignments = self.sweep.assignments(point)
        quantities = [repr(quantity) for quantity in self.sweep.quantities]
        text = json.dumps([_digest(self._scene), self._catalogue(point), assignments, quantities])
        return f"{_digest(text.encode())[:24]}"

    def _catalogue(self, point):
        """The digest of the scene's catalogue. A file that cannot be read is for falling_particles to complain about."""
        chosen = {**self.sweep.settings, **point.values}.get("catalogue")
        try:
            name = chosen if chosen is not None else tomllib.loads(self._scene.decode())["catalogue"]
            return _digest((self.sweep.scene.parent / name).read_bytes())
        except (OSError, ValueError, KeyError, TypeError):
            return None

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
