"""A missing package is named, with the Debian package that contains it."""

import pathlib
import subprocess
import sys

import pytest
import supernormal as sn

HAS_ODE_LAYER = (pathlib.Path(sn.__file__).parent / "ode.py").exists()


@pytest.mark.parametrize(
    "module,without,message",
    [
        ("supernormal", "numpy", "supernormal takes NumPy (Debian: python3-numpy)"),
        ("supernormal.ode", "numpy", "supernormal takes NumPy (Debian: python3-numpy)"),
        ("supernormal.ode", "ode", "supernormal.ode takes PyODE (Debian: python3-pyode)"),
    ],
)
def test_a_missing_package(module, without, message):
    if module == "supernormal.ode" and not HAS_ODE_LAYER:
        pytest.skip("the library was built without its ODE layer")
    program = f"import sys; sys.modules[{without!r}] = None; import {module}"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.returncode == 1 and run.stderr.splitlines()[-1] == f"ImportError: {message}"
