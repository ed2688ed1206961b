"""Shapes, poses and results are compared, copied, pickled and printed by their arguments."""

import copy
import inspect
import pickle

import numpy as np
import pytest
import supernormal as sn


def ball_point(n):
    return 2 * n


def ball_hessian(n):
    return 2 * (np.eye(3) - np.outer(n, n))


BRICK, EGG, THERE = sn.Box((1, 2, 3)), sn.Superovoid((1, 0.8, 1.5), 2.5, 2, 0.3, 0.2), sn.Pose((0.1, 0, 3), quaternion=(0.8, 0.6, 0, 0))
NEAR = sn.find_proximity(BRICK, sn.Pose(), EGG, THERE)

SHAPES = [
    sn.Sphere(0.7),
    sn.Ellipsoid((3, 0.1, 1)),
    sn.Superellipsoid((3, 2, 1), 3, 1.7),
    EGG,
    BRICK,
    sn.Capsule(0.5, 2),
    sn.Cylinder(0.5, 2),
    sn.Polytope([[1, 0, 0], [-1, 0.5, 0], [0, -1, 0], [0, 0, 1.5]]),
    sn.Rounded(sn.Rounded(BRICK, 0.1), 0.2),
    sn.MinkowskiSum(EGG, sn.Sphere(0.1)),
    sn.LinearImage(EGG, [[2, 0.3, 0], [0, 1, 0], [0, 0.2, 0.5]]),
    sn.CallbackShape(ball_point, hessian=ball_hessian),
]
VALUES = [
    *SHAPES,
    THERE,
    NEAR,
    sn.find_contact_manifold(BRICK, sn.Pose(), BRICK, sn.Pose((0, 0, 5.9)), sn.find_proximity(BRICK, sn.Pose(), BRICK, sn.Pose((0, 0, 5.9)))),
    sn.find_ray_hit(BRICK, sn.Pose(), (0, 0, 9), (0, 0, -1)),
    sn.Motion(THERE, (1, 2, 3), (4, 5, 6), (0.1, 0, 0)),
    sn.find_time_of_impact(BRICK, sn.Motion(), EGG, sn.Motion(sn.Pose((0, 0, 9)), (0, 0, -9), (1, 2, 3)), 1),
    EGG.mass_properties(),
    sn.Shapes(SHAPES),
    sn.Shapes.spheres([1, 2, 3]),
]
UNHASHED = [sn.Settings(tolerance=1e-7, solver=sn.Solver.NEWTON, certify_depth=True), sn.Poses([[1, 2, 3], [4, 5, 6]])]
OF_ARRAYS = [
    sn.find_proximities(sn.Shapes(SHAPES), sn.Pose(), BRICK, THERE),
    sn.find_ray_hits(BRICK, sn.Pose(), [[0, 0, 9], [0, 9, 9]], (0, 0, -1)),
    EGG.tessellate(0.1),
    sn.find_proximity_derivatives(EGG, sn.Pose(), EGG, THERE, sn.find_proximity(EGG, sn.Pose(), EGG, THERE), parameters=False),
    sn.find_gap_gradient(EGG, sn.Pose(), EGG, THERE, sn.find_proximity(EGG, sn.Pose(), EGG, THERE)),
    sn.find_clearances(EGG, sn.Pose(), sn.Shapes(SHAPES), THERE),
    sn.find_times_of_impact(BRICK, sn.Motion(), EGG, [sn.Motion(THERE, (0, 0, -9)), sn.Motion(THERE)], 1),
]
EVERYTHING = [*VALUES, *UNHASHED, *OF_ARRAYS]

COPIES = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    **{f"pickle {protocol}": lambda value, protocol=protocol: pickle.loads(pickle.dumps(value, protocol)) for protocol in (0, 1, 2, 5)},
}


def name(value):
    return type(value).__name__


def content(value):
    """All values of an object that a program can read."""
    names = [key for key in dir(type(value)) if isinstance(inspect.getattr_static(type(value), key), property)]
    return {key: getattr(value, key) for key in names}


def test_every_class_is_here():
    classes = {value for value in vars(sn).values() if inspect.isclass(value) and not issubclass(value, int)}
    assert {type(value) for value in EVERYTHING} == classes - {sn.Shape}


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
@pytest.mark.parametrize("value", EVERYTHING, ids=name)
def test_a_copy(value, make):
    made = make(value)
    assert type(made) is type(value) and made is not value
    for key, before in content(value).items():
        np.testing.assert_array_equal(getattr(made, key), before, err_msg=key)
    assert repr(made) == repr(value)


@pytest.mark.parametrize("value", EVERYTHING, ids=name)
def test_arrays_of_an_object_are_read_only(value):
    # Many are copies: what is written to a copy changes nothing.
    for key, array in content(value).items():
        assert not isinstance(array, np.ndarray) or not array.flags.writeable, key


@pytest.mark.parametrize("value", SHAPES, ids=name)
def test_a_copy_of_a_shape_computes_the_same(value):
    made = pickle.loads(pickle.dumps(value))
    directions = np.random.default_rng(3).normal(size=(50, 3))
    assert (made.point(directions) == value.point(directions)).all() and made.has_hessian == value.has_hessian


@pytest.mark.parametrize("value", [*VALUES, *UNHASHED], ids=name)
def test_equality(value):
    made = pickle.loads(pickle.dumps(value))
    assert made == value and not made != value
    others = [other for other in EVERYTHING if other is not value]
    assert all(value != other for other in others) and value != 1 and value is not None


@pytest.mark.parametrize("value", VALUES, ids=name)
def test_equal_objects_have_the_same_hash(value):
    assert len({value, pickle.loads(pickle.dumps(value)), copy.copy(value)}) == 1


def test_what_may_change_has_no_hash():
    for value in UNHASHED:
        with pytest.raises(TypeError, match="unhashable"):
            hash(value)


DESCRIBED = [shape for shape in SHAPES if type(shape) is not sn.CallbackShape]


@pytest.mark.parametrize("value", [*DESCRIBED, THERE, UNHASHED[1]], ids=name)
def test_the_text_of_a_value_makes_it_again(value):
    assert eval(repr(value), vars(sn)) == value
    assert repr(sn.Sphere(0.1)) == "Sphere(radius=0.1)"


def test_long_lists_have_short_texts():
    assert repr(sn.Poses(np.zeros((101, 3)))) == "Poses(of 101 bodies)"
    assert repr(sn.Polytope(np.eye(101, 3))) == "Polytope(of 101 points)"
    assert sn.read_shape(sn.describe(sn.Polytope(np.eye(101, 3)))) == sn.Polytope(np.eye(101, 3))


@pytest.mark.parametrize("shape", DESCRIBED, ids=name)
def test_the_description_of_a_shape_is_read_by_python_and_by_the_core(shape):
    text = sn.describe(shape)
    made = sn.read_shape(text)
    assert type(made) is type(shape) and made == shape and sn.describe(made) == text
    assert eval(text, vars(sn)) == shape and sn.read_shape(repr(shape)) == shape
    assert pickle.loads(pickle.dumps(made)) == shape and repr(made) == repr(shape)


def test_the_description_of_a_pose():
    assert sn.read_pose(sn.describe(THERE)) == THERE == eval(sn.describe(THERE), vars(sn)) == sn.read_pose(repr(THERE))
    signed = sn.Pose((-0.0, 1, 2))
    assert np.signbit(sn.read_pose(sn.describe(signed)).position[0]) and np.signbit(eval(sn.describe(signed), vars(sn)).position[0])


def test_what_has_no_description_and_what_is_none():
    with pytest.raises(ValueError, match=r"shape.core is a supernormal::CallbackShape, which has no description"):
        sn.describe(sn.Rounded(SHAPES[-1], 1))
    with pytest.raises(ValueError, match=r'text at character 15 is "__import__\(\)\)", but must be a finite number'):
        sn.read_shape("Sphere(radius=__import__())")
    with pytest.raises(ValueError, match=r"delta = 1 is outside \[1.01, 1000\]"):
        sn.read_shape("Superellipsoid(half_axes=(1, 1, 1), delta=1, epsilon=2)")
    with pytest.raises(ValueError, match="rotation"):
        sn.read_pose("Pose(position=(0, 0, 0), rotation=((1, 0, 0), (0, 1, 0), (0, 0, 3)))")


@pytest.mark.parametrize("value", EVERYTHING, ids=name)
def test_no_text_is_an_address(value):
    assert " object at 0x" not in repr(value) and name(value) in repr(value)


class Pebble(sn.Ellipsoid):
    """A subclass with arguments and attributes of its own."""

    def __init__(self, size, colour):
        super().__init__((3 * size, 2 * size, size))
        self.colour = colour


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
def test_a_copy_of_a_subclass(make):
    pebble = Pebble(0.1, ["grey"])
    made = make(pebble)
    assert type(made) is Pebble and made == pebble and made.colour == ["grey"]
    assert (made.colour is pebble.colour) == (make is copy.copy)
    assert pebble != sn.Ellipsoid(pebble.half_axes)


def test_what_a_shape_is_made_of():
    rounded, total = SHAPES[8], SHAPES[9]
    assert rounded.core == sn.Rounded(BRICK, 0.1) and rounded.core.core == BRICK
    assert (total.first, total.second) == (EGG, sn.Sphere(0.1)) and SHAPES[10].shape == EGG
    core = sn.Rounded(sn.Sphere(1), 2).core  # outlives the whole
    assert core.radius == 1


def test_a_function_that_cannot_be_pickled():
    with pytest.raises((pickle.PicklingError, AttributeError), match="lambda"):
        pickle.dumps(sn.CallbackShape(lambda n: n))
    assert copy.deepcopy(sn.CallbackShape(lambda n: n)).support((1, 0, 0)) == 1


def test_members_of_enums():
    for member in (*sn.Solver, *sn.Status):
        assert pickle.loads(pickle.dumps(member)) is member
