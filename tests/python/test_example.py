"""The example runs, and writes the figures that it names."""

import os
import pathlib
import subprocess
import sys

import pytest

TOUR = pathlib.Path(__file__).parents[2] / "samples" / "python" / "tour.py"


def test_the_tour(tmp_path):
    pytest.importorskip("matplotlib", reason="python3-matplotlib is not installed")
    environment = {**os.environ, "MPLBACKEND": "Agg", "MPLCONFIGDIR": str(tmp_path / "matplotlib")}
    run = subprocess.run([sys.executable, TOUR, tmp_path / "figures"], env=environment, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert "Superellipsoid on a floor: 4 contacts, 1.000 mm deep" in run.stdout
    assert "Superovoid on a floor: 1 contacts, 1.000 mm deep" in run.stdout
    wanted = {"distance.png", "rays.png"} | ({"pebbles.png"} if "ten pebbles after 3 s" in run.stdout else set())
    assert {path.name for path in (tmp_path / "figures").iterdir()} == wanted
    assert all(path.stat().st_size > 10_000 for path in (tmp_path / "figures").iterdir())
