"""Rigid clusters of bodies: impacts and skidding against closed forms, equal forces on any number of ranks, and restarts."""

import math

from ranks import largest_difference

STYLES = ("rigid/supernormal", "rigid/nve/supernormal", "rigid/small/supernormal", "rigid/nve/small/supernormal")


def radii_of_gyration(epsilon, radius, height):
    """Squared radii of gyration (m^2) about z and about x of the body (rho / radius)^epsilon + |z / height|^epsilon = 1."""

    def moment(power, order):  # the integral over t in [0, 1] of (1 - t^epsilon)^power t^order
        return math.gamma((order + 1) / epsilon) * math.gamma(power + 1) / math.gamma((order + 1) / epsilon + power + 1) / epsilon

    volume = moment(2 / epsilon, 0)
    about_z = radius**2 / 2 * moment(4 / epsilon, 0) / volume
    return about_z, about_z / 2 + height**2 * moment(2 / epsilon, 2) / volume


def check_impact(driver, style, ranks):
    """The end of one dumbbell hits an end of another one, off the line of their centres."""
    epsilon, radius, height, reach, mass, speed, restitution, timestep = 4, 0.01, 0.012, 0.015, 0.01, 0.25, 0.6, 2e-7
    about_z, _ = radii_of_gyration(epsilon, radius, height)
    inertia = 2 * mass * (about_z + reach**2)
    mobility = 2 * (1 / (2 * mass) + reach**2 / inertia)  # 1/kg, of both
    name = f"dumbbells, fix {style}, {ranks} ranks"
    for e, law in ((1, "hooke 1e5"), (restitution, f"hooke 1e5 restitution {restitution}")):
        time = 1.3 * math.pi / math.sqrt(1e5 * mobility)
        (table,) = driver.run("dumbbells", ranks, style=style, exponents=f"2 {epsilon}", radius=radius, height=height, reach=reach,
                              mass=mass, speed=speed, law=law, timestep=timestep, steps=int(time / timestep))
        start, end = table[0], table[-1]
        assert end["v_contacts"] == 0 and max(row["v_contacts"] for row in table) == 1
        yield f"{name}: restitution {e}", abs((end["v_v3"] - end["v_v2"]) / (2 * speed) / e - 1), 1e-3
        impulse = (1 + e) * 2 * speed / mobility
        yield f"{name}: velocity of an end", abs((speed - end["v_v2"]) / (impulse * mobility / 2) - 1), 1e-3
        lost = 0.5 * (1 - e**2) * (2 * speed) ** 2 / mobility
        yield f"{name}: energy", abs(start["v_energy"] - lost - end["v_energy"]) / start["v_energy"], 1e-3 if e < 1 else 1e-5
        momentum, moment = 2 * mass * speed, 2 * mass * speed * reach
        yield f"{name}: momentum", max(abs(row["c_moments[1]"]) for row in table) / momentum, 1e-12
        change = max(abs(row["c_moments[2]"] - start["c_moments[2]"]) for row in table)
        yield f"{name}: angular momentum", change / moment, 1e-9


def check_skid(driver, style):
    """A pair of pills skids until it rolls."""
    epsilon, radius, width, speed, friction, timestep = 4, 0.01, 0.012, 0.5, 0.3, 5e-6
    about_axis, _ = radii_of_gyration(epsilon, radius, width)
    share = about_axis / radius**2
    until = speed * share / (1 + share) / (friction * 9.81)  # s, until it rolls
    steps = int(2 * until / timestep)
    (table,) = driver.run("skid", 1, style=style, exponents=f"2 {epsilon}", radius=radius, width=width, reach=0.013, mass=0.01,
                          speed=speed, friction=friction, timestep=timestep, steps=steps, every=steps // 100)
    half = table[25]
    expected = speed - friction * 9.81 * half["Step"] * timestep
    yield f"pair of pills, fix {style}: velocity as it skids", abs(half["v_vx"] / expected - 1), 1e-3
    yield f"pair of pills, fix {style}: velocity as it rolls", abs(table[-1]["v_vx"] / (speed / (1 + share)) - 1), 1e-3


def check_ranks(driver, style):
    """A bed of crosses on 1, 2 and 4 ranks, and restarted on another number of ranks."""
    driver.run("clusters", 1, style=style, resumes=0, **{"from": "none"}, until=60000, every=60000, out="clusters_bed")
    bed = "clusters_bed.60000.restart"
    reference = None
    for ranks in (1, 2, 4):
        out = f"clusters_{ranks}"
        (table,) = driver.run("clusters", ranks, style=style, resumes=1, **{"from": bed}, until=60020, every=60010, out=out)
        assert table[-1]["c_pair[1]"] > 100
        (rows,) = driver.dump(f"{out}.dump").values()
        if reference is None:
            reference = rows
            continue
        for what, columns in (("forces", (7, 8, 9)), ("torques", (10, 11, 12))):
            yield f"crosses, fix {style}, {ranks} ranks: {what}", largest_difference(rows, reference, columns), 1e-9
    for ranks in (1, 2):
        out = f"clusters_again_{ranks}"
        driver.run("clusters", ranks, style=style, resumes=1, **{"from": "clusters_1.60010.restart"}, until=60020, every=60010, out=out)
        (rows,) = driver.dump(f"{out}.dump").values()
        yield f"crosses, fix {style}, restarted on {ranks} ranks: forces", largest_difference(rows, reference, (7, 8, 9)), 1e-9


def check(driver):
    """Yields the name, the value and the limit of each comparison."""
    for style in STYLES:
        yield from check_impact(driver, style, 2)
        yield from check_skid(driver, style)
    for style in STYLES[2:]:
        yield from check_ranks(driver, style)
