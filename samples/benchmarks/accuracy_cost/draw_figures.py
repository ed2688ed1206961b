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
FORMS = {"Supernormal": "#0b5394", "dConvex": "#38761d", "dTriMesh": "#cc0000", "dBox": "#e69138"}
PHASES = {
    "broad phase": (["broad_s"], "#999999"),
    "narrow phase": (["narrow_s"], "#0b5394"),
    "quickstep": (["joints_s", "solver_s"], "#e69138"),
}
SPACES = {"hash": "#0b5394", "quadtree": "#38761d", "sweep and prune": "#cc0000", "simple": "#999999"}


def draw_figures(tables, folder):
    """Draws the figures of those tables that have rows."""
    with matplotlib.rc_context(SETTINGS):
        if tables["query"].rows:
            for body_class, name in QUERY_CLASSES.items():
                _save(_queries(tables["query"], body_class, name), folder / f"query_{body_class}.svg")
        if tables["scene_outcomes"].rows:
            _save(_outcomes(tables["scene_outcomes"], tables["scene_forms"]), folder / "outcomes.svg")
        if tables["scene_growth"].rows:
            _save(_growth(tables["scene_growth"]), folder / "growth.svg")


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


def _outcomes(outcomes, forms):
    """Cost and accuracy of each form of the grains."""
    figure = Figure(figsize=(9.6, 4.2), layout="constrained")
    figure.suptitle("1000 grains")
    fall, settled = figure.subplots(1, 2)
    for form, colour in FORMS.items():
        _plot(fall, outcomes.select(form=form), "rocking_error", "step_s", 1e3, form, colour)
    fall.set(title="fall: tolerances 1e-1 to 1e-12; 32, 122, 482 vertices", xlim=(1e-7, 10), ylim=(1, 1000))
    fall.set(xlabel="error of the period of a rocking ellipsoid", ylabel="mean time of a step, ms")
    fall.legend(loc="upper left")
    names = [f"{row['form']} {row['accuracy']}" if row["form"].startswith("d") else row["form"] for row in forms.rows]
    bottom = [0.0] * len(names)
    for phase, (columns, colour) in PHASES.items():
        heights = [1e3 * sum(row.number(column) for column in columns) for row in forms.rows]
        settled.bar(range(len(names)), heights, 0.7, bottom, color=colour, label=phase)
        bottom = [low + height for low, height in zip(bottom, heights)]
    settled.set(title="settled: a step of the same bed", ylabel="ms")
    settled.set_xticks(range(len(names)), names, rotation=35, ha="right", rotation_mode="anchor", fontsize=7.5)
    settled.legend(loc="upper left")
    return figure


def _growth(table):
    figure = Figure(figsize=(7.2, 4.8), layout="constrained")
    axes = figure.subplots()
    for space, colour in SPACES.items():
        rows = table.select(space=space)
        grains = [row.number("grains") for row in rows]
        finding = [1e3 * (row.number("broad_s") + row.number("narrow_s")) for row in rows]
        axes.loglog(grains, finding, marker="o", linewidth=3, color=colour, label=space)
        axes.loglog(grains, [1e3 * row.number("step_s") for row in rows], marker="o", linewidth=1, markersize=3, color=colour)
    axes.set(title="Time of a step over the number of grains: find the contacts (thick), and with quickstep (thin)")
    axes.set(xlim=(400, 25000), ylim=(1, 2000), xlabel="grains", ylabel="ms")
    axes.set_xticks([500, 1000, 2000, 4000, 8000, 20000], [500, 1000, 2000, 4000, 8000, 20000])
    axes.minorticks_off()
    axes.legend(loc="upper left")
    return figure
