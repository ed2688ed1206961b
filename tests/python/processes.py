"""Shapes, poses and answers go from process to process: each is pickled on its way."""

import multiprocessing

import numpy as np
import supernormal as sn

SHAPES = [
    sn.Superellipsoid((0.3, 0.2, 0.1), 4, 1.7),
    sn.Polytope([[1, 0, 0], [-1, 0.5, 0], [0, -1, 0], [0, 0, 1.5]]),
    sn.Rounded(sn.MinkowskiSum(sn.Box((0.1, 0.2, 0.3)), sn.Ellipsoid((0.3, 0.2, 0.1))), 0.05),
    sn.LinearImage(sn.Cylinder(0.2, 0.3), [[1, 0.2, 0], [0, 1, 0], [0, 0.3, 2]]),
]
BRICK = sn.Superovoid((0.5, 0.4, 0.3), 2.5, 2, 0.2, 0.2)


def nearest(shape: sn.Shape, pose: sn.Pose) -> sn.Proximity:
    return sn.find_proximity(shape, pose, BRICK, sn.Pose())


def main() -> None:
    random = np.random.default_rng(1)
    tasks = [(SHAPES[k % len(SHAPES)], sn.Pose(random.uniform(-2, 2, 3))) for k in range(200)]
    expected = [nearest(*task) for task in tasks]
    for method in ("fork", "spawn"):
        with multiprocessing.get_context(method).Pool(2) as pool:
            assert pool.starmap(nearest, tasks) == expected, method
    print(f"{len(tasks)} answers of two processes are the same, forked and spawned")


if __name__ == "__main__":
    main()
