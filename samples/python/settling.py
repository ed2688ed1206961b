"""Glass beads settle in a fluid whose drag is a function of Python: forces in, velocities out, every few steps.

    PYTHONPATH=build/release/lib/python /usr/bin/python3 samples/python/settling.py

A program for flows would take the place of `Fluid`. Each exchange takes the grains' poses and velocities and sets the forces and
torques until the next one.
"""

# %%
from __future__ import annotations

import dataclasses
import math
import pathlib
import tempfile
from typing import Callable, Sequence

import numpy as np
import numpy.typing as npt
import supernormal.scenes as scenes

Array = npt.NDArray[np.float64]
GRAVITY = 9.81  # m/s^2
GLASS = 2500.0  # kg/m^3


# %% The fluid at rest, and two laws of drag on spheres.
@dataclasses.dataclass(frozen=True)
class Fluid:
    density: float
    """kg/m^3"""
    viscosity: float
    """Pa s"""
    factor: Callable[[Array], Array]
    """Drag over Stokes' drag, of the Reynolds number."""

    def forces_on(self, grains: scenes.Grains) -> Array:
        """Drag and buoyancy, N."""
        diameter = np.cbrt(6 / math.pi * grains.volume)
        speed = np.linalg.norm(grains.velocity, axis=1)
        reynolds = self.density * speed * diameter / self.viscosity
        drag: Array = -3 * math.pi * self.viscosity * (diameter * self.factor(reynolds))[:, None] * grains.velocity
        drag[:, 2] += self.density * grains.volume * GRAVITY
        return drag

    def terminal_velocity(self, diameter: float, density: float) -> float:
        """m/s; the root of weight - buoyancy - drag, by fixed-point iteration from Stokes' law."""
        stokes = (density - self.density) * GRAVITY * diameter**2 / (18 * self.viscosity)
        speed = stokes
        for _ in range(200):
            speed = 0.5 * (speed + stokes / float(self.factor(np.array(self.density * speed * diameter / self.viscosity))))
        return speed


def stokes(reynolds: Array) -> Array:
    """Re << 1."""
    return np.ones_like(reynolds)


def schiller_naumann(reynolds: Array) -> Array:
    """Re < 800. (L. Schiller, A. Naumann, Z. Ver. Dtsch. Ing. 77 (1933) 318.)"""
    return 1 + 0.15 * reynolds**0.687


# %% Beads of some diameters (m), far apart. Their scene is a dictionary, and their catalogue a file of three lines each.
def scene_of_beads(folder: pathlib.Path, diameters: Sequence[float], duration: float, step: float) -> scenes.Scene:
    names = [f"bead_{number}" for number in range(len(diameters))]
    beads = {
        name: {"half_axes": [diameter / 2] * 3, "delta": 2, "epsilon": 2, "density": GLASS, "source": "glass"}
        for name, diameter in zip(names, diameters)
    }
    (folder / "beads.toml").write_text("".join(f"{name} = {scenes.to_toml(bead)}\n" for name, bead in beads.items()))
    tables = {
        "seed": 1,
        "catalogue": "beads.toml",
        "container": {
            "kind": "none",
            "start": {"corner": [0.0, 0.0, 0.0], "size": [1.0, 0.02, 0.02]},
            "bounds": {"corner": [-1.0, -1.0, -10.0], "size": [3.0, 2.0, 11.0]},
        },
        "part": [{"name": "bottom", "shape": "plane", "position": [0.0, 0.0, -9.0]}],
        "drop": {"height": 0.0, "gap": 1.0},
        "grain": [{"name": name, "count": 1} for name in names],
        "time": {"duration": duration, "step": step, "frame": duration},
        "solver": {"iterations": 20, "erp": 0.2, "cfm": 1e-10},
        "gravity": {"acceleration": [0.0, 0.0, -GRAVITY]},
    }
    return scenes.Scene.from_dict(tables, folder=folder, name="settling")


# %% The coupling. The drag of an exchange holds until the next. So the time between them must be below twice the relaxation time of the
# smallest bead, density diameter^2 / (18 viscosity).
def settle(scene: scenes.Scene, fluid: Fluid, steps_per_exchange: int) -> Array:
    """(exchanges, N); m/s, the velocities of fall after each exchange, in the order of the kinds."""
    velocities = []
    with scene.start() as world:
        order = np.argsort(world.grains().kind)  # the start shuffles them
        while not world.is_at_end:
            world.set_forces(fluid.forces_on(world.grains()))
            world.step(min(steps_per_exchange, scene.steps - world.steps_done))
            velocities.append(-world.grains().velocity[order, 2])
    return np.array(velocities)


# %%
CASES = {
    "Stokes, in glycerol": (Fluid(1260.0, 1.4, stokes), [1e-3, 2e-3, 3e-3], 0.02, 1e-5),
    "Schiller and Naumann, in water": (Fluid(998.0, 1e-3, schiller_naumann), [0.1e-3, 0.2e-3, 0.5e-3, 1e-3, 2e-3], 1.0, 1e-4),
}


def main() -> None:
    for name, (fluid, diameters, duration, step) in CASES.items():
        with tempfile.TemporaryDirectory() as folder:
            found = settle(scene_of_beads(pathlib.Path(folder), diameters, duration, step), fluid, 5)[-1]
        print(f"{name}: an exchange every 5 steps of {step:.2g} s")
        for diameter, speed in zip(diameters, found):
            wanted = fluid.terminal_velocity(diameter, GLASS)
            reynolds = fluid.density * speed * diameter / fluid.viscosity
            print(f"  {1e3 * diameter:.1f} mm: {1e3 * speed:9.4f} mm/s, Re {reynolds:.2g}, off by {speed / wanted - 1:.1e}")


if __name__ == "__main__":
    main()
