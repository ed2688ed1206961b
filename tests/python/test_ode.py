"""Geoms of Supernormal in PyODE's worlds behave as PyODE's own."""

import gc
import pathlib
import re
import sys
import weakref

import numpy as np
import pytest
import supernormal as sn

pyode = pytest.importorskip("ode", reason="python3-pyode is not installed")
if not (pathlib.Path(sn.__file__).parent / "ode.py").exists():
    pytest.skip("the library was built without its ODE layer", allow_module_level=True)
import supernormal.ode as so  # noqa: E402  # it imports PyODE


def drop(make_geom):
    """Two thrown balls bounce on a plane and on each other, and roll; positions and orientations every 50 ms for 3 s."""
    world = pyode.World()
    world.setGravity((0, 0, -9.81))
    space = pyode.HashSpace()
    contacts = pyode.JointGroup()
    floor = pyode.GeomPlane(space, (0, 0, 1), 0)
    geoms = []
    for k in range(2):
        body = pyode.Body(world)
        mass = pyode.Mass()
        mass.setSphereTotal(1, 0.2)
        body.setMass(mass)
        geom = make_geom(space)
        geom.setBody(body)
        body.setPosition((0.1 * k, 0.05 * k, 0.5 + 0.6 * k))
        body.setLinearVel((1 - k, 0.2, 0))
        geoms.append(geom)
    met = set()

    def near(_, geom1, geom2):
        for contact in pyode.collide(geom1, geom2):
            contact.setMu(0.4)
            contact.setBounce(0.5)
            joint = pyode.ContactJoint(world, contacts, contact)
            joint.attach(geom1.getBody(), geom2.getBody())
            met.add(frozenset((type(geom1), type(geom2))))

    rows = []
    for step in range(3000):
        space.collide(None, near)
        world.step(0.001)
        contacts.empty()
        if step % 50 == 0:
            rows.append([x for geom in geoms for x in geom.getPosition() + geom.getQuaternion()])
    assert len(met) == 2  # the floor with a ball, and the balls with each other
    assert floor.getSpace() is space
    return np.array(rows)


@pytest.fixture(scope="module")
def spheres():
    return drop(lambda space: pyode.GeomSphere(space, 0.2))


@pytest.mark.parametrize(
    "make",
    [
        lambda space: so.Ellipsoid(space, (0.2, 0.2, 0.2)),
        lambda space: so.Superellipsoid(space, (0.2, 0.2, 0.2), 2, 2),
        lambda space: so.Superovoid(space, (0.2, 0.2, 0.2), 2, 2, 0, 0),
        lambda space: so.Convex(space, sn.Sphere(0.2)),
    ],
    ids=["Ellipsoid", "Superellipsoid", "Superovoid", "Convex"],
)
def test_the_trajectory_of_spheres(spheres, make):
    assert np.ptp(spheres[:, 0]) > 0.1 and np.ptp(spheres[:, 2]) > 0.1  # they move
    assert np.abs(drop(make) - spheres).max() <= 1e-9


def test_a_geom_is_one_of_pyodes():
    world, space, other = pyode.World(), pyode.HashSpace(), pyode.SimpleSpace()
    geom = so.Superellipsoid(space, (0.3, 0.2, 0.1), 3, 4)
    assert isinstance(geom, pyode.GeomObject) and geom.placeable() and not geom.isSpace()
    assert geom.getSpace() is space and space.getNumGeoms() == 1 and space.getGeom(0) is geom and space.query(geom)
    body = pyode.Body(world)
    assert geom.getBody() is None
    geom.setBody(body)
    assert geom.getBody() is body
    body.setPosition((1, 2, 3))
    assert geom.getPosition() == (1, 2, 3)
    geom.setPosition((4, 5, 6))
    assert body.getPosition() == (4, 5, 6)
    assert np.array(geom.getAABB()) == pytest.approx([3.7, 4.3, 4.8, 5.2, 5.9, 6.1], abs=1e-9)
    geom.setOffsetPosition((0, 0, 1))
    assert geom.getPosition() == (4, 5, 7)
    geom.clearOffset()
    geom.setQuaternion((0, 1, 0, 0))
    assert geom.getRotation() == pytest.approx([1, 0, 0, 0, -1, 0, 0, 0, -1])
    geom.setCategoryBits(6)
    assert geom.getCategoryBits() == 6
    geom.disable()
    assert not geom.isEnabled()
    geom.enable()
    geom.colour = "blue"
    assert geom.colour == "blue" and geom.attribs["colour"] == "blue"
    space.remove(geom)
    other.add(geom)
    assert other.getNumGeoms() == 1 and space.getNumGeoms() == 0
    geom.setBody(None)
    assert geom.getBody() is None


def test_a_geom_dies_with_its_object():
    space = pyode.SimpleSpace()
    before = sys.getrefcount(space)
    shape = sn.CallbackShape(lambda n: n)
    alive = weakref.ref(shape)
    geoms = [so.Convex(space, shape), so.Ellipsoid(space, (1, 2, 3))]
    del shape
    gc.collect()
    assert space.getNumGeoms() == 2
    assert geoms[0].support((0, 0, 2)) == (0, 0, 1)
    del geoms
    gc.collect()
    # An assertion that calls a method of the space would hold a reference to it.
    references = sys.getrefcount(space)
    assert references == before and alive() is None
    assert space.getNumGeoms() == 0


def test_a_refused_geom_leaves_nothing():
    space = pyode.SimpleSpace()
    before = sys.getrefcount(space)
    for _ in range(3):
        with pytest.raises(ValueError):
            so.Ellipsoid(space, (0, 1, 1))
    gc.collect()
    references = sys.getrefcount(space)
    assert references == before
    assert space.getNumGeoms() == 0


def test_queries_agree_with_the_core():
    q = (0.8, 0.1, -0.3, np.sqrt(1 - 0.74))
    geom = so.Superovoid(None, (0.3, 0.2, 0.4), 2.5, 2, 0.2, 0.1)
    geom.setPosition((1, 2, 3))
    geom.setQuaternion(q)
    shape, pose = sn.Superovoid((0.3, 0.2, 0.4), 2.5, 2, 0.2, 0.1), sn.Pose((1, 2, 3), quaternion=q)
    ball = pyode.GeomSphere(None, 0.5)
    ball.setPosition((1.5, 2.5, 3.5))
    found = so.proximity(geom, ball)
    expected = sn.find_proximity(shape, pose, sn.Sphere(0.5), sn.Pose((1.5, 2.5, 3.5)))
    assert found.gap == pytest.approx(expected.gap, abs=1e-12) and found.converged and found.isGlobal
    assert found.normal == pytest.approx(expected.normal, abs=1e-6)
    assert found.point1 == pytest.approx(expected.point1, abs=1e-6)
    assert so.proximity(ball, geom).normal == pytest.approx(-expected.normal, abs=1e-6)
    assert geom.pointDepth((1, 2, 3.1)) == pytest.approx(-shape.signed_distance((1, 2, 3.1), pose), abs=1e-12)
    lowest = geom.support((0, 0, -1))
    assert lowest[2] == pytest.approx(shape.bounding_box(pose)[0, 2])
    mass, properties = geom.getMass(1000, offCentre=True), shape.mass_properties()
    assert mass.mass == pytest.approx(1000 * properties.volume)
    assert mass.c == pytest.approx(tuple(properties.centroid))
    about_origin = np.trace(properties.second_moment) * np.eye(3) - properties.second_moment
    assert np.array(mass.I) == pytest.approx(1000 * about_origin)
    assert geom.getMassTotal(2, offCentre=True).mass == pytest.approx(2)
    points, normals, triangles = geom.tessellate(0.002)
    assert points == pytest.approx(shape.point(normals), abs=1e-12) and triangles.max() == len(points) - 1


SHIFTED = sn.CallbackShape(lambda n: n + (0.2, 0, 0))


@pytest.mark.parametrize(
    "make",
    [
        lambda: so.Superovoid(None, (0.3, 0.2, 0.4), 2.5, 2, 0.2, 0.1),
        lambda: so.Superovoid(None, (0.3, 0.2, 0.4), 2.5, 2, -0.2, -0.2),
        lambda: so.Convex(None, SHIFTED),
        lambda: so.Ellipsoid(None, (3, 2, 1)),
    ],
    ids=["Superovoid", "the other way round", "Convex", "Ellipsoid"],
)
def test_the_mass_of_a_body_whose_centre_is_anywhere(make):
    """ode.Body.setMass() ends the interpreter when the centre of mass is not the origin."""
    geom = make()
    off_centre = geom.getMass(1000, offCentre=True)
    centre = np.array(off_centre.c)
    for set_mass, amount in ((geom.setBodyAndMass, 1000), (geom.setBodyAndMassTotal, off_centre.mass)):
        body = pyode.Body(pyode.World())
        body.setPosition((1, 2, 3))
        body.setQuaternion((0, 1, 0, 0))
        set_mass(body, amount)
        assert geom.getBody() is body and body.getMass().mass == pytest.approx(off_centre.mass)
        assert np.array(geom.getPosition()) == pytest.approx((1, 2, 3) - centre * (1, -1, -1))
        at_centre = np.array(off_centre.I) - off_centre.mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
        assert np.array(body.getMass().I) == pytest.approx(at_centre, abs=1e-9 * at_centre.max())
    if not centre.any():
        pyode.Body(pyode.World()).setMass(geom.getMass(1000))
        return
    for refused in (lambda: geom.getMass(1000), lambda: geom.getMassTotal(5)):
        with pytest.raises(ValueError, match=r"^the centre of mass is at \(.* call setBodyAndMass\(body, density\)"):
            refused()


def test_an_egg_spins_about_its_centre_of_mass():
    world = pyode.World()
    egg, body = so.Superovoid(None, (0.2, 0.2, 0.3), 2, 2, 0.3, 0.3), pyode.Body(world)
    egg.setBodyAndMass(body, 1000)
    centre = np.array(egg.getMass(1000, offCentre=True).c)
    body.setAngularVel((2, 0, 0))
    for _ in range(100):
        world.step(0.01)
    assert body.getPosition() == pytest.approx((0, 0, 0), abs=1e-12)
    turned = np.array(egg.getRotation()).reshape(3, 3) @ centre
    assert abs(turned[1]) > 0.9 * centre[2] * np.sin(2) and np.array(egg.getPosition()) == pytest.approx(-turned)


def test_a_certified_depth():
    one, two = so.Superellipsoid(None, (1, 1.1, 1.2), 8, 8), so.Superellipsoid(None, (1, 1.1, 1.2), 8, 8)
    assert not so.proximity(one, two).isGlobal
    certified = so.proximity(one, two, certified=True)
    assert certified.isGlobal and certified.gap == pytest.approx(-2, abs=1e-8)


def test_set_and_get():
    geom = so.Superellipsoid(None, (1, 2, 3), 2.5, 4)
    geom.setParams((3, 2, 1), 3, 5)
    assert geom.getParams() == ((3, 2, 1), 3, 5)
    geom.setRounding(0.5)
    assert geom.getAABB()[1] == pytest.approx(3.5)
    ellipsoid = so.Ellipsoid(None, (1, 2, 3))
    ellipsoid.setHalfAxes((4, 5, 6))
    assert ellipsoid.getHalfAxes() == (4, 5, 6)
    egg = so.Superovoid(None, (1, 1, 1), 2, 2, 0.1, 0.1)
    egg.setParams((1, 1, 1.5), 2, 2, 0.3, 0.3)
    assert egg.getParams() == ((1, 1, 1.5), 2, 2, 0.3, 0.3)


def test_statistics_and_warm_start():
    geom, ball = so.Superellipsoid(None, (1, 2, 3), 2.5, 4), so.Superellipsoid(None, (1, 2, 3), 3, 3)
    ball.setPosition((1, 1, 1))
    so.setWarmStart(False)
    so.resetStatistics()
    for _ in range(2):
        assert len(pyode.collide(geom, ball)) >= 1
    cold = so.getStatistics()
    assert (cold.queriesCold, cold.queriesWarm, cold.notConverged) == (2, 0, 0) and cold.evaluationsCold > 2
    so.setWarmStart(True)
    for _ in range(2):
        pyode.collide(geom, ball)
    assert so.getStatistics().queriesWarm >= 1


@pytest.mark.parametrize(
    "shape",
    [
        sn.Sphere(0.1),
        sn.Box((0.1, 0.08, 0.05)),
        sn.Cylinder(0.1, 0.05),
        sn.Polytope([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]),
        sn.Superellipsoid((0.1, 0.08, 0.05), 8, 8),
        sn.LinearImage(sn.Box((1, 1, 1)), [[1, 0.2, 0], [0, 1, 0], [0, 0, 1]]),
    ],
    ids=lambda shape: type(shape).__name__,
)
def test_a_known_shape_has_its_mass(shape):
    mass = so.Convex(None, shape).getMass(1000, offCentre=True)
    exact = shape.mass_properties()
    assert mass.mass == pytest.approx(1000 * exact.volume, rel=1e-14)
    assert mass.c == pytest.approx(tuple(exact.centroid), abs=1e-15)


SPHERE = sn.Sphere(1)
REFUSALS = [
    (lambda: so.Ellipsoid(None, (1, 0, 1)), "snCreateEllipsoid: half-axis b = 0 m is outside [1e-30, 1e+30] m"),
    (lambda: so.Superellipsoid(None, (1, 1, 1), 0.5, 2), "snCreateSuperellipsoid: delta = 0.5 is outside [1.01, 1000]"),
    (lambda: so.Superovoid(None, (1, 1, 1), 2, 2, 0.9, 0.9), "snCreateSuperovoid: taper_x = 0.9"),
    (lambda: so.Convex(None, sn.Polytope([[0, 0, 0]])), "snCreateFromDescription: "),
    (lambda: so.Superellipsoid().setParams((1, 1, -1), 2, 2), "snGeomSuperellipsoidSetParams: half-axis c = -1 m is outside"),
    (lambda: so.Superovoid().setParams((1, 1, 1), 2, 0, 0, 0), "snGeomSuperovoidSetParams: epsilon = 0 is outside"),
    (lambda: so.Superellipsoid.getParams(so.Superovoid()), "snGeomSuperellipsoidGetParams: "),
    (lambda: so.Superovoid.getParams(so.Convex(None, SPHERE)), "snGeomSuperovoidGetParams: "),
    (lambda: so.Ellipsoid().setRounding(-1), "snGeomSetRounding: radius = -1 m is outside [0, 1e+30] m"),
    (lambda: so.Ellipsoid().setSolver(sn.Solver.NEWTON, 2), "snGeomSetSolver: tolerance = 2 is outside [1e-15, 1]"),
    (lambda: so.Ellipsoid().setSolver(7), "snGeomSetSolver: solver = 7 is none of"),
    (lambda: so.setDefaultSolver(maxEvaluations=0), "snSetDefaultSolver: max_evaluations = 0 is outside [1, 1000000]"),
    (lambda: so.Ellipsoid().pointDepth((float("nan"), 0, 0)), "snGeomPointDepth: x = nan m is outside"),
    (lambda: so.Ellipsoid().support((0, 0, 0)), "snGeomSupport: direction = (0, 0, 0), but must have a length"),
    (lambda: so.Ellipsoid().getMass(-1), "snMassSet: density = -1 kg/m^3 is outside (0, inf) kg/m^3"),
    (lambda: so.Ellipsoid().getMassTotal(0), "snMassSetTotal: total_mass = 0 kg is outside (0, inf) kg"),
    (lambda: so.Convex(None, sn.MinkowskiSum(sn.Ellipsoid((1, 1, 1)), sn.Box((1, 1, 1)))).getMass(1), "is uncertain by"),
    (lambda: so.Ellipsoid().tessellate(0), "snGeomTessellate: chord_error = 0 m"),
    (lambda: so.proximity(pyode.GeomSphere(), pyode.GeomSphere()), "snGeomProximity: "),
    (lambda: so.proximity(so.Ellipsoid(), pyode.SimpleSpace()), "snGeomProximity: "),
    (lambda: so.proximity(pyode.GeomSphere(), pyode.GeomSphere(), True), "snGeomProximityCertified: "),
]


@pytest.mark.parametrize("call,message", REFUSALS, ids=[f"{k} {message}" for k, (_, message) in enumerate(REFUSALS)])
def test_refusal(call, message):
    with pytest.raises(ValueError, match=re.escape(message)) as refusal:
        call()
    assert str(refusal.value) == so.lastError()


def test_a_collider_says_why_it_makes_no_contact():
    calm = True

    def point(n):
        if calm:
            return n
        raise RuntimeError("out of order")

    geom = so.Convex(None, sn.CallbackShape(point))
    assert len(pyode.collide(geom, so.Ellipsoid())) == 1
    calm = False
    assert pyode.collide(geom, so.Ellipsoid()) == []
    assert "out of order" in so.lastError()


BROKEN = [(float("nan"), 0, 0), (0, float("inf"), 0), (0, 0, 1e200)]


@pytest.mark.parametrize("place", BROKEN, ids=str)
def test_a_pose_that_cannot_be_computed_with(place):
    geom = so.Superellipsoid(None, (1, 2, 3), 3, 3)
    others = [so.Ellipsoid(), pyode.GeomSphere(None, 1), pyode.GeomBox(None, (1, 1, 1)), pyode.GeomRay(None, 9), pyode.GeomCapsule(None, 1, 1)]
    for broken, other in [(geom, other) for other in others] + [(other, geom) for other in others[:3]]:
        for at in (geom, *others):
            at.setPosition((0, 0, 0))
        broken.setPosition(place)
        with pytest.raises(ValueError):
            geom.setRounding(-1)  # another message
        assert pyode.collide(broken, other) == []
        assert so.lastError().startswith("dCollide: the pose of ") and "position = (" in so.lastError()
    geom.setPosition((float("nan"), 0, 0))
    assert pyode.collide(geom, pyode.GeomPlane(None, (0, 0, 1), 0)) == [] and "position = (nan, 0, 0) m" in so.lastError()


@pytest.fixture
def look_ahead():
    """Sets the default, and takes it back."""
    yield so.setDefaultLookAhead
    so.setDefaultLookAhead(0)


def shoot(speed, step):
    """A pebble against a wall of 1 cm at x = 5: its position after ten steps, and the smallest depth of a contact."""
    world, space, contacts = pyode.World(), pyode.SimpleSpace(), pyode.JointGroup()
    wall = pyode.GeomBox(space, (0.01, 2, 2))
    wall.setPosition((5, 0, 0))
    pebble = so.Ellipsoid(space, (0.02, 0.015, 0.01))
    body = pyode.Body(world)
    pebble.setBodyAndMass(body, 7800)
    body.setLinearVel((speed, 0, 0))
    depths = []

    def near(_, geom1, geom2):
        for contact in pyode.collide(geom1, geom2):
            contact.setMode(pyode.ContactApprox1)
            contact.setMu(0.5)
            depths.append(contact.getContactGeomParams()[2])
            so.contactLookAhead(contact, step)
            pyode.ContactJoint(world, contacts, contact).attach(geom1.getBody(), geom2.getBody())

    for _ in range(10):
        space.collide(None, near)
        world.quickStep(step)
        contacts.empty()
    return body.getPosition()[0], min(depths, default=0)


def test_contacts_before_overlap(look_ahead):
    assert shoot(1000, 0.02)[0] > 100  # through
    look_ahead(0.02)
    place, depth = shoot(1000, 0.02)
    assert place == pytest.approx(5 - 0.005 - 0.02, abs=1e-6)
    assert depth < -4.9
    look_ahead(0)
    geom = so.Ellipsoid(None, (0.02, 0.015, 0.01))
    plane = pyode.GeomPlane(None, (0, 0, 1), 0)
    geom.setPosition((0, 0, 0.01005))
    assert pyode.collide(geom, plane) == []
    geom.setLookAhead(0.02)
    (contact,) = pyode.collide(geom, plane)
    assert contact.getContactGeomParams()[2] == pytest.approx(-5e-5, rel=1e-3)
    contact.setMode(pyode.ContactApprox1)
    contact.setMu(0.25)
    so.contactLookAhead(contact, 0.02)
    assert contact.getContactGeomParams()[2] == 0
    # dContactMotionN, of which PyODE knows nothing, and the ERP of contacts that look ahead
    assert contact.getMode() == pyode.ContactApprox1 | 0x080 | pyode.ContactSoftERP and contact.getMu() == 0.25
    assert contact.getSoftERP() == pytest.approx(0.8)


def test_refusals_of_contacts_before_overlap():
    geom = so.Ellipsoid()
    for time in (-1, float("nan"), 2e6):
        with pytest.raises(ValueError, match=r"time = .* is outside \[0, 1e\+06\] s"):
            geom.setLookAhead(time)
        with pytest.raises(ValueError, match="snSetDefaultLookAhead: time = "):
            so.setDefaultLookAhead(time)
    contact = pyode.Contact()
    for step in (0, -1, float("inf")):
        with pytest.raises(ValueError, match="snContactLookAhead: step = "):
            so.contactLookAhead(contact, step)
    with pytest.raises(TypeError, match="must be an ode.Contact"):
        so.contactLookAhead(geom, 0.01)
    mode = contact.getMode()
    contact.setContactGeomParams((0, 0, 0), (0, 0, 1), -1, geom, geom)
    contact.setBounce(1.5)
    with pytest.raises(ValueError, match=r"surface.bounce = 1.5 is outside \[0, 1\]"):
        so.contactLookAhead(contact, 0.01)
    assert contact.getContactGeomParams()[2] == -1 and contact.getMode() == mode


def test_restitution_of_contacts_before_overlap():
    world, space, step = pyode.World(), pyode.Space(), 0.01
    world.setGravity((0, 0, -9.81))
    contacts = pyode.JointGroup()
    floor = pyode.GeomPlane(space, (0, 0, 1), 0)
    ball = so.Ellipsoid(space, (0.05, 0.05, 0.05))
    body = pyode.Body(world)
    ball.setBodyAndMass(body, 1000)
    body.setPosition((0, 0, 0.55))
    ball.setLookAhead(step)
    while body.getLinearVel()[2] <= 0:
        for contact in pyode.collide(ball, floor):
            contact.setMode(pyode.ContactApprox1 | pyode.ContactBounce)
            contact.setBounce(0.8)
            so.contactLookAhead(contact, step)
            pyode.ContactJoint(world, contacts, contact).attach(body, None)
        world.quickStep(step)
        contacts.empty()
    velocity = body.getLinearVel()[2] - 9.81 * step / 2
    height = body.getPosition()[2] - 0.05 + velocity**2 / (2 * 9.81)
    assert height == pytest.approx(0.64 * 0.5, rel=1e-3)


@pytest.fixture
def tower(look_ahead):
    """Ten bricks on a floor, which a stepper moves: (its step in s, the stepper, the bodies, a function that collides)."""
    step = 1 / 30
    look_ahead(step)
    world, space = pyode.World(), pyode.SimpleSpace()
    world.setGravity((0, 0, -9.81))
    floor = pyode.GeomPlane(space, (0, 0, 1), 0)
    stepper, bodies, bricks = so.Stepper(world), [], []
    for k in range(10):
        bodies.append(pyode.Body(world))
        bricks.append(so.Superellipsoid(space, (0.1, 0.07, 0.05), 20, 20))
        bricks[k].setBodyAndMass(bodies[k], 1000)
        bodies[k].setPosition((0.002 * (k % 2), 0, 0.05 + 0.1 * k))
        stepper.addBody(bodies[k])

    def near(_, geom1, geom2):
        for contact in pyode.collide(geom1, geom2):
            contact.setMode(pyode.ContactApprox1)
            contact.setMu(0.5)
            stepper.addContact(contact, geom1.getBody(), geom2.getBody())

    yield step, stepper, bodies, lambda: space.collide(None, near)
    del floor, bricks


def test_a_stepper_holds_a_tower(tower):
    step, stepper, bodies, collide = tower
    assert stepper.moves(bodies[0])
    for _ in range(60):
        left = step
        while left > 0:
            collide()
            left -= stepper.step(left)
    assert bodies[-1].getPosition() == pytest.approx((0.002, 0, 0.95), abs=1e-3)
    collide()
    stepper.step(step)
    forces = np.array([stepper.contactForce(k) for k in range(40)])
    weights = 9.81 * sum((k + 1) * body.getMass().mass for k, body in enumerate(bodies))
    assert np.abs(forces[:, 2]).sum() == pytest.approx(weights, rel=1e-3)
    geoms = [so.Superellipsoid(None, (1, 1, 1), 2, 2)]
    stepper.load(geoms, stepper.save(geoms))
    stepper.removeBody(bodies[-1])
    with pytest.raises(ValueError, match="body is not a body of the stepper: add it by addBody"):
        stepper.removeBody(bodies[-1])


def test_refusals_of_a_stepper(tower):
    step, stepper, bodies, _ = tower
    contact = pyode.Contact()
    contact.setContactGeomParams((0, 0, 0), (0, 0, 1), 0.1, pyode.GeomSphere(), pyode.GeomSphere())
    other = pyode.Body(pyode.World())
    refusals = [
        (lambda: stepper.step(0), "snStepperStep: step = 0 s"),
        (lambda: stepper.addBody(bodies[0]), "must be added once"),
        (lambda: stepper.addBody(other), "another world"),
        (lambda: stepper.addContact(contact, other, None), "body1 is not a body of the stepper"),
        (lambda: stepper.setAccuracy(least=9, most=8), "most = 8 is outside [9, "),
        (lambda: stepper.load([], [1]), "snStepperLoad: these 1 numbers are none of snStepperSave"),
        (lambda: stepper.contactForce(0), "contact = 0 is not one of the 0 contacts"),
        (lambda: (contact.setMu(-1), stepper.addContact(contact, bodies[0], None)), "surface.mu = -1"),
    ]
    for call, message in refusals:
        with pytest.raises(ValueError, match=re.escape(message)):
            call()
    for wrong in (lambda: so.Stepper(bodies[0]), lambda: stepper.addBody(1), lambda: stepper.addContact(1, bodies[0], None)):
        with pytest.raises(TypeError):
            wrong()
    assert stepper.step(step) == step


def test_a_stepper_dies_with_its_object_and_lets_bodies_go():
    world = pyode.World()
    body = pyode.Body(world)
    before = sys.getrefcount(body), sys.getrefcount(world)
    stepper = so.Stepper(world)
    stepper.addBody(body)
    assert sys.getrefcount(body) > before[0] and sys.getrefcount(world) > before[1]
    stepper.removeBody(body)
    assert sys.getrefcount(body) == before[0]
    del stepper
    gc.collect()
    assert (sys.getrefcount(body), sys.getrefcount(world)) == before


def test_wrong_types():
    with pytest.raises(TypeError, match="must be a supernormal.Shape"):
        so.Convex(pyode.SimpleSpace())
    with pytest.raises(TypeError):
        so.Ellipsoid(None, (1, 2))
