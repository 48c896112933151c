"""What the tests of engines share: a mesh, its cells in one piece, and the examples as commands that have to give the same."""

import functools
import glob
import os
import shutil
import subprocess
import sys

import numpy as np
import tribox

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "..", "examples", "engines")
sys.path.insert(0, EXAMPLES)
os.environ["PATH"] = f"{os.path.dirname(os.environ['TRIBOX_PROGRAM'])}:{os.environ['PATH']}"

import shards  # noqa: E402

LEFT_OUT = 77  # the exit code of a test that cannot run here
GRACE = 30  # seconds beyond its own limit after which a run hangs


def leave_out(why):
    print(f"left out: {why}", file=sys.stderr)
    sys.exit(LEFT_OUT)


def need(modules=(), programs=()):
    """Ends the test where a module or a program is missing."""
    for module in modules:
        try:
            __import__(module)
        except ImportError as error:
            leave_out(error)
    for program in programs:
        if not shutil.which(program):
            leave_out(f"there is no {program}")


def bumpy_sphere(rings):
    """2 * rings * 2 * rings triangles that are nowhere flat."""
    v, u = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1), indexing="ij")
    radius = 1 + 0.1 * np.sin(7 * u) * np.sin(5 * v) ** 2
    points = (radius * [np.sin(v) * np.cos(u), np.sin(v) * np.sin(u), np.cos(v)]).astype(np.float32).transpose(1, 2, 0)
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[:-1, 1:], points[1:, 1:]
    return np.concatenate([np.stack([a, b, d], 2).reshape(-1, 3, 3), np.stack([a, d, c], 2).reshape(-1, 3, 3)])


class Case:
    """A mesh in a file, and the cells that it should have."""

    def __init__(self, folder, rings, resolution):
        self.mesh = bumpy_sphere(rings)
        self.grid = tribox.grid_around(self.mesh, resolution)
        self.folder, self.path, self.resolution = folder, os.path.join(folder, "mesh.f32"), resolution
        self.mesh.tofile(self.path)

    @functools.cached_property
    def words(self):
        return tribox.voxelize(self.mesh, self.grid).words

    @functools.cached_property
    def ids(self):
        """Of all cells, -1 where there is none."""
        voxels = tribox.voxelize(self.mesh, self.grid, ids=True)
        cells = np.full(voxels.shape, -1, np.int32)
        cells[np.array(voxels)] = voxels.ids
        return cells


def flip(path, place):
    """Changes a bit of a file."""
    with open(path, "r+b") as file:
        file.seek(place)
        octet = file.read(1)[0]
        file.seek(place)
        file.write(bytes([octet ^ 1]))


class Engine:
    """An example as a command: where its answer appears, and which processes do its work."""

    needs, environment, numbers = {}, {}, (2,)  # numbers: of workers, to try
    has_ids = False

    def __init__(self, case, workers=2):
        self.case, self.path, self.workers = case, os.path.join(case.folder, self.out), workers
        self.jobs = self.path + ".jobs"

    def clear(self):
        """Removes what the last run left."""
        for name in os.listdir(self.case.folder):
            path = os.path.join(self.case.folder, name)
            if name.startswith(self.out):
                shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)

    def damage(self):
        """What a run may have left: the sorted mesh, of which a bit is another."""
        shards.take_up(self.jobs, self.case.path, *self.told())
        shards.sort(self.case.path, self.case.resolution, self.jobs)
        path = os.path.join(self.jobs, "tiles", "triangles")
        flip(path, os.path.getsize(path) // 2)

    def lies(self):
        """What whole files a run has left for the next."""
        return [path for end in ("tiles", "*.npz") for path in glob.glob(os.path.join(self.jobs, end))]


class Dask(Engine):
    """dask_zarr.py; its workers are processes that it starts."""

    needs = dict(modules=("dask.distributed", "zarr"))
    name, out, word, suits, numbers, shards = "dask", "out.zarr", "spawn_main", (40, 300), (0, 2), 8

    def __init__(self, case, workers=2):
        super().__init__(case, workers)
        self.environment = {"DASK_TEMPORARY_DIRECTORY": case.folder}

    def command(self, limit):
        return [sys.executable, os.path.join(EXAMPLES, "dask_zarr.py"), self.case.path, str(self.case.resolution), self.path,
                "--workers", str(self.workers), "--shards", str(self.shards), "--timeout", str(limit),
                *["--ids"] * self.has_ids]

    def told(self):
        return self.case.resolution, self.shards

    def is_right(self):
        import zarr
        return np.array_equal(zarr.open(self.path, mode="r")[:], self.case.ids if self.has_ids else self.case.words)


class Mpi(Engine):
    """mpi_bricks.py; its workers are the ranks."""

    needs = dict(modules=("mpi4py",), programs=("mpirun",))
    name, out, word, suits, numbers = "mpi", "out.npz", "mpi_bricks.py", (60, 600), (1, 3)
    environment = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}

    def command(self, limit):
        return ["mpirun", "--timeout", str(limit), "-n", str(self.workers), sys.executable, "-m", "mpi4py",
                os.path.join(EXAMPLES, "mpi_bricks.py"), self.case.path, str(self.case.resolution), self.path,
                *["--ids"] * self.has_ids]

    def told(self):
        return self.case.resolution, self.workers, "ranks"

    def is_right(self):
        bricks = tribox.Bricks.load(self.path)
        expected = tribox.bricks(self.case.mesh, self.case.grid, side=64 if self.has_ids else 128, ids=self.has_ids)  # as its tiles
        return all(np.array_equal(getattr(bricks, name), getattr(expected, name)) for name in ("at", "bits", "ids"))


ENGINES = {engine.name: engine for engine in (Dask, Mpi)}


def engine_of(name, folder, rings, resolution):
    """An engine that is ready; the test is left out where it cannot be."""
    need(**ENGINES[name].needs)
    return ENGINES[name](Case(folder, rings, resolution))


def start(engine, limit, log):
    """Starts the command in a group of its own, what it prints in a file."""
    return subprocess.Popen(engine.command(limit), stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
                            cwd=engine.case.folder, env={**os.environ, **engine.environment})
