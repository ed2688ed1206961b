"""An object that is used before its __init__ raises TypeError and does not end the interpreter."""

import inspect
import operator
import pathlib
import re

import pytest
import supernormal as sn

CLASSES = [value for value in (getattr(sn, name) for name in sn.__all__) if inspect.isclass(value) and not issubclass(value, int)]


@pytest.mark.parametrize("kind", CLASSES, ids=[kind.__name__ for kind in CLASSES])
def test_an_object_of_new_alone(kind):
    properties = [name for name in dir(kind) if isinstance(inspect.getattr_static(kind, name), property)]
    uses = [operator.attrgetter(name) for name in properties] + ([] if kind is sn.Shape else [repr])
    for use in uses:
        with pytest.raises(TypeError, match=re.escape("before its __init__() was called")):
            use(kind.__new__(kind))


def test_an_unmade_argument():
    unmade = sn.Box.__new__(sn.Box)
    for call in (
        lambda: sn.find_proximity(unmade, sn.Pose(), sn.Sphere(1), sn.Pose()),
        lambda: sn.find_proximity(sn.Sphere(1), sn.Pose.__new__(sn.Pose), sn.Sphere(1), sn.Pose()),
        lambda: unmade.support((1, 0, 0)),
    ):
        with pytest.raises(TypeError, match="before its __init__"):
            call()
    for call in (lambda: sn.Rounded(unmade, 1), lambda: sn.find_proximities([unmade], sn.Pose(), sn.Sphere(1), sn.Pose())):
        with pytest.raises((TypeError, RuntimeError)):
            call()


def test_a_subclass_that_uses_itself_first():
    class Early(sn.Superellipsoid):
        def __init__(self):
            self.support((1, 0, 0))

    class Never(sn.Superellipsoid):
        def __init__(self):
            pass

    with pytest.raises(TypeError, match="before its __init__"):
        Early()
    with pytest.raises(TypeError, match=re.escape("__init__() must be called")):
        Never()


def ode_classes():
    pyode = pytest.importorskip("ode", reason="python3-pyode is not installed")
    if not (pathlib.Path(sn.__file__).parent / "ode.py").exists():
        pytest.skip("the library was built without its ODE layer")
    import supernormal.ode as so

    return pyode, so, [so.Ellipsoid, so.Superellipsoid, so.Superovoid, so.Convex]


def test_a_geom_that_is_not_made():
    pyode, so, classes = ode_classes()
    for kind in classes:

        class Never(kind):
            def __init__(self):
                pass

        with pytest.raises(TypeError, match=re.escape("Never.__init__() must call super().__init__(), which makes the geom")):
            Never()
        # The same as an abstract base or a mixin would, which no class of ours sees.
        unmade = kind.__new__(kind)
        unmade.setPosition((1, 2, 3))
        unmade.setBody(pyode.Body(pyode.World()))
        pyode.SimpleSpace().add(unmade)
        pyode.collide(unmade, so.Ellipsoid())


def test_a_geom_that_is_used_before_it_is_made():
    pyode, so, _ = ode_classes()
    world, space = pyode.World(), pyode.SimpleSpace()
    uses = [
        lambda geom: geom.setBody(pyode.Body(world)),
        lambda geom: geom.setPosition((1, 0, 0)),
        lambda geom: geom.setQuaternion((0, 1, 0, 0)),
        lambda geom: geom.setCategoryBits(3),
        lambda geom: geom.setCollideBits(3),
        lambda geom: geom.disable(),
        lambda geom: space.add(geom),
    ]
    for use in uses:

        class Early(so.Ellipsoid):
            def __init__(self):
                use(self)
                super().__init__(None, (1, 2, 3))

        with pytest.raises(TypeError, match="after other methods of the geom; call it first"):
            Early()
    assert space.getNumGeoms() == 0


def test_a_geom_is_made_once():
    pyode, so, _ = ode_classes()
    space = pyode.SimpleSpace()
    geom = so.Ellipsoid(space, (1, 2, 3))
    with pytest.raises(TypeError, match="is called again"):
        geom.__init__(space, (3, 2, 1))
    assert space.getNumGeoms() == 1 and geom.getHalfAxes() == (1, 2, 3)
