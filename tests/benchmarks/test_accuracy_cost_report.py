"""The report of samples/benchmarks/accuracy_cost has the numbers of its tables, and leaves out what is not measured."""

import pathlib
import subprocess
import sys

import pytest

PROGRAM = pathlib.Path(__file__).parents[2] / "samples" / "benchmarks" / "accuracy_cost" / "report.py"
QUERY = (
    "class,pose,method,accuracy,queries,time_s,time_p99_s,evaluations,gap_error,gap_error_p99,gap_error_worst,normal_error,contact_error,"
    "failures,inexact,no_answer,wrong_verdict,wrong_gap"
)


def query(method, accuracy, time, error, failures=0, pose="S"):
    return f'M,{pose},"{method}",{accuracy},240,{time},3e-06,4,{error},1e-12,2e-10,1e-09,nan,{failures},5,{failures},0,0'


def write(path, head, *rows):
    path.write_text("\n".join(["# processor: of the test", head, *rows, "# done: all", ""]))


def report_of(folder):
    subprocess.run([sys.executable, PROGRAM, folder], check=True, capture_output=True, text=True)
    return (folder / "report.md").read_text()


def test_queries_and_their_ratios(tmp_path):
    rows = [
        query("hybrid", "1e-02", 1e-6, "1e-04"),
        query("hybrid", "1e-09", 2e-6, "1e-13"),
        query("hybrid (warm)", "1e-09", 5e-7, 0),
        query("libccd GJK+EPA", "1e-06", 11e-6, "2e-05", 7),
    ]
    write(tmp_path / "query.csv", QUERY, *rows)
    text = report_of(tmp_path)
    assert "\n* processor: of the test\n" in text
    assert (
        "| exponents 1.3…5 | 1 % overlap | libccd GJK+EPA | 1e-06 | 11.0 / 3.00 | 4 | 2e-05 | 1e-09 | – | 7 of 240 |\n" in text
    )
    assert "| exponents 1.3…5 | 1 % overlap | 5.5 | – | – | 4.00 |\n" in text
    assert "| exponents 1.3…5 | cold | – | 1.00 | – | – | – | 2.00 | – | – | 0.2 |\n" in text
    assert "## Colliders" not in text


def test_a_method_of_the_literature_has_the_loosest_accuracy_that_is_precise_enough(tmp_path):
    rows = [
        query(f"{method}{start}", accuracy, time, error, 3, pose)
        for pose in "TS"
        for method in ("Newton (Algorithm I)", "surface angles (2)")
        for start, time in (("", 2e-6), (" (warm)", 1e-6))
        for accuracy, error in (("1e-02", "1e-05"), ("1e-04", "1e-10"), ("1e-06", "1e-15"))
    ]
    write(tmp_path / "literature.csv", QUERY, *rows)
    text = report_of(tmp_path)
    assert "| exponents 1.3…5 | surface angles (2) | 1e-04 | 2.00 | 1.00 | 4 | 1e-10 | 6 | 0 | 0 | 10 | 480 |\n" in text
    assert "| exponents 1.3…5 | 1.0 | 1.0 |\n" in text


def test_no_tables_make_a_report_without_sections(tmp_path):
    assert "##" not in report_of(tmp_path)


def test_every_figure_of_the_report_is_drawn(tmp_path):
    pytest.importorskip("matplotlib", reason="python3-matplotlib is not installed")
    write(tmp_path / "query.csv", QUERY, query("hybrid", "1e-09", 2e-6, "1e-13"), query("libccd MPR", "1e-04", 2e-6, "nan"))
    named = {word.split(")")[0] for word in report_of(tmp_path).split("](")[1:]}
    assert named == {path.name for path in tmp_path.glob("*.svg")} and len(named) == 5
    assert all("</svg>" in (tmp_path / name).read_text() for name in named)
