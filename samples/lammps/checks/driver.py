"""Runs supernormal_lammps and reads its output."""

import os
import pathlib
import subprocess

INPUTS = pathlib.Path(__file__).parent


class Driver:
    """The program and its working folder."""

    def __init__(self, program, folder):
        self.program = pathlib.Path(program).resolve()
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)

    def other_product(self, name):
        """A program of samples/falling_particles in the same build; None if that product is not built."""
        program = self.program.parent.parent / "falling_particles" / name
        return program if program.exists() else None

    def run(self, name, ranks=1, **variables):
        """Runs the input NAME.in and returns its tables of numbers, one for each `run`: lists of dictionaries by column."""
        return read_tables(self.output(name, ranks, **variables))

    def output(self, name, ranks=1, **variables):
        """Runs the input NAME.in and returns the output of LAMMPS."""
        done, command = self.attempt(name, ranks, **variables)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
        return done.stdout

    def attempt(self, name, ranks=1, **variables):
        """Runs the input NAME.in, which may fail. Returns the finished process and its command."""
        command = ["mpirun", "--oversubscribe", "-np", str(ranks), str(self.program), "-in", str(INPUTS / f"{name}.in"), "-log", "none"]
        for variable, value in {"inputs": INPUTS, **variables}.items():
            command += ["-var", variable, str(value)]
        # Open MPI refuses root without these. In a container the user is root.
        environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        return subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True, check=False), command

    def dump(self, name):
        """The rows of a text dump by step, as lists of numbers."""
        frames = {}
        lines = (self.folder / name).read_text().splitlines()
        for number, line in enumerate(lines):
            if line == "ITEM: TIMESTEP":
                rows = frames[int(lines[number + 1])] = []
            elif not line.startswith("ITEM") and number > 0 and len(line.split()) > 3:
                rows.append([float(word) for word in line.split()])
        return frames


    def do_restarts_differ(self, one, other):
        """Whether two restart files have different bytes. LAMMPS since 2022 has its time, and the step at which it was set, in 20 bytes of the header,
        before the particles; a restarted run sets them anew."""
        files = [(self.folder / name).read_bytes() for name in (one, other)]
        places = [k for k, (a, b) in enumerate(zip(*files)) if a != b]
        return len(files[0]) != len(files[1]) or bool(places) and (places[-1] - places[0] >= 20 or places[-1] >= 1000)


def read_tables(text):
    """The thermo_style tables in the output of LAMMPS."""
    tables, columns = [], None
    for line in text.splitlines():
        if line.split()[:1] == ["Step"]:
            columns = line.split()
            tables.append([])
        elif line.startswith("Loop time"):
            columns = None
        elif columns:
            words = line.split()
            if len(words) == len(columns) and words[0].isdigit():
                tables[-1].append(dict(zip(columns, map(float, words))))
    return tables
