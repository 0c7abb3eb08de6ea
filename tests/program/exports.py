"""Reads files that withy exports for other programs by means of these programs. tests/program/convert.rs calls it with a folder."""

import json
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

folder = Path(sys.argv[1])
expected = json.loads((folder / "expected.json").read_text())
frames = [
    (float(item.get("timestep")), folder / item.get("file"))
    for item in ET.parse(folder / "run.pvd").getroot().iter("DataSet")
]
assert [time for time, _ in frames] == expected["times"], frames


def same(points, angle, moment):
    assert np.array_equal(points[expected["last"]][:2], expected["position"]), points
    assert angle.shape == moment.shape == (len(points),)
    assert np.isfinite(angle).all() and np.isfinite(moment).all()


import meshio

mesh = meshio.read(frames[-1][1])
assert [cells.type for cells in mesh.cells] == ["line", "vertex"], mesh
same(mesh.points, mesh.point_data["angle"], mesh.point_data["M"])
assert mesh.point_data["velocity"].shape == mesh.points.shape

import pyvista

grid = pyvista.read(frames[-1][1])
same(grid.points, grid["angle"], grid["M"])
assert list(grid.celltypes[-2:]) == [3, 1] and list(grid.cell_data["body"][-2:]) == [0, 1]
reader = pyvista.get_reader(folder / "run.pvd")
assert list(reader.time_values) == expected["times"]
reader.set_active_time_value(reader.time_values[-1])
same(reader.read()[0].points, grid["angle"], grid["M"])

arrays = np.load(folder / "run.npz")
assert arrays["points.rod"].shape == (len(arrays["t"]), 7, 2)
assert np.array_equal(arrays["points.rod"][-1, -1], expected["position"])
assert arrays["history.energy"].shape == arrays["history.t"].shape

with open(folder / "run.csv", encoding="utf-8") as file:
    names, units = file.readline().strip().split(","), file.readline().strip().split(",")
assert dict(zip(names, units))["energy"] == "energy", units
table = np.loadtxt(folder / "run.csv", delimiter=",", skiprows=2)
assert np.array_equal(table[:, names.index("energy")], arrays["history.energy"])

if (folder / "run.parquet").exists():
    import pyarrow.parquet

    table = pyarrow.parquet.read_table(folder / "run.parquet")
    assert np.array_equal(table["energy"].to_numpy(), arrays["history.energy"])
    assert table.schema.metadata[b"dimension.energy"] == b"energy"
    print("parquet", end=" ")
print("meshio, pyvista and numpy read what was written")
