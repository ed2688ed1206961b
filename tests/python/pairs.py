"""Random pairs for the loop in C++ (loop.cpp) and for the package."""

import os
import pathlib
import subprocess
import tempfile
from typing import Dict, Tuple

import numpy as np
import supernormal as sn


def random_pairs(count: int, seed: int) -> np.ndarray:
    """The input of loop.cpp, (count, 22). Exponents 1.3 to 5, half-axes 0.5 to 1.5 m, apart and overlapping."""
    random = np.random.default_rng(seed)
    axes = random.uniform(0.5, 1.5, (2, count, 3))
    exponents = random.uniform(1.3, 5, (2, count, 2))
    quaternions = unit(random.normal(size=(count, 4)))
    positions = unit(random.normal(size=(count, 3))) * random.uniform(1.5, 6, (count, 1))
    rotations = sn.Poses(positions, quaternion=quaternions).rotation.reshape(count, 9)
    return np.hstack([axes[0], exponents[0], axes[1], exponents[1], positions, rotations])


def unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def solve_in_python(pairs: np.ndarray, threads: int) -> sn.Proximities:
    """The work of a program whose bodies are arrays: shapes and poses are made anew."""
    shapes1 = sn.Shapes.superellipsoids(pairs[:, 0:3], pairs[:, 3], pairs[:, 4])
    shapes2 = sn.Shapes.superellipsoids(pairs[:, 5:8], pairs[:, 8], pairs[:, 9])
    poses2 = sn.Poses(pairs[:, 10:13], rotation=pairs[:, 13:22].reshape(-1, 3, 3))
    return sn.find_proximities(shapes1, sn.Pose(), shapes2, poses2, threads=threads)


def solve_in_cpp(pairs: np.ndarray) -> Tuple[Dict[str, np.ndarray], float, float]:
    """The results by name, and the processor time and the time of the loop, s."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        np.ascontiguousarray(pairs).tofile(folder / "pairs")
        run = [os.environ["SUPERNORMAL_LOOP"], folder / "pairs", folder / "results"]
        seconds = subprocess.run(run, check=True, capture_output=True, text=True).stdout.split()
        rows = np.fromfile(folder / "results").reshape(-1, 18)
    columns = {"gap": 0, "error": 1, "global_error": 14, "evaluations": 15, "status": 16, "is_global": 17}
    results = {key: rows[:, column] for key, column in columns.items()}
    for key, first in {"normal": 2, "point1": 5, "point2": 8, "contact": 11}.items():
        results[key] = rows[:, first : first + 3]
    return results, float(seconds[0]), float(seconds[1])
