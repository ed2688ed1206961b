"""Driven walls and servos against closed forms, on any number of ranks, and after a restart."""

import math

STIFFNESS, BALLS, AREA = 1e3, 4, 0.01  # N/m, of each ball and the plane; m^2


def press(driver, drive, timestep, time, every=1, ranks=1, save=1000000, out="press", sides=0, law=f"hooke {STIFFNESS}"):
    steps = round(time / timestep)
    (table,) = driver.run("press", ranks, drive=drive, law=law, timestep=timestep, steps=steps, every=every, save=save, out=out, sides=sides)
    return [(row["Step"] * timestep, row) for row in table]


def check_ranks(driver, kind, drive, timestep):
    """The place of a wall after 100 steps."""
    one, *others = (press(driver, drive, timestep, 100 * timestep, ranks=ranks)[-1][1]["f_wall[8]"] for ranks in (1, 2, 4))
    yield f"{kind} on 1, 2, 4 ranks: place", max(abs(other / one - 1) for other in others), 1e-12


def check_force(driver):
    """A plate under a constant force and its weight on the springs of balls: x = (F / k) (1 - cos w t)."""
    mass, force, spring = 0.05, 0.2, BALLS * STIFFNESS
    total = force + mass * 9.81
    omega = math.sqrt(spring / mass)
    period = 2 * math.pi / omega
    drive = f"axis 0 0 -1 force {force} mass {mass} gravity fall"
    rows = press(driver, drive, period / 2000, 2 * period, every=10)
    error = max(abs(row["f_wall[8]"] - total / spring * (1 - math.cos(omega * time))) for time, row in rows)
    yield "plate under a force: place, of its amplitude", error / (total / spring), 1e-5
    yield from check_ranks(driver, "plate under a force", drive, period / 200)
    # Damped, it rests where springs and forces balance.
    rows = press(driver, f"axis 0 0 -1 pressure {force / AREA} area {AREA} mass {mass} damping {mass * omega} gravity fall", period / 500, 8 * period)
    yield "plate under a pressure, damped: depth at rest", abs(rows[-1][1]["f_wall[8]"] / (total / spring) - 1), 1e-6
    yield "the same: force on the balls", abs(rows[-1][1]["f_wall[3]"] / total - 1), 1e-6


def check_free(driver):
    """A plate without contacts: terminal speed, energy by power, times, and stops."""
    away = "axis 0 0 1"
    rows = press(driver, f"{away} force 2 mass 0.1 damping 5 from 0.01", 1e-4, 0.3)
    yield "damped plate: terminal speed", abs(rows[-1][1]["f_wall[9]"] / 0.4 - 1), 1e-5
    yield "plate that is held: place", max(abs(row["f_wall[8]"]) for time, row in rows if time <= 0.01), 0
    rows = press(driver, f"{away} power 3 largest_force 1e6 mass 0.1", 1e-4, 0.1)
    yield "plate with a power: energy", max(abs(0.05 * row["f_wall[9]"] ** 2 / (3 * time) - 1) for time, row in rows[1:]), 1e-9
    rows = press(driver, f"{away} force 2 mass 0.1 travel 0 0.01 until 0.2", 1e-4, 0.3)
    yield "end of the travel: place", max(abs(row["f_wall[8]"] - 0.01) for time, row in rows if time > 0.05), 1e-15
    # A plane that turns about an axis beside the balls.
    moment, torque, lever = 1e-3, 0.05, 0.06
    rows = press(driver, f"axis 0 1 0 point {-lever} 0 0.02 torque {torque} moment {moment}", 2e-6, 0.02, every=10)
    arms = [lever - 0.04, lever + 0.04]
    spring = 2 * STIFFNESS * sum(arm**2 for arm in arms)  # N m/rad
    omega = math.sqrt(spring / moment)
    error = max(abs(row["f_wall[8]"] - torque / spring * (1 - math.cos(omega * time))) for time, row in rows)
    yield "plate that turns: angle, of its amplitude", error / (torque / spring), 2e-3


def check_servo(driver):
    """The stress of a servo on springs approaches its target like exp(-gain k t / area)."""
    stress, gain = 20.0, 1e-4
    rate = gain * BALLS * STIFFNESS / AREA
    drive = f"axis 0 0 -1 stress {stress} gain {gain} area {AREA} largest_speed 1"
    rows = press(driver, drive, 1e-3 / rate, 20 / rate, every=10)
    error = max(abs(row["f_wall[11]"] / stress - 1 + math.exp(-rate * time)) for time, row in rows)
    yield "servo: its way to the target", error, 1e-3
    # The largest stable gain, with the damper of a restitution of 0.5 and a step of 1e-5 s.
    largest = AREA / BALLS / (2 * 0.2553 * math.sqrt(STIFFNESS * 1e-3) + 0.5 * STIFFNESS * 1e-5)
    law = f"hooke {STIFFNESS} restitution 0.5"
    ends = [press(driver, f"axis 0 0 -1 stress {stress} gain {factor * largest} area {AREA} largest_speed 0.05", 1e-5, 0.02, every=100,
                  law=law)[-1][1]["f_wall[11]"] for factor in (0.9, 1.1)]
    yield "servo with 0.9 of the largest stable gain: stress", abs(ends[0] / stress - 1), 1e-6
    yield "servo with 1.1 of the largest stable gain rests", 0 if abs(ends[1] / stress - 1) > 0.1 else 1, 0
    yield "servo: stress", abs(rows[-1][1]["f_wall[11]"] / stress - 1), 1e-6
    yield from check_ranks(driver, "servo", drive, 2e-2 / rate)
    # Walls beside the balls go apart: the force is the stress times the area between them.
    drive = f"axis 0 0 -1 stress {stress} gain 0.02 between x_low x_high y_low y_high largest_speed 1"
    rows = press(driver, drive, 1e-5, 0.02, every=10, sides=1)
    error = max(abs(row["f_wall[3]"] / (stress * 0.12 * (0.12 + 0.5 * time)) - 1) for time, row in rows[50:])
    yield "servo between walls that go apart: force", error, 2e-3


def check_restart(driver):
    """A run from a restart file goes on with the same digits."""
    for kind, drive in (("force", "axis 0 0 -1 force 0.2 mass 0.05 damping 1"), ("servo", f"axis 0 0 -1 stress 20 gain 1e-4 area {AREA} largest_speed 0.01")):
        law = f"hooke {STIFFNESS} restitution 0.5 friction 0.3"
        for ranks in (1, 2):
            whole = press(driver, drive, 1e-5, 0.002, law=law, save=100, out=f"press_{kind}")
            variables = dict(drive=drive, law=law, timestep=1e-5, steps=100, every=1)
            (again,) = driver.run("press_again", ranks, **{"from": f"press_{kind}.100.restart"}, **variables)
            ends = [table[-1] for table in ([row for _, row in whole], again)]
            yield f"{kind}, restarted on {ranks} ranks: place", abs(ends[0]["f_wall[8]"] / ends[1]["f_wall[8]"] - 1), 0 if ranks == 1 else 1e-12


def check(driver):
    """Yields the name, the value and the limit of each comparison."""
    yield from check_force(driver)
    yield from check_free(driver)
    yield from check_servo(driver)
    yield from check_restart(driver)
