"""supernormal.scenes beside the program: the same bytes, and what a program of Python may do to a world."""

import copy
import dataclasses
import multiprocessing
import os
import pathlib
import pickle
import re
import shutil
import signal
import subprocess
import sys
import threading
import tomllib

import numpy as np
import pytest
import supernormal as sn
import supernormal.scenes as scenes

PROGRAM = os.environ["FALLING_PARTICLES"]
SCENES = pathlib.Path(__file__).parents[3] / "samples" / "scenes"
NO_PICTURES = {"output.pictures": []}
# Few steps of the scenes that have most in them.
SHORTER = {
    "short": {"output.pictures": ["page", "vtk", "lammps"], "output.forces": True},
    "drum": {"time.duration": 0.6, "container.turns_at": 0.2, "output.pictures": []},
    "hopper": {"time.duration": 0.1, "container.opens_at": 0.05, "output.pictures": []},
    "feeder": {"time.duration": 0.3, "output.pictures": ["glb"]},
    "shear_cell": {"time.duration": 0.2, "part[lid].drive.from": 0.05, "output.pictures": []},
    "drum_periodic": {"time.duration": 0.1, "container.turns_at": 0.02, "output.pictures": []},
    "packing_spheres": {"time.duration": 0.2, "output.pictures": []},
    "compounds": {"time.duration": 0.1, "output.pictures": []},
    "sizes": {"time.duration": 0.1, "output.pictures": []},
}
TABLES = {"measurement": [{"kind": "contact_forces", "interval": 0.01}, {"kind": "coordination", "interval": 0.02}]}


@pytest.fixture(autouse=True)
def quiet(recwarn, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def run_program(scene, values, folder, *options):
    settings = [word for key, value in values.items() for word in ("--set", f"{key}={scenes.to_toml(value)}")]
    command = [PROGRAM, "-q", "-s", SCENES / f"{scene}.toml", "-o", folder, *settings, *options]
    subprocess.run(command, check=True, capture_output=True)


def without_times(name, text):
    """The text without the lines whose numbers are times of the machine."""
    return [line for line in text.splitlines() if name != "summary.toml" or not re.match(r"\S*(seconds|share_|real)", line)]


def assert_same_bytes(folder, other):
    files = sorted(path.relative_to(folder) for path in folder.rglob("*"))
    assert files and files == sorted(path.relative_to(other) for path in other.rglob("*"))
    for file in files:
        if file.name == "summary.toml":
            texts = [(root / file).read_text() for root in (folder, other)]
            assert without_times(file.name, texts[0]) == without_times(file.name, texts[1])
        elif (folder / file).is_file():
            assert (folder / file).read_bytes() == (other / file).read_bytes(), file


@pytest.mark.parametrize("name", SHORTER)
def test_steps_of_python_leave_the_bytes_of_the_program(name):
    values = {**SHORTER[name], **(TABLES if name in ("short", "drum") else {})}
    run_program(name, values, "program")
    scene = scenes.Scene(SCENES / f"{name}.toml", values)
    with scene.start("python", threads=2) as world:
        while not world.is_at_end:
            world.step(min(17, scene.steps - world.steps_done), forces=world.steps_done % 2 == 0)
            world.grains(), world.contacts(), world.walls(), world.energy()
    assert_same_bytes(pathlib.Path("program", name), world.results.folder)
    summary = tomllib.loads(world.results.summary)
    assert summary["run"]["steps"] == scene.steps and not summary["run"]["interrupted"]


def test_a_text_and_a_dictionary_are_scenes_like_the_file():
    text = (SCENES / "short.toml").read_text()
    sources = [
        scenes.Scene(SCENES / "short.toml", NO_PICTURES),
        scenes.Scene.from_text(text, NO_PICTURES, folder=SCENES, name="short"),
        scenes.Scene.from_dict({**tomllib.loads(text), "output": {"pictures": []}}, folder=SCENES, name="short"),
    ]
    for number, scene in enumerate(sources):
        scene.run(f"out{number}")
        assert (scene.name, scene.steps) == ("short", sources[0].steps)
    tables = [pathlib.Path(f"out{number}", "short", "trajectory.csv").read_bytes() for number in range(3)]
    assert tables[0] == tables[1] == tables[2]


def test_two_worlds_in_turn_are_as_alone():
    scene = scenes.Scene(SCENES / "short.toml")
    with scene.start() as alone:
        alone.step(300)
        wanted = alone.grains()
    with scene.start() as one, scene.start() as two:
        for world in (one, two, one, two, two, one):
            world.step(100)
        for world in (one, two):
            np.testing.assert_array_equal(world.grains().position, wanted.position)
    with scene.start() as world:
        thread = threading.Thread(target=lambda: world.step(150))
        thread.start()
        thread.join()
        world.step(150)
        np.testing.assert_array_equal(world.grains().position, wanted.position)


@pytest.mark.parametrize("first, then", [("program", "python"), ("python", "program"), ("python", "python")])
def test_checkpoints_are_those_of_the_program(first, then):
    values = {"time.duration": 0.2, "output.pictures": ["page"]}
    run_program("short", values, "whole", "--checkpoint-every", "100")
    scene = scenes.Scene(SCENES / "short.toml", values)
    if first == "python":
        with scene.start("parts", checkpoint_every=100) as world:
            world.step(250)
            world.close()
    else:
        # The program stops at its first checkpoint.
        command = [PROGRAM, "-q", "-s", SCENES / "short.toml", "-o", "parts", "--checkpoint-every", "100"]
        command += [word for key, value in values.items() for word in ("--set", f"{key}={scenes.to_toml(value)}")]
        with subprocess.Popen(command, stderr=subprocess.PIPE) as run:
            while not any(pathlib.Path("parts").glob("*/checkpoint*")) and run.poll() is None:
                pass
            run.send_signal(signal.SIGTERM)
            run.communicate()
        assert not pathlib.Path("parts", "short").exists(), "the run was not stopped"
    if then == "python":
        with scene.start("parts", resume=True) as world:
            assert world.steps_done > 0 and world.steps_done % 100 == 0
            world.step(scene.steps - world.steps_done)
    else:
        run_program("short", values, "parts", "--resume")
    for file in ("trajectory.csv", "energies.csv", "state.csv"):
        assert pathlib.Path("whole", "short", file).read_bytes() == pathlib.Path("parts", "short", file).read_bytes()


def free_scene(step=1e-3, duration=1.0, **tables):
    """One grain without contacts."""
    dictionary = {
        "seed": 1,
        "catalogue": str(SCENES.parent / "data" / "grains.toml"),
        "container": {
            "kind": "none",
            "start": {"corner": [0.0, 0.0, 0.0], "size": [0.1, 0.1, 0.1]},
            "bounds": {"corner": [-10.0, -10.0, -10.0], "size": [20.0, 20.0, 20.0]},
        },
        "drop": {"height": 0.0, "gap": 0.02},
        "part": [{"name": "far", "shape": "box", "size": [0.1, 0.1, 0.1], "position": [8.0, 8.0, 8.0]}],
        "grain": [{"name": "soybean", "count": 1}],
        "time": {"duration": duration, "step": step, "frame": duration},
        "solver": {"iterations": 20, "erp": 0.2, "cfm": 1e-10},
        **tables,
    }
    if dictionary["container"]["kind"] == "periodic":
        del dictionary["part"]
    return scenes.Scene.from_dict(dictionary)


def test_forces_and_torques_act_as_newton_and_euler_say():
    scene = free_scene()
    with scene.start() as world:
        start = world.grains()
        force = start.mass[:, None] * [[0.3, -0.2, 0.1]]
        world.set_forces(force)
        world.step(500)
        now = world.grains()
        np.testing.assert_allclose(now.velocity, [[0.15, -0.1, 0.05]], rtol=1e-12)
        # A step moves by its velocity at the end: the sum of 1 to n instead of n^2/2.
        np.testing.assert_allclose(now.position - start.position, [[0.3, -0.2, 0.1]] * np.array(500 * 501 / 2 * 1e-6), rtol=1e-9)
        world.set_forces(np.zeros((1, 3)))
        world.step(100)
        np.testing.assert_array_equal(world.grains().velocity, now.velocity)
    with scene.start() as world:
        torque = 1e-9 * np.array([[0.2, 0.5, -0.4]])
        world.set_forces(np.zeros((1, 3)), torque)
        world.step(1)
        ((shape, _),) = scene.kinds[0].components
        inertia = scene.kinds[0].density * np.asarray(shape.mass_properties().inertia)
        w, x, y, z = world.grains().quaternion[0]
        turned = np.array(sn.Pose((0, 0, 0), quaternion=(w, x, y, z)).rotation)
        wanted = 1e-3 * turned @ np.linalg.solve(inertia, turned.T @ torque[0])
        np.testing.assert_allclose(world.grains().angular_velocity[0], wanted, rtol=1e-6)


def test_a_force_wakes_a_grain_and_moves_its_images():
    box = {"kind": "box", "width": [0.1, 0.1]}
    gravity = {"acceleration": [0, 0, -9.81]}
    scene = free_scene(container=box, gravity=gravity, auto_disable={"linear": 1.0, "angular": 100.0})
    with scene.start() as world:
        world.step(500)
        assert not world.grains().is_awake[0]
        world.set_forces([[0, 0, 0.1]])
        world.step()
        now = world.grains()
        assert now.is_awake[0] and now.velocity[0, 2] == pytest.approx(1e-3 * (0.1 / now.mass[0] - 9.81), rel=1e-3)
    # A grain on the edge of a periodic cell, with no contacts, gets the whole force.
    scene = free_scene(duration=0.02, container={"kind": "periodic", "side": 0.05}, drop={})
    with scene.start() as world:
        force = np.array([[1e-3, 2e-3, -3e-3]])
        world.set_forces(force)
        world.step(20)
        np.testing.assert_allclose(world.grains().velocity, 0.02 * force / world.grains().mass[:, None], rtol=1e-6)


def test_contacts_carry_the_weight_at_rest():
    scene = scenes.Scene(SCENES / "short.toml", {"time.duration": 1.5})
    with scene.start() as world:
        world.step(scene.steps, forces=True)
        grains, contacts, walls = world.grains(), world.contacts(), world.walls()
        assert np.abs(grains.velocity).max() < 2e-2
    floor = contacts.wall == walls.name.index("floor")
    weight = 9.81 * grains.mass.sum()
    assert contacts.force[floor, 2].sum() == pytest.approx(weight, rel=0.02)
    np.testing.assert_allclose(contacts.normal[floor], np.tile([0, 0, 1], (floor.sum(), 1)), atol=1e-12)
    assert (contacts.grain2 >= 0).sum() + (contacts.wall >= 0).sum() == len(contacts)
    # Action and reaction: what the contacts give the grains is their weight, and friction stays in its cone.
    total = np.zeros((len(grains), 3))
    np.add.at(total, contacts.grain1, contacts.force)
    between = contacts.grain2 >= 0
    np.subtract.at(total, contacts.grain2[between], contacts.force[between])
    np.testing.assert_allclose(total.sum(axis=0), [0, 0, weight], atol=0.02 * weight)
    along = np.einsum("ij,ij->i", contacts.force, contacts.normal)
    assert (along > -1e-12).all()
    with scene.start() as world:
        world.step(400)
        assert np.isnan(world.contacts().force).all()


def test_a_change_of_gravity_is_that_of_a_scene():
    scene = free_scene(gravity={"acceleration": [0, 0, -9.81]})
    with scene.start() as world:
        world.step(100)
        before, energy = world.grains(), world.energy()
        world.change({"gravity.acceleration": [1.0, 0.0, 0.0]})
        assert world.energy().potential == pytest.approx(-before.mass[0] * before.position[0, 0], rel=1e-12)
        assert world.energy().kinetic == energy.kinetic
        world.step(100)
        np.testing.assert_allclose(world.grains().velocity - before.velocity, [[0.1, 0, 0]], atol=1e-13)
        world.change({"gravity": None})  # left out
        velocity = world.grains().velocity
        world.step(10)
        np.testing.assert_array_equal(world.grains().velocity, velocity)
        world.change({"gravity": {"acceleration": [1.0, 0.0, 0.0]}, "stokes_drag": {"viscosity": 1.0}})  # added on the way
        world.step(500)
        speed = world.grains().velocity[0]
        assert abs(speed[2]) < 1e-6 and 0 < speed[0] < 0.1


def test_a_change_that_bonds_are_too_stiff_for_is_refused():
    with scenes.Scene(SCENES / "beam.toml", {**NO_PICTURES, "time.duration": 0.02}).start() as world:
        world.step(5)
        with pytest.raises(ValueError, match=r"too stiff for grain .* solver.iterations from \d+ on"):
            world.change({"solver.iterations": 1})
        world.step(50)
        assert world.energy().kinetic < 1


def test_a_refusal_of_a_text_names_the_text_and_its_line():
    text = (SCENES / "plate.toml").read_text()
    with pytest.raises(ValueError, match=r"^the text: "):
        scenes.Scene.from_text(text.replace("position = [0.04, 0.04, 0.2]", "position = [0.04, 0.04, 0.02]"), folder=SCENES).start()
    line = text[: text.index("seed = ")].count("\n") + 1
    with pytest.raises(ValueError, match=rf"^the text, line {line}: seed is "):
        scenes.Scene.from_text(text.replace("seed = ", "seed = -"), folder=SCENES)
    with pytest.raises(ValueError, match="^the text, line 1: unknown key"):
        scenes.Scene.from_dict({"seeds": 1})


def test_a_run_goes_on_from_the_state_of_another():
    scene = scenes.Scene(SCENES / "short.toml", NO_PICTURES)
    with scene.start("first") as world:
        world.step(100)
        wanted = world.grains()
    summary = world.results.summary
    assert tomllib.loads(summary)["run"]["interrupted"] is True and "Ctrl-C" not in summary
    assert "interrupted                     = true        # whether the run ended before time.duration" in summary
    state = (world.results.folder / "final_state.csv").resolve()
    with scenes.Scene(SCENES / "short.toml", {**NO_PICTURES, "start.file": state, "start.overlap": 1}).start() as world:
        np.testing.assert_array_equal(world.grains().position, wanted.position)


def test_bonds_have_their_share_of_the_rows():
    scene = scenes.Scene(SCENES / "beam.toml", {**NO_PICTURES, "time.duration": 0.02})
    results = scene.run("first")
    summary = tomllib.loads(results.summary)
    bonds, cost = summary["bonds"], summary["cost"]
    assert cost["bonds"]["rows"] == 6 * bonds["at_start"] * summary["run"]["steps"] and summary["collision"]["contacts"] == 0
    shares = {key: value for key, value in cost.items() if key.startswith("share_")}
    assert "share_bonds" in shares and sum(shares.values()) == pytest.approx(1, abs=1e-4)
    rest = cost["real"] * (shares["share_solver"] + shares["share_bonds"])
    assert cost["bonds"]["seconds"] == pytest.approx(rest, rel=1e-3) and cost["effect"]["rigid_contact"]["seconds"] == 0


def test_walls_have_the_normals_of_their_planes():
    with scenes.Scene(SCENES / "short.toml").start() as world:
        walls = world.walls()
    planes = {"floor": [0, 0, 1], "x_low": [1, 0, 0], "x_high": [-1, 0, 0], "y_low": [0, 1, 0], "y_high": [0, -1, 0]}
    assert {name: normal.tolist() for name, normal in zip(walls.name, walls.normal)} == planes
    # A plane of a part looks along z of its frame, a servo's too; a box has no normal.
    with scenes.Scene(SCENES / "triaxial.toml").start() as world:
        walls = world.walls()
    for quaternion, normal in zip(walls.quaternion, walls.normal):
        w, x, y, z = quaternion
        np.testing.assert_allclose(normal, [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], atol=1e-15)
    with scenes.Scene(SCENES / "piston.toml").start() as world:
        walls = world.walls()
    assert np.isnan(walls.normal[walls.name.index("piston")]).all()


def test_docstrings_say_what_each_field_is():
    for record in (scenes.Kind, scenes.Grains, scenes.Contacts, scenes.Walls, scenes.Energy, scenes.Results):
        for field in dataclasses.fields(record):
            assert re.search(rf"^ +{field.name}: \S", record.__doc__, re.MULTILINE), (record, field.name)


def test_a_change_is_written_into_the_results():
    scene = scenes.Scene(SCENES / "short.toml", {**NO_PICTURES, "time.duration": 0.2})
    with scene.start("out") as world:
        world.step(100)
        world.change({"friction.coefficient": 0.1, "gravity.acceleration": [0, 0, -1.62]})
        for _ in range(2):
            world.set_forces(np.zeros((len(world.grains()), 3)))
            world.step(1)
        world.step(scene.steps - 102)
    summary = tomllib.loads(world.results.summary)
    assert summary["run"]["set"][-2:] == ["gravity.acceleration=[0, 0, -1.62] from 0.05 s", "set_forces() from 0.05 s"]
    assert summary["end"]["energy_gained"] < 1e-6
    table = pathlib.Path("out", "short", "energies.csv").read_text().splitlines()
    assert len(table) == 1 + 1 + round(0.2 / tomllib.loads((SCENES / "short.toml").read_text())["time"]["frame"])


def test_a_drum_turns_on_from_where_it_is():
    scene = scenes.Scene(SCENES / "drum.toml", {**NO_PICTURES, "container.turns_at": 0, "grain[0].count": 20})
    with scene.start() as world:
        world.step(200)
        before = world.walls()
        world.change({"container.rpm": -60})
        np.testing.assert_array_equal(world.walls().quaternion, before.quaternion)
        world.step(400)
        after = world.walls()
    np.testing.assert_allclose(before.angular_velocity[0], [0, 20 * 2 * np.pi / 60, 0], atol=1e-9)
    np.testing.assert_allclose(after.angular_velocity, np.tile([0, -2 * np.pi, 0], (3, 1)), atol=1e-9)
    angle = 2 * np.pi / 60 * (20 * 0.1 - 60 * 0.2)
    np.testing.assert_allclose(np.abs(after.quaternion[0]), np.abs([np.cos(angle / 2), 0, np.sin(angle / 2), 0]), atol=1e-12)
    np.testing.assert_allclose(after.position[0], before.position[0], atol=1e-12)


def test_parts_get_other_motions_and_forces():
    part = {
        "name": "paddle",
        "shape": "box",
        "size": [0.01, 0.1, 0.02],
        "position": [0.2, 0.2, 0.05],
        "motion": [{"kind": "velocity", "velocity": [0.1, 0.0, 0.0]}],
    }
    piston = {**part, "name": "piston", "position": [0.2, 0.2, 0.5], "drive": {"axis": [0, 0, 1], "force": 0.02, "mass": 0.01}}
    del piston["motion"]
    post = {**part, "name": "post", "position": [0.4, 0.4, 0.05]}
    del post["motion"]
    scene = free_scene(part=[part, piston, post])
    with scene.start() as world:
        world.step(100)
        world.change({"part[paddle].motion": [{"kind": "rotation", "axis": [0, 0, 1], "point": [0.21, 0.2, 0.05], "rpm": 30}]})
        world.change({"part[piston].drive.force": -0.02})
        world.step(100)
        walls = world.walls()
        paddle, piston = walls.name.index("paddle"), walls.name.index("piston")
        # From (0.21, 0.2, 0.05) on, where its own axis is.
        np.testing.assert_allclose(walls.position[paddle], [0.21, 0.2, 0.05], atol=1e-12)
        np.testing.assert_allclose(walls.angular_velocity[paddle], [0, 0, np.pi], rtol=1e-9)
        np.testing.assert_allclose(walls.velocity[piston], 0, atol=1e-9)  # 0.1 s of 2 m/s^2 up, and then down
        assert walls.position[piston, 2] == pytest.approx(0.5 + 2 * 0.1**2, rel=1e-6)
        for values, text in [
            ({"part[post].motion": [{"kind": "velocity", "velocity": [0.1, 0, 0]}]}, "stood at the start"),
            ({"part[paddle].size": [1, 1, 1]}, r"part\[paddle\].size is fixed during a run"),
            ({"part[0].motion[0].rpm": 1}, "there is no part"),
            ({"part[padle].motion": []}, "paddle"),
        ]:
            with pytest.raises(ValueError, match=text):
                world.change(values)
        np.testing.assert_array_equal(world.walls().position, walls.position)
        world.change({"part[paddle].motion": []})
        world.step(50)
        np.testing.assert_array_equal(world.walls().velocity[paddle], 0)
        world.change({"part[paddle].motion": [{"kind": "velocity", "velocity": [0, 0.1, 0]}]})  # it may move again
        world.step(100)
        np.testing.assert_allclose(world.walls().position[paddle] - walls.position[paddle], [0, 0.01, 0], atol=1e-12)


@pytest.mark.parametrize(
    "values, text",
    [
        ({"time.step": 1e-3}, "time.step is fixed during a run; allowed to change: friction, .*solver"),
        ({"seed": 2}, "seed is fixed"),
        ({"container.width": [0.1, 0.1]}, "container.width is fixed"),
        ({"gravity.acceleration": [0, 0, -1e9]}, r"acceleration = -1e\+09 m/s\^2 is outside \[-10000, 10000\] m/s\^2"),
        ({"friction.coeficient": 0.3}, "did you mean"),
        ({"friction.coefficient": "x"}, "friction.coefficient is the string"),
    ],
)
def test_what_cannot_change_is_refused_by_name(values, text):
    with scenes.Scene(SCENES / "short.toml").start() as world:
        world.step(20)
        before = world.grains()
        with pytest.raises(ValueError, match=text):
            world.change(values)
        np.testing.assert_array_equal(world.grains().position, before.position)
        world.step()


def test_bad_input_names_parameter_value_and_range():
    scene = scenes.Scene(SCENES / "short.toml")
    for call, error, text in [
        (lambda: scenes.Scene("missing.toml"), ValueError, "missing.toml"),
        (lambda: scenes.Scene(SCENES / "short.toml", {"time.step": 7}), ValueError, r"values: time.step=7: .*7; allowed: .*\(0, 0.5\]"),
        (lambda: scenes.Scene(SCENES / "short.toml", {"a=b": 7}), TypeError, "a=b"),
        (lambda: scenes.Scene(SCENES / "short.toml", {"seed": object()}), TypeError, "allowed: bool"),
        (lambda: scenes.Scene(SCENES / "short.toml", {"friction.coefficient": None}), TypeError, r"values\['friction.coefficient'\] is None"),
        (lambda: scenes.Scene(SCENES / "short.toml", {"a": {"b": [1, None]}}), TypeError, r"values\['a'\]\['b'\]\[1\] is None; allowed"),
        (lambda: scenes.Scene(SCENES / "short.toml", {"a": {1: 2}}), TypeError, r"values\['a'\] has the key 1; allowed: str"),
        (lambda: scenes.Scene.from_dict({"time": {"step": None}}), TypeError, r"tables\['time'\]\['step'\] is None"),
        (lambda: scenes.Scene(SCENES / "short.toml", [1]), TypeError, "allowed: a mapping"),
        (lambda: scenes.Scene.from_text("seed = ", folder=SCENES, name="x"), ValueError, "^the text, line 1: "),
        (lambda: scenes.Scene.from_text("", name="a/b"), ValueError, "name is 'a/b'"),
        (lambda: scenes.Scene.from_text(3), TypeError, "text is 3"),
        (lambda: scenes.Scene.from_dict({"seed": 1, "grains": 2}), ValueError, "unknown key"),
        (lambda: scene.start(threads=257), ValueError, "threads is 257; allowed: 0 to 256"),
        (lambda: scene.start(threads=1.5), TypeError, "threads is 1.5"),
        (lambda: scene.start(pictures=["vtk"]), TypeError, r"pictures is \['vtk'\]; allowed: True or False"),
        (lambda: scene.start(resume="no"), TypeError, "resume is 'no'; allowed: True or False"),
        (lambda: scene.start(checkpoint_every=10), ValueError, "checkpoint_every is 10 and out is None"),
        (lambda: scene.start(resume=True), ValueError, "resume is True and out is None"),
        (lambda: scene.start("/proc/none"), ValueError, "/proc/none"),
        (lambda: scene.start(""), ValueError, "out is ''; allowed: a folder"),
    ]:
        with pytest.raises(error, match=text):
            call()
    text = (SCENES / "short.toml").read_text()
    with pytest.raises(ValueError, match="checkpoint_every is 10"):
        scenes.Scene.from_text(text, folder=SCENES).start("out", checkpoint_every=10)
    with scene.start() as world:
        count = len(world.grains())
        for call, error, text in [
            (lambda: world.step(scene.steps + 1), ValueError, f"count is {scene.steps + 1}; allowed: 0 to {scene.steps}"),
            (lambda: world.step(-1), ValueError, "count is -1"),
            (lambda: world.step("x"), TypeError, "count is 'x'"),
            (lambda: world.step(True), TypeError, "count is True; allowed: an integer"),
            (lambda: world.set_forces(np.zeros((count, 3), complex)), ValueError, "forces: its numbers are complex; allowed: an array of"),
            (lambda: world.set_forces(np.zeros((2, 3))), ValueError, rf"forces has the shape \(2, 3\), but must have \({count}, 3\)"),
            (lambda: world.set_forces(np.zeros((count, 3)), [1.0]), ValueError, r"torques has the shape \(1\)"),
            (lambda: world.set_forces(np.full((count, 3), np.nan)), ValueError, r"forces\[0, 0\] is nan; allowed: from"),
            (lambda: world.set_forces(np.full((count, 3), 1e300)), ValueError, r"forces\[0, 0\] is 1e\+300; allowed: from"),
            (lambda: world.set_forces("none"), ValueError, "forces: "),
            (lambda: world.finish(), RuntimeError, "out is None"),
            (lambda: world.results, RuntimeError, "after finish"),
        ]:
            with pytest.raises(error, match=text):
                call()
        world.step()
    with scene.start("out", checkpoint_every=100) as world:
        for call in (lambda: world.change({"gravity.acceleration": [0, 0, 0]}), lambda: world.set_forces(np.zeros((count, 3)))):
            with pytest.raises(ValueError, match="checkpoint"):
                call()
        world.close()


def test_a_closed_world_refuses_everything():
    world = scenes.Scene(SCENES / "short.toml", NO_PICTURES).start("out", pictures=False)
    world.step(5)
    world.close()
    world.close()
    assert world.is_closed and "closed" in repr(world) and not pathlib.Path("out").exists()
    for call in (world.step, world.grains, world.contacts, world.walls, world.energy, world.finish, lambda: world.time):
        with pytest.raises(RuntimeError, match="the world was closed"):
            call()
    with pytest.raises(RuntimeError, match="closed"):
        world.set_forces(np.zeros((60, 3)))
    with pytest.raises(RuntimeError, match="closed"):
        world.change({"gravity.acceleration": [0, 0, 0]})


def test_a_finished_world_can_be_read_and_not_stepped():
    world = scenes.Scene(SCENES / "short.toml", NO_PICTURES).start("out")
    world.step(7)
    results = world.finish()
    assert tomllib.loads(results.summary)["run"]["steps"] == 7 and results.first_leak is None
    assert (results.folder / "summary.toml").read_text() == results.summary
    assert len(world.grains()) == 60
    for call in (world.step, world.finish):
        with pytest.raises(RuntimeError, match="the results are complete"):
            call()
    world.close()


def test_an_exception_in_a_with_block_leaves_no_results():
    with pytest.raises(ZeroDivisionError):
        with scenes.Scene(SCENES / "short.toml", NO_PICTURES).start("out") as world:
            world.step(3)
            1 / 0
    assert world.is_closed and not pathlib.Path("out").exists()


def test_an_error_of_a_run_closes_the_world():
    # The feeder finds no place in a region that is full.
    values = {**NO_PICTURES, "feeder[0].patience": 0.01, "feeder[0].kg_per_second": 5.0}
    with scenes.Scene(SCENES / "feeder.toml", values).start() as world:
        with pytest.raises(RuntimeError, match="feeder"):
            world.step(world.scene.steps)
        assert world.is_closed
        with pytest.raises(RuntimeError, match="ended with an error .*feeder"):
            world.step()


def test_grains_that_forces_make_too_fast_end_the_world():
    scene = free_scene()
    with scene.start() as world:
        with pytest.raises(ValueError, match=r"torques\[0, 1\] is 1e\+300; allowed: from -"):
            world.set_forces(np.zeros((1, 3)), [[0, 1e300, 0]])
        forces = 0.99e30 * world.grains().mass[:, None] / scene.time_step * [[1, 0, 0]]
        world.set_forces(forces)
        world.step()
        assert world.grains().velocity[0, 0] == pytest.approx(0.99e30)
        with pytest.raises(RuntimeError, match=r"grain 0 has the speed 1.98e\+30 m/s .* allowed: up to 1e\+30"):
            world.step(3)
        assert world.is_closed
    scenes.Scene(SCENES / "short.toml").start().close()


FAILING_ODE = """
#define _GNU_SOURCE
#include <dlfcn.h>
extern void dDebug(int, const char*, ...);
int dWorldQuickStep(void* world, double step) {
  static int calls;
  if (++calls == 5) dDebug(1, "call %d", calls);
  return ((int (*)(void*, double))dlsym(RTLD_NEXT, "dWorldQuickStep"))(world, step);
}
"""
USING_IT = """
import supernormal.scenes as scenes, sys
scene = scenes.Scene(sys.argv[1])
broken, other = scene.start(), scene.start()
other.step(2)
for call in (lambda: broken.step(9), broken.step, other.step, scene.start):
    try:
        call()
    except RuntimeError as error:
        print(error)
assert broken.is_closed and len(other.grains()) == 60
other.close()
"""


@pytest.mark.skipif(shutil.which("cc") is None or "LD_PRELOAD" in os.environ, reason="takes a C compiler, and to be loaded first")
def test_an_error_of_ode_itself_does_not_end_the_program():
    pathlib.Path("failing.c").write_text(FAILING_ODE)
    flags = ["-shared", "-fPIC", "-fexceptions", "-o", "failing.so", "failing.c", "-Wl,--no-as-needed", "-lode", "-ldl"]
    subprocess.run(["cc", *flags], check=True)
    command = [sys.executable, "-c", USING_IT, str(SCENES / "short.toml")]
    run = subprocess.run(command, env={**os.environ, "LD_PRELOAD": os.path.abspath("failing.so")}, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    lines = run.stdout.splitlines()
    assert lines[0] == "ODE: call 5" and "ended with an error (ODE: call 5)" in lines[1]
    assert lines[2:] == ["ODE has failed in this process; allowed: worlds in a new process"] * 2


def test_a_scene_with_query_runs_alone():
    plain = scenes.Scene(SCENES / "short.toml")
    query = scenes.Scene(SCENES / "short.toml", {"query": {"solver": "newton"}})
    with plain.start():
        with pytest.raises(RuntimeError, match=r"\[query\] of the scene"):
            query.start()
    with query.start() as world:
        with pytest.raises(RuntimeError, match=r"\[query\] of an open world"):
            plain.start()
        world.step(10)
    plain.start().close()


def test_one_thread_at_a_time():
    with scenes.Scene(SCENES / "short.toml", {"time.duration": 1}).start() as world:
        thread = threading.Thread(target=lambda: world.step(world.scene.steps))
        thread.start()
        with pytest.raises(RuntimeError, match="at work in another thread"):
            while thread.is_alive():
                world.step(0)
        thread.join()
        assert world.is_at_end


def test_ctrl_c_ends_a_call_after_a_step():
    with scenes.Scene(SCENES / "short.toml", {"time.duration": 60}).start() as world:
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            world.step(world.scene.steps)
        done = world.steps_done
        assert 0 < done < world.scene.steps
        world.step()
        assert world.steps_done == done + 1


def test_a_fork_cannot_use_the_world():
    with scenes.Scene(SCENES / "short.toml").start() as world:
        queue = multiprocessing.get_context("fork").SimpleQueue()

        def use():
            try:
                world.step()
            except RuntimeError as error:
                queue.put(str(error))

        process = multiprocessing.get_context("fork").Process(target=use)
        process.start()
        process.join(20)
        assert process.exitcode == 0
        world.step()


def in_fork(work):
    """What `work` returns in a fork of this process."""
    context = multiprocessing.get_context("fork")
    queue = context.SimpleQueue()
    process = context.Process(target=lambda: queue.put(work()))
    process.start()
    process.join(20)
    if process.is_alive():
        process.kill()
        pytest.fail("the fork hangs")
    assert process.exitcode == 0
    return queue.get()


def kinetic_after(steps):
    with scenes.Scene(SCENES / "short.toml").start(pictures=False) as world:
        world.step(steps)
        return world.energy().kinetic


@pytest.mark.parametrize("is_closed", [False, True])
def test_a_fork_may_drop_the_world_and_open_another(is_closed):
    world = scenes.Scene(SCENES / "short.toml").start(pictures=False)
    world.step(5)
    if is_closed:
        world.close()

    def work():
        nonlocal world
        del world
        return kinetic_after(20)

    assert in_fork(work) == kinetic_after(20)


def test_a_fork_beside_a_world_at_work_is_told():
    world = scenes.Scene(SCENES / "short.toml", {"time.duration": 60}).start(pictures=False)
    thread = threading.Thread(target=world.step, args=(2000,))
    thread.start()

    def work():
        try:
            kinetic_after(1)
        except RuntimeError as error:
            return str(error)

    for _ in range(100):
        said = in_fork(work)
        if said:
            break
    thread.join()
    assert "was forked while a world was at work; allowed: a fork between two calls" in said


def test_a_closed_world_keeps_no_thread():
    before = len(os.listdir("/proc/self/task"))
    worlds = [scenes.Scene(SCENES / "short.toml").start(threads=1, pictures=False) for _ in range(3)]
    assert len(os.listdir("/proc/self/task")) >= before + 3
    for world in worlds:
        world.close()
    assert len(os.listdir("/proc/self/task")) == before


def test_scenes_are_pickled_and_copied():
    scene = scenes.Scene(SCENES / "short.toml", {"seed": 7, "time.duration": 0.05})
    text = scenes.Scene.from_text((SCENES / "short.toml").read_text(), {"seed": 8}, folder=SCENES, name="eight")
    for one in (scene, text):
        for other in (pickle.loads(pickle.dumps(one)), copy.copy(one), copy.deepcopy(one)):
            assert (other.name, other.seed, other.steps) == (one.name, one.seed, one.steps)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map(repr, [scene]) == [repr(scene)]


@pytest.mark.parametrize(
    "ending",
    [
        "sys.exit(0)",
        "keep = scene.start(); keep.step()",
        "scene.start(); del scene",
        "import ode; o = ode.World(); world.close(); ode.World().step(0.1)",
        "threading.Thread(target=lambda: world.step(100000), daemon=True).start(); time.sleep(0.1)",
    ],
)
def test_the_interpreter_ends_with_open_worlds(ending):
    start = f"import sys, threading, time; import supernormal.scenes as s; scene = s.Scene({str(SCENES / 'short.toml')!r}, "
    program = f"{start}{{'time.duration': 60}}); world = scene.start(); world.step(3); {ending}"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    if "No module named 'ode'" in run.stderr:
        pytest.skip("python3-pyode is not installed")
    assert run.returncode == 0, run.stderr


def test_kinds_are_shapes_of_the_package():
    scene = scenes.Scene(SCENES / "mixture.toml")
    for kind in scene.kinds:
        if len(kind.components) > 1:
            continue
        ((shape, _),) = kind.components
        assert kind.density * shape.mass_properties().volume == pytest.approx(kind.mass, rel=1e-9)


def test_check_doubts_and_tables():
    scene = scenes.Scene(SCENES / "short.toml")
    assert "60 at the start" in scene.check()
    assert "energies.csv" in tomllib.loads(scene.tables())
    assert scene.doubts() == []
    with pytest.warns(UserWarning, match="step"):
        scenes.Scene(SCENES / "short.toml", {"time.step": 0.01, "time.frame": 0.01}).start().close()


def test_toml_reads_back():
    value = {"text": 'a "b" \\ \n\t\x7f é', "numbers": [1, 2.5, 1e-300], "truth": True, "array": np.arange(3.0), "one": np.float32(0.5)}
    read = tomllib.loads(f"value = {scenes.to_toml(value)}")["value"]
    assert read == {**value, "array": [0.0, 1.0, 2.0], "one": 0.5}
    with pytest.raises(TypeError):
        scenes.to_toml(None)
