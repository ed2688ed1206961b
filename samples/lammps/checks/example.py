"""The example of README.md: a servo presses grains in a box."""

STRESS, AREA, WEIGHT = 4e3, 1.936e-3, (18 * 1e-3 + 36 * 4e-4) * 9.81  # Pa, m^2, N


def check(driver):
    """Yields the name, the value and the limit of each comparison."""
    (table,) = driver.run("../example")
    end = table[-1]
    yield "stress on the servo", abs(end["f_lid[11]"] / STRESS - 1), 1e-3
    yield "force on the box", abs(-end["f_box[3]"] / (STRESS * AREA + WEIGHT) - 1), 1e-2
