#!/usr/bin/env python3
"""Measurements that take longer than the checks: study.py PROGRAM FOLDER NAME."""

import argparse
import re

import gas
import heap
import liggghts
import walls
from driver import INPUTS, Driver, read_tables

COPIES = {10240: (5, 2, 2), 100352: (7, 7, 4)}  # replications of the bed with 512 particles


def processor_times(text):
    """Processor time of a rank (s) per step of the last run, in total and for pairs. Waiting is excluded."""
    loop, steps = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps", text)[-1]
    share = float(re.findall(r"([\d.]+)% CPU use", text)[-1]) / 100
    pairs = re.findall(r"^Pair +\| *\S+ *\| *(\S+)", text, re.MULTILINE)[-1]
    return float(loop) * share / int(steps), float(pairs) * share / int(steps)


def prepare_bed(driver):
    driver.run("dense", out="bed.restart")
    return "bed.restart.data"


def study_cost(driver):
    """The cost of a pair, compared with styles of LAMMPS: 10 240 particles on one rank."""
    bed = prepare_bed(driver)
    copies = dict(zip(("nx", "ny", "nz"), COPIES[10240]))
    print("| style | pairs computed | in contact | ns per pair | ns per contact |\n|---|---:|---:|---:|---:|")
    for name in ("supernormal", "spheres", "gayberne"):
        settings = dict(copies, steps=100)
        if name != "spheres":
            settings["bed"] = bed
        text = driver.output(f"cost_{name}", **settings)
        end = read_tables(text)[-1][-1]
        _, pair_time = processor_times(text)
        if name == "supernormal":
            computed, contacts = end["c_pair[3]"], end["c_pair[1]"]
        else:
            computed = contacts = end["c_twice"] / 2
        in_contact = "" if name == "gayberne" else f"{contacts:.0f}"
        per_contact = "" if name == "gayberne" else f"{1e9 * pair_time / contacts:.0f}"
        print(f"| {name} | {computed:.0f} | {in_contact} | {1e9 * pair_time / computed:.0f} | {per_contact} |", flush=True)


def study_scaling(driver):
    """Time per step and memory for 10 240 and 100 352 particles on 1 and 2 ranks."""
    bed = prepare_bed(driver)
    print("| particles | ranks | ms per step | us per particle and step | in pairs | ns per pair asked | MB per rank |\n|---:|---:|---:|---:|---:|---:|---:|")
    for particles, copies in COPIES.items():
        for ranks in (1, 2):
            settings = dict(zip(("nx", "ny", "nz"), copies), bed=bed, steps=20000 // (particles // 100))
            text = driver.output("cost_supernormal", ranks, **settings)
            step, pairs = processor_times(text)
            asked = read_tables(text)[-1][-1]["c_pair[3]"]
            memory = float(re.findall(r"Maximum resident set size: (\S+) Mbyte", text)[-1])
            cells = [particles, ranks, f"{1e3 * step:.1f}", f"{1e6 * step * ranks / particles:.2f}", f"{100 * pairs / step:.0f} %"]
            cells += [f"{1e9 * pairs * ranks / asked:.0f}", f"{memory:.0f}"]
            print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def study_gas(driver):
    """An elastic gas over 100 000 steps, with Hooke and Hertz forces."""
    for law in ("hooke 1e4", "hertz 1e7 0.3"):
        for what, value, _ in gas.check(driver, steps=100000, law=law):
            print(f"{what}: {value:.2g}", flush=True)


def study_drum(driver):
    """A drum that rotates for a million steps."""
    for what, value, _ in walls.check_drum(driver, steps=1000000):
        print(f"{what}: {value:.2g}", flush=True)


def study_liggghts(driver):
    """The cost of a step beside LIGGGHTS' superquadrics (../build_liggghts)."""
    liggghts.study(driver, INPUTS.parents[2] / "build" / "liggghts" / "lmp_liggghts", processor_times)


STUDIES = {"cost": study_cost, "scaling": study_scaling, "liggghts": study_liggghts, "gas": study_gas, "heap": heap.study, "drum": study_drum}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="supernormal_lammps")
    parser.add_argument("folder", help="for what it writes")
    parser.add_argument("name", choices=STUDIES, help="; ".join(f"{name}: {study.__doc__}" for name, study in STUDIES.items()))
    arguments = parser.parse_args()
    STUDIES[arguments.name](Driver(arguments.program, arguments.folder))


if __name__ == "__main__":
    main()
