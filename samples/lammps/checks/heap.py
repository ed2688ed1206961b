"""One heap in two engines: the cost of a second of the same grains with rigid and with soft contacts."""

import pathlib
import re
import resource
import subprocess
import tomllib

SCENE = pathlib.Path(__file__).resolve().parents[2] / "scenes/heap.toml"
SPRINGS = 5000  # N/m
FROM, TO = 0.2, 0.6  # fractions of the charge between which falling_particles measures the flow


def study(driver):
    """A hopper pours 900 soybeans on a dish: falling_particles, and LAMMPS on one rank."""
    program = driver.other_product("falling_particles")
    if program is None:
        raise SystemExit("the study heap takes falling_particles of samples/falling_particles in the same build")
    scene = tomllib.loads(SCENE.read_text())
    print("| contacts | step, s | deepest overlap at the end | angle of repose | flow, kg/s | processor time for a simulated second, s |")
    print("|---|---:|---:|---:|---:|---:|")
    summary, seconds = in_ode(program, driver.folder)
    charge = summary["discharge"]["charge"]
    print(row("rigid, by ODE", scene, scene["time"]["step"], summary, summary["discharge"]["mass_flow"], seconds), flush=True)
    step, frames, seconds = in_lammps(program, driver)
    soft, _ = in_ode(program, driver.folder / "soft", *after(driver.folder / "heap.lammpstrj"))
    print(row(f"springs of {SPRINGS} N/m, by LAMMPS", scene, step, soft, flow(frames, step, scene, charge), seconds), flush=True)


def row(name, scene, step, summary, rate, seconds):
    overlap, heap = summary["end"]["deepest_overlap_relative"], summary["heap"]
    angle, error = heap["angle_of_repose"], heap["angle_standard_error"]
    return f"| {name} | {step:.2g} | {100 * overlap:.2g} % | {angle:.1f} ± {error:.1f}° | {rate:.3f} | {seconds / scene['time']['duration']:.0f} |"


def in_ode(program, folder, *options):
    """The summary, and the processor time (s)."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, "-q", "-t", "1", "--no-pictures", "--scene", SCENE, "--out", folder, *options], check=True, stdout=subprocess.DEVNULL)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return tomllib.loads((folder / "heap/summary.toml").read_text()), seconds


def in_lammps(program, driver):
    """The step (s), the rows of all frames, and the processor time (s)."""
    soft = driver.folder / SCENE.name
    soft.write_text(soft_scene(), encoding="utf-8")
    subprocess.run([program, "--scene", soft, "--to-lammps", driver.folder], check=True)
    text = driver.output(str((driver.folder / "heap").resolve()))
    runs = re.findall(r"Loop time of (\S+) on .*?([\d.]+)% CPU use", text, re.DOTALL)
    step = float(re.search(r"^timestep (\S+)", (driver.folder / "heap.in").read_text(), re.MULTILINE)[1])
    return step, driver.dump("heap.lammpstrj"), sum(float(loop) * float(share) / 100 for loop, share in runs)


def soft_scene():
    """The scene with springs instead of the velocity limit of rigid contacts."""
    text = re.sub(r"\[max_correcting_velocity\][^\[]*", f"[compliance]\nstiffness = {SPRINGS}\ndamping = 1\n", SCENE.read_text(encoding="utf-8"))
    catalogue = SCENE.parent / tomllib.loads(text)["catalogue"]
    return re.sub(r"^catalogue = .*$", f'catalogue = "{catalogue}"', text, flags=re.MULTILINE)


def after(dump):
    """The options of a run of one tiny step after the end of a dump, which measures what LAMMPS has left."""
    values = [f'start.file="{dump.resolve()}"', "start.overlap=1", "container.opens_at=0", *(f"time.{key}=1e-9" for key in ("duration", "step", "frame"))]
    return [word for value in values for word in ("--set", value)]


def flow(frames, step, scene, charge):
    """The mean flow (kg/s) between the fractions FROM and TO of the charge (kg). Frames are interpolated."""
    clearance = scene["container"]["clearance"]
    out = [(number * step, sum(grain[4] < clearance for grain in rows) / len(rows)) for number, rows in sorted(frames.items())]
    return (TO - FROM) * charge / (time_when(out, TO) - time_when(out, FROM))


def time_when(out, share):
    for (before, less), (after, more) in zip(out, out[1:]):
        if less < share <= more:
            return before + (after - before) * (share - less) / (more - less)
    raise ValueError(f"{share:.0%} of the charge never ran out")
