"""Scenes of falling_particles, step by step.

    import supernormal.scenes as scenes

    scene = scenes.Scene("samples/scenes/drum.toml", {"time.duration": 2, "container.rpm": 30})
    with scene.start(out="out") as world:
        while not world.is_at_end:
            world.step(100)
            grains = world.grains()
    print(world.results.folder)

A scene is a file, a text or a dictionary with the sections and keys of a scene file. `falling_particles --list` prints them. A
world is a run of a scene. The same scene leaves the same bytes as the program, whatever the steps are between which a program of
Python looks at the world. Only times differ: the seconds of summary.toml.

Lengths are in metres, masses in kilograms, times in seconds, forces in newtons. Frames are the world's. Quaternions are (w, x, y,
z), from the frame of a body to the world's. Invalid input raises ValueError with the parameter, its value and the valid range.
What fails later, such as a full disk or a grain that a feeder finds no place for, raises RuntimeError and closes the world.

Worlds run one at a time, each in a thread of its own, without the interpreter's lock. Ctrl-C ends a call after the current step.
"""

from __future__ import annotations

import collections.abc
import dataclasses
import operator
import os
import pathlib
import warnings
from types import TracebackType
from typing import Any, List, Mapping, Optional, Tuple, Type, Union

import numpy as np
import numpy.typing as npt

from . import Pose, Shape, _scenes, read_shape

__all__ = ["Contacts", "Energy", "Grains", "Kind", "Results", "Scene", "Walls", "World", "to_toml"]

Array = npt.NDArray[np.float64]
Values = Mapping[str, Any]
Path = Union[str, "os.PathLike[str]"]

_MOST_STEPS = 1_000_000_000  # of a scene


@dataclasses.dataclass(frozen=True)
class Kind:
    """A kind of grain of a scene.

    name: in the catalogue.
    count: grains at the start.
    density: kg/m^3; of a compound, the mean.
    mass: kg, of a grain of scale 1.
    bounding_radius: m, of a sphere about the centre of mass that contains a grain of scale 1.
    components: the bodies of a grain of scale 1 with their poses in its frame; one, unless the kind is a compound.
    """

    name: str
    count: int
    density: float
    mass: float
    bounding_radius: float
    components: Tuple[Tuple[Shape, Pose], ...]


@dataclasses.dataclass(frozen=True)
class Grains:
    """All grains so far, N of them. An index stays the grain's, also after a sink has removed it.

    kind: (N,); index into Scene.kinds.
    is_present: (N,); False for a removed grain, whose position, quaternion and velocities are NaN.
    is_awake: (N,); False while [auto_disable] lets a grain sleep.
    scale: (N,); the factor on the lengths of the kind.
    mass: (N,); kg.
    volume: (N,); m^3.
    position: (N, 3); m, of the centre of mass, in the frame of the world. Along periodic axes it may be outside the cell.
    quaternion: (N, 4); w, x, y, z: the unit rotation from the frame of the grain to the world's. The axes of a grain are those of
        its half_axes, or of its compound, in the catalogue.
    velocity: (N, 3); m/s, of the centre of mass, in the frame of the world.
    angular_velocity: (N, 3); rad/s, in the frame of the world.
    """

    kind: npt.NDArray[np.int64]
    is_present: npt.NDArray[np.bool_]
    is_awake: npt.NDArray[np.bool_]
    scale: Array
    mass: Array
    volume: Array
    position: Array
    quaternion: Array
    velocity: Array
    angular_velocity: Array

    def __len__(self) -> int:
        return len(self.kind)


@dataclasses.dataclass(frozen=True)
class Contacts:
    """The contact points of the last step, M of them. A pair has up to five. There are none before a step and after a change of
    effects. Vectors are in the frame of the world.

    grain1: (M,); index into Grains.
    grain2: (M,); index into Grains; -1 for a wall.
    wall: (M,); index into Walls; -1 for a grain.
    position: (M, 3); m, where the force acts.
    normal: (M, 3); unit, from grain 2 or the wall towards grain 1. Along it a force pushes grain 1 away.
    depth: (M,); m, along the normal, at the start of the step: positive for overlap, negative for contacts ahead of touch.
    force: (M, 3); N, on grain 1, during the step; NaN unless World.step() was asked for forces.
    """

    grain1: npt.NDArray[np.int64]
    grain2: npt.NDArray[np.int64]
    wall: npt.NDArray[np.int64]
    position: Array
    normal: Array
    depth: Array
    force: Array

    def __len__(self) -> int:
        return len(self.grain1)


@dataclasses.dataclass(frozen=True)
class Walls:
    """The walls of the container and the parts of the scene, K of them. Vectors are in the frame of the world.

    name: K names, as in parts.csv and in measurements.
    position: (K, 3); m, of the origin of the wall's frame: the `position` of a part, a point of a plane, the middle of another wall
        of a container, the origin for a mesh.
    quaternion: (K, 4); w, x, y, z: the unit rotation from the wall's frame to the world's. It is (1, 0, 0, 0) for a wall of a
        container that stands, a plane too: `normal` has its direction.
    normal: (K, 3); unit, of a plane, towards the grains; NaN for other walls.
    velocity: (K, 3); m/s, of `position`, mean of the last step, without the motion of a conveyor's surface.
    angular_velocity: (K, 3); rad/s, mean of the last step.
    """

    name: Tuple[str, ...]
    position: Array
    quaternion: Array
    normal: Array
    velocity: Array
    angular_velocity: Array

    def __len__(self) -> int:
        return len(self.name)


@dataclasses.dataclass(frozen=True)
class Energy:
    """The energy of all present grains.

    kinetic: J, of translation and rotation.
    potential: J, in the scene's gravity, 0 at the origin, and of bonds.
    """

    kinetic: float
    potential: float


@dataclasses.dataclass(frozen=True)
class Results:
    """What a run has left.

    folder: of its files; README.md of falling_particles lists them.
    summary: the text of summary.toml.
    first_leak: the first grain that left the container, in words; None if all stayed.
    """

    folder: pathlib.Path
    summary: str
    first_leak: Optional[str]


def to_toml(value: Any) -> str:
    """The value in TOML, on one line. Mappings become inline tables, sequences and arrays of NumPy become arrays.

    Raises TypeError for what TOML has no form for.
    """
    return _toml("value", value)


def _toml(name: str, value: Any) -> str:
    """`name`: of the value, in messages."""
    if isinstance(value, np.generic) or isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, os.PathLike)):
        return '"' + "".join(map(_escaped, os.fspath(value))) + '"'
    if isinstance(value, collections.abc.Mapping):
        return "{" + ", ".join(f"{_key(name, key)} = {_toml(f'{name}[{key!r}]', item)}" for key, item in value.items()) + "}"
    if isinstance(value, collections.abc.Sequence) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(_toml(f"{name}[{index}]", item) for index, item in enumerate(value)) + "]"
    raise TypeError(f"{name} is {value!r}; allowed: bool, int, float, str, a path, a mapping, a sequence or an array of these")


def _escaped(letter: str) -> str:
    if letter in '"\\':
        return "\\" + letter
    return f"\\u{ord(letter):04x}" if ord(letter) < 0x20 or ord(letter) == 0x7F else letter


def _key(name: str, key: Any) -> str:
    if not isinstance(key, str):
        raise TypeError(f"{name} has the key {key!r}; allowed: str")
    return to_toml(key)


def _assignments(values: Optional[Values]) -> List[str]:
    if values is None:
        return []
    if not isinstance(values, collections.abc.Mapping):
        raise TypeError(f"values is {values!r}; allowed: a mapping from keys, such as 'time.step', to values")
    for key in values:
        if not isinstance(key, str) or "=" in key:
            raise TypeError(f"values has the key {key!r}; allowed: a key of a scene, such as 'time.step' or 'grain[pea].count'")
    return [_assignment(key, value) for key, value in values.items()]


def _assignment(key: str, value: Any) -> str:
    if value is None and "." not in key:
        return f"{key}.enabled=false"
    return f"{key}={_toml(f'values[{key!r}]', value)}"


def _integer(name: str, value: Any, lowest: int, highest: int) -> int:
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}; allowed: an integer from {lowest} to {highest}") from None
    if not lowest <= number <= highest:
        raise ValueError(f"{name} is {number}; allowed: {lowest} to {highest}")
    return number


def _flag(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is {value!r}; allowed: True or False")
    return bool(value)


class Scene:
    """A scene of falling_particles, which can be run many times.

    `values` replace or add values of the scene, as the program's --set does: {"time.step": 1e-3, "container.width[1]": 0.06,
    "grain[pea].count": 20, "friction": {"coefficient": 0.3}, "damping": None}. None leaves an effect out. The files are read when the
    scene is made, and again by World.change(), a copy and a pickle, for which multiprocessing.Pool.map may take scenes.

    Raises ValueError for what the program refuses, with the file, the line and the allowed values.
    """

    def __init__(self, path: Path, values: Optional[Values] = None) -> None:
        self._load(os.fspath(path), None, _assignments(values))

    @classmethod
    def from_text(cls, text: str, values: Optional[Values] = None, *, folder: Path = ".", name: str = "scene") -> Scene:
        """The scene of a text in TOML. Paths in it are relative to `folder`. `name`: of the scene and of the folder of its results.

        Messages name `the text` and its line.
        """
        if not isinstance(text, str):
            raise TypeError(f"text is {text!r}; allowed: str")
        return cls._of(os.path.join(os.fspath(folder), _file_name(name) + ".toml"), text, _assignments(values))

    @classmethod
    def from_dict(
        cls, tables: Mapping[str, Any], values: Optional[Values] = None, *, folder: Path = ".", name: str = "scene"
    ) -> Scene:
        """The scene of a dictionary, as tomllib.load() makes it of a scene file: {"seed": 1, "container": {"kind": "box", …}, …}.

        `the text, line 3` in a message is the third key of the dictionary.
        """
        if not isinstance(tables, collections.abc.Mapping):
            raise TypeError(f"tables is {tables!r}; allowed: a mapping from the sections of a scene to their values")
        text = "".join(f"{_key('tables', key)} = {_toml(f'tables[{key!r}]', value)}\n" for key, value in tables.items())
        return cls.from_text(text, values, folder=folder, name=name)

    def __reduce__(self) -> Tuple[Any, ...]:
        return (Scene._of, self._given)

    @classmethod
    def _of(cls, path: str, text: Optional[str], values: List[str]) -> Scene:
        scene = cls.__new__(cls)
        scene._load(path, text, values)
        return scene

    def _load(self, path: str, text: Optional[str], values: List[str]) -> None:
        source = _scenes.Source(path, text, values)
        fields = source.fields()
        self._given = (path, text, values)
        self._source = source
        self._name: str = fields["name"]
        self._seed: int = fields["seed"]
        self._time_step: float = fields["time_step"]
        self._steps: int = fields["steps"]
        self._kinds = tuple(_kind(**kind) for kind in fields["kinds"])

    @property
    def name(self) -> str:
        """The name of the file without folder and extension."""
        return self._name

    @property
    def seed(self) -> int:
        """The seed of the random numbers."""
        return self._seed

    @property
    def time_step(self) -> float:
        """s, of a step."""
        return self._time_step

    @property
    def steps(self) -> int:
        """The number of steps of a run."""
        return self._steps

    @property
    def kinds(self) -> Tuple[Kind, ...]:
        """The kinds of grains."""
        return self._kinds

    def __repr__(self) -> str:
        return f"<Scene {self._name!r}: {sum(kind.count for kind in self._kinds)} grains, {self._steps} steps>"

    def check(self) -> str:
        """What a run does and takes, as `falling_particles --check` prints it. Takes a second or two."""
        return self._source.check()

    def doubts(self) -> List[str]:
        """Values that are probably mistakes, each in a sentence with a remedy."""
        return self._source.doubts()

    def tables(self) -> str:
        """The tables that a run writes, with their columns, as TOML."""
        return self._source.tables()

    def start(
        self,
        out: Optional[Path] = None,
        *,
        threads: int = 0,
        pictures: bool = True,
        checkpoint_every: int = 0,
        resume: bool = False,
    ) -> World:
        """Makes the world of the scene, before its first step.

        out: the parent of the folder of the results; None: the run leaves nothing.
        threads: that find contacts, in [0, 256]; 0: as many as the machine has. The same results with any number.
        pictures: False: no pictures, whatever the scene asks for.
        checkpoint_every: steps between two checkpoints, in [0, 1e9]; 0: none. Takes a scene file and `out`.
        resume: continues from the checkpoint of a killed run of the scene, if there is one. The program resumes runs of Python, and
            Python those of the program.

        Raises ValueError for what the program refuses. Doubts are warnings, as of the program.
        """
        threads = _integer("threads", threads, 0, 256)
        pictures, resume = _flag("pictures", pictures), _flag("resume", resume)
        every = _integer("checkpoint_every", checkpoint_every, 0, _MOST_STEPS)
        if out is None and (every > 0 or resume):
            name, value = ("checkpoint_every", every) if every > 0 else ("resume", resume)
            raise ValueError(f"{name} is {value!r} and out is None; allowed: {name} with a folder `out`, which holds the checkpoints")
        for doubt in self.doubts():
            warnings.warn(doubt, stacklevel=2)
        folder = None if out is None else os.fspath(out)
        if folder == "":
            raise ValueError("out is ''; allowed: a folder, '.' too, or None")
        return World(self, _scenes.World(self._source, folder, threads, pictures, every, resume))

    def run(self, out: Path, *, draw: bool = True, **options: Any) -> Results:
        """Runs the scene from start to end, as the program does. `options` are those of start(), `draw` is that of finish()."""
        with self.start(out, **options) as world:
            world.step(self._steps - world.steps_done)
            return world.finish(draw=draw)


def _file_name(name: str) -> str:
    if not isinstance(name, str) or not name or "/" in name or "\0" in name or name in (".", ".."):
        raise ValueError(f"name is {name!r}; allowed: a name of a file, without folders")
    return name


def _kind(name: str, count: int, density: float, mass: float, bounding_radius: float, components: List[Any]) -> Kind:
    placed = tuple((read_shape(text), Pose(position, quaternion=quaternion)) for text, position, quaternion in components)
    return Kind(name, count, density, mass, bounding_radius, placed)


class World:
    """A run of a scene between two steps; Scene.start() makes it. Leave it with close(), finish() or a `with` block.

    At the end of a `with` block that no exception has left, a world with an `out` is finished: its results are complete, up to the
    last step. If it is closed before, its unfinished results are removed, unless it has checkpoints.

    Many worlds may be open at once. Each draws its own random numbers. A scene with a section [query], which holds for the process,
    is refused beside others.

    Raises RuntimeError after close(), and while another thread works with the world.
    """

    def __init__(self, scene: Scene, world: _scenes.World) -> None:
        self._scene = scene
        self._world = world
        self._results: Optional[Results] = None

    def __enter__(self) -> World:
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], value: Optional[BaseException], traceback: Optional[TracebackType]
    ) -> None:
        try:
            if kind is None and self._world.has_files() and not self._world.is_closed() and not self._world.is_finished():
                self.finish()
        finally:
            self.close()

    @property
    def scene(self) -> Scene:
        """The scene as it was at the start."""
        return self._scene

    @property
    def steps_done(self) -> int:
        """The steps so far."""
        return self._world.steps_done()

    @property
    def is_at_end(self) -> bool:
        """Whether all steps of the scene are done."""
        return self.steps_done == self._scene.steps

    @property
    def is_closed(self) -> bool:
        """Whether the world has ended, by close() or by an error."""
        return self._world.is_closed()

    @property
    def time(self) -> float:
        """s, since the start."""
        return self._world.time()

    def step(self, count: int = 1, *, forces: bool = False) -> None:
        """Makes `count` steps, in [0, Scene.steps - steps_done].

        forces: measures the forces of the contacts in the last one, for contacts(), where they are NaN otherwise. The motion is the
            same.

        Ctrl-C ends the call after a step and raises KeyboardInterrupt. The world may go on.
        """
        self._world.step(_integer("count", count, 0, _MOST_STEPS), _flag("forces", forces))

    def grains(self) -> Grains:
        """The grains now, in arrays of their own."""
        return Grains(**self._world.grains())

    def contacts(self) -> Contacts:
        """The contact points of the last step, in arrays of their own. Their forces are NaN unless step() was asked for forces."""
        return Contacts(**self._world.contacts())

    def walls(self) -> Walls:
        """The walls now, in arrays of their own."""
        return Walls(**self._world.walls())

    def energy(self) -> Energy:
        """The energy of the grains now."""
        return Energy(*self._world.energy())

    def set_forces(self, forces: npt.ArrayLike, torques: Optional[npt.ArrayLike] = None) -> None:
        """Sets the forces and torques that act on the grains from outside in every step from now on, such as a fluid's.

        forces: (N, 3), N, at the centres of mass; a row for each of Grains, also for removed ones, of which it is ignored. torques:
        the same, N m; None: none. Grains that feeders insert later get nothing until the next call. A grain with a force wakes. The
        work of the forces counts as energy gained or lost. The summary has the time of the first call.

        Raises ValueError for other shapes, numbers that are not finite, and in a world with checkpoints, which do not hold forces.
        """
        rows = _vectors("forces", forces)
        self._world.set_forces(rows, np.zeros_like(rows) if torques is None else _vectors("torques", torques))

    def change(self, values: Values) -> None:
        """Changes values of the scene from the next step on: {"gravity.acceleration": [0, 0, -1.6], "container.rpm": 40}.

        The sections of effects, such as [gravity] and [friction], and [solver] may change and be added, and None leaves an effect
        out: {"friction": None}. The run then continues from its saved state, as after a checkpoint, and all grains wake. Values of
        motions may change, too: container.rpm of a drum, part[NAME].motion, and of part[NAME].drive: .force, .torque, .power,
        .largest_force, .largest_torque, .stress, .damping and .until, for a drive of the same kind. A side of a cell is container.SIDE in place of part[NAME]. A new motion starts now,
        from the pose of the wall, with axes, points and directions of the world. The summary lists each change with its time.

        Raises ValueError for all other values, with those that may change, for a motion of a wall that stood at the start, and in a
        world with checkpoints, which do not hold changes. The world is then as before.
        """
        assignments = _assignments(values)
        if assignments:
            self._world.change(assignments)

    def finish(self, *, draw: bool = True) -> Results:
        """Completes the results, up to the last step, and moves them to their place. Then the world can be read, but not stepped.

        draw: makes the pictures that gnuplot and POV-Ray draw; their lack is a line on stderr.
        """
        folder = pathlib.Path(self._world.finish(_flag("draw", draw)))
        self._results = Results(folder, self._world.summary(), self._world.first_leak())
        return self._results

    @property
    def results(self) -> Results:
        """The results that finish() has returned. Raises RuntimeError before."""
        if self._results is None:
            raise RuntimeError("World.results: the results are not complete; allowed: after finish()")
        return self._results

    @property
    def first_leak(self) -> Optional[str]:
        """The first grain that left the container, in words; None while all are inside."""
        return self._world.first_leak()

    def close(self) -> None:
        """Ends the world. May be called again."""
        self._world.close()

    def __repr__(self) -> str:
        done = "closed" if self.is_closed else f"{self.steps_done} of {self._scene.steps} steps"
        return f"<World of {self._scene.name!r}: {done}>"


def _vectors(name: str, values: npt.ArrayLike) -> Array:
    try:
        if np.iscomplexobj(values):
            raise TypeError("its numbers are complex")
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name}: {error}; allowed: an array of numbers, (N, 3)") from None
