"""Makes the tables of a sweep from the lines of its points."""

import csv
import math
import statistics

from .point_run import csv_line
from .store import write_text
from .student import t_quantile


def collect(sweep, store):
    """Writes points.csv, a line each in the order of the sweep, and means.csv, a line for each combination of parameters: the mean of
    its seeds, their standard deviation and half the width of the confidence interval of the mean, by Student's t. Fields stay empty
    where there are too few runs. Returns the lines of means.csv as dictionaries of texts, and the points without a result.
    """
    lines = [store.result(store.key(point)) for point in sweep.points]
    names = [quantity.name for quantity in sweep.quantities]
    head = csv_line([*sweep.parameters, *(["seed"] if sweep.has_seeds else []), *names])
    write_text(store.folder / "points.csv", head + "".join(line for line in lines if line))

    means = [_mean_line(sweep, lines[first : first + sweep.seeds]) for first in range(0, len(lines), sweep.seeds)]
    means = [line for line in means if line]
    columns = means[0].keys() if means else [*sweep.parameters, "runs"]
    write_text(store.folder / "means.csv", csv_line(columns) + "".join(csv_line(line.values()) for line in means))
    return means, [point for point, line in zip(sweep.points, lines) if line is None]


def _mean_line(sweep, lines):
    """Of the runs with the same parameters; None where none of them has a result."""
    rows = list(csv.reader(line for line in lines if line))
    if not rows:
        return None
    mean_line = dict(zip(sweep.parameters, rows[0]))
    mean_line["runs"] = str(len(rows))
    first = len(rows[0]) - len(sweep.quantities)
    for column, quantity in enumerate(sweep.quantities, first):
        mean, deviation, half_width = mean_and_interval([float(row[column]) for row in rows], sweep.confidence)
        mean_line[f"{quantity.name}_mean"] = f"{mean:.9g}"
        mean_line[f"{quantity.name}_standard_deviation"] = "" if deviation is None else f"{deviation:.6g}"
        mean_line[confidence_column(sweep, quantity.name)] = "" if half_width is None else f"{half_width:.6g}"
    return mean_line


def confidence_column(sweep, name):
    return f"{name}_confidence_{100 * sweep.confidence:g}"


def mean_and_interval(numbers, confidence):
    """Mean, standard deviation of one number, and half the width of the mean's interval; a single number has the mean alone."""
    mean = math.fsum(numbers) / len(numbers)
    if len(numbers) < 2:
        return mean, None, None
    deviation = statistics.stdev(numbers)
    return mean, deviation, t_quantile(confidence, len(numbers) - 1) * deviation / math.sqrt(len(numbers))
