"""The program from outside: its sources of pairs, well-formed pictures, clear refusals."""

import os
import pathlib
import shlex
import stat
import subprocess
import threading
import xml.dom.minidom

import pytest
from conftest import ROOT, skip_without_runs

PROGRAM, FALLING_PARTICLES = os.environ["EXPLAIN_PAIR"], os.environ["FALLING_PARTICLES"]
SCENE = ROOT / "samples" / "scenes" / "short.toml"
ELLIPSOID = ("--body1", "ellipsoid 1 2 3")
CONCENTRIC = ("--case", "concentric: identical ellipsoids")


def run(*arguments, limit=()):
    return subprocess.run([*limit, PROGRAM, *map(str, arguments)], capture_output=True, text=True)


def draw(folder, *arguments):
    """Draws a picture that is well-formed and below 400 KB; what the program prints."""
    picture = folder / "pair.svg"
    ended = run(*arguments, "--out", picture)
    assert ended.returncode == 0, ended.stderr
    xml.dom.minidom.parse(str(picture))
    assert picture.stat().st_size < 400_000
    assert ended.stdout.startswith("hybrid ") and " gap " in ended.stdout.splitlines()[0]
    return ended.stdout


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """The options of the end of a run."""
    skip_without_runs()
    folder = tmp_path_factory.mktemp("run")
    command = [FALLING_PARTICLES, "-q", "--no-pictures", "--scene", SCENE, "--out", folder]
    subprocess.run(command, check=True, capture_output=True)
    trajectory = folder / "short" / "trajectory.csv"
    time = trajectory.read_text().splitlines()[-1].split(",")[0]
    return "--scene", SCENE, "--trajectory", trajectory, "--time", time


def test_help_and_list():
    assert "superovoid A B C DELTA EPSILON" in run("--help").stdout
    assert run("--list").stdout.count("\n") == 2 * 397


@pytest.mark.parametrize("option", ["--help", "--list"])
@pytest.mark.parametrize("stdout", [">/dev/full", ">&-"])
def test_a_stdout_that_is_full_or_closed_is_told_once(option, stdout):
    ended = subprocess.run(f"{shlex.quote(PROGRAM)} {option} {stdout}", shell=True, stderr=subprocess.PIPE, text=True)
    assert ended.returncode == 1
    assert ended.stderr == "explain_pair: cannot write to stdout (is it closed, or the disk full?)\n"


def test_described_bodies(tmp_path):
    boxy = ("--body2", "superellipsoid 1 1 1 8 8", "--position2", 2, -1, "-3e0")
    draw(tmp_path, *ELLIPSOID, *boxy, "--quaternion2", 0.8, 0, 0, -0.6, "--title", '<"&>')
    egg = ("--body2", "superovoid 1 1 1 2 2 0.1 -0.1", "--rounding2", 0.1, "--position2", -1.5, 0, 0)
    draw(tmp_path, *ELLIPSOID, *egg, "--certify")
    pair = ("--body1", "superellipsoid 1 2 3 4 3", *boxy)
    assert "\nsurface angles (2) " in draw(tmp_path, *pair, "--literature")
    alone = draw(tmp_path, *pair, "--literature", "surface angles (2)").splitlines()
    assert len(alone) == 4 and alone[3].startswith("surface angles (2) ")
    ended = run(*pair, "--literature", "surface angels (2)", "--out", tmp_path / "none.svg")
    assert ended.returncode == 2 and 'did you mean "surface angles (2)"?' in ended.stderr


def test_hard_cases(tmp_path):
    draw(tmp_path, "--case", "concentric: identical superellipsoids 8, 20")
    draw(tmp_path, "--case", "colliders: an ellipsoid above a box, gap -0.0625")


def test_grains_of_a_run(tmp_path, recorded):
    draw(tmp_path, *recorded, "--bodies", 7)
    draw(tmp_path, *recorded, "--bodies", 7, 8)


def test_a_png(tmp_path):
    assert run(*CONCENTRIC, "--out", tmp_path / "pair.png").returncode == 0
    assert (tmp_path / "pair.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    "text, arguments",
    [
        ("0 pairs are named; allowed: one", ()),
        ("2 pairs are named; allowed: one", (*ELLIPSOID, *CONCENTRIC)),
        ('--body2: "" is no kind of body; allowed: sphere, ellipsoid', ELLIPSOID),
        ('did you mean "concentric: identical ellipsoids"?', ("--case", "concentric: identical elipsoids")),
        ("--position2 has a nan; allowed: ", (*ELLIPSOID, "--body2", "sphere 1", "--position2", 0, "nan", 0)),
        ("--tolerance", (*ELLIPSOID, "--body2", "sphere 1", "--tolerance", 2)),
        ("--max-evaluations", (*ELLIPSOID, "--body2", "sphere 1", "--max-evaluations", 0)),
    ],
)
def test_refusals(tmp_path, text, arguments):
    refuse(tmp_path, text, *arguments)


def test_refusals_of_a_run(tmp_path, recorded):
    refuse(tmp_path, "is a device; allowed: a file", "--scene", SCENE, "--trajectory", "/dev/zero", "--time", 0, "--bodies", 1)
    refuse(tmp_path, "missing: --bodies", *recorded)
    refuse(tmp_path, "--bodies: there is no body 60; allowed: 0 to 59", *recorded, "--bodies", 60)
    refuse(tmp_path, "--bodies has 3 numbers; allowed: one or two", *recorded, "--bodies", 1, 2, 3)


def refuse(folder, text, *arguments):
    ended = run(*arguments, "--out", folder / "pair.svg")
    assert ended.returncode == 2
    assert text in ended.stderr.splitlines()[-1]
    assert list(folder.iterdir()) == []


def test_a_picture_that_cannot_be_written_leaves_what_was_there(tmp_path):
    ended = run(*CONCENTRIC, "--out", tmp_path / "missing" / "pair.svg")
    assert ended.returncode == 1 and "cannot write " in ended.stderr
    old = tmp_path / "old.svg"
    old.write_text("a user's")
    assert run(*CONCENTRIC, "--out", old, limit=("prlimit", "--fsize=1000")).returncode == 1
    assert old.read_text() == "a user's"
    assert list(tmp_path.iterdir()) == [old]


def test_what_is_no_file_is_written_as_it_is_and_stays(tmp_path):
    old, link, pipe, full = (tmp_path / name for name in ("old.svg", "link.svg", "pipe.svg", "full"))
    old.write_text("a user's")
    link.symlink_to("old.svg")
    assert run(*CONCENTRIC, "--out", link).returncode == 0
    assert link.is_symlink()
    xml.dom.minidom.parse(str(old))
    assert run(*CONCENTRIC, "--out", "/dev/full").returncode == 1
    assert pathlib.Path("/dev/full").is_char_device()
    os.mkfifo(pipe)
    read = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()))
    reader.start()
    assert run(*CONCENTRIC, "--out", pipe).returncode == 0
    reader.join()
    xml.dom.minidom.parseString(read[0])
    assert pipe.is_fifo()
    try:
        os.mknod(full, 0o600 | stat.S_IFCHR, os.makedev(1, 7))
    except PermissionError:
        return
    assert run(*CONCENTRIC, "--out", full).returncode == 1
    assert full.is_char_device()
