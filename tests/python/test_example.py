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


@pytest.fixture
def settling(monkeypatch):
    pytest.importorskip("supernormal.scenes", reason="built without samples/falling_particles")
    monkeypatch.syspath_prepend(str(SAMPLES))
    return importlib.import_module("settling")


def test_beads_settle_at_their_terminal_velocity(settling, tmp_path):
    for name, (fluid, diameters, duration, step) in settling.CASES.items():
        found = settling.settle(settling.scene_of_beads(tmp_path, diameters, duration, step), fluid, 5)[-1]
        diameter = np.array(diameters)
        reynolds = fluid.density * found * diameter / fluid.viscosity
        # Weight less buoyancy is the drag at the velocity that was found: 4/3 d g (density / fluid - 1) = C v^2, C = 24 / Re times the law.
        law = 1 if "Stokes" in name else 1 + 0.15 * reynolds**0.687
        weight = 4 / 3 * diameter * 9.81 * (2500 / fluid.density - 1)
        np.testing.assert_allclose(24 / reynolds * law * found**2, weight, rtol=1e-8)
        if "Stokes" in name:
            np.testing.assert_allclose(found, (2500 - 1260) * 9.81 * diameter**2 / (18 * 1.4), rtol=1e-8)


def test_the_error_of_an_exchange_is_its_interval(settling, tmp_path):
    fluid = settling.CASES["Stokes, in glycerol"][0]
    relaxation = 2500 * 3e-3**2 / (18 * fluid.viscosity)
    scene = settling.scene_of_beads(tmp_path, [3e-3], 2.0e-3, 1e-6)
    times = np.arange(1, 101) * 20e-6
    wanted = fluid.terminal_velocity(3e-3, 2500) * (1 - np.exp(-times / relaxation))
    errors = []
    for steps in (5, 10, 20):
        found = settling.settle(scene, fluid, steps)[20 // steps - 1 :: 20 // steps, 0]
        errors.append(np.abs(found - wanted).max() / wanted[-1])
    assert errors[0] < 2e-3
    # Euler's method: the velocity is too large by time / relaxation / 2 of the interval, at most exp(-1) / 2 of it.
    np.testing.assert_allclose(errors, np.array([5, 10, 20]) * 1e-6 / relaxation * np.exp(-1) / 2, rtol=0.2)


def test_the_program_that_couples_a_drag(settling, tmp_path):
    run = run_sample(tmp_path, "settling.py")
    assert len(re.findall(r"off by -?\d\.\de-(?:0[89]|1\d)", run.stdout)) == 8, run.stdout


@pytest.mark.parametrize("name, figures", [("gap_gradient", 1), ("drum", 2)])
def test_the_notebook_runs(name, figures, tmp_path, monkeypatch):
    nbformat = pytest.importorskip("nbformat", reason="python3-nbformat is not installed")
    nbclient = pytest.importorskip("nbclient", reason="python3-nbclient is not installed")
    for module, package in (("ipykernel", "python3-ipykernel"), ("matplotlib", "python3-matplotlib")):
        pytest.importorskip(module, reason=f"{package} is not installed")
    if name == "drum":
        pytest.importorskip("supernormal.scenes", reason="built without samples/falling_particles")
    for variable in ("MPLCONFIGDIR", "IPYTHONDIR", "JUPYTER_RUNTIME_DIR"):
        monkeypatch.setenv(variable, str(tmp_path / variable))
    notebook = nbformat.read(SAMPLES / f"{name}.ipynb", as_version=4)
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert not any(cell.outputs or cell.execution_count for cell in code)  # as it is committed

    folder = {"metadata": {"path": str(SAMPLES)}}  # where Jupyter runs it
    nbclient.NotebookClient(notebook, kernel_name="python3", timeout=120, resources=folder).execute()
    drawn = [output for cell in code for output in cell.outputs if "image/png" in output.get("data", {})]
    assert len(drawn) == figures
