"""Sizes of 1:50: forces do not depend on neighbour lists, communication and the number of ranks."""

from ranks import largest_difference

MULTI = "comm_modify mode multi"
RUNS = {"1 rank": (1, "multi", "comm_modify mode single"), "1 rank, bin": (1, "bin", "comm_modify mode single"), "2 ranks": (2, "multi", MULTI),
        "2 ranks, reduce/multi": (2, "multi", MULTI + " reduce/multi"), "4 ranks": (4, "multi", MULTI)}


def check(driver):
    """Yields the name, the value and the limit of each comparison."""
    driver.run("sizes", 1, fresh=1, style="multi", comm="comm_modify mode single", until=500, out="sizes")
    reference = None
    for name, (ranks, style, comm) in RUNS.items():
        out = f"sizes_{len(name)}"
        (table,) = driver.run("sizes", ranks, fresh=0, style=style, comm=comm, until=520, out=out, **{"from": "sizes.restart"})
        (rows,) = driver.dump(f"{out}.dump").values()
        if reference is None:
            reference = rows
            assert table[-1]["c_pair[1]"] > 10
        for what, columns in (("forces", (7, 8, 9)), ("torques", (10, 11, 12))):
            yield f"sizes 1:50, {name}: {what}", largest_difference(rows, reference, columns), 1e-12
