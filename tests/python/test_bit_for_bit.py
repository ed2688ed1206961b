"""The package gives the digits of the C++ core."""

import numpy as np
import pairs
import pytest
import supernormal as sn

FIELDS = ("gap", "error", "normal", "point1", "point2", "contact", "global_error", "evaluations", "status", "is_global")


@pytest.fixture(scope="module")
def bodies():
    return pairs.random_pairs(200_000, seed=7)


@pytest.fixture(scope="module")
def cpp(bodies):
    return pairs.solve_in_cpp(bodies)[0]


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_200000_pairs(bodies, cpp, threads):
    results = pairs.solve_in_python(bodies, threads)
    assert len(results) == 200_000
    assert 0.05 < (results.gap < 0).mean() < 0.95
    for field in FIELDS:
        assert same_bits(getattr(results, field), cpp[field]), field


def test_one_by_one(bodies, cpp):
    for i, row in enumerate(bodies[:500]):
        result = sn.find_proximity(
            sn.Superellipsoid(row[0:3], row[3], row[4]),
            sn.Pose(),
            sn.Superellipsoid(row[5:8], row[8], row[9]),
            sn.Pose(row[10:13], row[13:22].reshape(3, 3)),
        )
        for field in FIELDS:
            assert same_bits(np.asarray(getattr(result, field)), cpp[field][i]), (i, field)


def same_bits(values, expected):
    """Bits and not values: -0 is not 0."""
    return np.asarray(values, dtype=float).tobytes() == np.ascontiguousarray(expected).tobytes()
