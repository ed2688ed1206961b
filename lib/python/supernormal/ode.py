"""Supernormal bodies in PyODE worlds (Debian: python3-pyode).

    import ode
    import supernormal.ode

    space = ode.HashSpace()
    pebble = supernormal.ode.Superellipsoid(space, (0.02, 0.015, 0.008), 2.3, 2.0)
    body = ode.Body(world)
    pebble.setBodyAndMass(body, 2650)

The geoms derive from ode.GeomObject: setBody, getPosition, setCategoryBits ..., Space.collide, ode.collide and ContactJoint work as
for the geoms of PyODE. Names follow PyODE. Lengths are in metres, or in the unit of the world. Invalid input raises ValueError with
the parameter, its value and the valid range. As with all geoms of ODE, do not create, change or destroy them in near callbacks.
ode.collide() does not raise. A geom whose pose is not finite, or whose functions raise, makes no contacts; see lastError().
"""

from __future__ import annotations

import functools
import sys
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ._core import Shape, Solver

try:
    import ode as _pyode
except ImportError as _missing:
    raise ImportError("supernormal.ode takes PyODE (Debian: python3-pyode)", name="ode") from _missing

from . import _ode  # needs the ODE library that PyODE has loaded

__all__ = [
    "Convex",
    "Ellipsoid",
    "GeomProximity",
    "Statistics",
    "Stepper",
    "Superellipsoid",
    "Superovoid",
    "contactLookAhead",
    "getStatistics",
    "lastError",
    "proximity",
    "resetStatistics",
    "setDefaultLookAhead",
    "setDefaultSolver",
    "setWarmStart",
]

Vector = Tuple[float, float, float]


def _find_slots() -> Tuple[int, int]:
    space = _pyode.SimpleSpace()
    sphere = _pyode.GeomSphere(space)
    return _ode.find_slots(sphere, sphere._id(), space)


_SLOTS = _find_slots()


# ode.Body.setMass() aborts the program if the centre of mass is farther than this from the origin, m: dEpsilon of ODE.
_CENTRED = sys.float_info.epsilon


class _Made(type(_pyode.GeomObject)):  # type: ignore[misc]  # PyODE has no stubs
    """Refuses a geom whose __init__ did not call super().__init__(). PyODE would abort the program when it is used."""

    def __call__(cls, *arguments: Any, **keywords: Any) -> Any:
        geom = super().__call__(*arguments, **keywords)
        if not geom._is_made():
            raise TypeError(f"{cls.__name__}.__init__() must call super().__init__(), which makes the geom")
        return geom


class _Geom(_pyode.GeomObject, metaclass=_Made):  # type: ignore[misc]  # PyODE has no stubs
    """The methods of all geoms of this module in addition to ode.GeomObject."""

    def __new__(cls, *arguments: Any, **keywords: Any) -> Any:
        # A placeholder until __init__ makes the geom: PyODE aborts the program on a null geom.
        geom = super().__new__(cls)
        _ode.adopt(geom, _SLOTS, _ode.create_ellipsoid(0, (1.0, 1.0, 1.0)), None)
        return geom

    def _adopt(self, number: int, space: Any) -> None:
        """Replaces the placeholder by the new geom `number`, which is in `space`."""
        if self._is_made() or not _ode.is_untouched(self._id()):
            _ode.destroy(number)
            when = "again" if self._is_made() else "after other methods of the geom; call it first"
            raise TypeError(f"{type(self).__name__}: __init__() is called {when}")
        _ode.destroy(self._id())
        _ode.adopt(self, _SLOTS, number, space)
        _pyode._geom_c2py_lut[number] = self

    def _is_made(self) -> bool:
        return _pyode._geom_c2py_lut.get(self._id()) is self

    def _id(self) -> int:
        return _ode.number_of(self, _SLOTS)

    def _describe(self, **parameters: Any) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in parameters.items())})"

    def placeable(self) -> bool:
        """True: the geom has a pose and may have a body."""
        return True

    def setRounding(self, radius: float) -> None:
        """Sweeps the body with a sphere of `radius`, m, in [0, 1e30]. Replaces an earlier rounding; 0 removes it."""
        _ode.set_rounding(self._id(), radius)

    def setSolver(self, solver: Solver = Solver.HYBRID, tolerance: float = 1e-9, maxEvaluations: int = 1000) -> None:
        """Sets the Solver, the tolerance, in [1e-15, 1], and the limit, in [1, 1000000], of queries with this geom."""
        _ode.set_solver(self._id(), solver, tolerance, maxEvaluations)

    def setLookAhead(self, time: float) -> None:
        """Lets ode.collide() also return contacts of pairs that may meet within `time`, s, in [0, 1e6]; 0 (default): overlaps only.

        Use the time step of the simulation. A contact ahead has depth = -gap < 0: pass it to contactLookAhead(). The body then does
        not tunnel within a step. The bounding box covers the displacement within `time`. So call this again after setLinearVel() on
        a body that has not moved since the last Space.collide().
        """
        _ode.set_look_ahead(self._id(), time)

    def pointDepth(self, p: Sequence[float]) -> float:
        """The depth of a point (world frame, m) below the boundary, m: positive inside, negative outside."""
        return _ode.point_depth(self._id(), p)

    def support(self, direction: Sequence[float]) -> Vector:
        """The boundary point (world frame, m) whose outward normal is `direction` (world frame, any length but 0)."""
        return _ode.support_point(self._id(), direction)

    def getMass(self, density: float, offCentre: bool = False) -> Any:
        """The ode.Mass of the homogeneous body, in the geom's frame; density in kg/m^3, in (0, inf).

        Raises ValueError when the centre of mass is not the origin of the geom, as in a Superovoid: ode.Body.setMass() would abort
        the program. Use setBodyAndMass() for such a body. offCentre=True returns the mass anyway, for translate() and add().
        """
        return _to_mass(_ode.mass(self._id(), density, False), offCentre)

    def getMassTotal(self, mass: float, offCentre: bool = False) -> Any:
        """The ode.Mass of the homogeneous body with this mass, in kg, in (0, inf). See getMass()."""
        return _to_mass(_ode.mass(self._id(), mass, True), offCentre)

    def setBodyAndMass(self, body: Any, density: float) -> None:
        """Attaches the geom with its centre of mass at the body's origin, and sets the mass of the body.

        ODE requires the centre of mass at the body's origin, so the geom of a Superovoid gets an offset.
        density: kg/m^3, in (0, inf).
        """
        self._set_body(body, self.getMass(density, offCentre=True))

    def setBodyAndMassTotal(self, body: Any, mass: float) -> None:
        """setBodyAndMass() with the mass of the body instead of its density, in kg, in (0, inf)."""
        self._set_body(body, self.getMassTotal(mass, offCentre=True))

    def _set_body(self, body: Any, mass: Any) -> None:
        to_origin = tuple(-x for x in mass.c)
        mass.translate(to_origin)
        self.setBody(body)
        if any(to_origin):
            self.setOffsetPosition(to_origin)
        else:
            self.clearOffset()
        body.setMass(mass)

    def tessellate(self, chordError: float) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.uint32]]:
        """A closed mesh to draw: points (N, 3), m, normals (N, 3), triangles (M, 3), in the geom's frame.

        Its edges are within chordError of the boundary. chordError: m, at least 1e-6 of the largest half-extent.
        """
        return _ode.tessellate(self._id(), chordError)


def _to_mass(parameters: Tuple[float, Vector, Tuple[float, ...]], off_centre: bool) -> Any:
    mass, centre, inertia = parameters
    if not off_centre and any(abs(x) > _CENTRED for x in centre):
        raise ValueError(
            f"the centre of mass is at {centre} m in the geom's frame, and ode.Body.setMass() ends the program unless it is at the "
            "origin: call setBodyAndMass(body, density), which gives the geom an offset, or getMass(density, offCentre=True)"
        )
    result = _pyode.Mass()
    result.setParameters(mass, *centre, *inertia)
    return result


def _space_number(space: Any) -> int:
    return 0 if space is None else int(space._id())


class Ellipsoid(_Geom):
    """(x/a)^2 + (y/b)^2 + (z/c)^2 = 1 with halfAxes a, b, c in m, in [1e-30, 1e30]."""

    def __init__(self, space: Any = None, halfAxes: Sequence[float] = (1.0, 1.0, 1.0)) -> None:
        self._adopt(_ode.create_ellipsoid(_space_number(space), halfAxes), space)

    def __repr__(self) -> str:
        return self._describe(halfAxes=self.getHalfAxes())

    def getHalfAxes(self) -> Vector:
        """The half-axes, m."""
        return _ode.get_superellipsoid(self._id())[0]

    def setHalfAxes(self, halfAxes: Sequence[float]) -> None:
        """Sets the half-axes, m, in [1e-30, 1e30]. Keeps the rounding."""
        _ode.set_superellipsoid(self._id(), halfAxes, 2.0, 2.0)


class Superellipsoid(_Geom):
    """(|x/a|^delta + |y/b|^delta)^(epsilon/delta) + |z/c|^epsilon = 1.

    halfAxes: a, b, c in m, in [1e-30, 1e30]; delta, epsilon in [1.01, 1000].
    """

    def __init__(
        self, space: Any = None, halfAxes: Sequence[float] = (1.0, 1.0, 1.0), delta: float = 2.0, epsilon: float = 2.0
    ) -> None:
        self._adopt(_ode.create_superellipsoid(_space_number(space), halfAxes, delta, epsilon), space)

    def __repr__(self) -> str:
        return self._describe(**dict(zip(("halfAxes", "delta", "epsilon"), self.getParams())))

    def getParams(self) -> Tuple[Vector, float, float]:
        """The half-axes, m, and the exponents: (halfAxes, delta, epsilon)."""
        return _ode.get_superellipsoid(self._id())

    def setParams(self, halfAxes: Sequence[float], delta: float, epsilon: float) -> None:
        """Sets half-axes and exponents. Keeps the rounding. If it raises, the geom is unchanged."""
        _ode.set_superellipsoid(self._id(), halfAxes, delta, epsilon)


class Superovoid(_Geom):
    """A superellipsoid whose section grows or shrinks linearly along z; see supernormal.Superovoid.

    Its centre of mass is not its origin, but ODE requires it at the body's origin. setBodyAndMass() sets the offset.
    """

    def __init__(
        self,
        space: Any = None,
        halfAxes: Sequence[float] = (1.0, 1.0, 1.0),
        delta: float = 2.0,
        epsilon: float = 2.0,
        taperX: float = 0.0,
        taperY: float = 0.0,
    ) -> None:
        self._adopt(_ode.create_superovoid(_space_number(space), halfAxes, delta, epsilon, taperX, taperY), space)

    def __repr__(self) -> str:
        return self._describe(**dict(zip(("halfAxes", "delta", "epsilon", "taperX", "taperY"), self.getParams())))

    def getParams(self) -> Tuple[Vector, float, float, float, float]:
        """The half-axes, m, the exponents and the tapers: (halfAxes, delta, epsilon, taperX, taperY)."""
        return _ode.get_superovoid(self._id())

    def setParams(self, halfAxes: Sequence[float], delta: float, epsilon: float, taperX: float, taperY: float) -> None:
        """Sets half-axes, exponents and tapers. Keeps the rounding. If it raises, the geom is unchanged."""
        _ode.set_superovoid(self._id(), halfAxes, delta, epsilon, taperX, taperY)


class Convex(_Geom):
    """Any supernormal.Shape, such as a CallbackShape, a MinkowskiSum or a Polytope."""

    def __init__(self, space: Any = None, shape: Optional[Shape] = None) -> None:
        if shape is None:
            raise TypeError("shape is None, but must be a supernormal.Shape")
        self._adopt(_ode.create_convex(_space_number(space), shape), space)
        self._shape = shape

    def __repr__(self) -> str:
        return self._describe(shape=self._shape)


class GeomProximity(NamedTuple):
    """The result of proximity(), in the world frame; m. The unit normal points from the first geom to the second."""

    gap: float
    error: float
    normal: Vector
    point1: Vector
    point2: Vector
    evaluations: int
    converged: bool
    isGlobal: bool


def proximity(geom1: Any, geom2: Any, certified: bool = False) -> GeomProximity:
    """The signed distance of two geoms, apart or overlapping. One is of this module; the other may be of PyODE, but no space.

    certified: search until the depth of overlapping geoms is proved minimal (isGlobal), or the evaluations run out.
    """
    return GeomProximity(*_ode.proximity(geom1._id(), geom2._id(), certified))


def setDefaultSolver(solver: Solver = Solver.HYBRID, tolerance: float = 1e-9, maxEvaluations: int = 1000) -> None:
    """Sets the solver settings of new geoms; see setSolver() of a geom."""
    _ode.set_default_solver(solver, tolerance, maxEvaluations)


def setDefaultLookAhead(time: float) -> None:
    """Sets the look-ahead time of new geoms, s, in [0, 1e6]; see setLookAhead() of a geom."""
    _ode.set_default_look_ahead(time)


def contactLookAhead(contact: Any, step: float) -> None:
    """Turns an ode.Contact with a negative depth into a constraint: the gap may close within `step`, but not become negative.

    step: s, > 0, the same as in the next World.step() or quickStep().

    Call it after the contact's parameters are set and before the ContactJoint is made. It leaves other contacts unchanged. Set
    ode.ContactApprox1: without it mu is a force, which acts before the bodies touch. With ode.ContactBounce, in the default mode of
    ode.Contact, bodies bounce ahead of touch: see snContactLookAhead. Raises ValueError for a bounce outside [0, 1].
    """
    _require_contact(contact)
    _ode.contact_look_ahead(contact, _contact_slot(), step)


def _require_contact(contact: Any) -> None:
    if not isinstance(contact, _pyode.Contact):
        raise TypeError(f"contact is a {type(contact).__name__}, but must be an ode.Contact")


@functools.lru_cache(maxsize=None)
def _contact_slot() -> int:
    contact = _pyode.Contact()
    sphere = _pyode.GeomSphere()
    mu, motion2, depth, direction = 1.25, 2.25, 3.25, (4.25, 5.25, 6.25)
    contact.setMu(mu)
    contact.setMotion2(motion2)
    contact.setFDir1(direction)
    contact.setContactGeomParams((7, 8, 9), (0, 0, 1), depth, sphere, sphere)
    return _ode.find_contact(contact, mu, motion2, depth, direction)


class Stepper:
    """Moves bodies of an ode.World in place of World.quickStep(), from the contact forces of the last step, in sub-steps.

        stepper = supernormal.ode.Stepper(world)
        stepper.addBody(body)                    # every body that may touch one of its bodies
        supernormal.ode.setDefaultLookAhead(step)
        left = step
        while left > 0:                          # after an impact a step may end early
            space.collide(None, near)            # calls addContact(contact, geom1.getBody(), geom2.getBody())
            left -= stepper.step(left)

    It calls World.quickStep(), which moves the other bodies. A world has one stepper. A body that was added lives as long as the
    stepper, or until removeBody(). What is refused raises ValueError, and then nothing has changed.
    """

    def __init__(self, world: Any) -> None:
        body = _pyode.Body(world)  # lives until its world has been read
        self._stepper = _ode.Stepper(_body_number(body))
        self._world = world
        self._bodies: Dict[Any, int] = {}

    def addBody(self, body: Any) -> None:
        """The stepper moves this ode.Body from now on. It must be of the world, and not be added yet."""
        number = _body_number(body)
        self._stepper.add_body(number)
        self._bodies[body] = number

    def removeBody(self, body: Any) -> None:
        """The stepper leaves this ode.Body, and forgets the contacts that it was given with it."""
        self._stepper.remove_body(self._number("body", body))
        del self._bodies[body]

    def addContact(self, contact: Any, body1: Any, body2: Any) -> None:
        """Adds an ode.Contact for the next step, in place of an ode.ContactJoint.

        The bodies are bodies of the stepper; one may be None, the world. A negative depth is a gap; do not call contactLookAhead().
        Contacts of the same two geoms are added one after the other. Parameters have the ranges of ODE; bounce is in [0, 1].
        """
        _require_contact(contact)
        self._stepper.add_contact(contact, _contact_slot(), self._number("body1", body1), self._number("body2", body2))

    def step(self, time: float) -> float:
        """Moves the bodies by `time`, s, > 0, and forgets the contacts. Returns the time done, s.

        It is less than `time` if bodies have left the paths for which their contacts were found: collide again, and step by the rest.
        """
        return self._stepper.step(time)

    def moves(self, body: Any) -> bool:
        """Whether the stepper moved this ode.Body in the last step.

        Otherwise World.quickStep() did: a joint that the stepper does not solve holds the body, or one that it is joined to or touches.
        """
        return self._stepper.moves(self._number("body", body))

    def setAccuracy(self, sag: float = 2e-3, least: int = 8, most: int = 64) -> None:
        """Sets the largest overlap of a contact at rest and the numbers of sub-steps of a step.

        sag: relative to the least radius of gyration of its bodies, in [1e-12, 1]; least and most: in [1, 1000000]. The loads decide
        between them.
        """
        self._stepper.set_accuracy(sag, least, most)

    def contactForce(self, contact: int) -> Vector:
        """The force on body1, N, its mean over the last step. Contacts have the numbers 0, 1, ... in the order of addContact()."""
        return self._stepper.contact_force(contact)

    def save(self, geoms: Sequence[Any]) -> List[float]:
        """What the stepper remembers between two whole steps: numbers, in which geoms have their places among `geoms`."""
        return self._stepper.save([geom._id() for geom in geoms])

    def load(self, geoms: Sequence[Any], numbers: Sequence[float]) -> None:
        """Takes what save() of a stepper returned, in place of what this one remembers. The geoms have the same places."""
        self._stepper.load([geom._id() for geom in geoms], numbers)

    def _number(self, name: str, body: Any) -> int:
        if body is None:
            return 0
        if body not in self._bodies:
            raise ValueError(f"{name} is not a body of the stepper: add it by addBody()")
        return self._bodies[body]


def _body_number(body: Any) -> int:
    """The dBodyID of an ode.Body, which only geoms tell."""
    geom = _pyode.GeomSphere()
    geom.setBody(body)
    return _ode.body_of(geom._id())


def setWarmStart(on: bool) -> None:
    """Whether each pair starts from its last normal (default). If off, contacts are a pure function of the poses."""
    _ode.set_warm_start(on)


class Statistics(NamedTuple):
    """Counters of the colliders and proximity() in this thread since resetStatistics()."""

    queriesCold: int
    queriesWarm: int
    evaluationsCold: int
    evaluationsWarm: int
    closedForms: int
    contacts: int
    notConverged: int
    stalled: int
    outOfEvaluations: int
    diverged: int
    contactsNotConverged: int


def getStatistics() -> Statistics:
    """Counters of the colliders and proximity() in this thread since resetStatistics()."""
    return Statistics(*_ode.statistics())


def resetStatistics() -> None:
    """Sets all counters of this thread to 0."""
    _ode.reset_statistics()


def lastError() -> str:
    """The error message of the last refused call in this thread, colliders included; "" if there was none."""
    return _ode.last_error()
