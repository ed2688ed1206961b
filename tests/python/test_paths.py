"""find_proximity_path: the answer of find_proximity, and the normals at which the solver evaluated the gap function."""

import numpy as np
import pytest
import supernormal as sn
from pairs import random_pairs

TURNED = sn.Pose((0.4, -0.1, 2.2), quaternion=(0.8, 0.6, 0, 0))
PEBBLE = sn.Superellipsoid((1, 0.8, 0.5), 2.3, 8)
BRICK = sn.Box((1, 0.7, 0.3))


def gap(shape1, pose1, shape2, pose2, normals):
    """s(n) by its definition."""
    offset = pose2.position - pose1.position
    return normals @ offset - shape1.support(normals @ pose1.rotation) - shape2.support(-normals @ pose2.rotation)


@pytest.mark.parametrize("solver", sn.Solver)
def test_of_random_pairs(solver):
    for row in random_pairs(100, 3):
        shapes = [sn.Superellipsoid(row[k : k + 3], *row[k + 3 : k + 5]) for k in (0, 5)]
        pair = (shapes[0], TURNED, shapes[1], sn.Pose(TURNED.position + row[10:13], row[13:22].reshape(3, 3)))
        settings = sn.Settings(solver=solver)
        result, normals = sn.find_proximity_path(*pair, settings)
        direct = sn.find_proximity(*pair, settings)
        if solver == sn.Solver.HYBRID:  # which takes its first steps in vector lanes
            assert (result.status, result.is_global) == (direct.status, direct.is_global)
            assert abs(result.gap - direct.gap) <= result.error + direct.error
        else:
            assert result == direct
        assert normals.shape == (result.evaluations, 3)
        assert np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-14)
        best = np.argmin(np.linalg.norm(normals - result.normal, axis=1))
        assert gap(*pair, normals[best]) == pytest.approx(result.gap, abs=1e-12)


@pytest.mark.parametrize("pair", [(PEBBLE, BRICK), (BRICK, PEBBLE), (BRICK, BRICK)])
def test_bodies_with_faces_whichever_is_first(pair):
    pair = (pair[0], TURNED, pair[1], sn.Pose())
    result, normals = sn.find_proximity_path(*pair)
    assert result == sn.find_proximity(*pair)
    assert len(normals) == result.evaluations
    assert (gap(*pair, normals) <= result.gap + 1e-12).all()


def test_a_limit_leaves_the_first_normals_and_a_first_normal_is_the_first():
    pair = (PEBBLE, TURNED, PEBBLE, sn.Pose())
    _, whole = sn.find_proximity_path(*pair)
    _, part = sn.find_proximity_path(*pair, sn.Settings(max_evaluations=2))
    assert len(whole) > 2 and np.array_equal(part, whole[:2])
    _, warm = sn.find_proximity_path(*pair, first_normal=(0, 3, -4))
    assert warm[0] == pytest.approx(TURNED.rotation @ (0, 0.6, -0.8), abs=1e-15)


def test_refusals_are_those_of_find_proximity():
    with pytest.raises(ValueError, match="max_evaluations"):
        sn.find_proximity_path(PEBBLE, TURNED, BRICK, sn.Pose(), sn.Settings(max_evaluations=0))


def test_which_bodies_are_smooth():
    smooth = [sn.Sphere(1), PEBBLE, sn.Rounded(PEBBLE, 1), sn.MinkowskiSum(PEBBLE, sn.Sphere(1)), sn.Capsule(1, 0)]
    assert all(shape.is_smooth for shape in smooth)
    others = [BRICK, sn.Cylinder(1, 1), sn.Capsule(1, 1), sn.Rounded(BRICK, 1), sn.MinkowskiSum(PEBBLE, BRICK)]
    assert not any(shape.is_smooth for shape in others)
