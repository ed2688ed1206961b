"""Walls carry their load, and a drum moves its charge."""

import itertools

WEIGHT_STEPS = 16000


def write_pan(path, half, height, cells):
    """An open box of triangles as an STL file, z = 0 to `height`, facing inwards."""
    facets = []

    def quad(a, b, c, d):
        facets.extend([(a, b, c), (a, c, d)])

    step = 2 * half / cells
    for i, j in itertools.product(range(cells), repeat=2):
        x, y = -half + i * step, -half + j * step
        quad((x, y, 0), (x + step, y, 0), (x + step, y + step, 0), (x, y + step, 0))
    low, high = (-half, half)
    for (x1, y1), (x2, y2) in (((low, low), (low, high)), ((low, high), (high, high)), ((high, high), (high, low)), ((high, low), (low, low))):
        quad((x1, y1, 0), (x2, y2, 0), (x2, y2, height), (x1, y1, height))
    with open(path, "w", encoding="ascii") as file:
        file.write("solid pan\n")
        for facet in facets:
            file.write("facet normal 0 0 0\nouter loop\n")
            file.writelines(f"vertex {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in facet)
            file.write("endloop\nendfacet\n")
        file.write("endsolid pan\n")


def check_weight(driver):
    write_pan(driver.folder / "pan.stl", 0.035, 0.25, 7)
    nothing = "plane 0 0 -1 0 0 1"
    containers = {
        "cylinder": ("cylinder 0 0 0 0 0 1 0.04", "plane 0 0 0 0 0 1"),
        "box": ("box -0.035 -0.035 0 0.035 0.035 0.25", nothing),
        "mesh": ("mesh pan.stl 1", nothing),
    }
    for name, (sides, floor) in containers.items():
        (table,) = driver.run("bed", 1, sides=sides, floor=floor, steps=WEIGHT_STEPS, every=WEIGHT_STEPS // 20)
        yield f"{name}: weight that is borne", max(abs(row["v_borne"] - 1) for row in table[-3:]), 1e-3


def check_drum(driver, steps=60000):
    (table,) = driver.run("drum", 1, rpm=40, steps=steps, every=steps, out="drum")
    steady = table[len(table) // 3 :]
    torque = sum(row["f_mean[1]"] for row in steady) / len(steady)
    lever = sum(row["f_mean[2]"] for row in steady) / len(steady)
    yield f"drum, {steps} steps: torque against the weight's", abs(torque / lever - 1), 0.03
    yield f"drum, {steps} steps: particles lost", table[0]["Atoms"] - table[-1]["Atoms"], 0


def check_restart(driver):
    """A drum resumes from a restart file, including wall springs and motion."""
    common = dict(rpm=40, every=2000)
    for ranks in (1, 2):
        whole, again = f"whole_drum_{ranks}", f"again_drum_{ranks}"
        driver.run("drum", ranks, steps=8000, out=whole, **common)
        driver.run("drum_again", ranks, **{"from": f"{whole}.6000.restart"}, until=8000, out=again, **common)
        differ = driver.do_restarts_differ(f"{whole}.8000.restart", f"{again}.8000.restart")
        yield f"drum on {ranks} ranks: restarted run differs", 1 if differ else 0, 0


def check_time(driver):
    """The position of a moving wall follows the time, whatever happens to the step and the step counter of LAMMPS."""

    change_at = 0.08  # s: 8000 steps of 1e-5 s; the wall has 0.1 m/s

    def farthest(table, start):
        # LAMMPS' time may start anew with the step counter or after a restart, which depends on its version.
        before = 0.1 * (start - table[0]["Time"])
        touching = [row for row in table if row["f_wall[7]"] > 0]
        assert len(touching) >= 4
        return max(abs(row["v_is"] - row["v_right"] - before) for row in touching)

    for change in ("none", "timestep", "counter", "adaptive"):
        first, second = driver.run("moving_wall", 1, change=change, out=f"{change}.restart")
        distance = max(farthest(first, 0), farthest(second, change_at))
        yield f"moving wall, {change}: distance from its place, m", distance, 1e-12
    (table,) = driver.run("moving_wall_again", 1, **{"from": "none.restart"})
    yield "moving wall, restart with another step: distance from its place, m", farthest(table, change_at), 1e-12


def check(driver):
    """Yields the name, the value and the limit of each comparison."""
    yield from check_weight(driver)
    yield from check_time(driver)
    yield from check_drum(driver)
    yield from check_restart(driver)
