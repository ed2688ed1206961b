"""What falling_particles says of itself and of a scene, without a run."""

import hashlib
import subprocess
import tomllib

from .errors import InputError
from .quantity import NoValue


def version_of(program):
    """Its line of --version; of a program that has none, the digest of its file."""
    code, text = _ask(program, "--version")
    if code == 0 and text.strip():
        return text.strip().splitlines()[0]
    return hashlib.sha256(program.read_bytes()).hexdigest()


def refuse_misspelt_columns(sweep, point, program):
    """Raises InputError where the run of a point does not write a table or a column that is collected. What the program says against
    the scene is for the run to tell.
    """
    assignments = [word for assignment in sweep.assignments(point) for word in ("--set", assignment)]
    code, text = _ask(program, "--tables", str(sweep.scene), *assignments)
    if code != 0:
        return
    tables = tomllib.loads(text)
    for quantity in sweep.quantities:
        try:
            quantity.refuse_other_tables(tables)
        except NoValue as error:
            raise InputError(f"{sweep.path}: [[collect]] {quantity.name}: {error}") from None


def _ask(program, *arguments):
    try:
        ended = subprocess.run(
            [str(program.absolute()), *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, encoding="utf-8", check=False
        )
    except OSError as error:
        raise InputError(f"cannot start {program}: {error.strerror}") from None
    return ended.returncode, ended.stdout
