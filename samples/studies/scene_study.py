"""Shared parts of the studies of scenes: write scenes from a template, run each with several seeds, and keep means with errors.

A run whose results are in place is not run again, so a study that was stopped goes on where it was, and more seeds cost only
themselves.
"""

import argparse
import csv
import math
import pathlib
import re
import resource
import statistics
import string
import subprocess
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/release/samples/falling_particles/falling_particles"


class Study:
    """Scenes with different `values` of run(), under `out/studies/<name>/`."""

    def __init__(self, folder, description, seeds=3):
        self.folder = pathlib.Path(folder).resolve().parent
        parser = argparse.ArgumentParser(description=description)
        parser.add_argument("--seeds", type=int, default=seeds, help="runs of each case, with seeds 1, 2, ... (%(default)s)")
        parser.add_argument("--out", type=pathlib.Path, help="out/studies/NAME without it, with the endings of the next two")
        parser.add_argument("--look-ahead", action="store_true", help="contacts before overlap; results in NAME_ahead")
        parser.add_argument("--step-factor", type=float, default=1, help="times the step; results in NAME_stepFACTOR")
        parser.add_argument("--program", type=pathlib.Path, default=PROGRAM)
        parser.add_argument("--match", default="", help="run only the cases whose names contain this; the table has all that are there")
        self.arguments = parser.parse_args()
        self.seeds = range(1, self.arguments.seeds + 1)
        self.out = self.arguments.out or pathlib.Path("out/studies") / (self.folder.name + way_of(self.arguments))
        self.out.mkdir(parents=True, exist_ok=True)

    def run(self, case, seed, values, template="scene.toml.in", catalogue="grains.toml.in"):
        """The folder with the results of one scene, or None if it was not run; `case` names it."""
        name = f"{case}_{seed}"
        values = {**values, "seed": seed, "catalogue": f"{name}.grains.toml"}
        texts = {
            self.out / f"{name}.toml": self.go_its_way(fill(self.folder / template, values)),
            self.out / f"{name}.grains.toml": fill(self.folder / catalogue, values),
        }
        results = self.out / name
        is_same = all(path.exists() and path.read_text() == text for path, text in texts.items())
        if is_same and is_complete(results):
            return results
        if self.arguments.match not in name:
            return None
        for path, text in texts.items():
            path.write_text(text)
        scene_file = self.out / f"{name}.toml"
        print(f"{name} ...", flush=True)
        command = [self.arguments.program, "--quiet", "--threads", "1", "--no-pictures", "--scene", scene_file, "--out", self.out]
        before = processor_time()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        time_file(results).write_text(f"{processor_time() - before:.2f}\n")
        return results

    def go_its_way(self, scene):
        """The text of a scene with the changes of --look-ahead and --step-factor."""
        if self.arguments.step_factor != 1:
            scene = at_step(scene, self.arguments.step_factor)
        return looking_ahead(scene) if self.arguments.look_ahead else scene

    def write(self, header, rows):
        """results.csv, a table on stdout and figure.svg by the study's plot.gp."""
        table = self.out / "results.csv"
        with table.open("w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(header)
            writer.writerows(rows)
        print("| " + " | ".join(header) + " |\n|" + "---|" * len(header))
        for row in rows:
            print("| " + " | ".join(format_cell(cell) for cell in row) + " |")
        figure = self.out / "figure.svg"
        with figure.open("wb") as file:
            subprocess.run(["gnuplot", "-c", self.folder / "plot.gp", table], check=True, stdout=file)
        print(f"{table}, {figure}")


def way_of(arguments):
    """The suffix of a folder for --look-ahead and --step-factor, so that runs with different options do not replace one another."""
    step = "" if arguments.step_factor == 1 else f"_step{arguments.step_factor:g}"
    return ("_ahead" if arguments.look_ahead else "") + step


def at_step(scene, factor):
    """Another time step. Everything else stays, so intervals must be multiples of the new step."""
    return re.sub(r"(?m)^step = (\S+)", lambda step: f"step = {factor * float(step[1]):g}", scene, count=1)


def looking_ahead(scene):
    """Contacts before overlap, in place of the two sections for plain contacts."""
    for section in ("surface_layer", "max_correcting_velocity"):
        scene = re.sub(rf"(?m)^\[{section}\]\n(.+\n)*\n?", "", scene)
    return scene + "\n[speculative_contacts]\n"


def processor_time():
    """s; of all programs that have run."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def time_file(results):
    """The file with the processor time of the run, beside the results, which the program replaces as a whole."""
    return results.with_name(results.name + ".processor_s")


def is_complete(results):
    """Whether there is a run that was not interrupted."""
    return (results / "summary.toml").exists() and not read_summary(results)["run"]["interrupted"]


def fill(template, values):
    return string.Template(template.read_text()).substitute(values)


def format_cell(cell):
    return f"{cell:.4g}" if isinstance(cell, float) else str(cell)


def read_table(path):
    """A CSV file as a list of dictionaries. Cells with numbers become numbers."""
    with path.open(newline="") as file:
        return [{key: to_number(cell) for key, cell in row.items()} for row in csv.DictReader(file)]


def to_number(cell):
    try:
        return float(cell)
    except ValueError:
        return cell or None


def read_summary(results):
    return tomllib.loads((results / "summary.toml").read_text())


HEALTH = ["deepest_overlap_percent", "leaked", "deepest_in_median_frame_percent", "processor_s"]


def health(runs):
    """Of all runs: the deepest overlap at the end relative to the smallest half-axis, the grains that have leaked, the deepest
    overlap in the median of the frames with contacts, and the mean processor time."""
    summaries = [read_summary(results) for results in runs]
    deepest = max(summary["end"]["deepest_overlap_relative"] for summary in summaries)
    leaked = sum(summary["end"]["bodies_leaked"] for summary in summaries)
    times = mean(float(time_file(results).read_text()) if time_file(results).exists() else math.nan for results in runs)
    return [100 * deepest, leaked, 100 * max(map(deepest_in_median_frame, runs)), times]


def deepest_in_median_frame(results):
    """The overlap of a moving bed, relative to the smallest half-axis, without the impacts of arriving grains."""
    depths = [line["deepest_contact_m"] for line in read_table(results / "state.csv")]
    return statistics.median(depth for depth in depths if depth > 0) / read_summary(results)["end"]["smallest_half_axis"]


def mean(values):
    values = list(values)
    return math.fsum(values) / len(values)


def standard_error(values):
    """The standard error of the mean of independent values; NaN for a single value."""
    values = list(values)
    if len(values) < 2:
        return math.nan
    m = mean(values)
    return math.sqrt(math.fsum((v - m) ** 2 for v in values) / (len(values) - 1) / len(values))


def deviation(values):
    values = list(values)
    return standard_error(values) * math.sqrt(len(values))


def pooled_deviation(groups):
    """The scatter of values about the means of their groups, taken as equal for all groups, because few seeds do not determine it for each group."""
    freedom = sum(len(group) - 1 for group in groups)
    if freedom == 0:
        return math.nan
    return math.sqrt(math.fsum((v - mean(group)) ** 2 for group in groups for v in group) / freedom)


def superball_half_axis(exponent, diameter):
    """The half-axis a of |x|^p + |y|^p + |z|^p = a^p with the volume of a sphere of this diameter, in its unit."""
    volume = 8 * math.gamma(1 + 1 / exponent) ** 3 / math.gamma(1 + 3 / exponent)
    return (math.pi / 6 / volume) ** (1 / 3) * diameter
