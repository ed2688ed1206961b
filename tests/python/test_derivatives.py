"""Derivatives, gradients and clearances of N pairs."""

import numpy as np
import pytest
import supernormal as sn

RANDOM = np.random.default_rng(5)
COUNT = 40
EGG = sn.Superovoid((1, 0.8, 1.2), 2.5, 2, 0.3, 0.2)
BODIES = sn.Shapes.superellipsoids(RANDOM.uniform(0.5, 1.5, (COUNT, 3)), RANDOM.uniform(1.5, 4, COUNT), RANDOM.uniform(1.5, 4, COUNT))
EXACT = sn.Settings(tolerance=1e-14)


def random_quaternions():
    numbers = RANDOM.normal(size=(COUNT, 4))
    return numbers / np.linalg.norm(numbers, axis=1)[:, None]


POSES1 = sn.Poses(RANDOM.normal(size=(COUNT, 3)), quaternion=random_quaternions())
AWAY = RANDOM.normal(size=(COUNT, 3))
POSES2 = sn.Poses(POSES1.position + 3.5 * AWAY / np.linalg.norm(AWAY, axis=1)[:, None], quaternion=random_quaternions())


def rotation(vectors):
    """exp([w]) of each row."""
    angle = np.linalg.norm(vectors, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(vectors, -1, 0)
    zero = np.zeros_like(x)
    cross = np.stack([np.stack([zero, -z, y], -1), np.stack([z, zero, -x], -1), np.stack([-y, x, zero], -1)], -2)
    return np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * np.sinc(angle / 2 / np.pi) ** 2 * cross @ cross


def moved(poses, twist):
    return sn.Poses(poses.position + twist[:3], rotation=rotation(twist[3:]) @ poses.rotation)


def asked(twist):
    return sn.find_proximities(EGG, moved(POSES1, twist[:6]), BODIES, moved(POSES2, twist[6:]), settings=EXACT)


def test_they_are_the_differences_of_find_proximities():
    derivatives = sn.find_proximity_derivatives(EGG, POSES1, BODIES, POSES2, asked(np.zeros(12)))
    assert len(derivatives) == COUNT and derivatives.has_normal.all() and derivatives.has_points.all()
    assert (derivatives.status == sn.DerivativeStatus.SMOOTH).all()
    assert derivatives.normal.shape == (COUNT, 3, 12) and derivatives.gap_hessian.shape == (COUNT, 12, 12)
    step = 1e-4
    for k, twist in enumerate(step * np.eye(12)):
        ahead, behind = asked(twist), asked(-twist)
        assert derivatives.gap_gradient[:, k] == pytest.approx((ahead.gap - behind.gap) / (2 * step), abs=1e-6)
        for name in ("normal", "point1", "point2"):
            difference = (getattr(ahead, name) - getattr(behind, name)) / (2 * step)
            columns = getattr(derivatives, name)[:, :, k]
            scale = 1 + np.linalg.norm(getattr(derivatives, name), axis=(1, 2))
            assert (np.linalg.norm(columns - difference, axis=1) <= 1e-3 * scale).all(), name
    along = RANDOM.normal(size=12) / 4
    second = np.einsum("i,nij,j->n", along, derivatives.gap_hessian, along)
    step = 1e-3
    difference = (asked(step * along).gap - 2 * asked(0 * along).gap + asked(-step * along).gap) / step**2
    assert second == pytest.approx(difference, abs=1e-3 * np.abs(second).max())


def test_the_gradient_alone_has_the_digits_of_all_derivatives():
    answers = asked(np.zeros(12))
    alone = sn.find_gap_gradient(EGG, POSES1, BODIES, POSES2, answers)
    assert len(alone) == COUNT and alone.gradient.shape == (COUNT, 12)
    exact = sn.find_proximity_derivatives(EGG, POSES1, BODIES, POSES2, answers, hessian=False, parameters=False)
    assert (alone.gradient == exact.gap_gradient).all() and (alone.status == exact.status).all()
    assert alone.has_gap.all() and (alone.evaluations == exact.evaluations).all()
    assert exact.gap_hessian is None and exact.parameters1 is None and exact.parameters2 is None
    box = sn.Box((1, 1, 1))
    there = sn.Pose((0, 0, 3))
    flat = sn.find_gap_gradient(box, sn.Pose(), box, there, sn.find_proximity(box, sn.Pose(), box, there))
    assert flat.status[0] == sn.DerivativeStatus.FREE_ON_FACE and not flat.has_gap[0]


def test_the_gradient_by_rotations_of_boxy_bodies_is_that_of_differences():
    # A gap that is exact to 1e-9 leaves the points of flat sides uncertain by up to their size.
    random = np.random.default_rng(3)
    count, step = 300, 1e-5
    brick = lambda: sn.Shapes.superellipsoids(random.uniform(0.2, 1, (count, 3)), random.uniform(1.2, 50, count), random.uniform(1.2, 50, count))
    one, two = brick(), brick()
    turn = lambda: rotation(random.normal(size=(count, 3)))
    here = sn.Poses(np.zeros((count, 3)), rotation=turn())
    away = random.normal(size=(count, 3))
    there = sn.Poses(2 * away / np.linalg.norm(away, axis=1)[:, None], rotation=turn())
    found = sn.find_gap_gradient(one, here, two, there, sn.find_proximities(one, here, two, there))
    checked = found.status <= sn.DerivativeStatus.ACTIVE_SET
    assert checked.sum() > 250
    for k in range(3):
        w = step * np.eye(3)[k]
        gap = [sn.find_proximities(one, sn.Poses(here.position, rotation=rotation(s * w) @ here.rotation), two, there, settings=EXACT).gap for s in (1, -1)]
        assert np.abs((gap[0] - gap[1]) / (2 * step) - found.gradient[:, 3 + k])[checked].max() < 1e-3


def test_parameters_have_names():
    body = sn.Rounded(sn.Superellipsoid((1, 0.7, 0.5), 2.5, 2), 0.1)
    assert body.parameter_names == ("a", "b", "c", "delta", "epsilon", "radius")
    assert sn.Polytope([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]).parameter_names == ()
    there = sn.Pose((0.5, 1, 3), quaternion=(0.1, 0.5, 0.5, 0.7))

    def gap(a):
        shape = sn.Rounded(sn.Superellipsoid((a, 0.7, 0.5), 2.5, 2), 0.1)
        return sn.find_proximity(shape, sn.Pose(), EGG, there, settings=EXACT).gap

    derivatives = sn.find_proximity_derivatives(body, sn.Pose(), EGG, there, sn.find_proximity(body, sn.Pose(), EGG, there))
    assert derivatives.parameters1.shape == (1, 16) and derivatives.parameters2.shape == (1, 16)
    assert derivatives.parameters1[0, 0] == pytest.approx((gap(1 + 1e-4) - gap(1 - 1e-4)) / 2e-4, abs=1e-7)
    assert derivatives.parameters1[0, 5] == pytest.approx(-1, abs=1e-12)
    assert (derivatives.parameters1[0, 6:] == 0).all() and (derivatives.parameters2[0, 7:] == 0).all()


def test_a_status_says_what_is_not_defined():
    box = sn.Box((1, 1, 1))
    there = sn.Pose((0, 0, 3))
    derivatives = sn.find_proximity_derivatives(box, sn.Pose(), box, there, sn.find_proximity(box, sn.Pose(), box, there))
    assert derivatives.status[0] == sn.DerivativeStatus.FREE_ON_FACE and not derivatives.has_normal[0]
    assert (derivatives.gap_hessian == 0).all() and (derivatives.normal == 0).all()
    plain = sn.CallbackShape(lambda n: n)
    derivatives = sn.find_proximity_derivatives(plain, sn.Pose(), box, there, sn.find_proximity(plain, sn.Pose(), box, there))
    assert derivatives.status[0] == sn.DerivativeStatus.NO_HESSIAN and derivatives.has_gap[0]


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_threads_change_no_digit(threads):
    answers = asked(np.zeros(12))
    derivatives = sn.find_proximity_derivatives(EGG, POSES1, BODIES, POSES2, answers, threads=threads)
    bounds = sn.find_clearances(EGG, POSES1, BODIES, POSES2, threads=threads)
    for i in range(COUNT):
        one = sn.find_proximity_derivatives(EGG, POSES1[i], BODIES[i], POSES2[i], sn.find_proximity(EGG, POSES1[i], BODIES[i], POSES2[i], EXACT))
        assert (one.gap_hessian[0] == derivatives.gap_hessian[i]).all() and (one.normal[0] == derivatives.normal[i]).all()
        assert (one.parameters2[0] == derivatives.parameters2[i]).all()
        bound = sn.find_clearances(EGG, POSES1[i], BODIES[i], POSES2[i])
        assert bound.lower_bound[0] == bounds.lower_bound[i] and (bound.normal[0] == bounds.normal[i]).all()


def test_bounds_hold_and_distances_decide():
    gap = asked(np.zeros(12)).gap
    assert (gap > 0).all()
    last = np.full(COUNT, -np.inf)
    for budget in (1, 2, 3):
        bounds = sn.find_clearances(EGG, POSES1, BODIES, POSES2, max_evaluations=budget)
        assert (bounds.lower_bound <= gap).all() and (bounds.lower_bound >= last).all() and (bounds.evaluations <= budget).all()
        assert np.linalg.norm(bounds.normal, axis=1) == pytest.approx(np.ones(COUNT))
        last = bounds.lower_bound
    for distance in (0, 0.3, 1, 2):
        assert (sn.are_farther_than(EGG, POSES1, BODIES, POSES2, distance) == (gap > distance)).all()
    enough = sn.find_clearances(EGG, POSES1, BODIES, POSES2, enough=0, first_normals=bounds.normal)
    assert (enough.evaluations <= 1).all() and (enough.lower_bound > 0).all()
    assert sn.are_farther_than(EGG, POSES1, BODIES, POSES2, 0, first_normals=bounds.normal).all()
    assert len(sn.find_clearances([], sn.Pose(), EGG, sn.Pose())) == 0


def test_each_pair_has_a_distance_of_its_own():
    gap = asked(np.zeros(12)).gap
    distances = gap + RANDOM.choice([-1e-3, 1e-3], COUNT)
    assert (sn.are_farther_than(EGG, POSES1, BODIES, POSES2, distances) == (distances < gap)).all()
    # Superellipsoids are answered many at a time, with the same digits.
    together = sn.find_proximities(BODIES, POSES1, BODIES, POSES2).gap
    for distance in (together - 1e-3, together + 1e-3, np.median(together)):
        assert (sn.are_farther_than(BODIES, POSES1, BODIES, POSES2, distance) == (together > distance)).all()
    with pytest.raises(ValueError, match=r"^distance\[3\] = inf m is not finite"):
        sn.are_farther_than(EGG, POSES1, BODIES, POSES2, np.where(np.arange(COUNT) == 3, np.inf, 0))
    with pytest.raises(ValueError, match="distance has 2 entries and poses2 has 40"):
        sn.are_farther_than(EGG, POSES1, BODIES, POSES2, [1, 2])


def test_the_derivatives_of_a_body_and_a_plane_are_differences():
    normal, offset = np.array((0.1, -0.3, 0.9)) / np.linalg.norm((0.1, -0.3, 0.9)), 0.2
    found = sn.find_plane_derivatives(BODIES, POSES1, normal, offset, parameters=False)
    assert len(found) == COUNT and found.has_gap.all() and found.parameters1 is None
    step = 1e-5
    for k, twist in enumerate(step * np.eye(6)):
        ahead, behind = (sn.Poses(moved(POSES1, sign * twist).position, rotation=moved(POSES1, sign * twist).rotation) for sign in (1, -1))
        gaps = [[sn.find_plane_proximity(body, pose, normal, offset).gap for body, pose in zip(BODIES, poses)] for poses in (ahead, behind)]
        assert found.gap_gradient[:, k] == pytest.approx(np.subtract(*gaps) / (2 * step), abs=1e-7)
    many = sn.find_plane_derivatives(BODIES[3], POSES1[3], np.tile(normal, (2, 1)), [offset, 5])
    assert (many.gap_gradient[0] == found.gap_gradient[3]).all()
    with pytest.raises(ValueError, match=r"plane_offset\[1\] = nan m is not finite"):
        sn.find_plane_derivatives(EGG, sn.Pose(), normal, [0, np.nan])


def test_the_entries_of_proximities_are_those_of_the_arrays():
    answers = asked(np.zeros(12))
    one = sn.find_proximity(EGG, POSES1[7], BODIES[7], POSES2[7], EXACT)
    assert answers[7] == answers[np.int64(7)] == answers[7 - COUNT] == one
    assert [each.gap for each in answers] == list(answers.gap) and len(list(POSES1)) == COUNT == len(list(BODIES))
    with pytest.raises(IndexError, match=r"proximities\[40\]: proximities has 40 entries"):
        answers[COUNT]


def test_what_is_refused():
    answers = asked(np.zeros(12))
    arguments = (EGG, POSES1, BODIES, POSES2)
    with pytest.raises(ValueError, match="proximities has 40 entries and poses2 has 2"):
        sn.find_proximity_derivatives(EGG, sn.Pose(), EGG, sn.Poses([[1, 2, 3], [4, 5, 6]]), answers)
    with pytest.raises(ValueError, match="proximities is one Proximity for 40 pairs, but must be Proximities"):
        sn.find_gap_gradient(*arguments, answers[0])
    with pytest.raises(TypeError, match="proximities is 7, but must be a Proximity or Proximities"):
        sn.find_gap_gradient(*arguments, 7)
    with pytest.raises(ValueError, match="distance = nan m is not finite"):
        sn.are_farther_than(*arguments, np.nan)
    with pytest.raises(ValueError, match="enough = nan m, but must be a number"):
        sn.find_clearances(*arguments, enough=np.nan)
    with pytest.raises(ValueError, match=r"max_evaluations = 4 is outside \[1, 3\]"):
        sn.find_clearances(*arguments, max_evaluations=4)
    with pytest.raises(ValueError, match=r"threads = 300"):
        sn.find_proximity_derivatives(*arguments, answers, threads=300)
    directions = np.ones((COUNT, 3))
    directions[[7, 30]] = 0
    with pytest.raises(ValueError, match=r"^7: first_normals\[7\] = \(0, 0, 0\), but must have a length$"):
        sn.are_farther_than(*arguments, 1, first_normals=directions, threads=3)
