#!/usr/bin/env python3
"""Compares supernormal_lammps with closed forms and with itself: check.py PROGRAM FOLDER [NAME...]."""

import argparse
import sys
import time

import bricks
import clusters
import collision
import driven
import example
import gas
import ranks
import refusals
import sizes
import surfaces
import walls
from driver import Driver

CHECKS = {"bricks": bricks.check, "clusters": clusters.check, "collision": collision.check, "driven": driven.check, "example": example.check, "gas": gas.check, "ranks": ranks.check, "refusals": refusals.check, "sizes": sizes.check, "surfaces": surfaces.check, "walls": walls.check}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="supernormal_lammps")
    parser.add_argument("folder", help="for what it writes")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(CHECKS)}; all without")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - set(CHECKS)
    if unknown:
        parser.error(f"{', '.join(sorted(unknown))}: choose from {', '.join(CHECKS)}")

    driver = Driver(arguments.program, arguments.folder)
    failed, summary = 0, []
    for name in arguments.names or CHECKS:
        start, worst = time.monotonic(), 0.0
        for what, value, limit in CHECKS[name](driver):
            holds = value <= limit
            failed += not holds
            worst = max(worst, value)
            print(f"{'ok    ' if holds else 'FAILED'} {name}: {what}: {value:.2g} (at most {limit:g})", flush=True)
        summary.append(f"{name} {worst:.1g} ({time.monotonic() - start:.0f} s)")
    print(f"{failed} failed; largest errors: {', '.join(summary)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
