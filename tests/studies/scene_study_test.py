"""The computations of the studies of scenes against closed forms; and every study fills its templates."""

import importlib.machinery
import importlib.util
import math
import pathlib
import sys
import tempfile
import tomllib
import unittest
from unittest import mock

STUDIES = pathlib.Path(__file__).resolve().parents[2] / "samples/studies"
sys.path.insert(0, str(STUDIES))
sys.dont_write_bytecode = True

import scene_study  # noqa: E402


def load(name, program="study"):
    """The program samples/studies/NAME/study, or another one there, as a module."""
    loader = importlib.machinery.SourceFileLoader(f"{program}_{name}", str(STUDIES / name / program))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


class Statistics(unittest.TestCase):
    def test_the_error_of_a_mean(self):
        values = [1.0, 2.0, 3.0, 4.0]
        self.assertAlmostEqual(scene_study.mean(values), 2.5)
        self.assertAlmostEqual(scene_study.deviation(values), math.sqrt(5 / 3))
        self.assertAlmostEqual(scene_study.standard_error(values), math.sqrt(5 / 3) / 2)

    def test_one_value_has_no_error(self):
        self.assertTrue(math.isnan(scene_study.standard_error([3.0])))

    def test_scatter_about_the_means_of_groups(self):
        self.assertAlmostEqual(scene_study.pooled_deviation([[1.0, 3.0], [10.0, 14.0], [5.0]]), math.sqrt((2 + 8) / 2))
        self.assertTrue(math.isnan(scene_study.pooled_deviation([[1.0], [2.0]])))

    def test_superballs_have_the_volume_of_the_sphere(self):
        self.assertAlmostEqual(scene_study.superball_half_axis(2, 6e-3), 3e-3)
        cube = (math.pi / 6) ** (1 / 3) * 6e-3 / 2
        self.assertAlmostEqual(scene_study.superball_half_axis(1e6, 6e-3), cube, delta=1e-8)
        octahedron = (math.pi / 6 / (4 / 3)) ** (1 / 3) * 6e-3
        self.assertAlmostEqual(scene_study.superball_half_axis(1, 6e-3), octahedron)


class Order(unittest.TestCase):
    def test_cubes_side_by_side(self):
        study = load("superball_compression")
        upright = study.axes(1, 0, 0, 0)
        self.assertAlmostEqual(study.cubatic_order([upright] * 5), 1)
        quarter = study.axes(math.sqrt(0.5), 0, 0, math.sqrt(0.5))
        self.assertAlmostEqual(study.cubatic_order([upright, quarter]), 1)

    def test_a_cube_turned_by_an_eighth_has_less(self):
        study = load("superball_compression")
        eighth = study.axes(math.cos(math.pi / 8), 0, 0, math.sin(math.pi / 8))
        # P4 of the pair: 1 of the common axis, 3/8 of it with four others, and (35/4 - 15 + 3)/8 of four at 45 degrees.
        pair = 1 + 4 * 3 / 8 + 4 * (35 / 4 - 15 + 3) / 8
        expected = math.sqrt((2 * 5.25 + 2 * pair) / 5.25) / 2
        self.assertAlmostEqual(study.cubatic_order([study.axes(1, 0, 0, 0), eighth]), expected)


class Heap(unittest.TestCase):
    def test_formula_of_zhou(self):
        self.assertAlmostEqual(load("plate_heap").published(0.2, 1, 1), 19.7, delta=0.05)
        # The exponents of rolling friction are 0.06 between spheres and 0.12 on walls.
        self.assertAlmostEqual(load("plate_heap").published(0.2, 0.25, 0.5), 19.67 * 0.25**0.06 * 0.5**0.12, delta=0.05)

    def test_slope_of_spheres_in_lammps(self):
        heap = load("plate_heap", "soft_spheres")
        rise = math.tan(math.radians(20))
        places = [(i * 1e-3, j * 1e-3) for i in range(121) for j in range(80)]
        spheres = [(side * x, y, 0.1 - rise * x) for x, y in places for side in (1, -1)]
        self.assertAlmostEqual(heap.slope(spheres, 1), 20, delta=0.1)
        self.assertAlmostEqual(heap.slope(spheres, -1), 20, delta=0.1)


class Rods(unittest.TestCase):
    def test_distances_of_segments(self):
        distance = load("rod_packings").segment_distance
        x, z = (1, 0, 0), (0, 0, 1)
        self.assertAlmostEqual(distance([0, 2, 0], z, x, 1), 2)  # crossed
        self.assertAlmostEqual(distance([0, 2, 0.5], z, z, 1), 2)  # side by side
        self.assertAlmostEqual(distance([0, 0, 5], z, z, 1), 3)  # end to end
        self.assertAlmostEqual(distance([0, 0, 3], z, x, 1), 2)  # end to side
        self.assertAlmostEqual(distance([4, 0, 4], z, x, 1), math.sqrt(9 + 9))  # end to end, across

    def test_rattlers_are_taken_away(self):
        study = load("rod_packings")
        five = [(i, j, 0.0) for i in range(5) for j in range(i)]  # each touches the four others
        hanging = [(5, 0, 0.0), (6, 0, 0.0), (6, 1, 0.0), (6, 5, 0.0)]
        self.assertAlmostEqual(study.coordination(five + hanging, 1e-3), 4)
        self.assertAlmostEqual(study.coordination(five, -1e-3), 0)

    def test_forces_that_do_not_balance(self):
        study = load("rod_packings")
        keys = ("grain1", "grain2", "normal_force_N", "normal_x", "normal_y", "normal_z")
        # Three rods in a row, of which the outer ones have nothing behind them.
        row = [dict(zip(keys, line)) for line in ((0, 1, 2.0, 1, 0, 0), (1, 2, 2.0, 1, 0, 0))]
        with mock.patch.object(study, "COUNT", 3):
            self.assertAlmostEqual(study.unbalanced_force(row), 1)
            self.assertAlmostEqual(study.unbalanced_force(row[:1] + [{**row[1], "normal_force_N": 1.0}]), 1 / 1.5)


class Hopper(unittest.TestCase):
    def test_the_flow_is_a_slope_in_grams_per_second(self):
        study = load("rectangular_hopper")
        # Steady from 0.25 to 0.75 s after the slot opens, and slower before and after.
        times = [study.OPENS + t / 20 for t in range(21)]
        lines = [{"time_s": t, "kg": 0.1 * t if 0.24 < t - study.OPENS < 0.76 else 0.0} for t in times]
        self.assertAlmostEqual(study.flow(lines, 0.25), 100)


class Health(unittest.TestCase):
    def test_the_frame_in_the_middle_of_those_with_contacts(self):
        with tempfile.TemporaryDirectory() as out:
            results = pathlib.Path(out) / "case_1"
            results.mkdir()
            end = "[end]\nsmallest_half_axis = 0.002\ndeepest_overlap_relative = 0.01\nbodies_leaked = 3\n"
            (results / "summary.toml").write_text(end)
            (results / "state.csv").write_text("time_s,deepest_contact_m\n0,0\n1,9e-4\n2,2e-5\n3,1e-5\n")
            at_end, leaked, in_median_frame, seconds = scene_study.health([results])
            self.assertEqual((at_end, leaked), (1, 3))
            self.assertAlmostEqual(in_median_frame, 1)
            self.assertTrue(math.isnan(seconds))  # of a run before they were kept
            scene_study.time_file(results).write_text("1.50\n")
            self.assertEqual(scene_study.health([results])[3], 1.5)


def first_scenes(study, out, *options):
    """The scene files that a study writes until it reads its first results, parsed."""
    module = load(study.parent.name)
    ran = []
    arguments = [str(study), "--seeds", "1", "--out", out, *options]
    with mock.patch.object(sys, "argv", arguments), mock.patch("builtins.print"):
        with mock.patch.object(scene_study.subprocess, "run", lambda command, **_: ran.append(command)):
            try:
                module.main()
            except FileNotFoundError:  # of the first results that it reads
                return {path.name: tomllib.loads(path.read_text()) for path in pathlib.Path(out).glob("*.toml")}
    raise AssertionError(f"{ran} left results")


class Scenes(unittest.TestCase):
    def test_every_study_fills_its_templates(self):
        for study in sorted(STUDIES.glob("*/study")):
            with self.subTest(study=study.parent.name), tempfile.TemporaryDirectory() as out:
                self.assertTrue(first_scenes(study, out))

    def test_the_ways_change_contacts_and_step_and_nothing_else(self):
        for study in sorted(STUDIES.glob("*/study")):
            with self.subTest(study=study.parent.name), tempfile.TemporaryDirectory() as out:
                plain = first_scenes(study, out)
                ahead = first_scenes(study, out, "--look-ahead", "--step-factor", "2.5")
                self.assertEqual(plain.keys(), ahead.keys())
                for name, scene in plain.items():
                    if "time" in scene:  # not a catalogue
                        for section in ("surface_layer", "max_correcting_velocity"):
                            scene.pop(section, None)
                        scene["speculative_contacts"] = {}
                        self.assertAlmostEqual(ahead[name]["time"]["step"], 2.5 * scene["time"].pop("step"))
                        ahead[name]["time"].pop("step")
                    self.assertEqual(scene, ahead[name])

    def test_each_way_has_its_folder(self):
        def folder(*options):
            with mock.patch.object(sys, "argv", ["study", *options]), mock.patch.object(pathlib.Path, "mkdir"):
                return str(scene_study.Study(STUDIES / "drum_exponents/study", "").out)

        self.assertEqual(folder(), "out/studies/drum_exponents")
        self.assertEqual(folder("--look-ahead"), "out/studies/drum_exponents_ahead")
        self.assertEqual(folder("--step-factor", "2"), "out/studies/drum_exponents_step2")
        self.assertEqual(folder("--look-ahead", "--step-factor", "0.5"), "out/studies/drum_exponents_ahead_step0.5")
        self.assertEqual(folder("--look-ahead", "--out", "here"), "here")


class Again(unittest.TestCase):
    def test_what_is_there_is_not_run_again(self):
        with tempfile.TemporaryDirectory() as out:
            arguments = ["study", "--seeds", "1", "--out", out]
            with mock.patch.object(sys, "argv", arguments):
                study = scene_study.Study(STUDIES / "drum_exponents/study", "")
            ran = []

            def run(command, **_):
                ran.append(command)
                results = pathlib.Path(out) / "case_1"
                results.mkdir(exist_ok=True)
                (results / "summary.toml").write_text(f"[run]\ninterrupted = {'true' if len(ran) == 2 else 'false'}\n")

            with mock.patch.object(scene_study.subprocess, "run", run), mock.patch("builtins.print"):
                study.run("case", 1, {"exponent": 2, "half_axis": 0.003})
                study.run("case", 1, {"exponent": 2, "half_axis": 0.003})
                self.assertEqual(len(ran), 1)
                study.run("case", 1, {"exponent": 3, "half_axis": 0.003})
                self.assertEqual(len(ran), 2)
                study.run("case", 1, {"exponent": 3, "half_axis": 0.003})  # since the one before was interrupted
                self.assertEqual(len(ran), 3)
                study.run("case", 1, {"exponent": 3, "half_axis": 0.003})
                self.assertEqual(len(ran), 3)


if __name__ == "__main__":
    unittest.main()
