"""Planes, manifolds, curvatures and rays by their closed forms."""

import numpy as np
import pytest
import supernormal as sn


def test_a_plane():
    out = sn.find_plane_proximity(sn.Ellipsoid((3, 2, 1)), sn.Pose((0, 0, 0.9)), (0, 0, 2), 0)
    assert out.gap == pytest.approx(-0.1) and out.is_global and out.error == 0
    # Body 1 is the body and body 2 the half-space below.
    assert (out.normal == [0, 0, -1]).all()
    assert out.contact == pytest.approx([0, 0, -0.1], abs=1e-15)


def test_a_face_on_a_face_has_four_corners():
    below, above = sn.Box((1, 1, 1)), sn.Superellipsoid((0.5, 0.5, 0.5), 60, 60)
    poses = sn.Pose(), sn.Pose((0, 0, 1.49))
    nearest = sn.find_proximity(below, poses[0], above, poses[1])
    manifold = sn.find_contact_manifold(below, poses[0], above, poses[1], nearest)
    assert manifold.corner_points.shape == (4, 3) and manifold.corner_depths == pytest.approx(4 * [0.01], abs=1e-6)
    assert manifold.deepest.gap == nearest.gap
    points, depths = manifold.contacts(room=8)
    assert points.shape == (4, 3) and depths[0] == pytest.approx(0.01, abs=1e-9) and (np.diff(depths) <= 1e-9).all()
    points, depths = manifold.contacts(room=4)
    assert points.shape == (4, 3) and np.abs(points[:, :2]).min() > 0.3
    assert len(manifold.contacts(room=1)[0]) == 1
    plane = sn.find_plane_proximity(above, sn.Pose((0, 0, 0.49)), (0, 0, 1), 0)
    assert len(sn.find_plane_contact_manifold(above, sn.Pose((0, 0, 0.49)), plane).contacts()[0]) == 4


def test_round_bodies_have_one_contact_and_bodies_apart_none():
    ball = sn.Sphere(1)
    for height, contacts in ((1.9, 1), (2.1, 0)):
        poses = sn.Pose(), sn.Pose((0, 0, height))
        manifold = sn.find_contact_manifold(ball, poses[0], ball, poses[1], sn.find_proximity(ball, poses[0], ball, poses[1]))
        points, depths = manifold.contacts()
        assert points.shape == (contacts, 3) and depths.shape == (contacts,)


def test_curvatures():
    ellipsoid = sn.Ellipsoid((3, 2, 1))
    tensor = sn.find_curvature(ellipsoid, sn.Pose(), (0, 0, 1))
    assert tensor == pytest.approx(np.diag([1 / 9, 1 / 4, 0]), abs=1e-12)
    smaller, larger = sn.find_contact_curvature(ellipsoid, sn.Pose(), sn.Sphere(2), sn.Pose((0, 0, 3)), (0, 0, 7))
    assert (smaller, larger) == pytest.approx((1 / 9 + 1 / 2, 1 / 4 + 1 / 2))


def test_rays_meet_a_sphere_where_they_must():
    random = np.random.default_rng(5)
    origins, directions = random.normal(size=(2, 300, 3)) * 1.5
    hits = sn.find_ray_hits(sn.Sphere(1), sn.Pose(), origins, directions)
    along = directions / np.linalg.norm(directions, axis=1)[:, None]
    b = np.einsum("ij,ij->i", origins, along)
    c = np.einsum("ij,ij->i", origins, origins) - 1
    root = np.sqrt(np.maximum(b * b - c, 0))
    distance = np.where(c < 0, root - b, -b - root)
    expected = (b * b > c) & (distance >= 0)
    assert (hits.hit == expected).all() and 30 < expected.sum() < 270
    assert (hits.from_inside == (c < 0)).all()
    assert hits.distance[expected] == pytest.approx(distance[expected], abs=1e-6)
    assert np.isnan(hits.distance[~expected]).all() and np.isnan(hits.point[~expected]).all()
    assert hits.point[expected] == pytest.approx(hits.normal[expected], abs=1e-6)
    for i in range(50):
        single = sn.find_ray_hit(sn.Sphere(1), sn.Pose(), origins[i], directions[i])
        assert single.hit == hits.hit[i]
        if single.hit:
            assert single.distance == hits.distance[i] and (single.point == hits.point[i]).all()
            assert single.boundary_error <= 1e-9


def test_a_short_ray_does_not_arrive():
    box = sn.Box((1, 1, 1))
    assert sn.find_ray_hit(box, sn.Pose(), (5, 0, 0), (-1, 0, 0)).distance == pytest.approx(4)
    assert not sn.find_ray_hit(box, sn.Pose(), (5, 0, 0), (-1, 0, 0), length=3.9).hit
