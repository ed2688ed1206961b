"""Latin hypercubes, Student's t, means with their intervals."""

import math
import pathlib
import shutil
import subprocess
import tempfile
import types
import unittest

import sweep_files  # noqa: F401  (the path)

from sweeps.collect import confidence_column, mean_and_interval
from sweeps.figure import SCRIPT, figure_data
from sweeps.latin_hypercube import latin_hypercube
from sweeps.student import central_probability, t_quantile


class LatinHypercube(unittest.TestCase):
    def test_each_stratum_of_each_dimension_has_one_number(self):
        for points in (1, 2, 7, 64):
            for column in zip(*latin_hypercube(points, 5, 3)):
                self.assertEqual(sorted(int(value * points) for value in column), list(range(points)))

    def test_it_is_the_same_everywhere(self):
        """Digits of Python's Mersenne Twister, which its documentation guarantees."""
        self.assertEqual(latin_hypercube(3, 2, 1), latin_hypercube(3, 2, 1))
        self.assertNotEqual(latin_hypercube(3, 2, 1), latin_hypercube(3, 2, 2))
        expected = [[0.921258206326, 0.262907783712], [0.418356341913, 0.697953195591], [0.165145029031, 0.342782492174]]
        self.assertEqual([[round(x, 12) for x in row] for row in latin_hypercube(3, 2, 1)], expected)

    def test_dimensions_are_not_correlated(self):
        sample = latin_hypercube(1000, 2, 4)
        covariance = sum((x - 0.5) * (y - 0.5) for x, y in sample) / 1000
        self.assertLess(abs(covariance * 12), 4 / math.sqrt(1000))


class Student(unittest.TestCase):
    def test_quantiles_are_those_of_the_tables(self):
        """Abramowitz and Stegun, table 26.10, with more digits from the closed forms of one and two degrees of freedom."""
        for confidence, freedom, expected in [
            (0.95, 3, 3.182),
            (0.95, 4, 2.776),
            (0.95, 10, 2.228),
            (0.99, 30, 2.750),
            (0.90, 120, 1.658),
            (0.999, 7, 5.408),
        ]:
            self.assertAlmostEqual(t_quantile(confidence, freedom), expected, delta=6e-4)

    def test_closed_forms(self):
        for confidence in (0.1, 0.5, 0.95, 0.9999):
            self.assertAlmostEqual(t_quantile(confidence, 1) / math.tan(math.pi * confidence / 2), 1, delta=1e-11)
            expected = confidence * math.sqrt(2 / (1 - confidence**2))
            self.assertAlmostEqual(t_quantile(confidence, 2) / expected, 1, delta=1e-11)

    def test_it_becomes_the_normal_distribution(self):
        self.assertAlmostEqual(central_probability(1.5, 100_000), math.erf(1.5 / math.sqrt(2)), delta=1e-5)


class Means(unittest.TestCase):
    def test_the_interval_is_students(self):
        mean, deviation, half_width = mean_and_interval([1.0, 2.0, 3.0, 6.0], 0.95)
        self.assertEqual(mean, 3)
        self.assertAlmostEqual(deviation, math.sqrt(14 / 3), delta=1e-12)
        self.assertAlmostEqual(half_width, 3.182446305284 * deviation / 2, delta=1e-9)

    def test_one_number_has_no_interval(self):
        self.assertEqual(mean_and_interval([2.5], 0.95), (2.5, None, None))


class Labels(unittest.TestCase):
    def test_they_stand_for_the_keys_of_lines_and_quantities(self):
        figure = {"x": "time.duration", "y": "volume_fraction"}
        sweep = types.SimpleNamespace(figure=figure, confidence=0.95)
        means = [{"time.duration": "2", "c.damping": "0.1", "volume_fraction_mean": "0.6", confidence_column(sweep, "volume_fraction"): ""}]
        self.assertIn('"volume_fraction"', figure_data(sweep, means))
        figure["y_label"] = "volume fraction"
        self.assertIn('"volume fraction"', figure_data(sweep, means))
        figure.update(lines="c.damping", lines_label="damping")
        self.assertEqual(figure_data(sweep, means), '"damping = 0.1"\n2.0 0.6 0\n')


@unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is missing")
class Figure(unittest.TestCase):
    def draw(self, half_width):
        with tempfile.TemporaryDirectory() as folder:
            data = pathlib.Path(folder, "figure.dat")
            data.write_text(f'"a = 1"\n1 2 0\n2 3 {half_width}\n\n\n"a = 2"\n1 3 0\n2 5 0\n', encoding="ascii")
            command = ["gnuplot", "-c", str(SCRIPT), str(data), "x", "y", "linear", "95"]
            return subprocess.run(command, capture_output=True, text=True, check=True).stdout

    def test_it_speaks_of_intervals_only_where_there_are_some(self):
        self.assertIn("95 % intervals of the mean", self.draw(0.5))
        self.assertNotIn("intervals", self.draw(0))


if __name__ == "__main__":
    unittest.main()
