"""The end of a program: its objects are destroyed, and a daemon thread in a call of the library does no harm."""

import subprocess
import sys

import pytest

# Between the ends of the interpreter and of the process the threads have time to do harm.
SETUP = """
import ctypes, threading, time
import numpy as np
import supernormal as sn
brick, egg, here, there = sn.Superellipsoid((1, 2, 3), 3, 4), sn.CallbackShape(lambda n: n), sn.Pose(), sn.Pose((3, 3, 3))
def work():
    while True:
        {call}
libc = ctypes.CDLL(None)
libc.__cxa_atexit(libc.usleep, 200_000, None)
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.3)
print("the end")
"""

CALLS = {
    "a batch": "sn.find_proximities(brick, here, sn.Sphere(1), sn.Poses(np.full((100_000, 3), 2.0)))",
    "a batch of functions": "sn.find_proximities(egg, here, sn.Sphere(1), sn.Poses(np.full((100_000, 3), 2.0)), threads=2)",
    "short batches": "sn.find_proximities(brick, here, sn.Sphere(1), sn.Poses(np.full((10, 3), 2.0)), threads=2)",
    "a pair": "sn.find_proximity(brick, here, sn.Sphere(1), there)",
    "a pair with a function": "sn.find_proximity(egg, here, brick, there)",
    "a ray": "sn.find_ray_hit(brick, here, (9, 0, 0), (-1, 0, 0))",
    "points": "brick.signed_distance(np.ones((100, 3)))",
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_a_daemon_thread(call):
    # Where the threads are when the interpreter ends is chance.
    for _ in range(3):
        run = subprocess.run([sys.executable, "-c", SETUP.format(call=call)], capture_output=True, text=True, timeout=60)
        assert (run.returncode, run.stdout) == (0, "the end\n"), run.stderr


def test_a_shape_of_functions_that_lives_to_the_end():
    program = "import supernormal as sn; egg = sn.CallbackShape(lambda n: n); pair = sn.Rounded(egg, 1); print('the end')"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert (run.returncode, run.stdout) == (0, "the end\n"), run.stderr
