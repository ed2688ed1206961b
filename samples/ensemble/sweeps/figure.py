"""The figure of a sweep, drawn by gnuplot: a quantity over a parameter, with its confidence intervals, a line for each value of another."""

import pathlib
import shutil
import subprocess

from .collect import confidence_column
from .store import write_text

SCRIPT = pathlib.Path(__file__).parent.parent / "figure.gp"


def figure_data(sweep, means):
    """Blocks for gnuplot's `index`, each with its title in quotes as the first line, then x, mean and half-width."""
    figure = sweep.figure
    lines, label = figure.get("lines"), figure.get("lines_label", figure.get("lines"))
    blocks = {}
    for line in means:
        title = f"{label} = {line[lines]}" if lines else figure.get("y_label", figure["y"])
        half_width = line[confidence_column(sweep, figure["y"])] or "0"
        blocks.setdefault(title, []).append((float(line[figure["x"]]), line[f"{figure['y']}_mean"], half_width))
    texts = []
    for title, points in blocks.items():
        rows = [f"{x!r} {mean} {half_width}\n" for x, mean, half_width in sorted(points)]
        plain = title.replace("\\", "/").replace('"', "'").replace("\n", " ")  # gnuplot reads escapes
        texts.append(f'"{plain}"\n' + "".join(rows))
    return "\n\n".join(texts)


def draw_figure(sweep, store, means):
    """Writes figure.svg beside the tables. Returns why there is none, or None."""
    if sweep.figure is None or not means:
        return None
    if shutil.which("gnuplot") is None:
        return "no figure: gnuplot is not installed"
    try:
        data = figure_data(sweep, means)
    except ValueError:
        return f"no figure: {sweep.figure['x']} is not a number everywhere"
    write_text(store.folder / "figure.dat", data)
    labels = [sweep.figure.get(f"{axis}_label", sweep.figure[axis]) for axis in ("x", "y")]
    labels += [sweep.figure.get("scale", "linear"), f"{100 * sweep.confidence:g}"]
    drawn = subprocess.run(
        ["gnuplot", "-c", str(SCRIPT), str((store.folder / "figure.dat").absolute()), *labels], capture_output=True, text=True, check=False
    )
    if drawn.returncode != 0:
        return f"no figure: gnuplot: {drawn.stderr.strip()}"
    write_text(store.folder / "figure.svg", drawn.stdout)
    return None
