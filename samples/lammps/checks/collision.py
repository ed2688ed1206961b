"""Two bodies collide: time, overlap and rebound against closed forms."""

import math

MASS, SPEED = 0.01, 0.25  # kg; m/s of each body
REDUCED = MASS / 2
MODULUS = 1e8 / (2 * (1 - 0.3**2))  # Pa; effective modulus for Young's modulus 1e8 Pa and Poisson's ratio 0.3


def elliptic_integrals(b):
    """K and E of the ellipse with half-axes 1 and b, by the arithmetic-geometric mean (Abramowitz and Stegun, 17.6)."""
    mean, geometric, total, weight = 1.0, b, (1 - b * b) / 2, 1.0
    while abs(mean - geometric) > 1e-15:
        difference = (mean - geometric) / 2
        mean, geometric = (mean + geometric) / 2, math.sqrt(mean * geometric)
        total += weight * difference**2
        weight *= 2
    K = math.pi / (2 * mean)
    return K, K * (1 - total)


def hertz_stiffness(curvature1, curvature2):
    """k of F = k depth^(3/2) for two relative curvatures, 1/m: Johnson, Contact Mechanics, sections 3.3 and 4.2(c)."""
    larger, smaller = max(curvature1, curvature2), min(curvature1, curvature2)
    correction = 1.0
    if larger > smaller * (1 + 1e-9):
        low, high = 1e-4, 1.0  # axis ratio of the contact
        for _ in range(100):
            b = (low + high) / 2
            K, E = elliptic_integrals(b)
            if (E / b**2 - K) / (K - E) > larger / smaller:
                low = b
            else:
                high = b
        A, B = (K - E) * b / (1 - b * b), (E / b**2 - K) * b / (1 - b * b)
        correction = b * K / (9 / 8 * (2 / 3 * math.pi * b) ** 2 * math.sqrt(A * B)) ** (1 / 3)
    return 4 / 3 * MODULUS * (smaller * larger) ** -0.25 * correction**-1.5


def collide(driver, ranks, timestep, time, **variables):
    """The time in contact (s), the largest overlap (m), and the final state of the first body."""
    defaults = dict(a=0.01, b=0.01, c=0.01, slip=0, spin=0, newton="on", speed=SPEED, type1=1, type2=1)
    settings = {**defaults, **variables}
    law = settings.pop("law", None)
    if law:
        settings.update(law1=law, law2=law)
    (table,) = driver.run("collision", ranks, timestep=timestep, steps=int(1.2 * time / timestep), **settings)
    touching = [row for row in table if row["c_pair[1]"] > 0]
    overlap = max(2 * settings["a"] - (row["v_x2"] - row["v_x1"]) for row in table)
    return len(touching) * timestep, overlap, table[-1]


def check_hertz(driver, ranks, name, axes, **variables):
    a, b, c = axes
    k = hertz_stiffness(2 * a / b**2, 2 * a / c**2)
    expected_overlap = (1.25 * REDUCED * (2 * SPEED) ** 2 / k) ** 0.4
    expected_time = 2.9432675 * expected_overlap / (2 * SPEED)
    time, overlap, end = collide(driver, ranks, expected_time / 2000, expected_time, a=a, b=b, c=c, law="hertz 1e8 0.3", **variables)
    yield f"{name}: time", abs(time / expected_time - 1), 0.01
    yield f"{name}: overlap", abs(overlap / expected_overlap - 1), 0.01
    yield f"{name}: rebound", abs(end["v_vx"] / -SPEED - 1), 0.01


def check_restitution(driver, ranks):
    for law in ("hertz 1e8 0.3", "hooke 1e6"):
        *_, end = collide(driver, ranks, 1e-7, 1e-3, law=law + " restitution 0.7")
        yield f"restitution, {law.split()[0]}", abs(end["v_vx"] / (-0.7 * SPEED) - 1), 0.01


def check_oblique(driver, ranks):
    """Spinning balls in an oblique impact. They are so stiff that the normal hardly rotates during the impact."""
    radius, stiffness, slip, spin = 0.01, 1e8, 0.02, 0.7  # m, N/m, m/s, rad/s
    inertia = 0.4 * MASS * radius**2
    time = math.pi * math.sqrt(REDUCED / stiffness)
    rate = 2 * slip + 2 * radius * spin
    settings = dict(slip=slip, spin=inertia * spin)
    # Sticking: the tangential spring and 2/7 of the reduced mass oscillate.
    *_, end = collide(driver, ranks, time / 4000, time, law=f"hooke {stiffness} friction 1e6 tangential 0.3", **settings)
    left = 2 * end["v_vy"] + 2 * radius * end["v_spin1"] / inertia
    yield "oblique, sticking: slip", abs(left / rate - math.cos(math.sqrt(3.5 * 0.3) * math.pi)), 0.01
    # Sliding: the friction impulse is mu times the normal impulse.
    slip, spin = 1.0, 20.0
    *_, end = collide(driver, ranks, time / 4000, time, law=f"hooke {stiffness} friction 0.1", slip=slip, spin=inertia * spin)
    impulse = 0.1 * 2 * SPEED  # divided by the mass
    yield "oblique, sliding: velocity", abs(end["v_vy"] / (slip - impulse) - 1), 0.01
    yield "oblique, sliding: spin", abs(end["v_spin1"] / inertia - (spin - 2.5 * impulse / radius)) / (2.5 * impulse / radius), 0.01


def check_materials(driver):
    """Two materials, and what they mix to: springs in series, geometric means of the other parameters."""
    radius = 0.01  # m
    moduli, ratios = (1e8, 4e7), (0.3, 0.45)
    laws = [f"hertz {E} {nu}" for E, nu in zip(moduli, ratios)]
    for type1, type2 in ((1, 1), (2, 2), (1, 2)):
        pair = f"types {type1} and {type2}"
        both = dict(type1=type1, type2=type2)
        compliance = sum((1 - ratios[t - 1] ** 2) / moduli[t - 1] for t in (type1, type2))  # 1/E*, Johnson, eq. 4.22
        k = 4 / 3 / compliance * math.sqrt(radius / 2)
        expected = (1.25 * REDUCED * (2 * SPEED) ** 2 / k) ** 0.4
        time = 2.9432675 * expected / (2 * SPEED)
        _, overlap, _ = collide(driver, 1, time / 1000, time, law1=laws[0], law2=laws[1], **both)
        yield f"{pair}: overlap by Hertz's theory", abs(overlap / expected - 1), 0.01
        *_, end = collide(driver, 1, time / 1000, 2 * time, law1=laws[0] + " restitution 0.9", law2=laws[1] + " restitution 0.4", **both)
        yield f"{pair}: restitution", abs(end["v_vx"] / -SPEED / math.sqrt((0.9, 0.4)[type1 - 1] * (0.9, 0.4)[type2 - 1]) - 1), 0.01
        # Sliding: the friction impulse is mu times the normal impulse.
        friction = math.sqrt((0.1, 0.4)[type1 - 1] * (0.1, 0.4)[type2 - 1])
        *_, end = collide(driver, 1, 1e-9, 2.5e-6, law1="hooke 1e10 friction 0.1", law2="hooke 1e10 friction 0.4", slip=1, **both)
        yield f"{pair}: friction", abs((1 - end["v_vy"]) / (friction * 2 * SPEED) - 1), 0.01


def check(driver):
    """Yields the name, the relative error and the limit of each comparison."""
    yield from check_hertz(driver, 1, "balls", (0.01, 0.01, 0.01))
    yield from check_hertz(driver, 2, "ellipsoids, two ranks", (0.012, 0.01, 0.005))
    yield from check_hertz(driver, 2, "ellipsoids, newton off", (0.012, 0.01, 0.005), newton="off")
    yield from check_restitution(driver, 1)
    yield from check_oblique(driver, 2)
    yield from check_materials(driver)
