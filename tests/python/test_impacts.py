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


def test_what_is_out_of_range_is_refused():
    with pytest.raises(ValueError, match="horizon = -1 s is outside"):
        sn.find_time_of_impact(BALL, sn.Motion(), BALL, sn.Motion(), -1)
    with pytest.raises(ValueError, match="angular_velocity = "):
        sn.Motion(angular_velocity=(0, np.nan, 0))
    with pytest.raises(ValueError, match="plane_offset = nan m is outside"):
        sn.find_plane_time_of_impact(BALL, sn.Motion(), (0, 0, 1), np.nan, 1)
    with pytest.raises(ValueError, match="plane_normal"):
        sn.find_plane_time_of_impact(BALL, sn.Motion(), (0, 0, 0), 0, 1)
