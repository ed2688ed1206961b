"""The figures of report.md."""

from math import isnan

import matplotlib
from matplotlib.figure import Figure

SMALLEST = 1e-16  # where an error is 0
SETTINGS = {
    "font.size": 10,
    "svg.fonttype": "none",
    "svg.hashsalt": "accuracy_cost",
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.titlesize": 10,
    "grid.color": "#dddddd",
    "lines.linewidth": 1.5,
    "lines.markersize": 4,
    "legend.fontsize": 7.5,
    "legend.framealpha": 0.6,
}
QUERY_METHODS = {
    "hybrid": "#0b5394",
    "hybrid (warm)": "#6fa8dc",
    "Newton (Algorithm I)": "#cc0000",
    "fixed point (Algorithm II)": "#e69138",
    "libccd GJK+EPA": "#38761d",
    "libccd MPR": "#674ea7",
    "Bullet GJK+EPA (float)": "#000000",
}
QUERY_CLASSES = {
    "E": "ellipsoids",
    "M": "exponents 1.3 to 5",
    "B": "exponents 6 to 20",
    "O": "exponents 1.1 to 1.3",
    "N": "needles",
}
QUERY_POSES = {"T": "touching", "S": "1 % overlap", "D": "30 % overlap", "N": "1 % apart"}
def draw_figures(tables, folder):
    """Draws the figures of those tables that have rows."""
    with matplotlib.rc_context(SETTINGS):
        if tables["query"].rows:
            for body_class, name in QUERY_CLASSES.items():
                _save(_queries(tables["query"], body_class, name), folder / f"query_{body_class}.svg")


def _save(figure, path):
    figure.savefig(path, metadata={"Date": None})


def _plot(axes, rows, error, time, factor, name, colour):
    """Time over error, on logarithmic axes. Rows without an error are left out."""
    points = [(max(row.number(error), SMALLEST), factor * row.number(time)) for row in rows if not isnan(row.number(error))]
    if points:
        axes.loglog(*zip(*points), marker="o", color=colour, label=name)


def _four(title):
    figure = Figure(figsize=(9.6, 7.2), layout="constrained")
    figure.suptitle(title)
    return figure, figure.subplots(2, 2).ravel()


def _queries(table, body_class, name):
    figure, panels = _four(f"What each digit of the gap costs: {name}")
    for k, (axes, (pose, pose_name)) in enumerate(zip(panels, QUERY_POSES.items())):
        for method, colour in QUERY_METHODS.items():
            rows = table.select(**{"class": body_class}, pose=pose, method=method)
            _plot(axes, rows, "gap_error", "time_s", 1e6, method, colour)
        axes.set(title=pose_name, xlim=(1e-16, 1), ylim=(0.1, 300))
        axes.set(
            xlabel="median error of the gap / smallest half-axis" if k > 1 else "", ylabel="" if k % 2 else "median time, µs"
        )
    # A method may have points in some panels only.
    handles = {label: handle for axes in panels for handle, label in zip(*axes.get_legend_handles_labels())}
    named = [method for method in QUERY_METHODS if method in handles]
    panels[1].legend([handles[method] for method in named], named, loc="upper left")
    return figure
