"""Shapes against their closed forms, and their input and output arrays."""

import gc
from math import pi

import numpy as np
import pytest
import supernormal as sn

RANDOM = np.random.default_rng(3)
NORMALS = RANDOM.normal(size=(4, 5, 3))
UNIT = NORMALS / np.linalg.norm(NORMALS, axis=-1, keepdims=True)

SMOOTH = [
    sn.Sphere(0.7),
    sn.Ellipsoid((3, 2, 1)),
    sn.Superellipsoid((3, 2, 1), 3, 1.7),
    sn.Superovoid((1, 0.8, 1.5), 2.5, 2, 0.3, 0.3),
    sn.Rounded(sn.Superellipsoid((3, 2, 1), 3, 1.7), 0.25),
    sn.MinkowskiSum(sn.Ellipsoid((3, 2, 1)), sn.Sphere(0.1)),
    sn.LinearImage(sn.Sphere(1), [[2, 0.3, 0], [0, 1, 0], [0, 0.2, 0.5]]),
]
WITH_EDGES = [
    sn.Box((1, 2, 3)),
    sn.Capsule(0.5, 2),
    sn.Cylinder(0.5, 2),
    sn.Polytope([[1, 0, 0], [-1, 0.5, 0], [0, -1, 0], [0, 0, 1.5], [0, 0, -1]]),
]


def name(shape):
    return type(shape).__name__


@pytest.mark.parametrize("shape", SMOOTH + WITH_EDGES, ids=name)
def test_support_point_and_box_agree(shape):
    h = shape.support(NORMALS)
    r = shape.point(NORMALS)
    assert h.shape == (4, 5) and r.shape == (4, 5, 3)
    size = shape.half_extents.max()
    assert np.einsum("abi,abi->ab", r, UNIT) == pytest.approx(h, abs=1e-14 * size)
    lower, upper = shape.bounding_box()
    assert (r >= lower - 1e-14 * size).all() and (r <= upper + 1e-14 * size).all()
    assert shape.half_extents == pytest.approx((upper - lower) / 2, rel=1e-12)
    # No boundary point is outside another's tangent plane.
    points, planes = r.reshape(-1, 3), UNIT.reshape(-1, 3)
    assert (points @ planes.T <= h.reshape(-1) + 1e-14 * size).all()


@pytest.mark.parametrize("shape", SMOOTH, ids=name)
def test_the_hessian_is_the_derivative_of_the_point(shape):
    n, step = UNIT[0, 0], 1e-5
    hessian = shape.hessian(n)
    assert hessian.shape == (3, 3) and shape.has_hessian
    for axis in np.eye(3):
        difference = (shape.point(n + step * axis) - shape.point(n - step * axis)) / (2 * step)
        assert hessian @ axis == pytest.approx(difference, abs=1e-7 * shape.half_extents.max())


def test_a_bounding_box_turns_with_the_pose():
    c, s = np.cos(0.4), np.sin(0.4)
    pose = sn.Pose((1, 2, 3), [[c, -s, 0], [s, c, 0], [0, 0, 1]])
    lower, upper = sn.Box((1, 2, 3)).bounding_box(pose)
    half = [c + 2 * s, s + 2 * c, 3]
    assert lower == pytest.approx(np.array([1, 2, 3]) - half) and upper == pytest.approx(np.array([1, 2, 3]) + half)


def test_mass_of_a_superellipsoid():
    """tests/data/README.md"""
    mass = sn.Superellipsoid((3, 2, 1), 4, 4).mass_properties()
    assert mass.volume == pytest.approx(38.8919241107183, rel=1e-13)
    assert mass.second_moment[0, 0] / mass.volume == pytest.approx(2.4675115376401, rel=1e-13)
    assert mass.relative_error == 0 and (mass.centroid == 0).all()


def test_inertia_is_about_the_centroid():
    """A cone-like body, moved: its tensor does not change."""
    egg = sn.Superovoid((1, 1, 1.5), 2, 2, 0.4, 0.4)
    moved = sn.MinkowskiSum(egg, sn.Polytope([[3, -2, 1]]))
    assert moved.mass_properties().centroid == pytest.approx(egg.mass_properties().centroid + [3, -2, 1], rel=1e-9)
    assert moved.mass_properties().inertia == pytest.approx(egg.mass_properties().inertia, rel=1e-8, abs=1e-8)
    ball = sn.Sphere(2).mass_properties()
    assert ball.inertia == pytest.approx(0.4 * 4 * ball.volume * np.eye(3), rel=1e-14)
    assert sn.Box((1, 2, 3)).mass_properties().volume == pytest.approx(48)
    assert sn.Cylinder(1, 2).mass_properties().volume == pytest.approx(4 * pi)
    assert sn.Rounded(sn.Box((1, 1, 1)), 1).mass_properties().volume == pytest.approx(32 + 6 * pi + 4 * pi / 3)
    with pytest.raises(ValueError, match="of the shape, .* is uncertain by .* %, but must be known to 1 %"):
        sn.MinkowskiSum(sn.Ellipsoid((1, 2, 1)), sn.Box((1, 1, 1))).mass_properties()


def test_areas():
    assert sn.Sphere(2).surface_area() == pytest.approx(16 * pi, rel=1e-3)
    assert sn.Ellipsoid((3, 2, 1)).projected_area((0, 0, 5)) == pytest.approx(6 * pi, rel=1e-12)


def test_signed_distance_of_points():
    points = RANDOM.normal(size=(2, 50, 3))
    distance = sn.Sphere(0.9).signed_distance(points, sn.Pose((0.1, 0, 0)))
    assert distance == pytest.approx(np.linalg.norm(points - [0.1, 0, 0], axis=-1) - 0.9, abs=1e-14)
    box = sn.Box((1, 2, 3)).signed_distance([[0, 0, 0], [0.5, 0, 0], [2, 3, 0], [0, 0, -5]])
    assert box == pytest.approx([-1, -0.5, np.sqrt(2), 2], abs=1e-9)
    assert sn.Box((1, 2, 3)).signed_distance((4, 0, 0)).shape == ()


def test_tessellation_is_closed_and_near():
    shape = sn.Superellipsoid((3, 2, 1), 4, 2.5)
    mesh = shape.tessellate(0.01)
    assert mesh.points.shape == mesh.normals.shape and mesh.triangles.dtype == np.uint32
    edges = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, uses = np.unique(edges, axis=0, return_counts=True)
    assert (uses == 2).all()
    corners = mesh.points[mesh.triangles]
    volume = np.einsum("ai,ai->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert 0.98 < volume / shape.mass_properties().volume < 1
    assert mesh.points == pytest.approx(shape.point(mesh.normals), abs=1e-12)


def ellipsoid_point(n):
    squares = np.array([9.0, 4.0, 1.0])
    return squares * n / np.sqrt(n @ (squares * n))


def ellipsoid_hessian(n):
    squares = np.diag([9.0, 4.0, 1.0])
    h = np.sqrt(n @ squares @ n)
    return squares / h - np.outer(squares @ n, squares @ n) / h**3


@pytest.mark.parametrize("functions", [{}, {"hessian": ellipsoid_hessian}, {"support": lambda n: n @ ellipsoid_point(n)}])
def test_a_body_of_functions_is_the_body(functions):
    mine = sn.CallbackShape(ellipsoid_point, **functions)
    ellipsoid = sn.Ellipsoid((3, 2, 1))
    assert mine.has_hessian == ("hessian" in functions)
    assert mine.support(NORMALS) == pytest.approx(ellipsoid.support(NORMALS), rel=1e-13)
    poses = sn.Poses(RANDOM.normal(size=(40, 3)) * 3, quaternion=quaternions(40))
    found = sn.find_proximities(mine, sn.Pose(), sn.Box((1, 0.5, 0.5)), poses, threads=3)
    expected = sn.find_proximities(ellipsoid, sn.Pose(), sn.Box((1, 0.5, 0.5)), poses)
    assert found.gap == pytest.approx(expected.gap, abs=2e-9)


def quaternions(count):
    q = RANDOM.normal(size=(count, 4))
    return q / np.linalg.norm(q, axis=1)[:, None]


def test_shapes_keep_what_they_are_made_of():
    points = RANDOM.normal(size=(30, 3))
    shape = sn.Rounded(sn.Polytope(points), 0.1)
    expected = (points @ UNIT[0, 0]).max() + 0.1
    points[:] = 0
    gc.collect()
    assert shape.support(UNIT[0, 0]) == pytest.approx(expected)
    entry = sn.Shapes.superellipsoids([[1, 2, 3], [4, 5, 6]], 3, [2, 4])[1]
    gc.collect()
    assert isinstance(entry, sn.Superellipsoid)
    assert (entry.half_axes == [4, 5, 6]).all() and (entry.delta, entry.epsilon) == (3, 4)


def test_arrays_of_parameters_make_the_shapes_of_one():
    axes = RANDOM.uniform(1, 2, (5, 3))
    for many, one in (
        (sn.Shapes.spheres(axes[:, 0]), lambda a: sn.Sphere(a[0])),
        (sn.Shapes.ellipsoids(axes), sn.Ellipsoid),
        (sn.Shapes.superovoids(axes, 2.5, 2, axes[:, 0] / 9, 0.1), lambda a: sn.Superovoid(a, 2.5, 2, a[0] / 9, 0.1)),
    ):
        assert len(many) == 5 and len(list(many)) == 5
        for i, a in enumerate(axes):
            assert repr(many[i]) == repr(one(a))
            assert (many[i].support(NORMALS) == one(a).support(NORMALS)).all()


def test_other_types_of_numbers():
    assert repr(sn.Ellipsoid(np.array([1, 2, 3], dtype=np.int16))) == "Ellipsoid(half_axes=(1.0, 2.0, 3.0))"
    strided = np.arange(12, dtype=np.float32).reshape(2, 6)[:, ::2] + 1
    assert repr(sn.Shapes.ellipsoids(strided)[1]) == "Ellipsoid(half_axes=(7.0, 9.0, 11.0))"


def test_superovoid_limits():
    assert sn.Superovoid.max_taper(2) == pytest.approx(np.sqrt(2) / 2)
