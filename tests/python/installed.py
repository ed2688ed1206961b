"""The installed package works, and loads no library but the installed one.

    installed.py PREFIX
"""

import pathlib
import sys

import supernormal as sn

PREFIX = pathlib.Path(sys.argv[1]).resolve()

assert pathlib.Path(sn.__file__).resolve().is_relative_to(PREFIX), sn.__file__
gap = sn.find_proximity(sn.Sphere(1), sn.Pose(), sn.Sphere(1), sn.Pose((3, 0, 0))).gap
assert abs(gap - 1) < 1e-12, gap
if (pathlib.Path(sn.__file__).parent / "ode.py").exists():  # not in a build of the core alone
    from supernormal import _ode

    assert _ode.geom_class() >= 0
loaded = {line.split()[-1] for line in pathlib.Path("/proc/self/maps").read_text().splitlines() if "supernormal" in line}
assert loaded and all(pathlib.Path(path).is_relative_to(PREFIX) for path in loaded), loaded
print(f"{len(loaded)} files of Supernormal are loaded, all from {PREFIX}")
