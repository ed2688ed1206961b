#!/usr/bin/env python3
"""A tour of the Python package, in cells as of a notebook: shapes, distances, contacts, many pairs at once, a world of PyODE.

    tour.py             shows the figures
    tour.py FOLDER      writes them there
"""

from __future__ import annotations

import pathlib
import sys
import time
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
import supernormal as sn
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

Vectors = npt.NDArray[np.float64]


def draw(axes: Any, shape: sn.Shape, pose: sn.Pose, colour: str) -> None:
    """Draws a mesh of the body that is no farther than 1 % of its size from it."""
    mesh = shape.tessellate(0.01 * shape.half_extents.max())
    points = mesh.points @ pose.rotation.T + pose.position
    axes.add_collection3d(Poly3DCollection(points[mesh.triangles], facecolor=colour, edgecolor="#0003", linewidth=0.2, alpha=0.6))


# %% A body of one's own: a lens, the common part of two balls, by the boundary point of each normal
BALL_RADIUS, HALF_HEIGHT = 1.0, 0.3  # m
RIM_RADIUS = np.sqrt(BALL_RADIUS**2 - (BALL_RADIUS - HALF_HEIGHT) ** 2)


def lens_point(n: Vectors) -> Vectors:
    centre = -np.copysign(BALL_RADIUS - HALF_HEIGHT, n[2])  # of the ball whose cap has the normal n
    point = BALL_RADIUS * n + [0, 0, centre]
    if point[2] * n[2] > 0:
        return np.asarray(point)
    return np.array([*(RIM_RADIUS * n[:2] / np.hypot(n[0], n[1])), 0])  # a normal between those of the caps: on the rim


lens = sn.CallbackShape(lens_point)
egg = sn.Superovoid((0.5, 0.5, 0.7), delta=2, epsilon=2, taper_x=0.3, taper_y=0.3)
brick = sn.Superellipsoid((0.8, 0.5, 0.4), delta=8, epsilon=8)
print(f"egg: {egg.mass_properties()}")

# %% The distance of two bodies: common normal and witness points
egg_pose = sn.Pose((1.6, 0.3, 0.9), quaternion=(np.cos(0.4), 0, np.sin(0.4), 0))
nearest = sn.find_proximity(brick, sn.Pose(), egg, egg_pose)
print(f"brick and egg: {nearest}")

figure = plt.figure(figsize=(11, 4.2))
scene = figure.add_subplot(1, 2, 1, projection="3d")
lens_pose = sn.Pose((0, 0, 0.8), quaternion=(np.cos(0.2), np.sin(0.2), 0, 0))
for shape, pose, colour in ((brick, sn.Pose(), "tab:blue"), (egg, egg_pose, "tab:orange"), (lens, lens_pose, "tab:green")):
    draw(scene, shape, pose, colour)
scene.plot(*np.transpose([nearest.point1, nearest.point2]), "k.-")
scene.set(xlim=(-0.9, 2.1), ylim=(-1.5, 1.5), zlim=(-0.9, 2.1), xlabel="x in m", ylabel="y in m", zlabel="z in m")
scene.set_box_aspect((1, 1, 1), zoom=1.15)
scene.view_init(elev=18, azim=-70)
scene.set_title(f"gap {nearest.gap:.3f} m")

# %% The gap on a path, in one call: the egg passes through the brick
path = np.linspace(-2.5, 2.5, 401)
places = sn.Poses(np.column_stack([path, np.full_like(path, 0.3), np.full_like(path, 0.2)]))
passage = sn.find_proximities(brick, sn.Pose(), egg, places, sn.Settings(certify_depth=True))
assert passage.is_global.all()
curve = figure.add_subplot(1, 2, 2)
curve.plot(path, passage.gap)
curve.axhline(0, color="0.7", linewidth=0.8)
curve.fill_between(path, passage.gap, 0, where=passage.gap < 0, alpha=0.3, label="depth of the overlap, certified")
curve.set(xlabel="x of the egg in m", ylabel="gap in m")
curve.legend()
figure.tight_layout()

# %% Contacts: a flat body rests on several points, a round one on one
for shape in (brick, egg):
    height = shape.half_extents[2] - 0.001
    floor = sn.find_plane_proximity(shape, sn.Pose((0, 0, height)), (0, 0, 1), 0)
    points, depths = sn.find_plane_contact_manifold(shape, sn.Pose((0, 0, height)), floor).contacts()
    print(f"{type(shape).__name__} on a floor: {len(points)} contacts, {1000 * depths.max():.3f} mm deep")

# %% Many pairs at once, on all cores
COUNT = 100_000
random = np.random.default_rng(1)
grains = [sn.Shapes.superellipsoids(random.uniform(0.5, 1.5, (COUNT, 3)), 2.5, random.uniform(1.3, 5, COUNT)) for _ in range(2)]
quaternions = random.normal(size=(COUNT, 4))
quaternions /= np.linalg.norm(quaternions, axis=1)[:, None]
start = time.perf_counter()
pairs = sn.find_proximities(grains[0], sn.Pose(), grains[1], sn.Poses(random.uniform(-2, 2, (COUNT, 3)), quaternion=quaternions))
seconds = time.perf_counter() - start
print(f"{COUNT} pairs in {seconds:.2f} s, {100 * (pairs.gap < 0).mean():.0f} % overlap, {pairs.evaluations.mean():.1f} evaluations each")

# %% Rays: a depth picture of the lens
side = np.linspace(-1, 1, 300)
pixels = np.stack([*np.meshgrid(side, side), np.full((300, 300), 3.0)], axis=-1).reshape(-1, 3)
hits = sn.find_ray_hits(lens, lens_pose, pixels, (0, 0, -1))
picture, axes = plt.subplots(figsize=(4.2, 3.6))
image = axes.imshow(hits.distance.reshape(300, 300), extent=(-1, 1, -1, 1), origin="lower")
axes.set(xlabel="x in m", ylabel="y in m")
picture.colorbar(image, label="distance in m")
picture.tight_layout()

# %% A world of PyODE, where it is installed
try:
    import ode
    import supernormal.ode
except ImportError:
    print("PyODE (python3-pyode) is not installed: no pebbles")
else:
    world, space, contacts = ode.World(), ode.HashSpace(), ode.JointGroup()
    world.setGravity((0, 0, -9.81))
    world.setAngularDamping(0.01)
    floor_geom = ode.GeomPlane(space, (0, 0, 1), 0)
    pebbles = [supernormal.ode.Superellipsoid(space, (0.02, 0.015, 0.008), 2.3, 2.0) for _ in range(10)]
    for k, pebble in enumerate(pebbles):
        body = ode.Body(world)
        pebble.setBodyAndMass(body, 2650)
        body.setPosition((0.002 * k, 0, 0.05 + 0.04 * k))

    def near(_: object, geom1: Any, geom2: Any) -> None:
        for contact in ode.collide(geom1, geom2):
            contact.setMu(0.5)
            joint = ode.ContactJoint(world, contacts, contact)
            joint.attach(geom1.getBody(), geom2.getBody())

    heights = []
    for _ in range(1500):
        space.collide(None, near)
        world.step(0.002)
        contacts.empty()
        heights.append([pebble.getPosition()[2] for pebble in pebbles])
    fall, axes = plt.subplots(figsize=(5, 3.2))
    axes.plot(0.002 * np.arange(1500), heights)
    axes.set(xlabel="time in s", ylabel="height of ten pebbles in m", ylim=(0, None))
    fall.tight_layout()
    print(f"ten pebbles after 3 s: highest {1000 * max(heights[-1]):.1f} mm above the floor, lowest {1000 * min(heights[-1]):.1f} mm")

# %% The figures
if len(sys.argv) > 1:
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for number, name in zip(plt.get_fignums(), ("distance", "rays", "pebbles")):
        plt.figure(number).savefig(folder / f"{name}.png", dpi=90)
        print(f"wrote {folder / name}.png")
else:
    plt.show()
