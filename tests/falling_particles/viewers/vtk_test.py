"""Reads the VTK files of runs with VTK's own reader and compares them with the trajectories.

vtk_test.py RUNS: the folder of the runs "box", "hopper", "cell" and "drum". Exit code 77: VTK is not there.
"""

import csv
import sys
import xml.etree.ElementTree
from pathlib import Path

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError:
    print("skipped: python3-vtk9 is not installed (tests/run viewers installs it)")
    sys.exit(77)


def read_series(path):
    """The times and the polygonal data of a .pvd file."""
    for entry in xml.etree.ElementTree.parse(path).iter("DataSet"):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(path.parent / entry.get("file")))
        reader.Update()
        assert reader.GetErrorCode() == 0, entry.get("file")
        yield float(entry.get("timestep")), reader.GetOutput()


def read_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def check_grains(run):
    """Every position and orientation equals the trajectory's, digit for digit."""
    rows = read_rows(run / "trajectory.csv")
    start = 0
    for time, data in read_series(run / "grains.pvd"):
        points = vtk_to_numpy(data.GetPoints().GetData())
        quaternions = vtk_to_numpy(data.GetPointData().GetArray("quaternion"))
        frame = rows[start : start + len(points)]
        start += len(points)
        assert all(float(row["time_s"]) == time for row in frame)
        for row, point, quaternion in zip(frame, points, quaternions, strict=True):
            assert list(point) == [float(row[name]) for name in ("x_m", "y_m", "z_m")]
            assert list(quaternion) == [float(row[name]) for name in ("qw", "qx", "qy", "qz")]
    assert start == len(rows)


def check_contacts(run, has_forces):
    counts = [int(row["contacts"]) for row in read_rows(run / "energies.csv")]
    found = [data for _, data in read_series(run / "contacts.pvd")]
    assert [data.GetNumberOfPoints() for data in found] == counts
    for data in found:
        normals = vtk_to_numpy(data.GetPointData().GetArray("normal"))
        assert all(abs((normals**2).sum(axis=1) - 1) < 1e-12) if len(normals) else True
        assert (data.GetPointData().GetArray("force") is not None) == has_forces


def check_container(run, first, last):
    """Numbers of polygons and lines of the container at the start and at the end."""
    frames = [data for _, data in read_series(run / "container.pvd")]
    assert len(frames) == len(read_rows(run / "energies.csv"))
    for data, counts in ((frames[0], first), (frames[-1], last)):
        assert (data.GetNumberOfPolys(), data.GetNumberOfLines()) == counts, (data.GetNumberOfPolys(), data.GetNumberOfLines())
    return frames


def check_parts(run):
    """The shell of the drum, the first part, has rotated as in the table. Its ends are discs, and it has a box inside."""
    sides, end_sides = 24, 64
    shell, end, box = (2 * sides, 2 * sides), (end_sides - 2, end_sides), (12, 12)
    drum = tuple(of_shell + 2 * of_end + of_box for of_shell, of_end, of_box in zip(shell, end, box, strict=True))
    frames = check_container(run, drum, drum)
    rows = [row for row in read_rows(run / "parts.csv") if row["part"] == "drum"]
    start = vtk_to_numpy(frames[0].GetPoints().GetData())[0]
    for row, data in zip(rows, frames, strict=True):
        w, y = float(row["qw"]), float(row["qy"])
        cos, sin = w * w - y * y, 2 * w * y
        x, z = start[0], start[2] - 0.04
        point = vtk_to_numpy(data.GetPoints().GetData())[0]
        assert abs(point[0] - (cos * x + sin * z)) < 1e-9 and abs(point[2] - 0.04 - (cos * z - sin * x)) < 1e-9


def main():
    runs = Path(sys.argv[1])
    for name in ("box", "hopper", "cell", "drum"):
        check_grains(runs / name)
        check_contacts(runs / name, has_forces=name == "box")
    check_container(runs / "box", (10, 12), (10, 12))
    sides = 24
    lid = (sides - 2, sides)
    hopper = (10 + 4 * sides, 12 + 3 * sides)
    check_container(runs / "hopper", (hopper[0] + lid[0], hopper[1] + lid[1]), hopper)
    cells = check_container(runs / "cell", (0, 12), (0, 12))
    width = [data.GetBounds()[1] for data in (cells[0], cells[-1])]
    assert width[0] == 0.1 and width[1] < 0.1
    check_parts(runs / "drum")
    print("VTK reads what the trajectories say")


main()
