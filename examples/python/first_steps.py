# %% [markdown]
# From a mesh to cells, step by step: a script, which editors also show as a notebook. It writes its files where it is started.

# %% A mesh: any file that tribox reads. Here it is a torus with a colour for each face, made on the spot.
import numpy as np
import tribox

v, u = (axis.ravel() for axis in np.mgrid[0:30, 0:60])
turn, round_ = 2 * np.pi * u / 60, 2 * np.pi * v / 30
out = 1 + 0.4 * np.cos(round_)
points = np.stack([out * np.cos(turn), out * np.sin(turn), 0.4 * np.sin(round_)], 1)
right, up = 60 * v + (u + 1) % 60, 60 * ((v + 1) % 30) + u
faces = np.stack([60 * v + u, right, 60 * ((v + 1) % 30) + (u + 1) % 60, up], 1)
colors = np.where((u // 5 % 2 == 0)[:, None], (230, 90, 40), (40, 110, 220))
with open("torus.off", "w", encoding="ascii") as file:
    print("OFF", len(points), len(faces), 0, file=file)
    np.savetxt(file, points, "%.6f")
    np.savetxt(file, np.column_stack([np.full(len(faces), 4), faces, colors]), "%d")

mesh = tribox.read("torus.off")
print(mesh)

# %% Which of its triangles overlap a box? And the cells of a grid that it overlaps, each in the colour of its triangle.
print(tribox.overlap(mesh, (0, 0, -1), (1, 1, 1)).sum(), "triangles overlap the box")
voxels = tribox.voxelize(mesh, resolution=128, colors=True, threads=0)
print(voxels)

# %% With what it encloses: labels are 1 on the surface and 2 inside.
solid = tribox.voxelize(mesh, voxels.grid, fill="outside", labels=True)
print(dict(zip(("outside", "surface", "inside"), np.bincount(solid.labels().ravel()).tolist())))

# %% Operators and slices of Voxels are Voxels: what the upper half of the solid has and the surface has not.
half = solid[solid.shape[0] // 2:] & ~voxels[voxels.shape[0] // 2:]
print(half)

# %% For other programs: grid, labels and colours are in the files that hold them.
for name in "torus.npz", "torus.vox", "torus.glb":
    voxels.save(name)
solid.save("torus.nrrd")
assert (tribox.Voxels.load("torus.npz").colors == voxels.colors).all()

# %% A picture of three slices.
try:
    import matplotlib
    matplotlib.use("agg")  # a file, with no window
    from matplotlib import pyplot
except ImportError:
    print("no picture without matplotlib; torus.glb shows the cells in any viewer")
else:
    figure, axes = pyplot.subplots(1, 3, figsize=(12, 4))
    for axis, k in zip(axes, np.linspace(0, solid.shape[0] - 1, 5).astype(int)[1:4]):
        axis.imshow(solid.labels()[k], origin="lower")
        axis.set_title(f"layer {k}")
    figure.savefig("torus.png")
