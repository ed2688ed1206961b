"""Runs and their results, with a scripted program and with falling_particles."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

from sweep_files import ENSEMBLE, PROGRAM, SCENES, SweepTest

from sweeps.quantity import NoValue, Quantity

# Writes the seed as a result and counts its starts. Fails, waits or is interrupted if a file beside the scene says so.
STUB = """#!{python}
import pathlib, sys, time
arguments = sys.argv[1:]
value = lambda option: arguments[arguments.index(option) + 1]
assert value("--threads") == "1" and "--no-pictures" in arguments
scene = pathlib.Path(value("--scene"))
seed = next(text[5:] for text in arguments if text.startswith("seed="))
with open(scene.parent / "starts", "a") as starts: starts.write(seed + "\\n")
with open(scene.parent / "sets", "a") as sets: sets.write(" ".join(text for text in arguments if "=" in text) + "\\n")
if (scene.parent / f"fail-{{seed}}").exists(): sys.exit("the reason")
out = pathlib.Path(value("--out")) / scene.stem
out.mkdir(parents=True, exist_ok=True)
while (scene.parent / f"wait-{{seed}}").exists(): time.sleep(0.01)
interrupted = (scene.parent / f"interrupt-{{seed}}").exists()
text = f"[run]\\nsteps = {{seed}}\\ninterrupted = {{str(interrupted).lower()}}\\n"
(out / "summary.toml").write_text(text)
if (scene.parent / "doubt").exists(): print(f'falling_particles: warning: "{{seed}}" is {{seed}} m, too far', file=sys.stderr)
if interrupted: sys.exit(130)
if (scene.parent / f"leak-{{seed}}").exists(): sys.exit(3)
"""


class RunTest(SweepTest):
    def setUp(self):
        super().setUp()
        self.stub = self.folder / "stub"
        self.stub.write_text(STUB.format(python=sys.executable))
        self.stub.chmod(0o755)
        self.sweep = self.write('seeds = 4\n[grid]\n"a" = [1, 2]')
        self.out = self.folder / "out"

    def command(self, *arguments, program=None):
        command, *rest = arguments
        given = [] if command in ("points", "collect") else ["--program", str(program or self.stub)]
        return [sys.executable, str(ENSEMBLE), command, str(self.sweep), "--out", str(self.out), *given, *map(str, rest)]

    def ensemble(self, *arguments, program=None):
        return subprocess.run(self.command(*arguments, program=program), capture_output=True, text=True, check=False)

    def start(self, *arguments, program=None):
        process = subprocess.Popen(
            self.command(*arguments, program=program), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def tell(self, name):
        (self.folder / name).touch()

    def starts(self):
        file = self.folder / "starts"
        return file.read_text().split() if file.exists() else []

    def wait_for(self, condition):
        end = time.monotonic() + 60
        while not condition():
            self.assertLess(time.monotonic(), end, "nothing came")
            time.sleep(0.01)

    def tables(self):
        return [(self.out / name).read_text() for name in ("points.csv", "means.csv")]


class Results(RunTest):
    def test_points_become_lines_and_means(self):
        self.assertEqual(self.ensemble("point", *range(8)).returncode, 0)
        done = self.ensemble("collect")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        points, means = self.tables()
        self.assertEqual(points, "a,seed,steps\n" + "".join(f"{a},{seed},{seed}\n" for a in (1, 2) for seed in (1, 2, 3, 4)))
        # Of 1, 2, 3, 4: 3.182446 sqrt(5/3) / 2 is half the width.
        self.assertEqual(
            means, "a,runs,steps_mean,steps_standard_deviation,steps_confidence_95\n1,4,2.5,1.29099,2.05426\n2,4,2.5,1.29099,2.05426\n"
        )

    def test_a_folder_with_the_results_of_another_sweep_is_refused(self):
        self.ensemble("point", 0)
        first, self.sweep = self.sweep, self.sweep.with_name("other.toml")
        shutil.copy(first, self.sweep)
        for command in (("run",), ("point", 0), ("collect",)):
            done = self.ensemble(*command)
            self.assertEqual((done.returncode, done.stderr.count(f"has the results of {first}")), (2, 1))
        first.unlink()
        self.assertEqual(self.ensemble("point", 0).returncode, 0)

    def test_a_doubt_of_runs_is_told_once_with_their_number(self):
        (self.folder / "doubt").touch()
        self.assertEqual(self.ensemble("point", *range(8)).returncode, 0)
        done = self.ensemble("collect")
        warning = 'ensemble: warning in 8 of 8 runs, here point 0 (a=1 seed=1): "1" is 1 m, too far\n'
        self.assertEqual((done.returncode, done.stderr), (0, warning))

    def test_what_has_a_result_is_not_run_again(self):
        self.ensemble("point", 0, 3)
        self.ensemble("point", *range(8))
        self.assertEqual(sorted(self.starts()), sorted("12341234"))

    def test_a_stride_takes_every_so_many_points(self):
        self.ensemble("point", 1, "--stride", 3)
        self.assertEqual(self.starts(), ["2", "1", "4"])

    def test_more_seeds_run_what_is_new(self):
        self.ensemble("point", *range(8))
        self.write('seeds = 5\n[grid]\n"a" = [1, 2]')
        self.ensemble("point", *range(10))
        self.assertEqual(self.starts()[8:], ["5", "5"])

    def test_another_scene_catalogue_or_quantity_is_run_again(self):
        self.ensemble("point", 0)
        catalogue = self.folder / "grains.toml"
        for change in (
            lambda: (self.folder / "scene.toml").write_text('seed = 2\ncatalogue = "grains.toml"\n'),
            lambda: catalogue.write_text("[pea]\n"),
            lambda: self.write('seeds = 4\n[grid]\n"a" = [1, 2]', collect='[[collect]]\nname = "s"\nsummary = "run.steps"\n'),
            lambda: self.write('seeds = 4\narguments = ["--check-leaks"]\n[grid]\n"a" = [1, 2]'),
            lambda: (self.folder / "scene.toml").write_text('seed = 2\ncatalogue = "grains.toml"\n[[part]]\nfile = "drum.stl"\n'),
            lambda: (self.folder / "drum.stl").write_text("solid"),
            lambda: self.stub.write_text(self.stub.read_text() + "# another program\n"),
        ):
            before = len(self.starts())
            change()
            self.assertEqual(self.ensemble("point", 0).returncode, 0)
            self.ensemble("point", 0)
            self.assertEqual(len(self.starts()), before + 1)

    def test_files_of_a_run_go_unless_they_are_to_stay(self):
        self.ensemble("point", 0)
        self.assertEqual(list((self.out / "runs").iterdir()), [])
        self.write("seeds = 1\nkeep = true")
        self.ensemble("point", 0)
        self.assertEqual(len(list((self.out / "runs").glob("*/scene/summary.toml"))), 1)

    def test_tables_give_means_of_the_last_part_and_of_chosen_lines(self):
        table = self.folder / "t.csv"
        table.write_text("time_s,slice,x\n" + "".join(f"{t},{s},{t * 10 + s}\n" for t in range(11) for s in (1, 2)))
        (self.folder / "v.csv").write_text("time_s,x\n0,1\n1,\n")
        quantity = Quantity("q", table="t.csv", column="x", last=0.2, where=(("slice", 2),))
        self.assertEqual(quantity.value(self.folder), 92)  # of times 8, 9, 10
        self.assertEqual(Quantity("q", table="t.csv", column="x").value(self.folder), 51.5)
        for wrong, says in (
            (Quantity("q", table="t.csv", column="y"), "t.csv has no column y; there are: time_s, slice, x"),
            (Quantity("q", table="t.csv", column="x", where=(("slice", 3),)), "no line, slice = 3"),
            (Quantity("q", table="u.csv", column="x"), "cannot read u.csv"),
            (Quantity("q", table="v.csv", column="x"), "v.csv, x, has a line without a number"),
        ):
            with self.assertRaises(NoValue) as caught:
                wrong.value(self.folder)
            self.assertIn(says, str(caught.exception))


class Starts(RunTest):
    """Sweeps whose points start from the end of a run before them."""

    def setUp(self):
        super().setUp()
        self.write('seeds = 2\n[start.set]\n"b" = 3\n[grid]\n"a" = [1, 2]')

    def sets(self):
        return (self.folder / "sets").read_text().splitlines()

    def test_each_seed_has_one_start_from_which_its_points_go_on(self):
        self.assertEqual(self.ensemble("point", *range(4)).returncode, 0)
        self.assertEqual(self.starts(), ["1", "1", "2", "2", "1", "2"])
        states = []
        for line, values in zip(self.sets(), ["b=3 seed=1", "a=1 seed=1", "b=3 seed=2", "a=1 seed=2", "a=2 seed=1", "a=2 seed=2"]):
            said, _, state = line.partition(" start.file=")
            self.assertEqual(said, values)
            states.append(state)
        starts = sorted((self.out / "runs").glob("*/scene"))  # those of points have gone
        self.assertEqual(len(starts), 2)
        self.assertEqual({states[1], states[3]}, {f'"{start.absolute()}/final_state.csv"' for start in starts})
        self.assertEqual([states[0], states[2], states[4], states[5]], ["", "", states[1], states[3]])
        self.assertEqual(self.tables_after_collect()[0], "a,seed,steps\n1,1,1\n1,2,2\n2,1,1\n2,2,2\n")

    def tables_after_collect(self):
        self.ensemble("collect")
        return self.tables()

    def test_another_start_or_scene_of_it_runs_the_points_again(self):
        (self.folder / "other.toml").write_text('seed = 1\ncatalogue = "grains.toml"\n')
        for text in ('[start.set]\n"b" = 3', '[start.set]\n"b" = 4', '[start]\nscene = "other.toml"'):
            self.write(f"seeds = 1\n{text}")
            before = len(self.starts())
            self.ensemble("point", 0)
            self.ensemble("point", 0)
            self.assertEqual(len(self.starts()), before + 2)
        (self.folder / "other.toml").write_text('seed = 2\ncatalogue = "grains.toml"\n')
        self.ensemble("point", 0)
        self.assertEqual(len(self.starts()), before + 4)

    def test_a_start_that_fails_is_told_and_run_again(self):
        self.tell("fail-1")
        done = self.ensemble("point", 0)
        self.assertEqual((done.returncode, done.stderr.strip()), (1, "point 0 (a=1 seed=1) FAILED: its start: exit code 1: the reason"))
        (self.folder / "fail-1").unlink()
        self.assertEqual(self.ensemble("point", 0).returncode, 0)
        self.assertEqual(self.starts(), ["1", "1", "1"])


class Failures(RunTest):
    def test_a_failed_point_is_named_and_the_others_finish(self):
        self.tell("fail-2")
        done = self.ensemble("point", *range(8))
        self.assertEqual(done.returncode, 1)
        self.assertEqual(sorted(self.starts()), sorted("12341234"))
        done = self.ensemble("collect")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.splitlines(), [f"point {i} (a={a} seed=2): exit code 1: the reason" for i, a in ((1, 1), (5, 2))])
        self.assertIn("6 of 8 points", done.stdout)
        self.assertIn("\n1,3,2.66666667,", self.tables()[1])

    def test_it_is_run_again_the_next_time(self):
        self.tell("fail-2")
        self.ensemble("point", 1)
        (self.folder / "fail-2").unlink()
        self.assertEqual(self.ensemble("point", *range(8)).returncode, 0)
        self.assertEqual(self.ensemble("collect").returncode, 0)

    def test_a_run_that_failed_after_its_results_is_no_result_the_next_time_either(self):
        self.tell("leak-2")
        for _ in range(3):
            self.assertEqual(self.ensemble("point", 1).returncode, 1)
        self.assertEqual(self.starts(), ["2"] * 3)
        done = self.ensemble("collect")
        self.assertIn("point 1 (a=1 seed=2): exit code 3: ", done.stderr)
        self.assertEqual(self.tables()[0], "a,seed,steps\n")

    def test_a_mistake_in_what_is_collected_loses_no_run(self):
        self.write("seeds = 4", collect='[[collect]]\nname = "s"\nsummary = "run.stps"\n')
        self.assertEqual(self.ensemble("point", *range(4)).returncode, 1)
        self.write("seeds = 4", collect='[[collect]]\nname = "s"\nsummary = "run.steps"\n')
        self.assertEqual(self.ensemble("point", *range(4)).returncode, 0)
        self.assertEqual(self.starts(), ["1", "2", "3", "4"])

    def test_a_signal_is_told(self):
        self.stub.write_text("#!/bin/sh\nkill -SEGV $$\n")
        self.assertIn("FAILED: signal 11: ", self.ensemble("point", 0).stderr)

    def test_no_summary_is_a_failure(self):
        self.stub.write_text("#!/bin/sh\n[ \"$1\" != --version ]\n")
        self.assertIn("FAILED: cannot read summary.toml: ", self.ensemble("point", 0).stderr)

    def test_a_number_that_is_not_there_is_a_failure(self):
        self.write("seeds = 1", collect='[[collect]]\nname = "s"\nsummary = "run.stps"\n')
        done = self.ensemble("point", 0)
        self.assertEqual(done.returncode, 1)
        self.assertIn('summary.toml has no run.stps; did you mean "steps"?; there are: steps, interrupted', done.stderr)

    def test_a_stdout_that_is_full_or_closed_is_told_once(self):
        for stdout in (">/dev/full", ">&-"):
            for arguments in (["--help"], ["run", "--help"], ["points", str(self.sweep)], ["collect", str(self.sweep), "--out", str(self.out)]):
                for unbuffered in ("", "1"):
                    environment = os.environ | {"PYTHONUNBUFFERED": unbuffered}
                    command = ["sh", "-c", f'exec "$@" {stdout}', "sh", sys.executable, str(ENSEMBLE), *arguments]
                    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
                    with self.subTest(arguments=arguments, stdout=stdout, unbuffered=unbuffered):
                        self.assertEqual(done.returncode, 1)
                        self.assertIn("ensemble: cannot write to stdout: ", done.stderr.splitlines()[-1])
        silent = subprocess.run(["sh", "-c", 'exec "$@" >&-', "sh", *self.command("point", 0)], capture_output=True, check=False)
        self.assertEqual(silent.returncode, 0)

    def test_bad_input_has_its_own_exit_status(self):
        for arguments, says in (
            (("point", 8), "there is no point 8"),
            (("point", 0, "--stride", "x"), "--stride"),
        ):
            done = self.ensemble(*arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(says, done.stderr)
        self.assertIn("there is no program", self.ensemble("point", 0, program="/nowhere").stderr)
        self.assertFalse(self.out.exists())


class Kills(RunTest):
    def test_a_kill_leaves_no_part_of_a_result(self):
        self.tell("wait-3")
        process = self.start("point", *range(8))
        self.wait_for(lambda: "3" in self.starts())
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        self.assertEqual(len(list((self.out / "results").iterdir())), 2)
        (self.folder / "wait-3").unlink()
        self.assertEqual(self.ensemble("point", *range(8)).returncode, 0)
        self.assertEqual(self.starts(), [*"123", *"34", *"1234"])

    def test_a_run_whose_parent_was_killed_is_waited_for_and_not_done_twice(self):
        self.tell("wait-1")
        process = self.start("point", 0)
        self.wait_for(lambda: "1" in self.starts())
        process.kill()
        process.wait()
        second = self.start("point", 0)
        time.sleep(0.5)
        self.assertIsNone(second.poll())
        self.assertEqual(self.starts(), ["1"])
        (self.folder / "wait-1").unlink()
        self.assertEqual(second.wait(), 0)
        self.assertEqual(self.starts(), ["1"])

    def test_an_interrupted_run_is_no_result(self):
        self.tell("interrupt-1")
        self.assertEqual(self.ensemble("point", 0).returncode, 1)
        (self.folder / "interrupt-1").unlink()
        self.assertEqual(self.ensemble("point", 0).returncode, 0)
        self.assertEqual(self.starts(), ["1", "1"])


class FallingParticles(RunTest):
    """Grains in a box, 2 x 2 runs of 0.1 s."""

    def setUp(self):
        super().setUp()
        text = 'seeds = 2\nset = {"time.duration" = 0.1}\n[grid]\n"friction.coefficient" = [0.1, 0.5]'
        collect = '[[collect]]\nname = "kinetic"\ntable = "energies.csv"\ncolumn = "kinetic_J"\nlast = 0\n'
        self.write(text, SCENES / "short.toml", collect + '[[collect]]\nname = "deepest"\nsummary = "collision.deepest_contact"\n')

    def test_killed_at_any_moment_it_ends_with_the_same_bytes(self):
        self.assertEqual(self.ensemble("point", *range(4), program=PROGRAM).returncode, 0)
        self.assertEqual(self.ensemble("collect").returncode, 0)
        expected = self.tables()
        self.assertEqual(len(set(expected[0].splitlines())), 5)
        self.out = self.folder / "killed"
        for moment in (0.1, 0.4, 0.7):
            process = self.start("point", *range(4), program=PROGRAM)
            time.sleep(moment)
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        self.assertEqual(self.ensemble("point", *range(4), program=PROGRAM).returncode, 0)
        self.assertEqual(self.ensemble("collect").returncode, 0)
        self.assertEqual(self.tables(), expected)

    def test_points_keep_the_bonds_of_their_start(self):
        # Bonds anew would be unstrained, and broken ones whole again.
        scene = self.folder / "bonded.toml"
        text = (SCENES / "beam.toml").read_text().replace('"../data', f'"{SCENES.parent}/data')
        scene.write_text(text)
        times = '"time.duration" = 0.02\n"time.frame" = 0.01\n'
        self.write(f"seeds = 1\nkeep = true\n[start.set]\n{times}[set]\n{times}", scene)
        done = self.ensemble("point", 0, program=PROGRAM)
        self.assertEqual(done.returncode, 0, done.stderr)
        tables = [path.read_text().splitlines() for path in (self.out / "runs").glob("*/bonded/bonds.csv")]
        self.assertEqual(len(tables), 2)
        unstrained, strained = sorted(tables, key=lambda lines: float(lines[1].split(",")[-1]))
        self.assertLess(float(unstrained[1].split(",")[-1]), 1e-20)
        self.assertAlmostEqual(float(strained[1].split(",")[-1]) / float(unstrained[-1].split(",")[-1]), 1, 6)

    def test_a_misspelt_column_or_table_is_refused_before_the_first_run(self):
        for collect, says in (
            ('table = "energies.csv"\ncolumn = "kinetik_J"', 'energies.csv has no column kinetik_J; did you mean "kinetic_J"?; there are: time_s, '),
            ('table = "energy.csv"\ncolumn = "kinetic_J"', "there is no energy.csv; did you mean"),
            ('table = "measurements/stress.csv"\ncolumn = "contact_xx"', 'has no column contact_xx; did you mean "contact_xx_Pa"?'),
            ('table = "energies.csv"\ncolumn = "kinetic_J"\nwhere = {slice = 1}', "energies.csv has no column slice"),
        ):
            scene = self.folder / "measured.toml"
            text = (SCENES / "short.toml").read_text().replace('"../data', f'"{SCENES.parent}/data')
            box = "lower = [0, 0, 0]\nupper = [0.05, 0.05, 0.05]\n"
            scene.write_text(text + f'[[measurement]]\nkind = "stress"\ninterval = 0.05\n{box}')
            self.write("seeds = 2", scene, f'[[collect]]\nname = "q"\n{collect}\n')
            done = self.ensemble("run", program=PROGRAM)
            self.assertEqual(done.returncode, 2)
            self.assertIn("sweep.toml: [[collect]] q: ", done.stderr)
            self.assertIn(says, done.stderr)
        self.assertFalse(self.out.exists())

    def test_a_key_that_the_scene_has_not_is_refused_before_the_first_run(self):
        self.write('[grid]\n"friction.coeficient" = [0.1, 0.2]', SCENES / "short.toml")
        done = self.ensemble("run", program=PROGRAM)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn('unknown key "coeficient" in [friction]; did you mean "coefficient"?', done.stderr)
        self.assertFalse(self.out.exists())

    def test_another_program_is_refused(self):
        done = self.ensemble("run", program="/bin/true")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("--program /bin/true is another program", done.stderr)
        self.assertFalse(self.out.exists())

    def test_arguments_that_are_none_of_a_run_are_refused_before_the_first_run(self):
        for arguments, says in (
            ('"--chek-leaks"', "--chek-leaks"),
            ('"--threads", "2"', "--threads"),
            ('"--checkpoint-every", "0"', "--checkpoint-every"),
            ('"--scene", "other.toml"', "--scene"),
            ('"--version"', "a run does not come of them"),
        ):
            self.write(f"seeds = 2\narguments = [{arguments}]", SCENES / "short.toml")
            done = self.ensemble("run", program=PROGRAM)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("sweep.toml: arguments is [", done.stderr)
            self.assertIn(says, done.stderr.split("]: ")[1])
        self.assertFalse(self.out.exists())

    def test_names_of_files_are_names_whatever_they_look_like(self):
        if shutil.which("parallel") is None:
            self.skipTest("GNU parallel is missing")
        for name in ("o{}x", "{= system 'touch PERL' =}", "{%} {#} {1}", "$HOME `id` 'a\" \\", "%A %%"):
            with self.subTest(name):
                folder = self.folder / name
                folder.mkdir()
                self.out = folder / "out"
                done = self.ensemble("run", "--jobs", 1, program=PROGRAM)
                self.assertEqual((done.returncode, done.stdout.splitlines()[-1][:6]), (0, "4 of 4"), done.stderr)
                self.assertEqual(sorted(path.name for path in folder.iterdir()), ["out"])
        self.assertFalse(pathlib.Path("PERL").exists())

    def test_a_text_of_any_characters_comes_to_the_scene(self):
        catalogue = self.folder / "k\U0001f600\u00e4\x7f.toml"
        catalogue.write_text((SCENES.parent / "data/grains.toml").read_text(encoding="utf-8"), encoding="utf-8")
        self.write(f'seeds = 1\nset = {{"time.duration" = 0.01, catalogue = "{self.folder}/k\U0001f600\u00e4\\u007f.toml"}}', SCENES / "short.toml")
        self.assertEqual(self.ensemble("point", 0, program=PROGRAM).returncode, 0)

    def test_a_value_that_the_scene_refuses_is_told_with_the_point(self):
        self.write('seeds = 1\nset = {"time.step" = -1}', SCENES / "short.toml")
        done = self.ensemble("point", 0, program=PROGRAM)
        self.assertEqual(done.returncode, 1)
        self.assertIn("point 0 (seed=1) FAILED: exit code 2: --set time.step=-1: time.step is -1; allowed: a number in (0, ", done.stderr)

    def test_a_run_tells_each_failed_point_once(self):
        if shutil.which("parallel") is None:
            self.skipTest("GNU parallel is missing")
        self.write('seeds = 2\ngrid = {"time.step" = [5e-4, -1]}', SCENES / "short.toml")
        done = self.ensemble("run", "--jobs", 1, program=PROGRAM)
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1][:6]), (1, "2 of 4"), done.stderr)
        self.assertEqual(done.stderr.count("exit code 2"), 2, done.stderr)
        self.assertEqual(self.ensemble("collect").stderr.count("exit code 2"), 2)


if __name__ == "__main__":
    unittest.main()
