"""What LAMMPS says about wrong commands: each refusal names the parameter and its value, and ends the run; each warning does not."""

PLANE = "plane 0 0 0 0 0 1 type 1"
DRIVE = f"fix lid all wall/supernormal plane 0 0 0.06 0 0 -1 type 1 drive axis 0 0 -1"

RIGHT = dict(periodic="f", law="hooke 1e4", style="tolerance 1e-9", floor=PLANE, more="print right")

REFUSED = [
    ("law", "hooke stiff", "hooke takes a number instead of stiff"),
    ("law", "hooke 1e999", "hooke = inf is outside (-inf, inf)"),
    ("law", "hooke 1e4 friction 0.1 friction 0.2", "friction is given twice"),
    ("law", "hooke 1e4 hertz 1e7 0.3", "two laws"),
    ("law", "hooke 1e4 exponents 1e-7 2", "exponents = 1e-07 is outside [1.01, 1000]"),
    ("style", "tolerance 0", "tolerance = 0 is outside [1e-15, 1]"),
    ("style", "exponents atom", "there is no d_delta"),
    ("floor", "plane 0 0 0 0 0 0 type 1", "plane: normal = 0 0 0 has no direction"),
    ("floor", "plane 0 0 0 0 0 1e999 type 1", "plane: normal = inf is outside (-inf, inf)"),
    ("floor", "cylinder 0 0 0 0 0 1 -1e-9 type 1", "cylinder: radius = -1e-09 is outside (0, inf)"),
    ("floor", "mesh none.stl -1 type 1", "mesh: unit = -1 is outside (0, inf)"),
    ("floor", "plane 0 0 0 0 0 1 type one", "type takes an integer instead of one"),
    ("floor", f"{PLANE} move linear 1e999 0 0", "linear = inf is outside (-inf, inf)"),
    ("more", f"{DRIVE} force 1 mass 0", "mass = 0 is outside (0, inf)"),
    ("more", f"{DRIVE} force 1 mass 1 travel 1e-9 1", "travel = 1e-09 is outside (-inf, 0]"),
    ("more", f"{DRIVE} force 1 mass 1 from 1e-3 until 1e-9", "until = 1e-09 is outside (from, inf)"),
    ("more", "comm_style tiled", "comm_style tiled with newton off"),
    ("more", "timestep 0", "timestep = 0 is outside (0, inf)"),
    ("more", "run_style respa 2 2 pair 1", "takes run_style verlet"),
    ("periodic", "p", "atoms 2 and 3 are neighbors twice"),
]

WARNED = [
    ("more", "fix two all nve/asphere", "fix nve/asphere takes particles as ellipsoids"),
    ("more", "set atom 1 vz 2e3", "more than its smallest half-axis of 0.01"),
    ("floor", "plane 0 0 0.03 0 0 1 type 1", "overlaps with a wall by 0.0299, more than a half-axis of 0.01"),
]


def check(driver):
    """Yields the name, the value and the limit of each comparison."""
    text = driver.output("refusals", **RIGHT)
    yield "right commands: warnings and errors", sum(word in text for word in ("WARNING", "ERROR")), 0
    for cases, does_fail in ((REFUSED, True), (WARNED, False)):
        for variable, value, message in cases:
            done, _ = driver.attempt("refusals", **{**RIGHT, variable: value})
            holds = message in done.stdout + done.stderr and (done.returncode != 0) == does_fail
            yield f"{variable} {value}: {message}", 0 if holds else 1, 0
    yield from check_restart(driver)
    yield from check_tags(driver)


def check_restart(driver):
    """A restarted wall keeps its kind of drive."""
    slides, turns = f"{DRIVE} force 1 mass 1", f"{DRIVE} torque 1 point 0 0 0 moment 1"
    driver.output("refusals", **{**RIGHT, "more": slides})
    for more, message in ((slides, ""), (turns, "lid has a drive that turns, and in the restart file a drive that slides")):
        done, _ = driver.attempt("refusals_again", more=more)
        holds = message in done.stdout and (done.returncode != 0) == bool(message)
        yield f"restarted: {more}: {message or 'no refusal'}", 0 if holds else 1, 0


def check_tags(driver):
    """Clusters keep their particles if others are deleted, unless the particles get other tags."""
    for compress, message in (("no", ""), ("yes", "the particle with tag")):
        done, _ = driver.attempt("renumbered", compress=compress)
        holds = message in done.stdout + done.stderr and (done.returncode != 0) == bool(message)
        yield f"delete_atoms beside clusters, compress {compress}: {message or 'no refusal'}", 0 if holds else 1, 0
