"""Where pairs come from: the command line, a run, the hard cases."""

import re

import numpy as np
import pytest
from conftest import skip_without_runs
from pairs import HEAD, InputError, described_body, hard_case, recorded_pair

CATALOGUE = """[pea]
half_axes = [3e-3, 3e-3, 3e-3]
delta = 2
epsilon = 2
density = 1200
source = "typical"

[die]
half_axes = [6e-3, 6e-3, 6e-3]
delta = 8
epsilon = 8
rounding = 1e-3
density = 1190
source = "typical"
"""

SCENE = """seed = 7
catalogue = "grains.toml"
[container]
kind = "box"
width = [0.05, 0.06]
[drop]
height = 0.01
gap = 0.1
[[grain]]
name = "pea"
count = 5
# size
[[grain]]
name = "die"
count = 2
[time]
duration = 0.1
step = 0.0005
frame = 0.01
[solver]
iterations = 20
erp = 0.2
cfm = 1e-10
[surface_layer]
relative_depth = 0.002
[max_correcting_velocity]
velocity = 0.05
[gravity]
acceleration = [0, 0, -9.81]
[friction]
coefficient = 0.4
"""

TRAJECTORY = f"""{HEAD}
0,0,pea,0,0,0,1,0,0,0
0,1,pea,0.1,0,0,1,0,0,0
0,2,pea,0,0,0.05,1,0,0,0
0.5,0,pea,0,0,0.1,1,0,0,0
0.5,1,pea,0.02,0,0.1,0.6,0.8,0,0
0.5,2,pea,0,0,0.5,1,0,0,0
"""


def test_bodies_of_the_command_line():
    body = described_body("1", " superellipsoid  1 0.8 5e-1 2.5 8 ", 0.1)
    assert np.allclose(body.shape.half_extents, (1.1, 0.9, 0.6))
    assert body.description == "superellipsoid (1, 0.8, 0.5) m; 2.5, 8, rounded 0.1 m"
    assert described_body("1", "sphere 2", 0).shape.support((1, 0, 0)) == pytest.approx(2)
    for text in ("ellipsoid 1 2 3", "superovoid 1 1 1 2 2 0.1 -0.1", "box 1 2 3", "capsule 1 2", "cylinder 1 2"):
        assert described_body("2", text, 0).description.startswith(text.split()[0])


@pytest.mark.parametrize(
    "arguments, parts",
    [
        (("elipsoid 1 2 3", 0), ("--body2", '"elipsoid"', 'did you mean "ellipsoid"?', "cylinder", "allowed: ")),
        (("", 0), ("--body2", "superovoid", "allowed: ")),
        (("ellipsoid 1 2", 0), ("--body2", "has 2 numbers", "allowed: 3, A B C")),
        (("ellipsoid 1 2 3x", 0), ("--body2", '"3x" is not a number', "allowed: ")),
        (("ellipsoid 1 2 nan", 0), ("--body2", '"nan" is not a number', "allowed: ")),
        (("ellipsoid 1 2 3", -1), ("--rounding2 is -1", "allowed: a number in [0, 1e+30] m")),
        (("superellipsoid 1 1 1 2 0.5", 0), ("--body2", "0.5")),
        (("sphere 1", 0, (0, 0, 0), (1, 1, 0, 0)), ("--quaternion2", "1.41", "unit length", "allowed: ")),
        (("sphere 1", 0, (0, 1e200, 0)), ("--position2", "1e+200", "m", "allowed: ")),
    ],
)
def test_mistakes_in_bodies_are_named_with_what_is_allowed(arguments, parts):
    with pytest.raises(InputError) as refusal:
        described_body("2", *arguments)
    for part in parts:
        assert part in str(refusal.value)


def test_a_hard_case_by_its_name():
    pair = hard_case("concentric: identical ellipsoids")
    assert pair.title == "concentric: identical ellipsoids"
    assert tuple(pair.body2.shape.half_extents) == (1, 0.8, 0.5)
    with pytest.raises(InputError) as refusal:
        hard_case("concentric: identical elipsoids")
    for part in ("--case", "allowed: ", "397 names", "--list", 'did you mean "concentric: identical ellipsoids"?'):
        assert part in str(refusal.value)


class Run:
    """A run of the scene of the loader's tests."""

    def __init__(self, folder, trajectory=TRAJECTORY, size=""):
        skip_without_runs()
        (folder / "grains.toml").write_text(CATALOGUE)
        self.scene = folder / "scene.toml"
        self.scene.write_text(SCENE.replace("# size", size))
        self.trajectory = folder / "trajectory.csv"
        self.trajectory.write_text(trajectory)

    def pair(self, time, *bodies, overrides=()):
        return recorded_pair(str(self.scene), str(self.trajectory), time, bodies, overrides)

    def refusal(self, time, *bodies, overrides=()):
        with pytest.raises(InputError) as refusal:
            self.pair(time, *bodies, overrides=overrides)
        return str(refusal.value)


def test_two_grains_of_a_run_or_one_and_its_neighbour(tmp_path):
    run = Run(tmp_path)
    pair = run.pair(0.5, 0, 1)
    assert tuple(pair.body1.pose.position) == (0, 0, 0.1)
    assert tuple(pair.body2.pose.position) == (0.02, 0, 0.1)
    assert pair.body2.pose.rotation[2, 1] == pytest.approx(0.96)
    assert pair.body2.description.startswith("body 1: ")
    assert tuple(run.pair(0.5, 0).body2.pose.position) == (0.02, 0, 0.1)
    assert tuple(run.pair(0, 0).body2.pose.position) == (0, 0, 0.05)


def test_grains_keep_their_indices_when_others_go(tmp_path):
    run = Run(tmp_path, f"{HEAD}\n0,1,pea,0.1,0,0,1,0,0,0\n0,4,pea,0.2,0,0,1,0,0,0\n")
    pair = run.pair(0, 4)
    assert tuple(pair.body1.pose.position) == (0.2, 0, 0)
    assert pair.body2.description.startswith("body 1: ")
    assert re.search("no body 2; allowed: 1 to 4, without those that have gone", run.refusal(0, 2))


def test_the_size_of_a_grain_that_a_feeder_brought_is_not_known(tmp_path):
    rows = "0,0,pea,0,0,0,1,0,0,0\n0,7,die,0.1,0,0,1,0,0,0\n0,8,pea,0.2,0,0,1,0,0,0\n"
    run = Run(tmp_path, f"{HEAD}\n{rows}", 'size = { distribution = "uniform", smallest = 5e-3, largest = 7e-3 }')
    pair = run.pair(0, 0, 7)
    assert tuple(pair.body2.pose.position) == (0.1, 0, 0)
    assert 2.5e-3 <= pair.body1.shape.half_extents[0] <= 3.5e-3
    for bodies in ((0, 8), (0,)):  # in the latter it might be the neighbour
        text = run.refusal(0, *bodies)
        assert "body 8: pea" in text and "does not tell its size" in text and "allowed: " in text


def test_a_run_that_was_given_other_values_than_the_scenes(tmp_path):
    run = Run(tmp_path)
    assert tuple(run.pair(0.5, 0, 1, overrides=["grain[pea].count=3"]).body1.pose.position) == (0, 0, 0.1)
    assert "counts" in run.refusal(0.5, 0, 1, overrides=["grain[pea].counts=3"])


def test_mistakes_in_a_run_are_named_with_what_is_allowed(tmp_path):
    run = Run(tmp_path)
    for arguments, text in (
        ((0.4, 0, 1), "--time is 0.4; allowed: .*0.5 s is the nearest"),
        ((0.5, 3), "--bodies: there is no body 3; allowed: 0 to 2"),
        ((0.5, 1, 1), "--bodies: .*allowed: two different bodies"),
    ):
        assert re.search(text, run.refusal(*arguments))


@pytest.mark.parametrize(
    "trajectory, text",
    [
        ("", "cannot read"),
        ("time,x\n", "trajectory.csv:1: "),
        (f"{HEAD}\n", "has no frames"),
        (f"{HEAD}\n0,0,pea,0,0\n", "trajectory.csv:2: the line has not the 10 columns"),
        (f"{HEAD}\n0,0,pea,0,0,x,1,0,0,0\n", 'trajectory.csv:2: "x" is not a number'),
        (f"{HEAD}\n0,0.5,pea,0,0,0,1,0,0,0\n", 'trajectory.csv:2: "0.5" is not a number'),
        (f"{HEAD}\n0,0,pea,0,0,0,2,0,0,0\n", "trajectory.csv:2: the quaternion has the length 2"),
        (f"{HEAD}\n0,0,stone,0,0,0,1,0,0,0\n0,1,stone,0,0,1,1,0,0,0\n", 'a grain "stone"'),
    ],
)
def test_a_broken_trajectory_is_refused(tmp_path, trajectory, text):
    assert text in Run(tmp_path, trajectory).refusal(0, 0, 1)


def test_without_the_program_that_reads_scenes_the_message_names_it(tmp_path, monkeypatch):
    missing = str(tmp_path / "scene_grains")
    monkeypatch.setenv("EXPLAIN_PAIR_GRAINS", missing)
    with pytest.raises(InputError) as refusal:
        recorded_pair("scene.toml", "trajectory.csv", 0, (0, 1))
    assert missing in str(refusal.value) and "EXPLAIN_PAIR_GRAINS" in str(refusal.value)
