"""Forces do not depend on the number of ranks, and a restarted run gives the same bytes."""

import filecmp

BED = "bed.restart"


def largest_difference(rows, reference, columns):
    """The largest difference of the vectors in these columns, relative to the longest reference vector."""
    longest = max(sum(row[c] ** 2 for c in columns) ** 0.5 for row in reference)
    return max(sum((row[c] - other[c]) ** 2 for c in columns) ** 0.5 for row, other in zip(rows, reference)) / longest


def check_forces(driver):
    """Compares with one rank and newton on. After 20 steps the springs of friction and rolling have grown."""
    reference = None
    for ranks in (1, 2, 4):
        for newton in ("on", "off"):
            dump = f"forces_{ranks}_{newton}.dump"
            (table,) = driver.run("dense_forces", ranks, newton=newton, bed=BED, steps=20, out=dump)
            pairs = max(abs(row["c_sums[1]"] / row["PotEng"] - 1) for row in table)
            yield f"{ranks} ranks, newton {newton}: energies of single pairs", pairs, 1e-10
            frames = driver.dump(dump)
            if reference is None:
                reference = frames
                continue
            for step, rows in frames.items():
                for quantity, columns in (("forces", (7, 8, 9)), ("torques", (10, 11, 12))):
                    difference = largest_difference(rows, reference[step], columns)
                    yield f"{ranks} ranks, newton {newton}, step {step}: {quantity}", difference, 1e-10


def check_restart(driver):
    for ranks in (1, 2):
        whole, again = f"whole_{ranks}", f"again_{ranks}"
        driver.run("dense_restart", ranks, bed=BED, until=4400, every=100, out=whole)
        driver.run("dense_restart", ranks, bed=f"{whole}.4200.restart", until=4400, every=100, out=again)
        same = filecmp.cmp(driver.folder / f"{whole}.4400.restart", driver.folder / f"{again}.4400.restart", shallow=False)
        yield f"{ranks} ranks: restarted run differs", 0 if same else 1, 0


def check(driver):
    """Yields the name, the value and the limit of each comparison."""
    driver.run("dense", out=BED)
    yield from check_forces(driver)
    yield from check_restart(driver)
