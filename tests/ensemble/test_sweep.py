"""Sweep files become points, and mistakes in them messages."""

import os
import tomllib
import unittest

from sweep_files import COLLECT, SCENES, SweepTest

from sweeps.errors import InputError
from sweeps.sweep import load_sweep
from sweeps.toml_text import toml_text


class Points(SweepTest):
    def assignments(self, text):
        sweep = load_sweep(self.write(text))
        return [" ".join(sweep.assignments(point)) for point in sweep.points]

    def test_a_scene_alone_is_one_point(self):
        self.assertEqual(self.assignments(""), [""])

    def test_a_grid_is_every_combination_and_seeds_change_fastest(self):
        self.assertEqual(
            self.assignments('seeds = 2\n[grid]\n"a.x" = [1, 2.5]\n"b" = ["u", true]'),
            [f"a.x={x} b={b} seed={seed}" for x in ("1", "2.5") for b in ('"u"', "true") for seed in (1, 2)],
        )

    def test_a_list_is_its_entries(self):
        self.assertEqual(self.assignments('[[list]]\na = 1\nb = [1, 2]\n[[list]]\nb = {c = 1e-3}\na = 2'), ["a=1 b=[1, 2]", 'a=2 b={"c" = 0.001}'])

    def test_seeds_are_the_named_ones(self):
        self.assertEqual(self.assignments("seeds = [7, 3]"), ["seed=7", "seed=3"])

    def test_settings_are_of_all_points(self):
        self.assertEqual(self.assignments('set = {"time.step" = 1e-3}\n[grid]\na = [1, 2]'), ["time.step=0.001 a=1", "time.step=0.001 a=2"])

    def test_a_start_has_its_own_values_and_the_seed_of_its_point(self):
        sweep = load_sweep(self.write('seeds = [7]\nset = {a = 1}\n[start.set]\nb = 2'))
        self.assertEqual(sweep.start.scene, sweep.scene)
        self.assertEqual(sweep.start_assignments(sweep.points[0]), ["b=2", "seed=7"])
        self.assertEqual(sweep.assignments(sweep.points[0]), ["a=1", "seed=7"])

    def test_grid_list_and_hypercube_are_combined(self):
        text = '[grid]\na = [1, 2]\n[[list]]\nb = 3\n[[list]]\nb = 4\n[latin_hypercube]\npoints = 5\nseed = 1\nranges = {c = {from = 0, to = 1}}'
        sweep = load_sweep(self.write(text))
        self.assertEqual(len(sweep.points), 2 * 2 * 5)
        self.assertEqual(sweep.parameters, ["a", "b", "c"])
        self.assertEqual([point.index for point in sweep.points], list(range(20)))

    def test_ranges_are_linear_logarithmic_or_whole(self):
        ranges = 'ranges = {lin = {from = 2, to = 3}, log = {from = 1e-4, to = 1, scale = "log"}, whole = {from = 1, to = 4, whole = true}}'
        sweep = load_sweep(self.write(f"[latin_hypercube]\npoints = 400\nseed = 5\n{ranges}"))
        lin, log, whole = ([point.values[key] for point in sweep.points] for key in ("lin", "log", "whole"))
        self.assertTrue(all(2 <= value <= 3 for value in lin))
        self.assertAlmostEqual(sum(lin) / 400, 2.5, delta=1e-3)
        self.assertEqual(sum(value < 1e-2 for value in log), 200)  # half of the strata are in the lower half of the decades
        self.assertEqual([whole.count(value) for value in (1, 2, 3, 4)], [100] * 4)
        self.assertTrue(all(type(value) is int for value in whole))

    def test_numbers_of_narrow_ranges_differ_and_stay_within(self):
        ranges = 'a = {from = 1, to = 1.0000001}, b = {from = 0.9999999, to = 1.00000001, scale = "log"}, c = {from = -1000.0001, to = -1000}'
        sweep = load_sweep(self.write(f"[latin_hypercube]\npoints = 500\nseed = 5\nranges = {{{ranges}}}"))
        for key, lower, upper in (("a", 1, 1.0000001), ("b", 0.9999999, 1.00000001), ("c", -1000.0001, -1000)):
            values = [point.values[key] for point in sweep.points]
            self.assertGreater(len(set(values)), 240)
            self.assertTrue(all(lower <= value <= upper for value in values))

    def test_a_text_reads_back_as_it_was(self):
        for text in ("\U0001f600", "\U0010ffff\ue000", "\x7f\x00\t\n", 'a"b\\', "{= 1 =}"):
            written = toml_text({text: text})
            self.assertTrue(written.isascii())
            self.assertEqual(tomllib.loads("a = " + written)["a"], {text: text})

    def test_the_samples_are_read(self):
        self.assertEqual(len(load_sweep(SCENES.parent / "ensemble/packing.toml").points), 64)
        self.assertEqual(len(load_sweep(SCENES.parent / "ensemble/short.toml").points), 12)
        for name in ("friction.toml", "friction_anew.toml"):
            self.assertEqual(len(load_sweep(SCENES.parent / "ensemble" / name).points), 32)

    def test_the_sweep_of_the_page_is_read(self):
        page = (SCENES.parent / "ensemble/README.md").read_text(encoding="utf-8")
        text = page.split("```toml\n")[1].split("```")[0].replace("../scenes", str(SCENES))
        path = self.folder / "page.toml"
        path.write_text(text)
        sweep = load_sweep(path)
        self.assertEqual(len(sweep.points), 2048)
        self.assertIn("16 × 2 × 16 × 4 = 2048 runs", " ".join(page.split()))
        self.assertEqual(sweep.slurm_options, ["--partition=long"])


class Mistakes(SweepTest):
    def complaint(self, text, **parts):
        with self.assertRaises(InputError) as caught:
            load_sweep(self.write(text, **parts))
        return caught.exception

    def test_each_names_the_file_the_key_and_what_is_allowed(self):
        for text, *parts in [
            ("seds = 3", 'sweep.toml: unknown key "seds"; did you mean "seeds"?; allowed: scene'),
            ("seeds = 0", "sweep.toml: seeds is 0; allowed: a number of seeds from 1"),
            ("seeds = [1, 1]", "seeds is [1, 1]; allowed:"),
            ("seeds = true", "seeds is True"),
            ("[grid]\na = [1, 2, 1]", '[grid] "a" has 1 twice; allowed: values that differ'),
            ("[[list]]\na = 1\nb = 2\n[[list]]\na = 1\nb = 2", "[[list]] has a = 1, b = 2 twice; allowed: entries that differ"),
            ("[grid]\na = 3", '[grid] "a" is 3; allowed: an array'),
            ("[grid]\na = []", '[grid] "a" is []'),
            ("[[list]]\na = 1\n[[list]]\nb = 1", "[[list]]: its entries have different keys"),
            ("list = []", "[[list]]"),
            ("set = {a = 1}\n[grid]\na = [1]", '"a" is set 2 times; allowed: once'),
            ("seeds = 2\n[grid]\nseed = [1]", '"seed" is set 2 times'),
            ("confidence = 1", "confidence is 1; allowed: a number in (0, 1)"),
            ("keep = 1", "keep is 1; allowed: true or false"),
            ("arguments = [1]", "arguments is [1]; allowed: an array of texts"),
            ("[latin_hypercube]\nseed = 1\nranges = {}", "points is missing"),
            ("[latin_hypercube]\npoints = 0\nseed = 1\nranges = {}", "points is 0; allowed: a whole number from 1"),
            ("[latin_hypercube]\npoints = 2\nseed = 1\nranges = {a = {from = 2, to = 1}}", 'ranges "a" goes from 2 to 1; allowed:'),
            ("[latin_hypercube]\npoints = 2\nseed = 1\nranges = {a = {from = 0, to = 1, scale = \"log\"}}", "scale = 'log'", "from 0"),
            ("[latin_hypercube]\npoints = 2\nseed = 1\nranges = {a = {form = 0, to = 1}}", 'unknown key "form"; did you mean "from"?'),
            ("[grid]\na = [1]\n[figure]\nx = \"b\"\ny = \"steps\"", "[figure]: x is 'b'; allowed: a"),
            ('[grid]\na = [1]\n[figure]\nx = "a"\ny = "steps"\nx_label = 1', '[figure]: x_label is 1; allowed: a text, such as "time, s"'),
            ("start = 1", "start is 1; allowed: a table with scene and set"),
            ("[start]\nsets = {}", 'unknown key "sets"; did you mean "set"?'),
            ('[start]\nscene = "none.toml"', "[start] scene: there is no file", "allowed: a scene file, its path relative to the sweep file"),
            ("[start.set]\na = 07:32:00", '[start] set "a" is or holds a date or time'),
            ("[start.set]\nseed = 1", "[start] set has seed; allowed: seeds of the sweep"),
            ('set = {"start.file" = "a.csv"}\n[start]', '"start.file" is set besides [start]; allowed: one of them'),
            ("[slurm]\noption = []", 'unknown key "option"; did you mean "options"?'),
            ("a = ", "allowed: valid TOML 1.0"),
            ("[grid]\na = [2024-01-01]", '[grid] "a" is or holds a date or time; allowed: numbers'),
            ("set = {a = [{b = 07:32:00}]}", '[set] "a" is or holds a date or time'),
            ("[[list]]\na = 9223372036854775808", '[[list]] "a" is or holds a whole number beyond 64 bits'),
            ('set = {"a=b" = 1}', "[set] has the key 'a=b'; allowed: a key of the scene"),
            ('set = {"a\\u0000" = 1}', "[set] has the key 'a\\x00'"),
            ('arguments = ["\\u0000"]', "without a zero character"),
            ("a = " + "[" * 100000, "nested too deeply"),
            ("[grid]\n" + "".join(f"a{i} = [1, 2, 3, 4, 5, 6, 7, 8, 9, 0]\n" for i in range(10)), "the sweep has 10000000000 points; allowed: up to 1000000"),
            ("seeds = 1000\n[grid]\na = [1, 2]\n[latin_hypercube]\npoints = 1000\nseed = 1\nranges = {b = {from = 0, to = 1}}", "has 2000000 points"),
            ("seeds = 10_000_000_000", "seeds is 10000000000; allowed"),
            *(
                (f"[latin_hypercube]\npoints = 100\nseed = 1\nranges = {{a = {{{limits}}}}}", f'ranges "a" {says}')
                for limits, says in (
                    ("from = 1, to = 1.0000000000000002", "goes from 1 to 1.0000000000000002, too narrow for 100 different numbers; allowed: a wider"),
                    ("from = 0.2, to = 0.8, whole = true", "goes from 0.2 to 0.8, between which there is no whole number"),
                    ("from = 0, to = 1e400", "goes from 0 to inf"),
                    ("from = 0, to = 99999999999999999999", "goes from 0 to 99999999999999999999"),
                    ('from = 1e-300, to = 1e299, scale = "log"', "has scale = 'log'"),
                    ("from = 2024-01-01, to = 2024-01-02", "goes from datetime.date(2024, 1, 1)"),
                )
            ),
        ]:
            with self.subTest(text):
                self.assert_says(self.complaint(text), *parts)

    def test_what_is_collected_is_checked(self):
        for collect, *parts in [
            ("", "collect is None; allowed: one or more [[collect]]"),
            ('[[collect]]\nname = "a"', "[[collect]] has name; allowed: name and summary, or name, table and column"),
            ('[[collect]]\nname = "a"\ntable = "t.csv"', "allowed: name and summary, or name, table and column"),
            ('[[collect]]\nname = "a"\nsummary = "s"\nlast = 0.5', "last and where are of a table"),
            ('[[collect]]\nname = "a"\ntable = "t"\ncolumn = "c"\nlast = 2', "a: last is 2; allowed: a number in [0, 1]"),
            ('[[collect]]\nname = "a"\nsumary = "s"', 'unknown key "sumary"; did you mean "summary"?'),
            (COLLECT + COLLECT, "names steps, steps; allowed: different ones"),
        ]:
            with self.subTest(collect):
                self.assert_says(self.complaint("", collect=collect), *parts)

    def test_a_pipe_is_not_waited_for(self):
        os.mkfifo(self.folder / "pipe.toml")
        for path in (self.folder / "pipe.toml", self.folder, "/dev/null"):
            with self.assertRaises(InputError) as caught:
                load_sweep(path)
            self.assert_says(caught.exception, "is a folder, a pipe or a device; allowed: a file")
        self.assert_says(self.complaint("", scene="pipe.toml"), "scene: there is no file")

    def test_files_that_are_not_there(self):
        self.assert_says(self.complaint("", scene="other.toml"), "scene: there is no file", "other.toml; allowed: a scene file")
        with self.assertRaises(InputError) as caught:
            load_sweep(self.folder / "none.toml")
        self.assert_says(caught.exception, "cannot read sweep file", "No such file")


if __name__ == "__main__":
    unittest.main()
