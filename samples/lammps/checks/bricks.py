"""Bricks rest on their faces: one as in ODE, and a wall of them. Rods and cans rest on their sides."""

import csv
import subprocess

from walls import write_pan

# Floors: words of fix wall/supernormal.
PLANE, MESH = "plane 0 0 0 0 0 1", "mesh floor.stl 1"
COURSES, LONGEST = 6, 5
LENGTH, HEIGHT = 0.04, 0.02  # m
STEPS = 50000

CATALOGUE = """[brick]
half_axes = [0.02, 0.015, 0.01]
delta = 20
epsilon = 20
density = 2000
source = "a brick"
"""

SCENE = """seed = 3
catalogue = "catalogue.toml"
[container]
kind = "box"
width = [0.2, 0.2]
[drop]
height = 0.005
gap = 0.05
total = 4
[[grain]]
name = "brick"
fraction = 1
[time]
duration = 1.0
step = 5e-4
frame = 0.1
[solver]
iterations = 40
erp = 0.2
cfm = 1e-10
[compliance]
stiffness = 20000
damping = 20
[gravity]
acceleration = [0, 0, -9.81]
[friction]
coefficient = 0.5
"""


def check_ode(driver):
    """Four bricks fall on the floor in any orientation: falling_particles, and LAMMPS from the same start with the same stiffness."""
    program = driver.other_product("falling_particles")
    if program is None:
        print("left out: bricks: four bricks on the floor: there is no falling_particles in this build")
        return
    (driver.folder / "catalogue.toml").write_text(CATALOGUE, encoding="utf-8")
    scene = driver.folder / "brick.toml"
    scene.write_text(SCENE, encoding="utf-8")
    subprocess.run([program, "-q", "-t", "1", "--no-pictures", "--scene", scene, "--out", driver.folder], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([program, "--scene", scene, "--to-lammps", driver.folder], check=True)
    (table,) = driver.run(str((driver.folder / "brick").resolve()))
    with open(driver.folder / "brick/trajectory.csv", encoding="utf-8") as file:
        rigid = [row for row in csv.DictReader(file)][-4:]
    soft = sorted(driver.dump("brick.lammpstrj").items())[-1][1]
    heights = zip(sorted(float(row["z_m"]) for row in rigid), sorted(row[4] for row in soft))
    yield "four bricks on the floor: height of the centre, from ODE's, of the half-height", max(abs(a - b) for a, b in heights) / 0.01, 1e-4
    yield "four bricks on the floor: kinetic energy, of the largest", table[-1]["Temp"] / max(row["Temp"] for row in table), 1e-20


def check_wall(driver):
    lines = []
    for course in range(COURSES):
        count = LONGEST - course % 2
        lines += [f"create_atoms 1 single {(k - (count - 1) / 2) * 1.005 * LENGTH} 0 {(course + 0.5) * HEIGHT}" for k in range(count)]
    (driver.folder / "wall.bricks").write_text("\n".join(lines) + "\n", encoding="ascii")
    for kind, floor in (("", PLANE), (" on a mesh", MESH)):
        (table,) = driver.run("bricks", 1, bricks="wall.bricks", steps=STEPS, every=STEPS // 10, out="wall.dump", floor=floor)
        frames = driver.dump("wall.dump")
        start, end = frames[0], frames[STEPS]
        moved = max(max(abs(a - b) for a, b in zip(old[1:4], new[1:4])) for old, new in zip(start, end))
        tilted = max(2 * max(abs(q) for q in row[5:8]) for row in end)
        yield f"wall of bricks{kind} after 1 s: distance moved, of the height of a brick", moved / HEIGHT, 0.01
        yield f"wall of bricks{kind}: rotation, rad", tilted, 2e-3
        yield f"wall of bricks{kind}: kinetic energy, J", table[-1]["v_kinetic"], 1e-12
        yield f"wall of bricks{kind}: weight on the floor", abs(table[-1]["v_borne"] - 1), 1e-6


def check_rod(driver):
    """A rod with an oval outline drops on its side, on floors of three kinds."""
    for kind, floor in (("plane", PLANE), ("mesh", MESH), ("pipe", "cylinder 0 0 0.1 1 0 0 0.1")):
        (table,) = driver.run("rod", 1, exponents="2 20", floor=floor, steps=STEPS, every=STEPS // 50)
        end = table[-1]
        yield f"rod on its side after 0.5 s, {kind}: slope, rad", abs(end["c_slope"]), 1e-9
        yield f"rod, {kind}: kinetic energy, J", end["v_kinetic"], 1e-20
        yield f"rod, {kind}: weight on the floor", abs(end["v_borne"] - 1), 1e-9


def check_pile(driver):
    """A can drops on its side on a brick, and a log on two others."""
    (table,) = driver.run("pile", 1, steps=2 * STEPS, every=STEPS)
    end = table[-1]
    yield "a can on a brick, and a log on two, after 1 s: kinetic energy, J", end["v_kinetic"], 1e-15
    yield "the same: weight on the floor", abs(end["v_borne"] - 1), 1e-9


def check(driver):
    """Yields the name, the value and the limit of each comparison."""
    write_pan(driver.folder / "floor.stl", 0.12, 0.01, 9)
    yield from check_ode(driver)
    yield from check_wall(driver)
    yield from check_rod(driver)
    yield from check_pile(driver)
