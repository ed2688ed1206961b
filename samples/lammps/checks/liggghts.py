"""The cost of our pairs beside LIGGGHTS' superquadrics, and the contacts that LIGGGHTS misses in its first step."""

import math
import re
import statistics
import subprocess

from driver import INPUTS, read_tables

EXPONENTS = (2, 4, 8, 20)
FILLED = 0.53  # of the box
SPACING = 0.014  # m; of the lattice in dense.in, with a particle for each cell
BOX_OF_A_PARTICLE = 1.08e-6  # m^3; the mean over the types in dense.in
ROUNDS = 5
STEPS = 1000


def volume_share(exponent):
    """Of its box: the volume of |x|^e + |y|^e + |z|^e <= 1."""
    return math.gamma(1 + 1 / exponent) ** 3 / math.gamma(1 + 3 / exponent)


def read_sections(path):
    """The rows of the sections of a LAMMPS data file, as lists of words by the particle's number."""
    sections, rows = {}, None
    for line in path.read_text().splitlines():
        words = line.split("#")[0].split()
        if words and words[0] in ("Atoms", "Velocities", "Ellipsoids"):
            rows = sections[words[0]] = {}
        elif words and rows is not None:
            rows[int(words[0])] = words[1:]
    return sections


def write_beds(folder, name, exponent):
    """NAME.data without rotation, since LIGGGHTS reads none: NAME.still, and for LIGGGHTS NAME.bed and NAME.poses."""
    text = (folder / f"{name}.data").read_text()
    sections = read_sections(folder / f"{name}.data")
    before, after = text.split("Velocities")[0], text.split("Ellipsoids")[1]
    still = [" ".join([str(number), *words[:3], "0 0 0"]) for number, words in sections["Velocities"].items()]
    (folder / f"{name}.still").write_text("\n".join([before + "Velocities", "", *still, "", "Ellipsoids" + after]))
    header = [line for line in before.splitlines()[:15] if line.endswith("hi")]
    atoms, poses = [], []
    for number, (kind, _, _, *place) in sections["Atoms"].items():
        shape = [0.5 * float(word) for word in sections["Ellipsoids"][number][:3]]
        density = 1e-3 / (8 * math.prod(shape) * volume_share(exponent))
        atoms.append([number, kind, density, *shape, exponent, exponent, *place[:3]])
        poses.append(["set atom", number, "quat_direct", *sections["Ellipsoids"][number][3:]])
    lines = ["bed", "", f"{len(atoms)} atoms", "2 atom types", *header, "", "Atoms", ""]
    lines += [" ".join(map(str, row)) for row in atoms] + ["", "Velocities", "", *still]
    (folder / f"{name}.bed").write_text("\n".join(lines) + "\n")
    (folder / f"{name}.poses").write_text("\n".join(" ".join(map(str, row)) for row in poses) + "\n")


def read_overlaps(path):
    """The depths (m) of the overlapping pairs of a dump of pairs."""
    rows = [line.split() for line in path.read_text().split("ITEM: ENTRIES")[1].splitlines()[1:]]
    return {frozenset(int(float(word)) for word in row[:2]): abs(float(row[2])) for row in rows if float(row[2]) != 0}


def run_liggghts(folder, program, **variables):
    command = [program, "-in", INPUTS / "cost_liggghts.in", "-log", "none"]
    for variable, value in variables.items():
        command += ["-var", variable, value]
    return subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=True).stdout


def study(driver, liggghts, processor_times):
    """Prints the table. `liggghts`: the program that build_liggghts makes."""
    law = "hertz 1e7 0.3 restitution 0.6 friction 0.4"
    print("| exponents | ours, us per step | LIGGGHTS | ratio | ours, ns per pair asked | overlaps | missed by LIGGGHTS | by us |\n|---:|---:|---:|---:|---:|---:|---:|---:|")
    for exponent in EXPONENTS:
        name, both = f"{exponent}.restart", f"{exponent} {exponent}"
        scale = (BOX_OF_A_PARTICLE * volume_share(exponent) / (SPACING**3 * FILLED)) ** (1 / 3)
        driver.run("dense", out=name, exponents1=both, exponents2=both, scale=scale)
        write_beds(driver.folder, name, exponent)
        common = {"bed": f"{name}.still", "exponents1": both, "exponents2": both}
        driver.run("overlaps", out="ours.dump", **common)
        times, theirs = [], []
        for _ in range(ROUNDS):
            text = driver.output("cost_supernormal", nx=1, ny=1, nz=1, steps=STEPS, law=law, **common)
            times.append(processor_times(text)[1])
            asked = read_tables(text)[-1][-1]["c_pair[3]"]
            other = run_liggghts(driver.folder, liggghts, bed=f"{name}.bed", poses=f"{name}.poses", steps=STEPS, out="theirs.dump")
            theirs.append(float(re.findall(r"^Pair +time \(%\) = (\S+)", other, re.MULTILINE)[-1]) / STEPS)
        ours, found = (read_overlaps(driver.folder / f"{who}.dump") for who in ("ours", "theirs"))
        ratio = statistics.median(b / a for a, b in zip(times, theirs))
        cells = [exponent, f"{1e6 * statistics.median(times):.0f}", f"{1e6 * statistics.median(theirs):.0f}", f"{ratio:.2f}"]
        cells += [f"{1e9 * statistics.median(times) / asked:.0f}", len(ours)]
        cells += [len(ours.keys() - found.keys()), len(found.keys() - ours.keys())]
        print("| " + " | ".join(map(str, cells)) + " |", flush=True)
