#!/usr/bin/env python3
"""Fits a superellipsoid to measured contacts: a probe with a ball at its tip has touched an unknown body at many places.

    fit_contacts.py [--contacts N] [--noise METRES]

A contact says that the gap of ball and body was 0, but for noise. least_squares finds half-axes, exponents, position and orientation
of the body for which the gaps are smallest. All derivatives come with the gaps:

* with respect to the pose from the normal and the witness point (planner.py);
* with respect to a parameter of the shape from the support function at the normal n: d gap = -(dh/d parameter)(n), because the
  body touches the tangent plane there (envelope theorem).
"""

from __future__ import annotations

import argparse
import dataclasses
import time
from typing import Any

import numpy as np
import numpy.typing as npt
import supernormal as sn
from planner import left_jacobian
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

Numbers = npt.NDArray[np.float64]

BALL = sn.Sphere(0.002)  # m
# a, b, c in m; delta, epsilon; position in m; rotation vector
TRUTH = np.array([0.050, 0.035, 0.020, 3.2, 2.4, 0.010, -0.004, 0.006, 0.3, -0.2, 0.5])
NAMES = ["a", "b", "c", "delta", "epsilon", "x", "y", "z", "rotation x", "rotation y", "rotation z"]


def body_of(parameters: Numbers) -> tuple[sn.Superellipsoid, sn.Pose]:
    shape = sn.Superellipsoid(parameters[:3], *parameters[3:5])
    return shape, sn.Pose(parameters[5:8], Rotation.from_rotvec(parameters[8:]).as_matrix())


# %% Derivatives of the support function h = (t^q + (c |nz|)^q)^(1/q), t = ((a |nx|)^p + (b |ny|)^p)^(1/p), with respect to a, b, c,
# delta and epsilon; p = delta/(delta - 1), q = epsilon/(epsilon - 1)
def norm_by_exponent(first: Numbers, second: Numbers, p: float) -> tuple[Numbers, Numbers]:
    """(first^p + second^p)^(1/p) and its derivative with respect to p, without overflow: the larger one is a factor."""
    larger = np.maximum(np.maximum(first, second), 1e-300)
    ratio = np.minimum(first, second) / larger
    power = ratio**p
    log_ratio = np.log(np.maximum(ratio, 1e-300))
    norm = larger * (1 + power) ** (1 / p)
    return norm, norm * (-np.log1p(power) / p**2 + power * log_ratio / (p * (1 + power)))


def support_derivatives(shape: sn.Superellipsoid, n: Numbers) -> Numbers:
    """(N, 5). A half-axis scales one coordinate of the normal: dh/da = nx r_x / a."""
    a, b, c = shape.half_axes
    p, q = shape.delta / (shape.delta - 1), shape.epsilon / (shape.epsilon - 1)
    t, t_by_p = norm_by_exponent(a * abs(n[:, 0]), b * abs(n[:, 1]), p)
    h, h_by_q = norm_by_exponent(t, c * abs(n[:, 2]), q)
    h_by_t = (t / h) ** (q - 1)
    by_delta = -h_by_t * t_by_p / (shape.delta - 1) ** 2
    by_epsilon = -h_by_q / (shape.epsilon - 1) ** 2
    return np.column_stack([n * shape.point(n) / shape.half_axes, by_delta, by_epsilon])


# %% The gaps of all contacts, and their derivatives
@dataclasses.dataclass
class Contacts:
    centres: Numbers  # (N, 3), m, of the ball
    calls: int = 0

    def find(self, parameters: Numbers) -> sn.Proximities:
        self.calls += 1
        return sn.find_proximities(*body_of(parameters), BALL, sn.Poses(self.centres), threads=1)

    def gaps(self, parameters: Numbers) -> Numbers:
        return self.find(parameters).gap

    def jacobian(self, parameters: Numbers) -> Numbers:
        shape, pose = body_of(parameters)
        found = self.find(parameters)
        # The normals point from the body to the ball. If the body moves, the signs are opposite to those of planner.py.
        torque = np.cross(found.point1 - pose.position, found.normal) @ left_jacobian(parameters[8:])
        return np.hstack([-support_derivatives(shape, found.normal @ pose.rotation), -found.normal, -torque])


def measure(count: int, noise: float, random: np.random.Generator) -> Contacts:
    shape, pose = body_of(TRUTH)
    n = random.normal(size=(count, 3))
    n /= np.linalg.norm(n, axis=1)[:, None]
    centres = (shape.point(n) + BALL.radius * n) @ pose.rotation.T + pose.position
    return Contacts(centres + noise * random.normal(size=(count, 3)))


def first_guess(centres: Numbers) -> Numbers:
    """An ellipsoid with the extents of the contacts along their principal axes."""
    middle = centres.mean(axis=0)
    axes = np.linalg.svd(centres - middle, full_matrices=False)[2].T
    axes[:, 2] *= np.linalg.det(axes)
    half_axes = np.abs((centres - middle) @ axes).max(axis=0)
    return np.concatenate([half_axes, [2.0, 2.0], middle, Rotation.from_matrix(axes).as_rotvec()])


def nearest_to_truth(parameters: Numbers) -> Numbers:
    """The same body, which looks the same after half a turn about each of its axes, in the orientation nearest to the truth."""
    truth, found = Rotation.from_rotvec(TRUTH[8:]), Rotation.from_rotvec(parameters[8:])
    half_turns = [found * Rotation.from_rotvec(np.pi * axis) for axis in (*np.eye(3), np.zeros(3))]
    best = min(half_turns, key=lambda rotation: float((truth.inv() * rotation).magnitude()))
    return np.concatenate([parameters[:8], best.as_rotvec()])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--contacts", type=int, default=150)
    parser.add_argument("--noise", type=float, default=2e-5)
    arguments = parser.parse_args()
    contacts = measure(arguments.contacts, arguments.noise, np.random.default_rng(3))
    low = [1e-3] * 3 + [1.1] * 2 + [-np.inf] * 6
    high = [1.0] * 3 + [60.0] * 2 + [np.inf] * 6
    results: dict[str, tuple[Any, float, int]] = {}
    for name, method in (("derivatives of the gap", contacts.jacobian), ("differences", "2-point")):
        contacts.calls = 0
        begin = time.process_time()
        result = least_squares(
            contacts.gaps, first_guess(contacts.centres), method, (low, high), x_scale="jac", ftol=1e-12, xtol=1e-10, gtol=1e-14
        )
        results[name] = result, time.process_time() - begin, contacts.calls
        rms = np.sqrt(np.mean(result.fun**2))
        print(f"{name}: {result.nfev} steps, {contacts.calls} times the gaps, {1e3 * results[name][1]:.0f} ms, rms {1e6 * rms:.1f} um")

    result = results["derivatives of the gap"][0]
    variance = np.sum(result.fun**2) / (len(result.fun) - len(TRUTH))
    parameters = nearest_to_truth(result.x)
    jacobian = contacts.jacobian(parameters)
    errors = np.sqrt(variance * np.diag(np.linalg.inv(jacobian.T @ jacobian)))
    worst = 0.0
    for name, value, error, truth in zip(NAMES, parameters, errors, TRUTH):
        worst = max(worst, abs(value - truth) / error)
        print(f"{name:>10} = {value:9.6f} +- {error:.6f}   truth {truth:9.6f}")
    print(f"the farthest from the truth by {worst:.1f} standard errors")


if __name__ == "__main__":
    main()
