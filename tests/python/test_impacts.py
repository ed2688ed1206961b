"""The time of impact from Python."""

import numpy as np
import pytest
import supernormal as sn

BALL = sn.Sphere(0.5)
NEEDLE = sn.Capsule(0.1, 1)


def test_balls_meet_when_their_centres_are_as_far_as_their_radii():
    coming = sn.Motion(sn.Pose((5, 0, 0)), velocity=(-2, 0, 0), angular_velocity=(10, 20, 30))
    impact = sn.find_time_of_impact(BALL, sn.Motion(), BALL, coming, 10)
    assert impact.status == sn.ImpactStatus.HITS
    assert impact.may_hit
    assert impact.time == pytest.approx(2, abs=1e-9)
    assert impact.apart_until == impact.time
    assert impact.proximity.normal == pytest.approx((1, 0, 0))
    assert impact.proximity.point1 == pytest.approx((0.5, 0, 0))
    short = sn.find_time_of_impact(BALL, sn.Motion(), BALL, coming, 1.9, first_normal=(2, 0, 0))
    assert short.status == sn.ImpactStatus.APART
    assert short.time == 1.9
    assert 0 < short.proximity.gap <= 0.2 + 1e-9
    assert sn.find_time_of_impact(BALL, sn.Motion(), BALL, sn.Motion(sn.Pose((0.5, 0, 0))), 1).status == sn.ImpactStatus.OVERLAPPING


def test_a_needle_that_turns_comes_down_on_a_plane():
    motion = sn.Motion(sn.Pose((0, 0, 0.6)), angular_velocity=(0, 3, 0), velocity=(1, 0, 0))
    lying = sn.Motion(sn.Pose((0, 0, 0.6), rotation=motion.pose_at(np.pi / 6).rotation), (1, 0, 0), (0, 3, 0))
    impact = sn.find_plane_time_of_impact(NEEDLE, lying, (0, 0, 2), 0, 1)
    # 0.6 = 0.1 + |cos(pi / 2 + 3 t)|
    assert impact.time == pytest.approx(np.pi / 18, abs=1e-9)
    there = lying.pose_at(impact.time)
    assert sn.find_plane_proximity(NEEDLE, there, (0, 0, 1), 0).gap == pytest.approx(0, abs=1e-10)
    assert there.position == pytest.approx((impact.time, 0, 0.6))


def test_a_batch_has_the_digits_of_each_pair():
    random = np.random.default_rng(1)
    count = 30
    shapes = sn.Shapes.superellipsoids(random.uniform(0.2, 1, (count, 3)), random.uniform(1.5, 6, count), random.uniform(1.5, 6, count))
    motions = [sn.Motion(sn.Pose((4, y, z)), (-3, 0, 0), spin) for y, z, spin in zip(*random.uniform(-1, 1, (2, count)), random.normal(size=(count, 3)))]
    impacts = sn.find_times_of_impact(NEEDLE, sn.Motion(), shapes, motions, 2, threads=2)
    assert len(impacts) == count and 0 < (impacts.status == sn.ImpactStatus.HITS).sum() < count
    for i, (shape, motion) in enumerate(zip(shapes, motions)):
        one = sn.find_time_of_impact(NEEDLE, sn.Motion(), shape, motion, 2)
        assert (one.status, one.time, one.apart_until, one.evaluations) == (impacts.status[i], impacts.time[i], impacts.apart_until[i], impacts.evaluations[i])
        assert one.proximity.gap == impacts.gap[i] and (one.proximity.normal == impacts.normal[i]).all() and (one.proximity.contact == impacts.contact[i]).all()
    assert len(sn.find_times_of_impact([], sn.Motion(), BALL, sn.Motion(), 1)) == 0
    with pytest.raises(ValueError, match="motions2 has 30 entries and shapes1 has 2"):
        sn.find_times_of_impact([BALL, BALL], sn.Motion(), BALL, motions, 1)
    with pytest.raises(TypeError, match=r"motions1\[0\] is 3, but must be a Motion"):
        sn.find_times_of_impact(BALL, [3], BALL, motions, 1)
    with pytest.raises(ValueError, match="^horizon = -1 s is outside"):
        sn.find_times_of_impact(BALL, sn.Motion(), BALL, motions, -1)


def test_a_ball_falls_on_the_second_of_two_triangles():
    points = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]
    ball = sn.Motion(sn.Pose((1, 3, 2)), (0, 0, -1))
    rising = sn.Motion(velocity=(0, 0, 0.5))
    impact, triangle = sn.find_mesh_time_of_impact(BALL, ball, points, [[0, 1, 2], [0, 2, 3]], rising, 10)
    assert triangle == 1 and impact.time == pytest.approx(1, abs=1e-9)
    away, none = sn.find_mesh_time_of_impact(BALL, sn.Motion(sn.Pose((9, 9, 2)), (0, 0, -1)), points, [[0, 1, 2]], sn.Motion(), 10)
    assert none == -1 and away.status == sn.ImpactStatus.APART
    with pytest.raises(ValueError, match=r"triangles\[0\] has the corner 4, but there are 4 points"):
        sn.find_mesh_time_of_impact(BALL, ball, points, [[0, 1, 4]], rising, 10)
    with pytest.raises(TypeError, match="triangles has numbers of the type float64, but must be integers"):
        sn.find_mesh_time_of_impact(BALL, ball, points, [[0, 1, 2.5]], rising, 10)


def test_what_is_out_of_range_is_refused():
    with pytest.raises(ValueError, match="horizon = -1 s is outside"):
        sn.find_time_of_impact(BALL, sn.Motion(), BALL, sn.Motion(), -1)
    with pytest.raises(ValueError, match="angular_velocity = "):
        sn.Motion(angular_velocity=(0, np.nan, 0))
    with pytest.raises(ValueError, match="plane_offset = nan m is outside"):
        sn.find_plane_time_of_impact(BALL, sn.Motion(), (0, 0, 1), np.nan, 1)
    with pytest.raises(ValueError, match="plane_normal"):
        sn.find_plane_time_of_impact(BALL, sn.Motion(), (0, 0, 0), 0, 1)
