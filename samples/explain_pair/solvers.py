"""The paths of the solvers for a pair, with what they prove on the way."""

import json
from dataclasses import dataclass, field

import numpy as np
import supernormal as sn
from pairs import Pair, data

SOLVERS = {sn.Solver.HYBRID: "hybrid", sn.Solver.NEWTON: "Newton (I)", sn.Solver.FIXED_POINT: "fixed point (II)"}

# Up to ALL_INTERVALS evaluations each has its interval. Beyond, the spacing is this fraction of their number, because each interval
# takes a query.
ALL_INTERVALS = 24
SHARE_OF_GAPS = 8


@dataclass(frozen=True)
class Path:
    """The normals (N, 3) at which a method evaluated s, in order. World frame; lengths in m."""

    name: str
    status: str
    gap: float
    evaluations: int
    normals: np.ndarray
    values: np.ndarray  # (N,): s
    solver: sn.Solver = None  # None for a method of the literature
    is_global: bool = False
    intervals: list = field(default_factory=list)  # (evaluations, lower, upper): the largest s is proved to be within

    def __len__(self):
        return len(self.normals)


@dataclass(frozen=True)
class Explanation:
    """The data of a picture of a pair. The path of the hybrid is the first."""

    pair: Pair
    answer: sn.Proximity
    paths: list
    cuts: np.ndarray  # (N, 3), m; supporting half-spaces d' of the hybrid: s(m) + rho <= m.d' (lib/proximity/README.md, lemma 1)
    corners: np.ndarray  # (K, 3), m; empty if all manifold points are within a hundredth of the size of the smaller body

    @property
    def hybrid(self):
        return self.paths[0]

    @property
    def shown_evaluations(self):
        """How many evaluations the picture has: all of the hybrid, and for each other solver at most twice as many."""
        own = max(8, len(self.hybrid))
        return max(own, min(max(map(len, self.paths)), 2 * own))

    @property
    def rolling_radius(self):
        return self.pair.body1.shape.rolling_radius + self.pair.body2.shape.rolling_radius

    def room_left(self, evaluations, normals):
        """The slack of normals (..., 3), m: the smallest bound by the first cuts minus the best value so far.

        A normal may still be the best one unless this is negative.
        """
        bounds = np.min(normals @ self.cuts[:evaluations].T, axis=-1)
        return bounds - self.rolling_radius - np.max(self.hybrid.values[:evaluations])


def with_settings(settings, **changes):
    names = ("solver", "tolerance", "max_evaluations", "certify_depth")
    return sn.Settings(**{**{name: getattr(settings, name) for name in names}, **changes})


def is_solver_for(solver, pair):
    """Whether the library has this solver for the pair. All but the hybrid need smooth bodies; Newton's method needs a Hessian."""
    shapes = (pair.body1.shape, pair.body2.shape)
    if solver == sn.Solver.HYBRID:
        return True
    return all(shape.is_smooth and (solver == sn.Solver.FIXED_POINT or shape.has_hessian) for shape in shapes)


def solver_path(pair, settings):
    """Runs the solver of the settings: its answer and its path."""
    answer, normals = pair.find(sn.find_proximity_path, settings)
    if not len(normals):  # two balls have a closed form
        normals = answer.normal[np.newaxis]
    status = answer.status.name.lower().replace("_", " ")
    intervals = _intervals(pair, settings, max(answer.evaluations, 1))
    numbers = (answer.gap, answer.evaluations, normals, pair.gap(normals))
    return answer, Path(SOLVERS[settings.solver], status, *numbers, settings.solver, answer.is_global, intervals)


def _intervals(pair, settings, evaluations):
    """The interval after k evaluations is the library's answer with a limit of k evaluations."""
    intervals, lower, upper, k = [], -np.inf, np.inf, 1
    while not intervals or intervals[-1][0] < evaluations:
        limit = min(k, evaluations)
        so_far, _ = pair.find(sn.find_proximity_path, with_settings(settings, max_evaluations=limit))
        lower, upper = max(lower, so_far.gap), min(upper, so_far.gap + so_far.global_error)
        intervals.append((limit, lower, upper))
        k += 1 if k < ALL_INTERVALS else k // SHARE_OF_GAPS
    return intervals


def literature_paths(pair, tolerance):
    """The paths of samples/benchmarks/literature. Empty unless both bodies are superellipsoids or ellipsoids.

    The evaluations of the start are only counted.
    """
    bodies = (pair.body1, pair.body2)
    if not all(isinstance(body.shape, (sn.Ellipsoid, sn.Superellipsoid)) for body in bodies):
        return []
    question = {
        "bodies": [
            {
                "lengths": list(body.shape.half_axes),
                "exponents": [getattr(body.shape, "delta", 2), getattr(body.shape, "epsilon", 2)],
            }
            for body in bodies
        ],
        "poses": [{"position": list(b.pose.position), "rotation": b.pose.rotation.tolist()} for b in bodies],
        "first_normal": pair.first_normal,
        "tolerance": tolerance,
    }
    paths = []
    for path in data("literature", stdin=json.dumps(question)):
        if path["normals"]:
            normals = np.array(path["normals"])
            values = pair.gap(normals)
            # A method that does not compute the gap ends at its last normal.
            gap = values[-1] if path["gap"] is None else path["gap"]
            paths.append(Path(path["name"], path["status"], gap, path["evaluations"], normals, values))
    return paths


def explain(pair, settings, literature=()):
    """Solves the pair with every solver that the library has for it, with these settings except for the solver.

    `literature`: paths of other methods, which are drawn too. Raises RuntimeError if there is no result.
    """
    try:
        solved = [solver_path(pair, with_settings(settings, solver=one)) for one in SOLVERS if is_solver_for(one, pair)]
    except ValueError:
        raise RuntimeError(
            f'explain_pair: "{pair.title}" has no answer: a pose or a shape has numbers that are not finite'
        ) from None
    answer, hybrid = solved[0]
    body1, body2 = pair.body1, pair.body2
    n = hybrid.normals
    offsets = body2.point(-n) - body1.point(n)
    rho = body1.shape.rolling_radius + body2.shape.rolling_radius
    manifold = sn.find_contact_manifold(body1.shape, body1.pose, body2.shape, body2.pose, answer)
    corners = manifold.corner_points
    size = min(body1.shape.half_extents.max(), body2.shape.half_extents.max())
    if not (np.linalg.norm(corners - answer.contact, axis=1) > 0.01 * size).any():
        corners = corners[:0]
    return Explanation(pair, answer, [path for _, path in solved] + list(literature), offsets + rho * n, corners)
