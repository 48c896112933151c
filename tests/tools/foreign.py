"""Reads volumes with the programs that they are written for: foreign.py WITH FILE...

Prints a list with an object for each file: its size, its cells, where cell (0, 0, 0) begins and how long cells are, as far as the
file says so; or "missing" where the program is not there. Runs with Debian's Python, which has modules that others may lack.
"""

import json
import subprocess
import sys


def with_numpy(path):
    import numpy
    stored = numpy.load(path)
    if path.endswith(".npy"):
        assert stored.dtype == numpy.int32 and stored.ndim == 2 and stored.shape[1] == 3
        return {"cells": stored.tolist()}
    assert sorted(stored.files) == ["at", "bits", "cell", "origin", "shift", "size"]
    at, bits, size = stored["at"], stored["bits"], stored["size"]
    assert at.dtype == size.dtype == numpy.uint32 and at.shape == (len(bits), 3)
    assert bits.dtype == numpy.uint64 and bits.shape == (len(at), 8) and bits.any(axis=1).all()
    assert stored["origin"].dtype == stored["cell"].dtype
    rows = bits.astype("<u8").view(numpy.uint8).reshape(-1, 8, 8, 1)
    n, k, j, i = numpy.nonzero(numpy.unpackbits(rows, axis=-1, bitorder="little"))
    return {"cells": (8 * at[n].astype(int) + numpy.stack([i, j, k], 1)).tolist(), "size": size.tolist(),
            "origin": stored["origin"].astype(float).tolist(), "cell": stored["cell"].astype(float).tolist(),
            "shift": stored["shift"].tolist(), "type": str(stored["origin"].dtype)}


def with_openvdb(path):
    import pyopenvdb
    (grid,), _ = pyopenvdb.readAll(path)
    assert grid.name == "tribox" and all(value for value in (item.value for item in grid.citerOnValues()))
    cell, middle = grid.transform.voxelSize(), grid.transform.indexToWorld((0, 0, 0))
    return {"cells": [item.min for item in grid.citerOnValues() if item.min == item.max], "cell": cell, "middle": middle,
            "active": grid.activeVoxelCount(), "size": grid["size"], "lengths": grid["cell"], "begins": grid["origin"], "shift": grid["shift"]}


def with_vtk(path):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader
    reader = vtkXMLImageDataReader()
    reader.SetFileName(path)
    reader.Update()
    assert not reader.GetErrorCode()
    image = reader.GetOutput()
    nx, ny, nz = (n - 1 for n in image.GetDimensions())
    values = vtk_to_numpy(image.GetCellData().GetScalars())
    assert values.dtype == "uint8" and image.GetCellData().GetScalars().GetName() == "occupied" and set(values) <= {0, 1}
    return {"cells": [(int(n) % nx, int(n) // nx % ny, int(n) // nx // ny) for n in values.nonzero()[0]],
            "size": [nx, ny, nz], "cell": image.GetSpacing(), "origin": image.GetOrigin()}


def with_vtk_mesh(path):
    """How many edges are not of two triangles, and the volume."""
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    from vtkmodules.vtkIOGeometry import vtkGLTFReader, vtkOBJReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter
    reader = {"ply": vtkPLYReader, "obj": vtkOBJReader, "glb": vtkGLTFReader}[path[-3:]]()
    reader.SetFileName(path)
    surface = vtkCompositeDataGeometryFilter() if path.endswith("glb") else vtkGeometryFilter()
    edges, mass = vtkFeatureEdges(), vtkMassProperties()
    surface.SetInputConnection(reader.GetOutputPort())
    edges.FeatureEdgesOff()
    for after in (edges, mass):
        after.SetInputConnection(surface.GetOutputPort())
        after.Update()
    found = surface.GetOutput()
    return {"triangles": found.GetNumberOfCells(), "vertices": found.GetNumberOfPoints(),
            "edges": edges.GetOutput().GetNumberOfCells(), "volume": mass.GetVolume()}


def with_numpy_colours(path):
    """Cells and their colours."""
    import numpy
    stored = numpy.load(path)
    assert sorted(stored.files) == ["at", "bits", "cell", "colours", "origin", "shift", "size"]
    assert stored["colours"].dtype == numpy.uint8
    rows = stored["bits"].astype("<u8").view(numpy.uint8).reshape(-1, 8, 8, 1)
    n, k, j, i = numpy.nonzero(numpy.unpackbits(rows, axis=-1, bitorder="little"))
    cells = 8 * stored["at"][n].astype(int) + numpy.stack([i, j, k], 1)
    assert stored["colours"].shape == (len(cells), 3)
    return list(zip(cells.tolist(), stored["colours"].tolist()))


def with_openvdb_colours(path):
    import pyopenvdb
    grids = {grid.name: grid for grid in pyopenvdb.readAll(path)[0]}
    assert sorted(grids) == ["Cd", "tribox"] and grids["Cd"].transform == grids["tribox"].transform
    return {"cells": [item.min for item in grids["tribox"].citerOnValues()],
            "colours": [(item.min, item.value) for item in grids["Cd"].citerOnValues()],
            "middle": grids["Cd"].transform.indexToWorld((0, 0, 0))}


def with_openvdb_labels(path):
    import pyopenvdb
    grids = {grid.name: grid for grid in pyopenvdb.readAll(path)[0]}
    assert sorted(grids) == ["inside", "tribox"] and grids["inside"].transform == grids["tribox"].transform
    assert all(item.value for grid in grids.values() for item in grid.citerOnValues())
    return {name: [item.min for item in grid.citerOnValues() if item.min == item.max] for name, grid in grids.items()}


def with_vtk_colours(path):
    """The corners of each triangle, and its colour."""
    from vtkmodules.vtkIOPLY import vtkPLYReader
    reader = vtkPLYReader()
    reader.SetFileName(path)
    reader.Update()
    found = reader.GetOutput()
    colours = found.GetCellData().GetArray("RGB")
    return [([found.GetCell(n).GetPoints().GetPoint(c) for c in range(3)], [int(x) for x in colours.GetTuple(n)])
            for n in range(found.GetNumberOfCells())]


def with_vtk_faces(path):
    """Where the corners of each face are, and their colours where there are some."""
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
    reader = {"ply": vtkPLYReader, "obj": vtkOBJReader, "stl": vtkSTLReader}[path[-3:]]()
    if path.endswith("stl"):
        reader.MergingOff()
    reader.SetFileName(path)
    reader.Update()
    assert not reader.GetErrorCode()
    found, faces, colors = reader.GetOutput(), [], []
    rgb = found.GetPointData().GetArray("RGB")
    for n in range(found.GetNumberOfCells()):
        points = [found.GetCell(n).GetPointId(k) for k in range(found.GetCell(n).GetNumberOfPoints())]
        faces.append([found.GetPoint(p) for p in points])
        colors.append([rgb.GetTuple(p) for p in points] if rgb else None)
    return {"faces": faces, "colors": colors}


def with_teem(path):
    about = {}
    for line in subprocess.run(["teem-unu", "head", path], capture_output=True, check=True, text=True).stdout.splitlines():
        name, _, value = line.partition(": ")
        about[name] = value
    values = subprocess.run(["teem-unu", "data", path], capture_output=True, check=True).stdout
    nx, ny, nz = (int(n) for n in about["sizes"].split())
    assert about["type"] in ("uint8", "unsigned char") and about["encoding"] == "raw"
    assert len(values) == nx * ny * nz and set(values) <= {0, 1}
    vectors = [[float(x) for x in vector.strip("()").split(",")] for vector in about["space directions"].split()]
    assert all(vectors[a][b] == 0 for a in range(3) for b in range(3) if a != b)
    return {"cells": [(n % nx, n // nx % ny, n // nx // ny) for n, value in enumerate(values) if value], "size": [nx, ny, nz],
            "cell": [vectors[a][a] for a in range(3)], "middle": [float(x) for x in about["space origin"].strip("()").split(",")]}


def main():
    read = globals()["with_" + sys.argv[1]]
    try:
        found = [read(path) for path in sys.argv[2:]]
    except (ImportError, FileNotFoundError) as missing:
        found = "missing: %s" % missing
    print(json.dumps(found))


if __name__ == "__main__":
    main()
