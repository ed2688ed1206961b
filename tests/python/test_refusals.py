"""Invalid input raises an exception with the text of the C++ core: the parameter, its value and the valid range."""

import re

import numpy as np
import pytest
import supernormal as sn

NAN = float("nan")
BALL = sn.Sphere(1)
HERE = sn.Pose()


def proximity(**settings):
    return sn.find_proximity(BALL, HERE, BALL, sn.Pose((3, 0, 0)), sn.Settings(**settings))


REFUSALS = [
    (lambda: sn.Sphere(-1e-3), "radius = -0.001 m is outside [0, 1e+30] m"),
    (lambda: sn.Sphere(NAN), "radius = nan m is outside [0, 1e+30] m"),
    (lambda: sn.Ellipsoid((1, -2.5, 1)), "half-axis b = -2.5 m is outside [1e-30, 1e+30] m"),
    (lambda: sn.Superellipsoid((1, 1, 1e31), 2, 2), "half-axis c = 1e+31 m is outside [1e-30, 1e+30] m"),
    (lambda: sn.Superellipsoid((3, 2, 1), 0.9, 2), "delta = 0.9 is outside [1.01, 1000]"),
    (lambda: sn.Superellipsoid((3, 2, 1), 2, 1000.5), "epsilon = 1000.5 is outside [1.01, 1000]"),
    (lambda: sn.Superovoid((1, 1, 1), 2, 4, 0.1, 0.2), "taper_x = 0.1"),
    (lambda: sn.Superovoid((1, 1, 1), 2, 2, 0.8, 0.8), "taper_x = 0.8"),
    (lambda: sn.Box((1, -1, 1)), "-1 m is outside [0, 1e+30] m"),
    (lambda: sn.Capsule(1, -1), "half-length = -1 m is outside [0, 1e+30] m"),
    (lambda: sn.Cylinder(-1, 1), "radius = -1 m is outside [0, 1e+30] m"),
    (lambda: sn.Rounded(BALL, -1), "radius = -1 m is outside [0, 1e+30] m"),
    (lambda: sn.Polytope(np.empty((0, 3))), "point"),
    (lambda: sn.Polytope([[1, 2, 3], [1, NAN, 3]]), "nan"),
    (lambda: sn.Polytope([[1, 2]]), "points has the shape (1, 2), but must have (N, 3)"),
    (lambda: sn.LinearImage(BALL, np.zeros((3, 3))), "singular value"),
    (lambda: sn.CallbackShape(lambda n: -n), "direction"),
    (lambda: sn.CallbackShape(lambda n: NAN * n), "direction"),
    (lambda: sn.CallbackShape(lambda n: "far"), "returned 'far', but must return 3 numbers"),
    (lambda: sn.CallbackShape(lambda n: n, hessian=lambda n: np.eye(2)), "but must return 9 numbers"),
    (lambda: sn.CallbackShape(lambda n: n, hessian=lambda n: np.eye(3)), "essian"),
    (lambda: sn.CallbackShape(lambda n: n).hessian((1, 0, 0)), "the shape has no Hessian"),
    (lambda: sn.Shapes.superellipsoids(np.ones((3, 3)), 2, [2, 2, 0.5]), "shape 2: epsilon = 0.5 is outside [1.01, 1000]"),
    (lambda: sn.Shapes.superellipsoids(np.ones((3, 3)), [2, 2], 2), "delta has 2 entries and half_axes has 3; they must have as many"),
    (lambda: sn.Shapes.spheres([1, -1]), "shape 1: radius = -1 m is outside [0, 1e+30] m"),
    (lambda: sn.Pose((NAN, 0, 0)), "position = (nan, 0, 0) m is outside [-1e+150, 1e+150] m"),
    (lambda: sn.Pose((0, 0, 0), 1.02 * np.eye(3)), "rotation = (1.02, 0, 0, 0, 1.02, 0, 0, 0, 1.02) (by rows), but must be orthonormal and right-handed to 0.01"),
    (lambda: sn.Pose((0, 0, 0), -np.eye(3)), "right-handed"),
    (lambda: sn.Pose((0, 0, 0), NAN * np.eye(3)), "rotation = (nan"),
    (lambda: sn.Pose((0, 0, 0), quaternion=(1, 1, 0, 0)), "quaternion = (1, 1, 0, 0) (w, x, y, z) has the length 1.41421"),
    (lambda: sn.Pose((0, 0, 0), np.eye(3), (1, 0, 0, 0)), "rotation and quaternion are both given"),
    (lambda: sn.Poses([[0, 0, 0], [0, 1e151, 0]]), "position[1] = (0, 1e+151, 0) m is outside"),
    (lambda: sn.Poses(np.zeros((2, 3)), np.eye(3)), "rotation has the shape (3, 3), but must have (N, 3, 3)"),
    (lambda: sn.Poses(np.zeros((2, 3)), quaternion=[[1, 0, 0, 0]]), "quaternion has 1 entries and position 2"),
    (lambda: proximity(tolerance=0), "tolerance = 0 is outside [1e-15, 1]"),
    (lambda: proximity(tolerance=NAN), "tolerance = nan is outside [1e-15, 1]"),
    (lambda: proximity(max_evaluations=0), "max_evaluations = 0 is outside [1, 1000000]"),
    (lambda: sn.Settings(solver=7), "7 is not a valid Solver"),
    (lambda: sn.find_proximity(BALL, HERE, BALL, HERE, first_normal=(0, 0, 0)), "first_normal = (0, 0, 0), but must have a length"),
    (lambda: sn.find_plane_proximity(BALL, HERE, (0, NAN, 0), 0), "plane_normal = (0, nan, 0) is not finite"),
    (lambda: sn.find_plane_proximity(BALL, HERE, (0, 1, 0), NAN), "plane_offset = nan m is not finite"),
    (lambda: sn.find_ray_hit(BALL, HERE, (0, 0, 0), (1, 0, 0), -1), "length of the ray = -1 m is outside [0, inf] m"),
    (lambda: sn.find_ray_hit(BALL, HERE, (NAN, 0, 0), (1, 0, 0)), "origin = (nan, 0, 0) m is outside"),
    (lambda: sn.find_ray_hit(BALL, HERE, (0, 0, 0), (0, 0, 0)), "direction = (0, 0, 0), but must have a length"),
    (lambda: sn.find_proximities([BALL] * 2, HERE, [BALL] * 3, HERE), "shapes2 has 3 entries and shapes1 has 2"),
    (lambda: sn.find_proximities(BALL, HERE, BALL, HERE, threads=257), "threads = 257 is outside [0, 256]"),
    (lambda: sn.find_proximities([BALL] * 3, HERE, BALL, HERE, sn.Settings(tolerance=2)), "tolerance = 2 is outside [1e-15, 1]"),
    (lambda: BALL.support((0, 0, 0)), "direction = (0, 0, 0), but must have a length"),
    (lambda: BALL.point([[1, 0, 0], [NAN, 0, 0]]), "direction[1] = (nan, 0, 0) is not finite"),
    (lambda: BALL.support((1, 0)), "direction has the shape (2,), but must have (..., 3)"),
    (lambda: BALL.signed_distance((0, 0, float("inf"))), "point = (0, 0, inf) m is outside"),
    (lambda: BALL.tessellate(0), "chord_error = 0 m, but must be in [1e-06, inf)"),
    (lambda: BALL.projected_area((0, 0, 0)), "direction = (0, 0, 0), but must have a length"),
    (lambda: contacts_of_a_ball(room=0), "room = 0 is outside [1, inf)"),
]


def contacts_of_a_ball(room):
    nearest = sn.find_proximity(BALL, HERE, BALL, sn.Pose((1, 0, 0)))
    return sn.find_contact_manifold(BALL, HERE, BALL, sn.Pose((1, 0, 0)), nearest).contacts(room)


@pytest.mark.parametrize("call,message", REFUSALS, ids=[message for _, message in REFUSALS])
def test_refusal(call, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        call()


@pytest.mark.parametrize(
    "call,message",
    [
        (lambda: sn.find_proximities([BALL, 3], HERE, BALL, HERE), "shapes1[1] is 3, but must be a Shape"),
        (lambda: sn.find_proximities(BALL, None, BALL, HERE), "poses1 is None, but must be a Pose or Poses"),
        (lambda: sn.find_proximities(7, HERE, BALL, HERE), "shapes1 is 7, but must be a Shape"),
        (lambda: sn.Rounded(None, 1), "core is None, but must be a Shape"),
        (lambda: sn.find_proximity(None, HERE, BALL, HERE), "shape1 is None, but must be a Shape"),
        (lambda: sn.Shape(), "No constructor defined"),
        (lambda: sn.Superellipsoid((1, 1), 2, 2), "half_axes is (1, 1), but must be 3 numbers"),
        (lambda: sn.Superellipsoid((1, 1, 1), "2", 2), "delta is '2', but must be a number"),
        (lambda: sn.Superellipsoid(half_axis=(1, 1, 1), delta=2, epsilon=2), "Superellipsoid(half_axes, delta, epsilon) has no half_axis and lacks half_axes"),
        (lambda: sn.Box(1, 1, 1), "Box(half_lengths) takes 1 argument, not 3; half_lengths is 1, but must be 3 numbers"),
        (lambda: sn.Pose(HERE.position, rotation=np.ones(9)), "rotation is array([1., 1., 1., 1., 1., 1., 1., 1., 1.]), but must be numbers of the shape (3, 3)"),
        (lambda: sn.Settings(solver="newton"), "solver is 'newton', but must be a Solver"),
        (lambda: sn.Settings(1e-6), "Settings(solver, tolerance, max_evaluations, stop_when_apart, certify_depth) takes 0 arguments, not 1"),
        (lambda: setattr(sn.Settings(), "tolerance", "small"), "the value is 'small', but must be a number"),
        (lambda: sn.find_proximity(BALL, BALL), "lacks shape2 and lacks pose2; pose1 is Sphere(radius=1.0), but must be a Pose"),
        (lambda: sn.find_proximity(BALL, HERE, BALL, HERE, tolerance=1), "find_proximity(shape1, pose1, shape2, pose2, settings, first_normal) has no tolerance"),
        (lambda: BALL.tessellate("fine"), "chord_error is 'fine', but must be a number"),
        (lambda: sn.CallbackShape(3), "point is 3, but must be a function"),
        (lambda: sn.describe(3), "value is 3, but must be a Shape"),
        # NumPy would drop the imaginary parts, and read the texts.
        (lambda: sn.Box(np.array([1, 1, 1j])), "half_lengths has numbers of the type complex128"),
        (lambda: sn.Poses(np.ones((2, 3), complex)), "position has numbers of the type complex128"),
        (lambda: BALL.support([["1", "0", "0"]]), "direction has numbers of the type <U1"),
    ],
)
def test_wrong_types(call, message):
    with pytest.raises(TypeError, match=re.escape(message)):
        call()


def test_a_shape_that_stops_being_finite():
    size = [1.0]
    shape = sn.CallbackShape(lambda n: size[0] * n)
    size[0] = NAN
    with pytest.raises(ValueError, match="what a shape delivers is not finite"):
        sn.find_proximity(shape, HERE, BALL, HERE)
    with pytest.raises(ValueError, match="^0: what a shape delivers is not finite"):
        sn.find_proximities(shape, HERE, BALL, sn.Poses(np.ones((5, 3))))


def test_a_rotation_that_was_typed_becomes_the_nearest():
    typed = np.array([[0.866, -0.5, 0], [0.5, 0.866, 0], [0, 0, 1]])
    used = sn.Pose((0, 0, 0), typed).rotation
    assert np.abs(used.T @ used - np.eye(3)).max() < 1e-15 and np.abs(used - typed).max() < 1e-4
    angle = np.arctan2(0.5, 0.866)
    assert used[0, 0] == pytest.approx(np.cos(angle), abs=1e-15)
    exact = sn.Pose((0, 0, 0), quaternion=(0.5, 0.5, 0.5, 0.5)).rotation
    assert (sn.Pose((0, 0, 0), exact).rotation == exact).all()
    # As in C: the limits of lib/guide.md, by the sum of the errors.
    nearly = np.diag([1 + 1e-15, 1 + 1e-15, 1])
    assert (sn.Pose((0, 0, 0), nearly).rotation == nearly).all()
    beyond = np.diag([1 + 2e-15, 1 + 2e-15, 1])
    used = sn.Pose((0, 0, 0), beyond).rotation
    assert (used != beyond).any() and np.abs(used - np.eye(3)).max() < 1e-15
    assert np.abs(sn.Pose((0, 0, 0), np.diag([1, 1, 1.0099])).rotation - np.eye(3)).max() < 1e-15
    with pytest.raises(ValueError, match="orthonormal and right-handed to 0.01$"):
        sn.Pose((0, 0, 0), np.diag([1, 1, 1.0101]))


def test_an_index_out_of_range():
    for sequence in (sn.Poses(np.zeros((2, 3))), sn.Shapes([BALL, BALL])):
        with pytest.raises(IndexError, match="has 2 entries"):
            sequence[2]
        with pytest.raises(IndexError, match="has 2 entries, from -2 to 1"):
            sequence[-3]
        assert sequence[-1] == sequence[1]


def test_settings_out_of_range_are_refused_where_they_are_made():
    settings = sn.Settings()
    with pytest.raises(ValueError, match=r"^tolerance = 7 is outside \[1e-15, 1\]$"):
        sn.Settings(tolerance=7)
    with pytest.raises(ValueError, match=r"^max_evaluations = -1 is outside \[1, 1000000\]$"):
        settings.max_evaluations = -1
    assert settings == sn.Settings()
