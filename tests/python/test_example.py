"""The examples run, find what they should, and write the figures that they name."""

import importlib
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

SAMPLES = pathlib.Path(__file__).parents[2] / "samples" / "python"


def run_sample(tmp_path, program, *arguments):
    # SciPy's linear algebra is faster in one thread here.
    environment = {**os.environ, "MPLBACKEND": "Agg", "MPLCONFIGDIR": str(tmp_path / "matplotlib"), "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, SAMPLES / program, *arguments]
    run = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run


def test_the_tour(tmp_path):
    pytest.importorskip("matplotlib", reason="python3-matplotlib is not installed")
    run = run_sample(tmp_path, "tour.py", tmp_path / "figures")
    assert "Superellipsoid on a floor: 4 contacts, 1.000 mm deep" in run.stdout
    assert "Superovoid on a floor: 1 contacts, 1.000 mm deep" in run.stdout
    wanted = {"distance.png", "rays.png"} | ({"pebbles.png"} if "ten pebbles after 3 s" in run.stdout else set())
    assert {path.name for path in (tmp_path / "figures").iterdir()} == wanted
    assert all(path.stat().st_size > 10_000 for path in (tmp_path / "figures").iterdir())


@pytest.fixture
def planner(monkeypatch):
    pytest.importorskip("scipy", reason="python3-scipy is not installed")
    monkeypatch.syspath_prepend(str(SAMPLES))
    return importlib.import_module("planner")


def test_the_gradient_of_a_path(planner):
    random = np.random.default_rng(2)
    for weight in (1.0, 1000.0):
        problem = planner.Problem(weight)
        path = np.linalg.solve(planner.BENDS, planner.random_path(random)).ravel()
        gradient = problem.value_and_gradient(path)[1]
        central = [(problem.value(path + step) - problem.value(path - step)) / 2e-6 for step in 1e-6 * np.eye(len(path))]
        # The differences are no better: an error of a gap of 1e-10 m, over a step of 1e-6.
        np.testing.assert_allclose(gradient, central, atol=2e-5 * np.abs(gradient).max())


def test_the_planner(planner, tmp_path):
    pytest.importorskip("matplotlib", reason="python3-matplotlib is not installed")
    run = run_sample(tmp_path, "planner.py", "--starts", "1", tmp_path)
    lines = run.stdout.splitlines()
    assert len(lines) == 3 and all("1 of 1 paths are free" in line for line in lines), run.stdout
    calls = [int(re.search(r"(\d+) times the gaps", line)[1]) for line in lines]
    assert calls[1] > 10 * calls[0] and calls[2] > 3 * calls[0]
    assert (tmp_path / "planner.png").stat().st_size > 10_000


def test_a_path_through_an_obstacle_is_not_free(planner):
    share = np.linspace(0, 1, planner.POSES + 2)[1:-1, None]
    assert not planner.is_free(planner.START + share * (planner.GOAL - planner.START))


def test_the_fit_to_contacts(planner, tmp_path):
    run = run_sample(tmp_path, "fit_contacts.py", "--contacts", "100")
    worst = float(re.search(r"farthest from the truth by ([\d.]+) standard errors", run.stdout)[1])
    assert 0.1 < worst < 4, run.stdout
    exact = run_sample(tmp_path, "fit_contacts.py", "--noise", "1e-12").stdout
    assert re.search(r"delta = +3.200000 .*\n +epsilon = +2.400000", exact), exact


def test_the_derivatives_of_the_fit(planner):
    fit = importlib.import_module("fit_contacts")
    contacts = fit.measure(40, 1e-3, np.random.default_rng(5))
    step = 1e-6 * np.diag([0.05] * 3 + [1.0] * 2 + [0.05] * 3 + [1.0] * 3)
    central = [(contacts.gaps(fit.TRUTH + d) - contacts.gaps(fit.TRUTH - d)) / (2 * d.max()) for d in step]
    np.testing.assert_allclose(contacts.jacobian(fit.TRUTH), np.transpose(central), atol=3e-5)


def test_the_gap_in_torch(planner, tmp_path):
    pytest.importorskip("torch", reason="python3-torch is not installed")
    run = run_sample(tmp_path, "torch_gap.py")
    assert "gradcheck: passed for 50 pairs, 17 of them overlapped" in run.stdout
    assert re.search(r"after \d+ steps of Adam 0 overlap, the deepest by 0.0000 m", run.stdout)


def test_the_notebook_runs(tmp_path, monkeypatch):
    nbformat = pytest.importorskip("nbformat", reason="python3-nbformat is not installed")
    nbclient = pytest.importorskip("nbclient", reason="python3-nbclient is not installed")
    for module, package in (("ipykernel", "python3-ipykernel"), ("matplotlib", "python3-matplotlib")):
        pytest.importorskip(module, reason=f"{package} is not installed")
    for name in ("MPLCONFIGDIR", "IPYTHONDIR", "JUPYTER_RUNTIME_DIR"):
        monkeypatch.setenv(name, str(tmp_path / name))
    notebook = nbformat.read(SAMPLES / "gap_gradient.ipynb", as_version=4)
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert not any(cell.outputs or cell.execution_count for cell in code)  # as it is committed

    nbclient.NotebookClient(notebook, kernel_name="python3", timeout=120).execute()
    figures = [output for cell in code for output in cell.outputs if "image/png" in output.get("data", {})]
    assert len(figures) == 1
