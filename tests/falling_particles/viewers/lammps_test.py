"""Reads the LAMMPS dumps of runs with ASE's reader and compares them with the trajectories.

lammps_test.py RUNS: the folder of the run "box". Exit code 77: ASE is not there.
"""

import csv
import sys
from pathlib import Path

try:
    import ase.io
except ImportError:
    print("skipped: python3-ase is not installed (tests/run viewers installs it)")
    sys.exit(77)


def main():
    run = Path(sys.argv[1]) / "box"
    with open(run / "trajectory.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    frames = ase.io.read(run / "grains.lammpstrj", index=":", format="lammps-dump-text")
    names = []
    start = 0
    for frame in frames:
        part = rows[start : start + len(frame)]
        start += len(frame)
        for row, position, kind in zip(part, frame.positions, frame.numbers, strict=True):
            assert list(position) == [float(row[name]) for name in ("x_m", "y_m", "z_m")]
            if row["grain"] not in names:
                names.append(row["grain"])
            assert frames[0].numbers[int(row["body"])] == kind  # a body keeps its type
    assert start == len(rows) and len(frames) == len({row["time_s"] for row in rows})
    assert len(set(frames[0].numbers)) == len(names)
    print(f"ASE reads what the trajectory says: {len(frames)} frames of {len(frames[0])} grains")


main()
