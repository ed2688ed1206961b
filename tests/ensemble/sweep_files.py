"""Shared parts of the tests: samples/ensemble on the path, and sweep files in separate folders."""

import os
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ENSEMBLE = ROOT / "samples/ensemble/ensemble"
SCENES = ROOT / "samples/scenes"
PROGRAM = os.environ.get("FALLING_PARTICLES", str(ROOT / "build/release/samples/falling_particles/falling_particles"))
sys.path.insert(0, str(ENSEMBLE.parent))

COLLECT = '[[collect]]\nname = "steps"\nsummary = "run.steps"\n'


class SweepTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "scene.toml").write_text('seed = 1\ncatalogue = "grains.toml"\n')

    def write(self, text, scene="scene.toml", collect=COLLECT):
        """A sweep file. `text`: its first part, before the collected quantities."""
        path = self.folder / "sweep.toml"
        path.write_text(f'scene = "{scene}"\n{text}\n{collect}')
        return path

    def assert_says(self, error, *parts):
        text = str(error)
        self.assertNotIn("\n", text)
        for part in parts:
            self.assertIn(part, text)
