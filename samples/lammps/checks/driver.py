"""Runs supernormal_lammps, and reads what it writes."""

import os
import pathlib
import subprocess

INPUTS = pathlib.Path(__file__).parent


class Driver:
    """The program, and the folder that it runs in."""

    def __init__(self, program, folder):
        self.program = pathlib.Path(program).resolve()
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)

    def run(self, name, ranks=1, **variables):
        """Runs the input NAME.in and returns its tables of numbers, one for each `run`: lists of dictionaries by column."""
        return read_tables(self.output(name, ranks, **variables))

    def output(self, name, ranks=1, **variables):
        """Runs the input NAME.in and returns what LAMMPS prints."""
        command = ["mpirun", "--oversubscribe", "-np", str(ranks), str(self.program), "-in", str(INPUTS / f"{name}.in"), "-log", "none"]
        for variable, value in {"inputs": INPUTS, **variables}.items():
            command += ["-var", variable, str(value)]
        # Open MPI refuses root without these; in a container there is no one else.
        environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        done = subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
        return done.stdout

    def dump(self, name):
        """The rows of a dump of text, as lists of numbers, by step."""
        frames = {}
        lines = (self.folder / name).read_text().splitlines()
        for number, line in enumerate(lines):
            if line == "ITEM: TIMESTEP":
                rows = frames[int(lines[number + 1])] = []
            elif not line.startswith("ITEM") and number > 0 and len(line.split()) > 3:
                rows.append([float(word) for word in line.split()])
        return frames


def read_tables(text):
    """The tables of thermo_style that LAMMPS prints."""
    tables, columns = [], None
    for line in text.splitlines():
        if line.startswith("Step "):
            columns = line.split()
            tables.append([])
        elif line.startswith("Loop time"):
            columns = None
        elif columns:
            words = line.split()
            if len(words) == len(columns) and words[0].isdigit():
                tables[-1].append(dict(zip(columns, map(float, words))))
    return tables
