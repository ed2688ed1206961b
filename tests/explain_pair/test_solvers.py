"""Recorded paths: they are what the library did, and the bounds hold."""

import numpy as np
import pytest
import supernormal as sn
from pairs import Pair, hard_case
from solvers import SOLVERS, explain, is_solver_for, literature_paths, solver_path, with_settings

ROUNDING = 1e-14  # of numbers near 1


def direct_gap(pair, normals):
    """s(n) from the bodies' extents in the world."""
    places = [normals @ body.pose.position for body in (pair.body1, pair.body2)]
    return places[1] - places[0] - pair.body1.support(normals) - pair.body2.support(-normals)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_path_is_the_librarys_and_ends_at_its_answer(sample_pairs, solver):
    for pair in sample_pairs:
        settings = sn.Settings(solver=solver)
        answer, path = solver_path(pair, settings)
        direct = pair.find(sn.find_proximity, settings)
        if solver == sn.Solver.HYBRID:  # which takes its first steps in vector lanes
            assert (answer.status, answer.is_global) == (direct.status, direct.is_global)
            assert abs(answer.gap - direct.gap) <= answer.error + direct.error
        else:
            assert answer == direct  # to be recorded changes no digit
        assert len(path) == path.evaluations == answer.evaluations
        # The answer is one of the evaluations. For the solvers without a safeguard the others are for the contact's place.
        is_answer = (np.linalg.norm(path.normals - answer.normal, axis=1) < ROUNDING) & (
            np.abs(path.values - answer.gap) < ROUNDING
        )
        last = np.flatnonzero(is_answer)[-1]
        if solver != sn.Solver.HYBRID:
            placeless = pair.find(sn.find_proximity, with_settings(settings, max_evaluations=int(last) + 1))
            assert placeless.evaluations == last + 1
            for name in ("status", "gap", "error"):
                assert getattr(placeless, name) == getattr(answer, name)
            for name in ("normal", "point1"):
                assert np.array_equal(getattr(placeless, name), getattr(answer, name))
            assert np.array_equal(placeless.contact, answer.contact) == (last + 1 == len(path))
        assert np.abs(path.values - direct_gap(pair, path.normals)).max() < 1e-12


def test_methods_of_the_literature_end_where_the_hybrid_does_if_they_say_so(sample_pairs, explanations):
    drawn = 0
    for pair, plain in zip(sample_pairs, explanations):
        for path in literature_paths(pair, 1e-9):
            assert path.solver is None
            assert np.abs(path.values - direct_gap(pair, path.normals)).max() < 1e-12
            if path.status == "converged" and plain.answer.gap > 0:
                assert path.gap == pytest.approx(plain.answer.gap, abs=1e-6)
            drawn += 1
    assert drawn >= 9
    assert literature_paths(hard_case("colliders: an ellipsoid above a box, gap -0.0625"), 1e-9) == []


def test_cuts_and_intervals_hold(explanations):
    random = np.random.default_rng(4)
    for explanation in explanations:
        pair, answer, path = explanation.pair, explanation.answer, explanation.hybrid
        normals = random.normal(size=(300, 3))
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        values = pair.gap(normals)
        assert (values[:, None] + explanation.rolling_radius <= normals @ explanation.cuts.T + ROUNDING).all()
        counts, lower, upper = np.array(path.intervals).T
        assert (upper >= max(values.max(), answer.gap) - ROUNDING).all()
        assert (lower <= answer.gap).all()
        assert (np.diff(upper) <= 0).all() and (np.diff(counts) > 0).all()
        assert counts[-1] == answer.evaluations and lower[-1] == answer.gap
        assert upper[-1] <= answer.gap + answer.global_error
        # The cuts leave the answer, which is below the highest evaluation by no more than the error that it states.
        assert explanation.room_left(len(path), answer.normal) >= -answer.global_error - ROUNDING


def test_fewer_evaluations_are_the_first_of_the_whole_path(sample_pairs):
    for pair in sample_pairs:
        _, whole = pair.find(sn.find_proximity_path, sn.Settings())
        for k in range(1, min(len(whole), 30)):
            _, part = pair.find(sn.find_proximity_path, sn.Settings(max_evaluations=k))
            assert np.array_equal(part, whole[:k])


@pytest.mark.parametrize("name", ["an ellipsoid above a box, gap -0.0625", "an ellipsoid at a box's edge, gap 0.0625"])
def test_bodies_with_faces_and_edges_have_the_hybrid_alone_whichever_is_first(name):
    pair = hard_case(f"colliders: {name}")
    assert not is_solver_for(sn.Solver.NEWTON, pair)
    for one in (pair, Pair(pair.title, pair.body2, pair.body1, pair.first_normal)):
        explanation = explain(one, sn.Settings())
        (path,) = explanation.paths
        assert len(path) == explanation.answer.evaluations
        assert (path.values <= explanation.answer.gap + ROUNDING).all()
        assert path.normals[-1] @ explanation.answer.normal > 0.99
