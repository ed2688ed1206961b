"""Adhesion, and resistance to rolling and to spinning, against closed forms."""

GRAVITY = 9.81  # m/s^2


def check_adhesion(driver):
    """A ball and a brick under a ceiling: how deep adhesion pulls them in, and the gravity at which they fall."""
    mass, pull, stiffness, rate, timestep = 0.01, 0.2, 1e4, 10.0, 2e-5  # kg, N, N/m, m/s^3, s
    # The springs of both materials in series have this stiffness, and their adhesion has this geometric mean.
    law, ceiling = (f"hooke {factor * stiffness} restitution 0.1 friction 0.5 adhesion {force}" for factor, force in ((0.8, 0.1), (4 / 3, 0.4)))
    steps = int(1.1 * pull / mass / rate / timestep)
    (table,) = driver.run("hang", 1, law=law, ceiling=ceiling, mass=mass, rate=rate, timestep=timestep, steps=steps, every=steps // 1000)
    for body, z, contacts in (("ball", "v_z1", "f_ball[7]"), ("brick", "v_z2", "f_brick[7]")):
        held = [row for row in table if row[contacts] > 0]
        middle = held[len(held) // 2]
        depth = (pull - mass * middle["v_gravity"]) / stiffness
        yield f"adhesion, {body}: depth", abs((0.01 + middle[z]) / depth - 1), 0.01
        yield f"adhesion, {body}: pull-off force", abs(mass * held[-1]["v_gravity"] / pull - 1), 0.01


def check_resistance(driver):
    radius, mass, length, timestep = 0.01, 0.01, 2e-4, 2e-5  # m, kg, m, s
    settings = dict(radius=radius, mass=mass, timestep=timestep)
    # The torque against rolling is the length times the weight. Friction keeps the ball rolling.
    speed, deceleration = 0.1, 5 / 7 * length / radius * GRAVITY
    steps = int(2 * speed / deceleration / timestep)
    (table,) = driver.run("resist", 1, law=f"hooke 1e5 restitution 0.3 friction 1 rolling {length}", speed=speed, spin=0, steps=steps,
                          every=steps // 100, **settings)
    yield "rolling: distance to rest", abs(table[-1]["v_x"] / (speed**2 / 2 / deceleration) - 1), 0.01
    yield "rolling: velocity at rest, of the first", abs(table[-1]["v_vx"]) / speed, 1e-6
    # The torque against spinning is the length times the weight.
    spin, deceleration = 20.0, 2.5 * length * GRAVITY / radius**2
    steps = int(1.5 * spin / deceleration / timestep)
    (table,) = driver.run("resist", 1, law=f"hooke 1e5 restitution 0.3 friction 1 spinning {length}", speed=0, spin=spin, steps=steps,
                          every=steps // 90, **settings)
    half = min(table, key=lambda row: abs(row["Step"] * timestep - spin / 2 / deceleration))
    yield "spinning: velocity at half of the time", abs(half["v_spun"] / (spin - deceleration * half["Step"] * timestep) - 1), 0.01
    yield "spinning: velocity at rest, of the first", abs(table[-1]["v_spun"]) / spin, 1e-6


def check(driver):
    """Yields the name, the value and the limit of each comparison."""
    yield from check_adhesion(driver)
    yield from check_resistance(driver)
