#!/usr/bin/env python3
"""A robot finds a path past obstacles: SciPy with the gradient of the gap, beside SciPy's own differences.

    planner.py [--starts N] [FOLDER]     N random starts (default 100); FOLDER gets the figure

The robot is a superellipsoid that flies freely. A path has eight poses between start and goal. It is short, and keeps MARGIN
from every obstacle: a sum of squares of its steps and of what is missing to the margin. L-BFGS minimises the sum.

The gradient costs no query. If the robot, body 2, moves by the twist (v, omega) about its origin c, then
d gap = n . v + omega . ((P2 - c) x n), with the normal n and the witness point P2 that the gap came with (envelope theorem).

At the end, the time of impact proves that the robot can move from each sample of the path to the next without touching an obstacle.
"""

from __future__ import annotations

import argparse
import dataclasses
import pathlib
import time
from typing import Any, Callable

import numpy as np
import numpy.typing as npt
import supernormal as sn
from scipy.optimize import OptimizeResult, minimize
from scipy.spatial.transform import Rotation

Numbers = npt.NDArray[np.float64]

POSES = 8  # between start and goal: what L-BFGS varies
SUBSTEPS = 3  # from pose to pose; at each the gaps are asked for
MARGIN = 0.04  # m
ROBOT = sn.Superellipsoid((0.30, 0.16, 0.10), delta=4, epsilon=3)
START, GOAL = np.array([-1.5, 0.0, 0, 0, 0, 0]), np.array([1.5, 0.2, 0.1, 0, 0, np.pi / 2])  # m, and a rotation vector
OBSTACLES: list[tuple[sn.Shape, sn.Pose]] = [
    (sn.Superellipsoid((0.15, 0.15, 0.8), 8, 8), sn.Pose((-0.8, 0.1, 0))),
    (sn.Ellipsoid((0.3, 0.4, 0.3)), sn.Pose((-0.2, 0.5, 0.2))),
    (sn.Superovoid((0.3, 0.3, 0.5), 2.5, 2, 0.3, 0.3), sn.Pose((0.0, -0.5, -0.2))),
    (sn.Cylinder(0.12, 0.9), sn.Pose((0.45, 0.1, 0), quaternion=(np.cos(0.6), np.sin(0.6), 0, 0))),
    (sn.Box((0.2, 0.3, 0.1)), sn.Pose((0.8, 0.4, 0.3))),
    (sn.Rounded(sn.Box((0.1, 0.1, 0.3)), 0.05), sn.Pose((0.9, -0.3, 0))),
]


# %% The gaps of a path, and their gradient
def left_jacobian(rotation_vector: Numbers) -> Numbers:
    """(..., 3) -> (..., 3, 3): J with omega = J d(rotation_vector), the twist in the world frame."""
    angle2 = np.sum(rotation_vector**2, axis=-1)[..., None, None]
    angle = np.sqrt(np.maximum(angle2, 1e-12))
    x, y, z = np.moveaxis(rotation_vector, -1, 0)
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*x.shape, 3, 3)
    sine = np.where(angle2 < 1e-8, 0.5 - angle2 / 24, (1 - np.cos(angle)) / angle**2)
    rest = np.where(angle2 < 1e-8, 1 / 6 - angle2 / 120, (angle - np.sin(angle)) / angle**3)
    return np.asarray(np.eye(3) + sine * cross + rest * (cross @ cross))


def poses_of(path: Numbers) -> tuple[Numbers, Numbers]:
    return path[:, :3], Rotation.from_rotvec(path[:, 3:]).as_matrix()


SAMPLES = SUBSTEPS * (POSES + 1) - 1  # without start and goal
SHAPES = sn.Shapes([shape for _ in range(SAMPLES) for shape, _ in OBSTACLES])
PLACES = sn.Poses(
    np.tile([pose.position for _, pose in OBSTACLES], (SAMPLES, 1)), np.tile([pose.rotation for _, pose in OBSTACLES], (SAMPLES, 1, 1))
)


def gaps_of(samples: Numbers) -> tuple[Numbers, Numbers]:
    """The gaps (samples, obstacles) and their derivatives with respect to each sample (samples, obstacles, 6)."""
    position, rotation = (np.repeat(part, len(OBSTACLES), axis=0) for part in poses_of(samples))
    found = sn.find_proximities(SHAPES, PLACES, ROBOT, sn.Poses(position, rotation), threads=1)
    torque = np.cross(found.point2 - position, found.normal).reshape(SAMPLES, len(OBSTACLES), 3)
    force = found.normal.reshape(SAMPLES, len(OBSTACLES), 3)
    return found.gap.reshape(SAMPLES, -1), np.concatenate([force, torque @ left_jacobian(samples[:, 3:])], axis=2)


# %% The sum of squares that a path minimises
ARM = np.array([1, 1, 1, 0.3, 0.3, 0.3])  # m: a rotation by 1 rad counts as 0.3 m
STEPS = np.diff(np.eye(POSES + 2), axis=0)[:, 1:-1]
# Samples are linear between the poses, rotation vectors as well.
TIMES = np.arange(1, SAMPLES + 1) / SUBSTEPS
LINEAR = np.stack([np.interp(TIMES, np.arange(POSES + 2), row) for row in np.eye(POSES + 2)], axis=1)
# The poses are BENDS @ variables. So the length of the path has the same second derivative along each variable, and L-BFGS takes a
# third of the iterations (Ratliff and others 2009, CHOMP).
BENDS = np.linalg.inv(np.linalg.cholesky(STEPS.T @ STEPS)).T


def samples_of(path: Numbers) -> Numbers:
    return np.asarray(LINEAR @ np.vstack([START, path, GOAL]))


def steps_of(path: Numbers) -> Numbers:
    return np.asarray(np.diff(np.vstack([START, path, GOAL]), axis=0) * ARM)


def length_gradient(steps: Numbers) -> Numbers:
    return np.asarray(2 * (steps[:-1] - steps[1:]) * ARM)


@dataclasses.dataclass
class Problem:
    weight: float  # of what is missing to the margin
    calls: int = 0

    def value_and_gradient(self, variables: Numbers) -> tuple[float, Numbers]:
        self.calls += 1
        path = BENDS @ variables.reshape(POSES, 6)
        steps = steps_of(path)
        gaps, derivative = gaps_of(samples_of(path))
        missing = np.maximum(MARGIN - gaps, 0)
        push = -2 * self.weight * LINEAR[:, 1:-1].T @ np.einsum("so,sok->sk", missing, derivative)
        return float(np.sum(steps**2) + self.weight * np.sum(missing**2)), (BENDS.T @ (length_gradient(steps) + push)).ravel()

    def value(self, variables: Numbers) -> float:
        return self.value_and_gradient(variables)[0]

    def differences(self, variables: Numbers) -> tuple[float, Numbers]:
        """Differences that know that a sample has its own gaps only: eight times the gaps in place of once for each variable."""
        path, step = BENDS @ variables.reshape(POSES, 6), 1e-6
        value, _ = self.value_and_gradient(variables)
        samples = samples_of(path)
        missing = np.sum(np.maximum(MARGIN - gaps_of(samples)[0], 0) ** 2, axis=1)
        gradient = np.empty_like(samples)
        for k in range(6):
            moved = samples.copy()
            moved[:, k] += step
            gradient[:, k] = self.weight * (np.sum(np.maximum(MARGIN - gaps_of(moved)[0], 0) ** 2, axis=1) - missing) / step
        self.calls += 7
        return value, (BENDS.T @ (LINEAR[:, 1:-1].T @ gradient + length_gradient(steps_of(path)))).ravel()


Solve = Callable[[Problem, Numbers], OptimizeResult]
LIMITS = {"maxiter": 400, "maxfun": 100_000, "ftol": 1e-7, "gtol": 1e-5}


def by_gradient(problem: Problem, first: Numbers) -> OptimizeResult:
    return minimize(problem.value_and_gradient, first, jac=True, method="L-BFGS-B", options=LIMITS)


def by_differences(problem: Problem, first: Numbers) -> OptimizeResult:
    # SciPy's default step, 1e-8, is near the error of a gap, 1e-9 of the robot's smallest half-axis.
    return minimize(problem.value, first, method="L-BFGS-B", options={**LIMITS, "eps": 1e-6})


def by_sparse_differences(problem: Problem, first: Numbers) -> OptimizeResult:
    return minimize(problem.differences, first, jac=True, method="L-BFGS-B", options=LIMITS)


@dataclasses.dataclass
class Outcome:
    path: Numbers
    is_free: bool
    iterations: int
    calls: int
    seconds: float
    value: float


def plan(first: Numbers, solve: Solve) -> Outcome:
    """Two rounds: the first is smooth, the second has nearly the whole margin."""
    begin, variables, iterations, calls, value = time.process_time(), np.linalg.solve(BENDS, first).ravel(), 0, 0, np.inf
    for weight in (10.0, 1000.0):
        problem = Problem(weight)
        result = solve(problem, variables)
        variables, iterations, calls, value = result.x, iterations + result.nit, calls + problem.calls, result.fun
    seconds = time.process_time() - begin
    path = BENDS @ variables.reshape(POSES, 6)
    return Outcome(path, is_free(path), iterations, calls, seconds, float(value))


# %% The proof: from sample to sample in steady motion, the robot meets nothing
def is_free(path: Numbers) -> bool:
    position, rotation = poses_of(np.vstack([START, samples_of(path), GOAL]))
    for k in range(len(position) - 1):
        turn = Rotation.from_matrix(rotation[k + 1] @ rotation[k].T).as_rotvec()
        motion = sn.Motion(sn.Pose(position[k], rotation[k]), position[k + 1] - position[k], turn)
        for shape, pose in OBSTACLES:
            if sn.find_time_of_impact(shape, sn.Motion(pose), ROBOT, motion, 1.0).may_hit:
                return False
    return True


def random_path(random: np.random.Generator) -> Numbers:
    """The straight path, bent as a whole and at each pose."""
    share = np.linspace(0, 1, POSES + 2)[1:-1, None]
    bend = random.uniform(-1, 1, (2, 6)) * [0.5, 0.5, 0.5, 1.2, 1.2, 1.2]
    noise = random.uniform(-0.1, 0.1, (POSES, 6)) * [1, 1, 1, 3, 3, 3]
    return np.asarray(START + share * (GOAL - START) + np.sin(np.pi * share) * bend[0] + np.sin(2 * np.pi * share) * bend[1] + noise)


# %% The figure
def draw(outcome: Outcome, first: Numbers, file: pathlib.Path) -> None:
    import matplotlib.pyplot as plt

    figure = plt.figure(figsize=(9, 6))
    axes: Any = figure.add_subplot(projection="3d")

    def add(shape: sn.Shape, position: Numbers, rotation: Numbers, colour: str, alpha: float) -> None:
        mesh = shape.tessellate(0.01)
        points = mesh.points @ rotation.T + position
        axes.plot_trisurf(*points.T, triangles=mesh.triangles, color=colour, alpha=alpha, linewidth=0, clip_on=False)

    for shape, pose in OBSTACLES:
        add(shape, pose.position, pose.rotation, "#90c0f0", 0.4)
    for position, rotation in zip(*poses_of(np.vstack([START, outcome.path, GOAL]))):
        add(ROBOT, position, rotation, "#ffb060", 0.8)
    for path, style in ((first, "k:"), (outcome.path, "k.-")):
        axes.plot(*np.vstack([START, path, GOAL])[:, :3].T, style, linewidth=1)
    axes.set(xlim=(-1.9, 1.9), ylim=(-1, 1), zlim=(-0.8, 0.8), xlabel="x in m", ylabel="y in m", zlabel="z in m")
    axes.set_box_aspect((3.8, 2, 1.6), zoom=1.4)
    axes.view_init(60, -85)
    figure.savefig(file, dpi=70, bbox_inches="tight", pad_inches=0.3)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--starts", type=int, default=100)
    parser.add_argument("folder", nargs="?", type=pathlib.Path)
    arguments = parser.parse_args()

    solvers: dict[str, Solve] = {
        "gradient of the gap": by_gradient,
        "differences, one for each variable": by_differences,
        "differences, one for each coordinate of a sample": by_sparse_differences,
    }
    random = np.random.default_rng(7)
    starts = [random_path(random) for _ in range(arguments.starts)]
    outcomes: dict[str, list[Outcome]] = {name: [] for name in solvers}
    for first in starts:  # in turn, so that a busy machine slows all of them
        for name, solve in solvers.items():
            outcomes[name].append(plan(first, solve))
    fastest = np.mean([outcome.seconds for outcome in outcomes["gradient of the gap"]])
    for name, found in outcomes.items():
        free = sum(outcome.is_free for outcome in found)
        mean = {field: np.mean([getattr(outcome, field) for outcome in found]) for field in ("iterations", "calls", "seconds")}
        print(
            f"{name}: {free} of {len(found)} paths are free; {mean['iterations']:.0f} iterations, {mean['calls']:.0f} times the gaps, "
            f"{mean['seconds'] / fastest:.1f} times the time ({1e3 * mean['seconds']:.0f} ms)"
        )
    if arguments.folder:
        arguments.folder.mkdir(parents=True, exist_ok=True)
        free_ones = [k for k, outcome in enumerate(outcomes["gradient of the gap"]) if outcome.is_free]
        best = min(free_ones, key=lambda k: outcomes["gradient of the gap"][k].value)
        draw(outcomes["gradient of the gap"][best], starts[best], arguments.folder / "planner.png")


if __name__ == "__main__":
    main()
