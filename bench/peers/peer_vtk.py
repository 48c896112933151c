"""VTK's ways."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints, vtkSMPTools, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkBox, vtkCellArray, vtkCellLocator, vtkPolyData
from vtkmodules.vtkFiltersExtraction import vtkExtractPolyDataGeometry
from vtkmodules.vtkImagingHybrid import vtkVoxelModeller
from vtkmodules.vtkImagingStencil import vtkImageStencilToImage, vtkPolyDataToImageStencil

from asked import pairs_of, triangles_of

NAME = "VTK " + vtkVersion.GetVTKVersion()
vtkSMPTools.Initialize(1)


def made(task):
    points, cells, made_ = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(task.vertices, deep=True))
    cells.SetData(3, numpy_to_vtk(task.faces.astype(np.int64).ravel(), deep=True, array_type=16))
    made_.SetPoints(points)
    made_.SetPolys(cells)
    return made_


def run(filter_):
    """A call that runs it anew."""
    def call():
        filter_.Modified()
        filter_.Update()
        return filter_.GetOutput()
    return call


def cells_of(image):
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1]) > 0


def stencil(task):
    filter_ = vtkPolyDataToImageStencil()
    filter_.SetInputData(made(task))
    filter_.SetTolerance(0)
    filter_.SetOutputOrigin(task.middle())
    filter_.SetOutputSpacing(task.grid.cell)
    filter_.SetOutputWholeExtent(*(n for size in task.grid.size for n in (0, size - 1)))

    def answer(found):
        image = vtkImageStencilToImage()
        image.SetInputData(found)
        image.SetOutputScalarTypeToUnsignedChar()
        image.Update()
        return cells_of(image.GetOutput())
    return run(filter_), answer


def modeller(task):
    filter_, first = vtkVoxelModeller(), task.middle()
    last = first + np.array(task.grid.cell) * (np.array(task.grid.size) - 1)
    filter_.SetInputData(made(task))
    filter_.SetSampleDimensions(*task.grid.size)
    filter_.SetModelBounds(*np.stack([first, last], 1).ravel())
    filter_.SetMaximumDistance(1 / max(task.grid.size))
    filter_.SetScalarTypeToUnsignedChar()
    return run(filter_), cells_of


def locator(task):
    mesh = made(task)

    def call():
        found = vtkCellLocator()
        found.SetDataSet(mesh)
        found.BuildLocator()
        return found
    return call, None


def boxes(task):
    tree, bounds = locator(task)[0](), np.stack([task.los, task.his], 2).reshape(-1, 6).tolist()
    lists = [vtkIdList() for _ in bounds]

    def call():
        for box, found in zip(bounds, lists):
            tree.FindCellsWithinBounds(box, found)
        return lists

    def answer(lists):
        numbers = [[found.GetId(k) for k in range(found.GetNumberOfIds())] for found in lists]
        return pairs_of(np.concatenate([[], *numbers]), np.cumsum([0, *map(len, numbers)]))
    return call, answer


def crop(task):
    filter_, box = vtkExtractPolyDataGeometry(), vtkBox()
    box.SetBounds(*np.stack([task.lo, task.hi], 1).ravel())
    filter_.SetInputData(made(task))
    filter_.SetImplicitFunction(box)
    filter_.ExtractBoundaryCellsOn()
    return run(filter_), lambda part: triangles_of(vtk_to_numpy(part.GetPoints().GetData()),
                                                   vtk_to_numpy(part.GetPolys().GetConnectivityArray()).reshape(-1, 3))


WAYS = {"surface": ("vtkVoxelModeller", modeller), "middles": ("vtkPolyDataToImageStencil", stencil),
        "index": ("vtkCellLocator", locator), "boxes": ("vtkCellLocator", boxes), "crop": ("vtkExtractPolyDataGeometry", crop)}
