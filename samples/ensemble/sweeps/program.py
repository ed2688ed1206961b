"""What falling_particles says of itself and of a scene, without a run."""

import hashlib
import subprocess
import tomllib

from .errors import InputError
from .quantity import NoValue


def version_of(program):
    """Its line of --version; of a program that refuses this option, the digest of its file."""
    code, text, _ = _ask(program, "--version")
    if code == 0:
        line = _first_line(text)
        if not line.startswith("falling_particles "):
            raise InputError(f"--program {program} is another program: its --version says {line!r}; allowed: falling_particles")
        return line
    return hashlib.sha256(program.read_bytes()).hexdigest()


def options_of_runs(folder):
    """What every run has besides its scene."""
    return ["--quiet", "--no-pictures", "--threads", "1", "--out", str(folder)]


def refuse_bad_requests(sweep, point, program):
    """Raises InputError where the scene has not a key of the sweep, where the program takes the arguments of the sweep for none of a run,
    or where the run of a point does not write a table or a column that is collected. What the program says against a value is for the
    run to tell, since another point may have another one.
    """
    assignments = [word for assignment in sweep.assignments(point) for word in ("--set", assignment)]
    question = ["--tables", str(sweep.scene), *assignments, *options_of_runs(".")]
    code, text, complaint = _ask(program, *question)
    if code != 0:
        if ": unknown key " in _first_line(complaint):
            raise InputError(f"{sweep.path}: {_first_line(complaint)}")
        return
    code, changed, complaint = _ask(program, *question, *sweep.arguments)
    if code != 0 or changed != text:
        why = _first_line(complaint) or "a run does not come of them"
        raise InputError(f"{sweep.path}: arguments is {sweep.arguments!r}: {why}; allowed: options of falling_particles for a run")
    tables = tomllib.loads(text)
    for quantity in sweep.quantities:
        try:
            quantity.refuse_other_tables(tables)
        except NoValue as error:
            raise InputError(f"{sweep.path}: [[collect]] {quantity.name}: {error}") from None


def _first_line(text):
    return text.strip().partition("\n")[0]


def _ask(program, *arguments):
    try:
        ended = subprocess.run(
            [str(program.absolute()), *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, encoding="utf-8", check=False
        )
    except OSError as error:
        raise InputError(f"cannot start {program}: {error.strerror}") from None
    return ended.returncode, ended.stdout, ended.stderr
