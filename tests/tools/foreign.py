"""Reads files of voxelize and overlap with the programs that they are for: a function for each, which returns what it finds."""


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


def with_openvdb_colours(path):
    import pyopenvdb
    grids = {grid.name: grid for grid in pyopenvdb.readAll(path)[0]}
    assert sorted(grids) == ["Cd", "tribox"] and grids["Cd"].transform == grids["tribox"].transform
    return {"cells": [item.min for item in grids["tribox"].citerOnValues()],
            "colours": [(item.min, item.value) for item in grids["Cd"].citerOnValues()],
            "middle": grids["Cd"].transform.indexToWorld((0, 0, 0))}


def with_vtk_faces(path):
    """Where the corners of each face are, and its colour."""
    from vtkmodules.vtkIOPLY import vtkPLYReader
    reader = vtkPLYReader()
    reader.SetFileName(path)
    reader.Update()
    assert not reader.GetErrorCode()
    found = reader.GetOutput()
    own, numbers = found.GetCellData().GetArray("RGB"), range(found.GetNumberOfCells())
    return {"faces": [[found.GetPoint(found.GetCell(n).GetPointId(k)) for k in range(3)] for n in numbers],
            "colors": [own.GetTuple(n) for n in numbers]}
