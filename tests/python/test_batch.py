"""The batch calls: their arguments, their threads, and how they end."""

import os
import signal
import threading
import time

import numpy as np
import pairs
import pytest
import supernormal as sn

RANDOM = np.random.default_rng(11)
POSES = sn.Poses(RANDOM.normal(size=(20, 3)) * 3)


def test_one_for_all_or_one_for_each():
    shapes = [sn.Sphere(0.1 * (i + 1)) for i in range(20)]
    expected = np.linalg.norm(POSES.position, axis=1) - 1 - 0.1 * np.arange(1, 21)
    for bodies in (shapes, tuple(shapes), sn.Shapes(shapes), sn.Shapes.spheres(0.1 * np.arange(1, 21))):
        out = sn.find_proximities(sn.Sphere(1), sn.Pose(), bodies, POSES)
        assert len(out) == 20 and out.gap == pytest.approx(expected, abs=1e-12)
        assert out.normal.shape == (20, 3) and out.evaluations.dtype == np.int32
    assert len(sn.find_proximities(sn.Sphere(1), sn.Pose(), sn.Sphere(2), sn.Pose())) == 1
    assert len(sn.find_proximities([], sn.Pose(), sn.Sphere(2), sn.Pose())) == 0


def test_columns_are_not_copied():
    out = sn.find_proximities(sn.Sphere(1), sn.Pose(), sn.Sphere(1), POSES)
    assert out.gap is out.gap


def test_first_normals_lead_to_their_maximum():
    """Two concentric boxes: the tracked depth depends on the face near the normal."""
    box = sn.Box((1, 1.02, 1.04))
    out = sn.find_proximities(box, sn.Pose(), box, sn.Pose(), first_normals=[(1, 0.1, 0.1), (0.1, 1, 0.1), (0.1, 0.1, 1)])
    assert out.gap == pytest.approx([-2, -2.04, -2.08], abs=1e-9)
    warm = sn.find_proximities(box, sn.Pose(), sn.Sphere(1), POSES, first_normals=POSES.position)
    assert warm.gap == pytest.approx(sn.find_proximities(box, sn.Pose(), sn.Sphere(1), POSES).gap, abs=1e-9)


def test_the_interpreter_is_free_meanwhile():
    bodies = pairs.random_pairs(100_000, seed=2)
    done = threading.Event()
    worker = threading.Thread(target=lambda: (pairs.solve_in_python(bodies, threads=1), done.set()))
    steps = []
    worker.start()
    while not done.is_set():
        steps.append(time.perf_counter())
        time.sleep(0.001)
    worker.join()
    # The solving alone takes some 0.2 s of processor time, in which a locked interpreter would not have come here at all.
    assert len(steps) > 20


def slowly(n):
    time.sleep(1e-4)
    return n


def test_control_c_ends_a_batch():
    bodies = pairs.random_pairs(2000, seed=2)
    shape = sn.CallbackShape(slowly)
    many = sn.Poses(np.repeat(bodies[:, 10:13], 50, axis=0))
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        sn.find_proximities(shape, sn.Pose(), sn.Sphere(1), many, threads=2)
    # All pairs would take more than 20 s.
    assert time.perf_counter() - start < 10
    timer.join()


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_the_first_pair_that_fails_is_named_whatever_the_threads(threads):
    directions = RANDOM.normal(size=(10_000, 3))
    directions[[1234, 4321, 9999]] = 0
    with pytest.raises(ValueError, match=r"^1234: directions\[1234\] = \(0, 0, 0\), but must have a length$"):
        sn.find_ray_hits(sn.Sphere(1), sn.Pose(), (3, 0, 0), directions, threads=threads)


def test_an_exception_of_a_function_comes_through():
    class Trouble(Exception):
        pass

    calm = True

    def point(n):
        if calm:
            return n
        raise Trouble("in the middle")

    shape = sn.CallbackShape(point)
    calm = False
    with pytest.raises(Trouble, match="in the middle"):
        sn.find_proximities(shape, sn.Pose(), sn.Sphere(1), POSES, threads=3)
    with pytest.raises(Trouble):
        sn.find_proximity(shape, sn.Pose(), sn.Sphere(1), POSES[0])


def test_functions_of_other_threads():
    shape = sn.CallbackShape(lambda n: 2 * n)
    results = []
    workers = [
        threading.Thread(target=lambda: results.append(sn.find_proximities(shape, sn.Pose(), sn.Sphere(1), POSES, threads=2).gap))
        for _ in range(4)
    ]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert len(results) == 4 and all((gap == results[0]).all() for gap in results)
