"""The modules of samples/explain_pair, its program, and pairs for its tests. `EXPLAIN_PAIR`: the program, with pair_data beside it;
`FALLING_PARTICLES`: another product's, with scene_grains beside it, without which the tests of runs are skipped."""

import os
import pathlib
import sys

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "samples" / "explain_pair"))
os.environ["EXPLAIN_PAIR_DATA"] = str(pathlib.Path(os.environ["EXPLAIN_PAIR"]).with_name("pair_data"))
os.environ["EXPLAIN_PAIR_GRAINS"] = str(pathlib.Path(os.environ["FALLING_PARTICLES"]).with_name("scene_grains"))


def pytest_configure(config):
    config.addinivalue_line("markers", "thorough: takes long")


def skip_without_runs():
    if not os.access(os.environ["EXPLAIN_PAIR_GRAINS"], os.X_OK):
        pytest.skip(f"there is no {os.environ['EXPLAIN_PAIR_GRAINS']}")


@pytest.fixture(scope="session")
def sample_pairs():
    """Apart, touching and overlapping pairs of round, boxy, sharp and tapered bodies, far from the world's axes."""
    import supernormal as sn
    from pairs import Pair, PlacedBody

    shapes = [
        sn.Ellipsoid((0.5, 0.4, 0.3)),
        sn.Superellipsoid((0.5, 0.4, 0.3), 8, 8),
        sn.Superellipsoid((0.5, 0.5, 0.3), 1.3, 3),
        sn.Superovoid((0.3, 0.3, 0.4), 2.5, 2, 0.3, 0.3),
        sn.Rounded(sn.Superellipsoid((0.4, 0.3, 0.3), 20, 20), 0.05),
    ]
    place, way = np.array([10.0, -20, 30]), np.array([0.6, -0.5, 0.62])
    way /= np.linalg.norm(way)

    def body(name, shape, position, quaternion):
        return PlacedBody(name, shape, sn.Pose(position, quaternion=np.array(quaternion) / np.linalg.norm(quaternion)), {})

    return [
        Pair(
            "a pair",
            body("one", shape1, place, (0.8, 0.1, -0.3, 0.5)),
            body("two", shape2, place + distance * way, (0.2, 0.7, 0.4, -0.3)),
        )
        for shape1 in shapes
        for shape2 in shapes
        for distance in (1.3, 0.65, 0.4)
    ]


@pytest.fixture(scope="session")
def explanations(sample_pairs):
    import supernormal as sn
    from solvers import explain

    return [explain(pair, sn.Settings()) for pair in sample_pairs]
