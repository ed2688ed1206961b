"""An elastic gas conserves energy and momentum."""

import math

MASS = 1e-3  # kg
# Their faces meet: they start parallel, and every kind is flat somewhere.
BOXY = dict(exponents1="8 8", exponents2="20 20", exponents3="2 12", exponents4="60 60", orientation="quat 0 0 1 0")
# All have straight sides: cans, one with a flattened outline, and a pillow.
CANS = dict(exponents1="2 20", exponents2="3 12", exponents3="2 12", exponents4="20 2", orientation="quat 0 0 1 0")


def check(driver, steps=10000, law="hooke 1e4", limit=1e-4):
    """Yields the name, the value and the limit of each figure."""
    yield from check_gas(driver, "gas", steps, law, limit)
    yield from check_gas(driver, "gas of bricks", steps, law, limit, **BOXY)
    yield from check_gas(driver, "gas of cans", steps, law, limit, **CANS)
    if law == "hooke 1e4":
        yield from check_rigid(driver, steps, limit)


def check_gas(driver, kind, steps, law, limit, **bodies):
    (table,) = driver.run("gas", 1, law=law, timestep=2e-6, steps=steps, every=steps // 100, **bodies)
    start = table[0]["v_energy"]
    drift = max(abs(row["v_energy"] / start - 1) for row in table)
    # A sum of 1000 momenta, each exact to rounding.
    scale = math.sqrt(2 * table[0]["KinEng"] * MASS * 1000)
    momentum = max(abs(row[f"f_move[{axis}]"]) for row in table for axis in (1, 2, 3)) / scale
    name = f"{kind}, {law.split()[0]}, {steps} steps"
    yield f"{name}: energy", drift, limit
    yield f"{name}: momentum", momentum, 1e-12
    if bodies:
        faces, contacts = (sum(row[f"c_pair[{k}]"] for row in table) for k in (5, 1))
        yield f"{name}: faces meet in fewer than a tenth of the contacts", 0 if faces > 0.1 * contacts else 1, 0


def check_rigid(driver, steps, limit):
    """Crosses of two bodies, moved by fix rigid/nve/supernormal."""
    for kind, exponents in (("ellipsoids", "2 2"), ("bricks", "12 20")):
        (table,) = driver.run("rigid", 1, exponents=exponents, steps=steps, every=steps // 100)
        drift = max(abs(row["v_energy"] / table[0]["v_energy"] - 1) for row in table)
        yield f"gas of rigid crosses of {kind}, {steps} steps: energy", drift, limit
