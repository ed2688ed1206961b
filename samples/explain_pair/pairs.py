"""The two bodies in a picture: from the command line, from the hard cases, or from a run."""

import json
import os
import pathlib
import stat
import subprocess
from dataclasses import dataclass
from difflib import get_close_matches
from math import inf, isfinite

import numpy as np
import supernormal as sn

UNIT_LENGTH = 1e-3  # largest deviation of the length of a quaternion from 1
LARGEST = 1e30  # m
FARTHEST = 1e100  # m
SAME_TIME = 1e-6  # s; a time selects the frame that agrees to this, so that it need not be typed with all digits
HEAD = "time_s,body,grain,x_m,y_m,z_m,qw,qx,qy,qz"


class InputError(Exception):
    """A mistake in the user's input. Its text is the whole message."""


@dataclass(frozen=True)
class PlacedBody:
    """A body in its pose. Directions, normals and points are in the world frame."""

    description: str
    shape: sn.Shape
    pose: sn.Pose
    data: dict  # as JSON of pair_data.cpp, without the pose

    def support(self, directions):
        """The support function about the body's origin for unit vectors (..., 3), m."""
        return self.shape.support(directions @ self.pose.rotation)

    def point(self, normals):
        """The boundary points with these outward unit normals (..., 3), m."""
        return self.pose.position + self.shape.point(normals @ self.pose.rotation) @ self.pose.rotation.T


@dataclass(frozen=True)
class Pair:
    title: str
    body1: PlacedBody
    body2: PlacedBody
    first_normal: list = None  # unit, frame of body 1; the start of the solvers, if prescribed

    def find(self, query, settings):
        """The answer of find_proximity or find_proximity_path."""
        body1, body2 = self.body1, self.body2
        return query(body1.shape, body1.pose, body2.shape, body2.pose, settings, self.first_normal)

    def gap(self, normals):
        """s(n) for unit vectors (..., 3), m."""
        offset = self.body2.pose.position - self.body1.pose.position
        return normals @ offset - self.body1.support(normals) - self.body2.support(-normals)


def data(*question, stdin=None):
    """The answer of pair_data.cpp. Raises InputError or RuntimeError with its message."""
    return _answer_of(os.environ["EXPLAIN_PAIR_DATA"], *question, stdin=stdin)


def scene_grains(scene, *overrides):
    """The grains of a scene, from a program of samples/falling_particles. Raises InputError or RuntimeError."""
    program = os.environ["EXPLAIN_PAIR_GRAINS"]
    if not os.access(program, os.X_OK):
        raise InputError(
            f'--scene takes the program "{program}", which does not exist; allowed: build samples/falling_particles, or name its scene_grains '
            "in the environment variable EXPLAIN_PAIR_GRAINS"
        )
    return _answer_of(program, scene, *overrides)


def _answer_of(*command, stdin=None):
    answer = subprocess.run(command, input=stdin, capture_output=True, text=True)
    if answer.returncode != 0:
        raise (InputError if answer.returncode == 2 else RuntimeError)(answer.stderr.strip())
    return json.loads(answer.stdout)


def body_data(kind, lengths, exponents=(2, 2), tapers=(0, 0)):
    return {"kind": kind, "lengths": lengths, "exponents": exponents, "tapers": tapers, "rounding": 0, "is_callback": False}


def make_shape(body, scale=1.0):
    """The shape of a body as JSON. Raises ValueError when the library refuses a parameter."""
    lengths = scale * np.array(body["lengths"])
    makers = {
        "ellipsoid": lambda: sn.Ellipsoid(lengths),
        "superellipsoid": lambda: sn.Superellipsoid(lengths, *body["exponents"]),
        "superovoid": lambda: sn.Superovoid(lengths, *body["exponents"], *body["tapers"]),
        "box": lambda: sn.Box(lengths),
        "capsule": lambda: sn.Capsule(lengths[0], lengths[2]),
        "cylinder": lambda: sn.Cylinder(lengths[0], lengths[2]),
        "polytope": lambda: sn.Polytope(body["points"]),
    }
    shape = makers[body["kind"]]()
    if body["rounding"] > 0:
        shape = sn.Rounded(shape, scale * body["rounding"])
    return sn.CallbackShape(shape.point, shape.support) if body["is_callback"] else shape


def describe(body):
    """Such as "superellipsoid (1, 0.8, 0.5) m; 20, 4"."""

    def listed(numbers):
        return ", ".join(f"{number:g}" for number in numbers)

    kind = body["kind"]
    text = f"polytope of {len(body['points'])} points" if kind == "polytope" else f"{kind} ({listed(body['lengths'])}) m"
    if kind in ("superellipsoid", "superovoid"):
        text += f"; {listed(body['exponents'])}"
    if kind == "superovoid":
        text += f"; taper {listed(body['tapers'])}"
    if body["rounding"] > 0:
        text += f", rounded {body['rounding']:g} m"
    return text + (", by callbacks" if body["is_callback"] else "")


# Kinds of the command line: how many numbers, their usage, and the body that they make.
KINDS = {
    "sphere": (1, "RADIUS", lambda r: body_data("ellipsoid", [r, r, r])),
    "ellipsoid": (3, "A B C (half-axes, m)", lambda *p: body_data("ellipsoid", p)),
    "superellipsoid": (
        5,
        "A B C DELTA EPSILON (exponents in xy and along z, 1.01 to 1000)",
        lambda *p: body_data("superellipsoid", p[:3], p[3:]),
    ),
    "superovoid": (7, "A B C DELTA EPSILON TAPER_X TAPER_Y", lambda *p: body_data("superovoid", p[:3], p[3:5], p[5:])),
    "box": (3, "A B C (half-lengths, m)", lambda *p: body_data("box", p)),
    "capsule": (2, "RADIUS HALF_LENGTH (of the axis, along z, m)", lambda r, c: body_data("capsule", [r, r, c])),
    "cylinder": (2, "RADIUS HALF_LENGTH (along z, m)", lambda r, c: body_data("cylinder", [r, r, c])),
}


def did_you_mean(word, words):
    """`; did you mean "…"?`, or "" when no word is near."""
    near = get_close_matches(word, words, 1)
    return f'; did you mean "{near[0]}"?' if near else ""


def shortest(number):
    """The shortest text that reads back as the same number."""
    return repr(float(number)).removesuffix(".0")


def _number_of(option, word):
    try:
        value = float(word)
    except ValueError:
        value = inf
    if not isfinite(value):
        raise InputError(f'{option}: "{word}" is not a number; allowed: finite decimal numbers such as 0.02 or 2e-2')
    return value


def described_body(number, text, rounding, position=(0, 0, 0), quaternion=(1, 0, 0, 0)):
    """Body "1" or "2" from a text such as "superellipsoid 1 0.8 0.5 2.5 8" and the values of its other options."""
    option = f"--body{number}"
    kind, *words = text.split() or [""]
    if kind not in KINDS:
        raise InputError(f'{option}: "{kind}" is no kind of body; allowed: {", ".join(KINDS)}{did_you_mean(kind, KINDS)}')
    parameters = [_number_of(option, word) for word in words]
    count, usage, make = KINDS[kind]
    if len(parameters) != count:
        raise InputError(f'{option}: "{kind}" has {len(parameters)} numbers; allowed: {count}, {usage}')
    if not 0 <= rounding <= LARGEST:
        raise InputError(f"--rounding{number} is {shortest(rounding)}; allowed: a number in [0, {LARGEST:g}] m")
    for x in position:
        if not abs(x) <= FARTHEST:
            raise InputError(f"--position{number} has a {shortest(x)}; allowed: a number in [-{FARTHEST:g}, {FARTHEST:g}] m")
    body = {**make(*parameters), "rounding": rounding}
    pose = _pose(f"--quaternion{number}", position, quaternion)
    try:
        return PlacedBody(describe(body), make_shape(body), pose, body)
    except ValueError as error:
        raise InputError(f"{option}: {error}") from None


def _pose(name, position, quaternion):
    length = float(np.linalg.norm(quaternion))
    if not abs(length - 1) <= UNIT_LENGTH:
        raise InputError(f"{name} has the length {shortest(length)}; allowed: w x y z of unit length, to {UNIT_LENGTH}")
    return sn.Pose(position, quaternion=quaternion)


def hard_case(name):
    """A hard case by its name."""
    case = data("case", name)
    bodies = [
        PlacedBody(describe(body), make_shape(body), sn.Pose(pose["position"], pose["rotation"]), body)
        for body, pose in zip(case["bodies"], case["poses"])
    ]
    return Pair(name, *bodies, case["first_normal"])


def recorded_pair(scene, trajectory, time, bodies, overrides=()):
    """Two grains of a run, or one and the body with the smallest gap to it, in the frame of the run."""
    grains = _Grains(scene, trajectory, time, overrides)
    for index in bodies:
        grains.require(index)
    if len(bodies) == 2 and bodies[0] == bodies[1]:
        raise InputError(f"--bodies: both are {bodies[0]}; allowed: two different bodies")
    second = bodies[1] if len(bodies) == 2 else grains.nearest_to(bodies[0])
    return Pair(f"{grains.scene['name']} at {shortest(time)} s", grains.body(bodies[0]), grains.body(second))


class _Grains:
    """The bodies of a frame with their shapes."""

    def __init__(self, scene, trajectory, time, overrides):
        self.paths = (trajectory, scene)
        self.scene = scene_grains(scene, *overrides)
        self.bodies = _nearest_frame(trajectory, time)

    def require(self, index):
        if index in self.bodies:
            return
        low, high = min(self.bodies), max(self.bodies)
        rest = "" if high - low + 1 == len(self.bodies) else ", without those that have gone"
        raise InputError(f"--bodies: there is no body {index}; allowed: {low} to {high}{rest}")

    def body(self, index):
        kind = self._kind(index)
        text = f"body {index}: {self.bodies[index][0]}"
        if kind["is_compound"]:
            raise InputError(f"--bodies: {text} is a compound; allowed: grains of one convex body")
        return PlacedBody(text, make_shape(kind["body"], self._scale(index)), self.bodies[index][1], kind["body"])

    def nearest_to(self, first):
        body1 = self.body(first)
        # The bounding spheres of two bodies bound their gap from below. The gap of one body leaves few others to ask.
        bounds = {
            index: float(np.linalg.norm(pose.position - body1.pose.position)) - self._radius(first) - self._radius(index)
            for index, (_, pose) in self.bodies.items()
            if index != first
        }
        if not bounds:
            raise InputError("--bodies: there is no other body; allowed: bodies of a run of two or more")
        candidate = self.body(min(bounds, key=bounds.get))
        nearest = sn.find_proximity(body1.shape, body1.pose, candidate.shape, candidate.pose)
        near = [index for index, bound in bounds.items() if bound <= nearest.gap + nearest.error]
        bodies = [self.body(index) for index in near]
        poses = sn.Poses([body.pose.position for body in bodies], rotation=[body.pose.rotation for body in bodies])
        gaps = sn.find_proximities(body1.shape, body1.pose, [body.shape for body in bodies], poses).gap
        return near[int(np.argmin(gaps))]

    def _kind(self, index):
        name = self.bodies[index][0]
        if name not in self.scene["kinds"]:
            trajectory, scene = self.paths
            raise InputError(
                f'"{trajectory}" has a grain "{name}", which "{scene}" has not; allowed: the trajectory of a run of this scene'
            )
        return self.scene["kinds"][name]

    def _scale(self, index):
        kind = self._kind(index)
        if index < len(self.scene["scales"]):
            return self.scene["scales"][index]
        if kind["has_sizes"]:
            raise InputError(
                f"--bodies: body {index}: {self.bodies[index][0]} came from a feeder, and a trajectory does not tell its size; "
                "allowed: runs in which such kinds are not fed"
            )
        return 1

    def _radius(self, index):
        return self._scale(index) * self._kind(index)["bounding_radius"]


def _nearest_frame(path, wanted):
    """The frame of this time: kind and pose of each body by its index. Removed bodies are missing."""
    lines = _lines_of(path)
    head = next(lines, None)
    if head is None:
        raise InputError(f'cannot read "{path}"; allowed: the trajectory.csv of a run')
    if head != HEAD:
        raise InputError(f'{path}:1: the line is not "{HEAD}"; allowed: the trajectory.csv of a run')
    nearest, bodies = inf, {}
    for line, row in enumerate(lines, 2):
        columns = row.split(",")
        if len(columns) != 10:
            raise InputError(f"{path}:{line}: the line has not the 10 columns {HEAD}")
        try:
            time = float(columns[0])
            if abs(time - wanted) > abs(nearest - wanted):
                continue
            if time != nearest:
                nearest, bodies = time, {}
            numbers = [float(column) for column in columns[3:]]
            index = int(columns[1])
        except ValueError as error:
            wrong = str(error).rpartition(": ")[2].strip("'")
            raise InputError(f'{path}:{line}: "{wrong}" is not a number') from None
        bodies[index] = (columns[2], _pose(f"{path}:{line}: the quaternion", numbers[:3], numbers[3:]))
    if not bodies:
        raise InputError(f'"{path}" has no frames; allowed: the trajectory.csv of a run')
    if not abs(nearest - wanted) <= SAME_TIME:
        raise InputError(
            f'--time is {shortest(wanted)}; allowed: the time of a frame of "{path}", of which {shortest(nearest)} s is the nearest'
        )
    return bodies


def _lines_of(path):
    """The lines of a file; none if it cannot be read."""
    try:
        mode = pathlib.Path(path).stat().st_mode
        if not stat.S_ISREG(mode):
            is_device = stat.S_ISCHR(mode) or stat.S_ISBLK(mode)
            kind = "a folder" if stat.S_ISDIR(mode) else "a device" if is_device else "a pipe or a socket"
            raise InputError(f'--trajectory: "{path}" is {kind}; allowed: a file')
        with open(path, encoding="utf-8", errors="replace", newline="\n") as file:
            for line in file:
                yield line.rstrip("\n")
    except OSError:
        return
