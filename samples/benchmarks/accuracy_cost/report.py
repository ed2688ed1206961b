"""Writes report.md from the tables of `accuracy_cost` in a folder, and draws its figures: report.py FOLDER.

Parts without measurements are left out. Without matplotlib there are no figures.
"""

import pathlib
import sys
from math import copysign, inf, isnan, nan

CLASSES = {"E": "ellipsoids", "M": "exponents 1.3…5", "B": "exponents 6…20", "O": "exponents 1.1…1.3", "N": "needles"}
POSES = {"T": "touching", "S": "1 % overlap", "D": "30 % overlap", "N": "1 % apart", "F": "far"}
HYBRID = ("hybrid", "1e-09")
HYBRID_WARM = ("hybrid (warm)", "1e-09")
HYBRID_EARLY_OUT = ("hybrid (early out)", "1e-09")
OTHERS = [
    ("libccd GJK+EPA", "1e-06"),
    ("libccd MPR", "1e-04"),
    ("Bullet GJK+EPA (float)", ""),
]
ALGORITHM_1 = "Newton (Algorithm I)"
COMPARED = [HYBRID, HYBRID_WARM, HYBRID_EARLY_OUT, (ALGORITHM_1, "1e-09"), ("fixed point (Algorithm II)", "1e-09"), *OTHERS]


class Row(dict):
    """Texts by their columns."""

    def number(self, column):
        """NaN if there is none."""
        return float(self.get(column) or "nan")


class Table:
    """A table of the program. It is empty if the file does not exist."""

    def __init__(self, path):
        lines = path.read_text().splitlines() if path.exists() else []
        self.comments = [line[2:] for line in lines if line.startswith("# ") and not line.startswith("# done")]
        head, *rows = [line.replace('"', "").split(",") for line in lines if not line.startswith("# ")] or [[]]
        self.rows = [Row(zip(head, row)) for row in rows]

    def select(self, **cells):
        return [row for row in self.rows if all(row.get(column) == cell for column, cell in cells.items())]

    def find(self, **cells):
        """The first row with these cells. It is empty if there is none."""
        return next(iter(self.select(**cells)), Row())

    def method(self, body_class, pose, method):
        name, accuracy = method
        return self.find(**{"class": body_class}, pose=pose, method=name, accuracy=accuracy)


def ratio(a, b):
    """As in C++."""
    if b == 0:
        return nan if a == 0 or isnan(a) else copysign(inf, a)
    return a / b


def text(form, value):
    return "–" if isnan(value) else form % value


def microseconds(seconds):
    return text("%.2f" if seconds < 1e-5 else "%.1f", 1e6 * seconds)


def markdown(about, head, texts, rows):
    """A section. The first `texts` columns hold text, the others numbers."""
    rule = "|" + "---|" * texts + "---:|" * (len(head) - texts)
    head, *rows = ("| " + " | ".join(row) + " |" for row in (head, *rows))
    return "\n".join([about, head, rule, *rows]) + "\n\n"


def digits(tables):
    tolerances = ["1e-01", "1e-02", "1e-03", "1e-04", "1e-06", "1e-09", "1e-12", "1e-14"]
    rows = []
    for body_class, name in CLASSES.items():
        for start, method in (("cold", "hybrid"), ("warm", "hybrid (warm)")):
            found = [tables["query"].method(body_class, "S", (method, tolerance)) for tolerance in tolerances]
            errors = [
                row.number("gap_error_worst") / float(row["accuracy"])
                for row in found
                if row and float(row["accuracy"]) > 1e-13
            ]
            worst = max([0, *(error for error in errors if not isnan(error))])
            rows.append([name, start, *(microseconds(row.number("time_s")) for row in found), text("%.2g", worst)])
    about = (
        "## What each digit costs\n\n"
        "The hybrid at 1 % overlap: median time in µs over its tolerance, and the worst error over the tolerance.\n"
    )
    return markdown(about, ["class", "start", *tolerances, "worst error / tolerance"], 2, rows)


def ratios(tables):
    rows = []
    for body_class, name in CLASSES.items():
        for pose, pose_name in POSES.items():

            def time(method):
                return tables["query"].method(body_class, pose, method).number("time_s")

            hybrid, early_out = time(HYBRID), time(HYBRID_EARLY_OUT)
            is_verdict = [pose in "NF" and method.startswith("libccd") for method, _ in OTHERS]
            others = [ratio(time(method), early_out if verdict else hybrid) for method, verdict in zip(OTHERS, is_verdict)]
            rows.append(
                [name, pose_name, *(text("%.1f", other) for other in others), text("%.2f", ratio(hybrid, time(HYBRID_WARM)))]
            )
    about = (
        "## Ratios\n\n"
        "Median time of the other over that of the hybrid at its default tolerance, cold; then warm over cold. Of bodies apart libccd\n"
        "says only that they are, and is compared with the hybrid that stops when it knows as much (early out).\n"
    )
    head = ["class", "pose", "libccd GJK+EPA 1e-6", "libccd MPR 1e-4", "Bullet", "cold / warm"]
    return markdown(about, head, 2, rows)


def _precise_enough(rows):
    """The loosest accuracy with a median gap error below 1e-9. If there is none, the tightest."""
    return next((row for row in rows if row.number("gap_error") < 1e-9), rows[-1] if rows else Row())


def _comparisons(table, body_class, method):
    """The rows of a method at the accuracy that is precise enough, or at all numbers of vertices, each with that of its warm start."""
    rows = table.select(**{"class": body_class}, pose="S", method=method)
    warm = _precise_enough(table.select(**{"class": body_class}, pose="S", method=f"{method} (warm)"))
    return [(row, warm) for row in (rows if method == "dTriMesh" else [_precise_enough(rows)])]


def _cold_methods(table, body_class):
    methods = dict.fromkeys(row["method"] for row in table.select(**{"class": body_class}))
    return [method for method in methods if not method.endswith("(warm)")]


def literature(tables):
    table = tables["literature"]
    rows, beside = [], []
    for body_class, name in CLASSES.items():
        methods = _cold_methods(table, body_class)
        for method in methods:
            for row, warm in _comparisons(table, body_class, method):
                everywhere = [found for pose in POSES if (found := table.method(body_class, pose, (method, row["accuracy"])))]
                counts = (
                    sum(found.number(column) for found in everywhere)
                    for column in ("no_answer", "wrong_verdict", "wrong_gap", "inexact", "queries")
                )
                evaluations = row.number("evaluations")
                rows.append(
                    [
                        name,
                        method,
                        row["accuracy"],
                        microseconds(row.number("time_s")),
                        microseconds(warm.number("time_s")),
                        text("%.3g", evaluations) if evaluations > 0 else "–",
                        text("%.0e", row.number("gap_error")),
                        *(text("%.0f", count) for count in counts),
                    ]
                )
        if methods:
            (theirs,), (ours,) = (_comparisons(table, body_class, method) for method in ("surface angles (2)", ALGORITHM_1))
            beside.append([name, *(text("%.1f", ratio(a.number("time_s"), b.number("time_s"))) for a, b in zip(theirs, ours))])
    about = (
        "## The methods of the literature\n\n"
        "Each method at the loosest of its accuracies at which the median error of the gap is below 1e-9 of the smallest half-axis,\n"
        "or at its tightest. Meshes have their number of vertices there, and all of their sizes. Time, evaluations and error at 1 %\n"
        "overlap; failures in all five situations. Off: gaps that were told and are off by more than 1e-6.\n"
    )
    head = ["class", "method", "accuracy", "cold, µs", "warm, µs", "evaluations", "error"]
    head += ["no answer", "wrong verdict", "wrong gap", "off", "of"]
    about_beside = (
        "### Algorithm I beside the reference method\n\n"
        "The time of the Newton iteration in four surface angles over that of Algorithm I, each as accurate as above.\n"
    )
    return markdown(about, head, 3, rows) + markdown(about_beside, ["class", "cold", "warm"], 1, beside)


def queries(tables):
    rows = [
        [
            name,
            pose_name,
            *method,
            f"{microseconds(row.number('time_s'))} / {microseconds(row.number('time_p99_s'))}",
            text("%.3g", row.number("evaluations")) if row.number("evaluations") > 0 else "–",
            *(text("%.0e", row.number(column)) for column in ("gap_error", "normal_error", "contact_error")),
            f"{row['failures']} of {row['queries']}",
        ]
        for body_class, name in CLASSES.items()
        for pose, pose_name in POSES.items()
        for method in COMPARED
        if (row := tables["query"].method(body_class, pose, method))
    ]
    about = (
        "## Queries\n\n"
        "Median / 99th percentile of the time in µs; median error of the gap, of the normal (rad) and of the contact point (gap and "
        "point\nrelative to the smallest half-axis); failures: no answer, wrong verdict, or wrong by more than 10 % of the gap + 0.001 "
        "of the\nhalf-axis. A dash: the method does not tell it (of bodies apart libccd says only that they are).\n\n"
        "![exponents 1.3 to 5](query_M.svg)\n![exponents 6 to 20](query_B.svg)\n\n"
        "More figures: [ellipsoids](query_E.svg), [octahedral](query_O.svg), [needles](query_N.svg).\n"
    )
    head = ["class", "pose", "method", "accuracy", "time", "evaluations", "gap", "normal", "point", "failures"]
    return markdown(about, head, 4, rows)


# The sections, each with the table that it needs.
SECTIONS = [
    (digits, "query"),
    (ratios, "query"),
    (literature, "literature"),
    (queries, "query"),
]


def read_tables(folder):
    return {name: Table(folder / f"{name}.csv") for name in dict.fromkeys(name for _, name in SECTIONS)}


def report(tables):
    """The text of report.md."""
    measured = next((tables[name] for name in ("query", "literature") if tables[name].rows), None)
    environment = "".join(f"* {line}\n" for line in (measured.comments if measured else []))
    return (
        "# What accuracy costs\n\nWritten by `accuracy_cost --atlas`. Only ratios carry to another machine; all "
        f"methods of a table took turns in one run.\n\n{environment}\n"
        + "".join(section(tables) for section, name in SECTIONS if tables[name].rows)
    )


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: report.py FOLDER, with the tables of accuracy_cost")
    folder = pathlib.Path(sys.argv[1])
    tables = read_tables(folder)
    try:
        (folder / "report.md").write_text(report(tables), encoding="utf-8")
    except OSError as error:
        sys.exit(f"{folder}/report.md: cannot be written: {error.strerror}")
    try:
        from draw_figures import draw_figures
    except ImportError as missing:
        print(f"no figures: {missing} (apt install python3-matplotlib)", file=sys.stderr)
    else:
        draw_figures(tables, folder)


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    main()
