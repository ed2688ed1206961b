"""The pairs with known answers of the C++ tests (tests/data)."""

import csv
import pathlib

import numpy as np
import pytest
import supernormal as sn

DATA = pathlib.Path(__file__).parent.parent / "data" / "superellipsoid_pairs.csv"


@pytest.fixture(scope="module")
def reference():
    with DATA.open() as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))[1:]
    table = np.array([[float(x) for x in row[1:]] for row in rows])
    assert table.shape == (1600, 29)
    return table


def shape_of(axes, delta, epsilon):
    """An Ellipsoid if both exponents are 2: the shape that a program would choose."""
    return sn.Ellipsoid(axes) if delta == 2 and epsilon == 2 else sn.Superellipsoid(axes, delta, epsilon)


def solve(reference, settings=sn.Settings()):
    shapes1 = [shape_of(row[0:3], row[3], row[4]) for row in reference]
    shapes2 = [shape_of(row[5:8], row[8], row[9]) for row in reference]
    poses2 = sn.Poses(reference[:, 10:13], quaternion=reference[:, 13:17])
    return sn.find_proximities(shapes1, sn.Pose(), shapes2, poses2, settings)


@pytest.fixture(scope="module")
def solved(reference):
    return solve(reference)


def units(reference):
    return np.minimum(reference[:, 0:3].min(axis=1), reference[:, 5:8].min(axis=1))


def test_every_gap(reference, solved):
    assert (solved.status == sn.Status.CONVERGED).all()
    error = np.abs(solved.gap - reference[:, 17])
    assert (error <= 1e-9 * units(reference)).all()
    rounding = np.finfo(float).eps * (np.abs(reference[:, 17]) + reference[:, 5:8].max(axis=1))
    assert (error <= solved.error + rounding).all()


def test_the_normal_is_in_the_plane_of_the_gap(reference, solved):
    """s(n) = n . (point2 - point1) for the returned normal and points, in one frame."""
    s = np.einsum("ij,ij->i", solved.normal, solved.point2 - solved.point1)
    scale = reference[:, 0:3].max(axis=1) + reference[:, 5:8].max(axis=1) + np.linalg.norm(reference[:, 10:13], axis=1)
    assert (np.abs(s - solved.gap) <= 1e-14 * scale).all()
    assert np.abs(np.linalg.norm(solved.normal, axis=1) - 1).max() < 1e-14


def test_points_where_they_are_determined(reference):
    known = (reference[:, 27] == 1) & (reference[:, 28] == 1)
    assert known.sum() > 300
    # A gap that is exact to e fixes points to about sqrt(2 e times the radius of curvature). On a side of exponent 140 the radius
    # reaches 1e13 sizes: a gap to 1e-9 leaves the place on it open. The step to 1e-12 finds it.
    solved = solve(reference, sn.Settings(tolerance=1e-12))
    size = np.maximum(reference[:, 0:3].max(axis=1), reference[:, 5:8].max(axis=1))[known]
    for points, column in ((solved.point1, 21), (solved.point2, 24)):
        distance = np.linalg.norm(points[known] - reference[known, column : column + 3], axis=1)
        assert (distance <= 1e-5 * size).all()
        assert np.median(distance / size) < 1e-9


HALF_TURN = (0, 1, 0, 0)


def test_r1_apart():
    shape1 = sn.Superellipsoid((15, 10, 5), 2 / 0.7, 2 / 0.5)
    shape2 = sn.Superellipsoid((5, 3, 2), 2 / 0.2, 2 / 1.25)
    out = sn.find_proximity(
        shape1,
        sn.Pose((2.82, -16.4, 7.52), quaternion=HALF_TURN),
        shape2,
        sn.Pose((-0.47, 8.44, 0.8), quaternion=HALF_TURN),
        sn.Settings(tolerance=1e-12),
    )
    assert out.status is sn.Status.CONVERGED
    assert out.gap == pytest.approx(12.6945142566438972, rel=1e-10)
    assert out.normal == pytest.approx([-0.0018948754308, 0.9516017981184, -0.3073278823422], abs=1e-6)
    assert out.point1 == pytest.approx([2.1781654632855, -6.6089213379082, 4.8540806508774], abs=1e-5)
    assert out.point2 == pytest.approx([2.1541109401146, 5.4712012549538, 0.9527024670205], abs=1e-5)


def test_r2_overlapping():
    out = sn.find_proximity(
        sn.Ellipsoid((20, 15, 10)),
        sn.Pose((-10, 7.25, 3.56), quaternion=HALF_TURN),
        sn.Ellipsoid((15, 12, 8)),
        sn.Pose((15.3, -2.2, 2.84), quaternion=HALF_TURN),
    )
    assert out.gap == pytest.approx(-6.3690451349138511, rel=1e-9)


@pytest.mark.parametrize("exponent", np.arange(2, 8.5, 0.5))
def test_l1_touching(exponent):
    ball = sn.Superellipsoid((3.456, 3.456, 3.456), exponent, exponent)
    out = sn.find_proximity(ball, sn.Pose((-3.456, 0, 0)), ball, sn.Pose((3.456, 0, 0)), sn.Settings(tolerance=1e-12))
    assert abs(out.gap) <= 1e-10 * 3.456
    assert out.contact == pytest.approx([0, 0, 0], abs=1e-9)


def test_a_certified_depth_is_the_smallest(reference):
    """The nominal overlap of 30 % has several local maxima; a certified query finds the highest from any start."""
    deep = np.flatnonzero(reference[:, 17] < -0.2 * units(reference))[:100]
    assert len(deep) == 100
    settings = sn.Settings(certify_depth=True)
    for row in reference[deep]:
        shapes = shape_of(row[0:3], row[3], row[4]), shape_of(row[5:8], row[8], row[9])
        pose2 = sn.Pose(row[10:13], quaternion=row[13:17])
        out = sn.find_proximity(shapes[0], sn.Pose(), shapes[1], pose2, settings, first_normal=(0.3, -0.5, 0.8))
        assert out.is_global
        unit = min(row[0:3].min(), row[5:8].min())
        assert abs(out.gap - row[17]) <= 1e-9 * unit
        assert out.global_error <= 1.001e-9 * unit
