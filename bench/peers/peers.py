"""Who is asked: a function each, which returns (its name, {question: (what answers, the way for a task)}), or raises ImportError.

A way is (a call, what is compared of its answer). Those in C++ are in peers.cc, compiled as they are needed, and take the time
themselves.
"""

import ctypes
import json
import os
import subprocess
import tempfile

import numpy as np

from asked import Timed, pairs_of, triangles_of

HERE, FOLDER, SLAB = os.path.dirname(os.path.abspath(__file__)), tempfile.TemporaryDirectory(), 32


def vtk():
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints, vtkSMPTools, vtkVersion
    from vtkmodules.vtkCommonDataModel import vtkBox, vtkCellArray, vtkCellLocator, vtkPolyData
    from vtkmodules.vtkFiltersExtraction import vtkExtractPolyDataGeometry
    from vtkmodules.vtkImagingHybrid import vtkVoxelModeller
    from vtkmodules.vtkImagingStencil import vtkImageStencilToImage, vtkPolyDataToImageStencil
    vtkSMPTools.Initialize(1)

    def made(task):
        points, cells, made_ = vtkPoints(), vtkCellArray(), vtkPolyData()
        points.SetData(numpy_to_vtk(task.vertices, deep=True))
        cells.SetData(3, numpy_to_vtk(task.faces.astype(np.int64).ravel(), deep=True, array_type=16))
        made_.SetPoints(points)
        made_.SetPolys(cells)
        return made_

    def run(filter_, task, **settings):
        """A call that runs it anew."""
        filter_.SetInputData(made(task))
        for name, value in settings.items():
            getattr(filter_, "Set" + name)(*value if isinstance(value, (list, tuple, np.ndarray)) else [value])

        def call():
            filter_.Modified()
            filter_.Update()
            return filter_.GetOutput()
        return call

    def cells_of(image):
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1]) > 0

    def stencil(task):
        def answer(found):
            image = vtkImageStencilToImage()
            image.SetInputData(found)
            image.SetOutputScalarTypeToUnsignedChar()
            image.Update()
            return cells_of(image.GetOutput())
        return run(vtkPolyDataToImageStencil(), task, Tolerance=0, OutputOrigin=task.middle(), OutputSpacing=task.grid.cell,
                   OutputWholeExtent=[n for size in task.grid.size for n in (0, size - 1)]), answer

    def modeller(task):
        filter_, first, size = vtkVoxelModeller(), task.middle(), np.array(task.grid.size)
        last = first + np.array(task.grid.cell) * (size - 1)
        filter_.SetScalarTypeToUnsignedChar()
        return run(filter_, task, SampleDimensions=task.grid.size, ModelBounds=np.stack([first, last], 1).ravel(),
                   MaximumDistance=1 / max(size)), cells_of

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
        filter_.ExtractBoundaryCellsOn()
        return run(filter_, task, ImplicitFunction=box), lambda part: triangles_of(
            vtk_to_numpy(part.GetPoints().GetData()), vtk_to_numpy(part.GetPolys().GetConnectivityArray()).reshape(-1, 3))

    return "VTK " + vtkVersion.GetVTKVersion(), {
        "surface": ("vtkVoxelModeller", modeller), "middles": ("vtkPolyDataToImageStencil", stencil),
        "index": ("vtkCellLocator", locator), "boxes": ("vtkCellLocator", boxes), "crop": ("vtkExtractPolyDataGeometry", crop)}


def openvdb():
    """The level set of a mesh: a distance in each cell near the surface, and a sign in all. It answers other questions."""
    import pyopenvdb

    def level_set(task, test):
        """The cells whose middle has a distance that passes the test."""
        transform = pyopenvdb.createLinearTransform(voxelSize=task.grid.cell[0])
        transform.translate(tuple(task.middle()))

        def answer(grid):
            nx, ny, nz = task.grid.size
            cells = np.empty((nz, ny, nx), bool)
            for i in range(0, nx, SLAB):
                slab = np.empty((min(SLAB, nx - i), ny, nz), np.float32)
                grid.copyToArray(slab, ijk=(i, 0, 0))
                cells[:, :, i:i + SLAB] = test(slab).T
            return cells
        return lambda: pyopenvdb.FloatGrid.createLevelSetFromPolygons(task.vertices, triangles=task.faces, transform=transform,
                                                                      halfWidth=1), answer

    return "OpenVDB " + ".".join(map(str, pyopenvdb.LIBRARY_VERSION)), {
        "surface": ("level set, half a diagonal",
                    lambda task: level_set(task, lambda d: np.abs(d) <= 0.75 ** 0.5 * task.grid.cell[0])),
        "middles": ("level set, inside", lambda task: level_set(task, lambda d: d < 0))}


def open3d():
    import open3d as o3d

    def made(task):
        return o3d.geometry.TriangleMesh(o3d.utility.Vector3dVector(task.vertices), o3d.utility.Vector3iVector(task.faces))

    def voxels(task):
        mesh, size, cell, first = made(task), np.array(task.grid.size), task.grid.cell[0], task.middle()  # cell 0 is about a bound

        def answer(grid):
            cells = np.zeros(size, bool)
            at = np.array([voxel.grid_index for voxel in grid.get_voxels()]).reshape(-1, 3)
            cells[tuple(at[(at < size).all(1)].T)] = True
            return cells.T
        make = o3d.geometry.VoxelGrid.create_from_triangle_mesh_within_bounds
        return lambda: make(mesh, cell, first, first + cell * size), answer

    def crop(task):
        mesh, box = made(task), o3d.geometry.AxisAlignedBoundingBox(task.lo, task.hi)
        return lambda: mesh.crop(box), lambda part: triangles_of(part.vertices, part.triangles)

    return "Open3D " + o3d.__version__, {"surface": ("VoxelGrid", voxels), "crop inside": ("crop", crop)}


def compiled(name, *flags):
    """NAME_cells of peers.cc, of a mesh and other numbers and arrays; the cells come last."""
    library = os.path.join(FOLDER.name, name + ".so")
    try:
        subprocess.run(["c++", "-O3", "-shared", "-fPIC", "-DPEER_" + name, os.path.join(HERE, "peers.cc"), "-o", library, *flags],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    except (OSError, subprocess.CalledProcessError):
        raise ImportError(name + " does not compile") from None
    cells_of = getattr(ctypes.CDLL(library), name + "_cells")
    cells_of.restype = ctypes.c_double

    def way(task, *arguments):
        cells = np.zeros(task.grid.size[::-1], np.uint8)
        vertices, faces = np.ascontiguousarray(task.vertices, np.float32), np.ascontiguousarray(task.faces, np.int32)
        kept = vertices, len(vertices), faces, len(faces), *arguments, cells
        raw = [n.ctypes.data_as(ctypes.c_void_p) if isinstance(n, np.ndarray) else n for n in kept]

        def call():
            cells.fill(0)
            taken = cells_of(*raw)
            if taken < 0:
                raise MemoryError
            return Timed(taken, taken)
        return call, lambda _, kept=kept: cells.view(bool)
    return way


def recast():
    """Spans of solid cells, columns along y."""
    way = compiled("recast", "-lRecast")

    def spans(task):
        lo, size = np.array(task.grid.origin), np.array(task.grid.size, np.int32)
        hi, areas = lo + np.array(task.grid.cell) * size, np.full(len(task.faces), 63, np.uint8)
        return way(task, areas, lo.astype(np.float32), hi.astype(np.float32), ctypes.c_float(task.grid.cell[0]), size)

    return "Recast", {"surface": ("rcRasterizeTriangles, spans", spans)}


def itk():
    """The filter from a mesh of triangles to the solid in an image."""
    libraries = "ITKCommon", "ITKMesh", "ITKTransform", "itkvnl_algo", "itkvnl", "itksys", "itkv3p_netlib"
    way = compiled("itk", "-I/usr/include/ITK-5.2", *(f"-l{name}-5.2" for name in libraries))
    return "ITK 5.2", {"middles": ("TriangleMeshToBinaryImageFilter", lambda task: way(
        task, task.middle(), ctypes.c_double(task.grid.cell[0]), np.array(task.grid.size, np.int32)))}


def bvh():
    """three-mesh-bvh, in a process of node that times itself."""
    node = ["node", "--no-deprecation", os.path.join(HERE, "bvh.cjs")]
    try:
        name = subprocess.check_output(node, text=True, stderr=subprocess.DEVNULL)
    except (OSError, subprocess.CalledProcessError):
        raise ImportError("node does not find it") from None

    def path(name):
        return os.path.join(FOLDER.name, name)

    def ways(task, question):
        for name, array in (("vertices", task.vertices), ("faces", task.faces), ("boxes", np.concatenate([task.los, task.his], 1))):
            array.tofile(path(name))
        return (lambda: Timed(*json.loads(subprocess.check_output([*node, FOLDER.name]))[question]),
                lambda _: pairs_of(*(np.fromfile(path(name), np.uint32) for name in ("numbers", "start"))))

    return name, {"index": ("MeshBVH", lambda task: ways(task, 0)), "boxes": ("shapecast", lambda task: ways(task, 1))}
