"""An elastic gas conserves energy and momentum."""

import math

MASS = 1e-3  # kg


def check(driver, steps=10000, law="hooke 1e4", limit=1e-4):
    """Yields the name, the value and the limit of each figure."""
    (table,) = driver.run("gas", 1, law=law, timestep=2e-6, steps=steps, every=steps // 10)
    start = table[0]["v_energy"]
    drift = max(abs(row["v_energy"] / start - 1) for row in table)
    # A sum of 1000 momenta, each exact to rounding.
    scale = math.sqrt(2 * table[0]["KinEng"] * MASS * 1000)
    momentum = max(abs(row[f"f_move[{axis}]"]) for row in table for axis in (1, 2, 3)) / scale
    name = f"gas, {law.split()[0]}, {steps} steps"
    yield f"{name}: energy", drift, limit
    yield f"{name}: momentum", momentum, 1e-12
