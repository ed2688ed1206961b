"""Has CMake build the package and the libraries below it, and leaves them to setuptools.

The wheel is this tree: the package with the shared libraries in its folder, where its extensions find them ($ORIGIN). The ODE
layer is part of it if ODE is found; it takes ODE and PyODE from the system. Everything is built in build/wheel of the project.
The environment variable CMAKE_ARGS adds arguments of CMake, and CMAKE_BUILD_PARALLEL_LEVEL is the number of compilers at once.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "wheel"


def version() -> str:
    found = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())
    assert found, "CMakeLists.txt has no version"
    return found[1]


def numpy() -> str:
    """Before 2.12 pybind11 reads no arrays of NumPy 2."""
    asked = subprocess.run(["pkg-config", "--exists", "pybind11 >= 2.12"], check=False)
    return "numpy" if asked.returncode == 0 else "numpy<2"


def replace_links(folder: pathlib.Path) -> None:
    """A wheel has no symbolic links: each library keeps the name by which programs load it."""
    for link in [path for path in folder.iterdir() if path.is_symlink()]:
        target = link.resolve()
        link.unlink()
        target.rename(link)


class BuildByCMake(build_ext):
    def run(self) -> None:
        prefix = pathlib.Path(self.build_lib).resolve()
        tree = BUILD / f"cmake-{sys.implementation.cache_tag}"
        has_ode = subprocess.run(["pkg-config", "--exists", "ode"], check=False).returncode == 0
        settings = {
            "CMAKE_BUILD_TYPE": "Release",
            "CMAKE_INSTALL_LIBDIR": "supernormal",
            "CMAKE_INSTALL_DOCDIR": "supernormal",
            "SUPERNORMAL_PYTHON": sys.executable,
            "SUPERNORMAL_PYTHON_PACKAGES": ".",
            "SUPERNORMAL_BUILD_DOCUMENTATION": "OFF",
            "SUPERNORMAL_PRECOMPILE": "ON",
            "SUPERNORMAL_UNITE": "ON",
            "SUPERNORMAL_BUILD_ODE_LAYER": "ON" if has_ode else "OFF",
            "SUPERNORMAL_REQUIRE_OPTIONAL": "ON",  # without pybind11 there is no package
        }
        arguments = [f"-D{name}={value}" for name, value in settings.items()] + shlex.split(os.environ.get("CMAKE_ARGS", ""))
        subprocess.run(["cmake", "-S", ROOT, "-B", tree, *arguments], check=True)
        at_once = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
        subprocess.run(["cmake", "--build", tree, "--parallel", at_once], check=True)
        libraries = ["supernormal_core_runtime", "supernormal_runtime"] if has_ode else ["supernormal_core_runtime"]
        for component in [*libraries, "supernormal_python"]:
            subprocess.run(["cmake", "--install", tree, "--prefix", prefix, "--component", component, "--strip"], check=True)
        replace_links(prefix / "supernormal")


BUILD.mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    install_requires=[numpy()],
    packages=[],
    ext_modules=[Extension("supernormal._core", [])],  # the wheel is for this interpreter and this kind of machine
    cmdclass={"build_ext": BuildByCMake},
    options={
        "build": {"build_base": str(BUILD)},
        "egg_info": {"egg_base": str(BUILD)},
        "bdist_wheel": {"bdist_dir": str(BUILD / "bdist")},
    },
)
