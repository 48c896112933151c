"""materials.py - how many cells each material of scene.obj has: --ids says of each cell which triangle. Needs NumPy and tribox.

    python3 scene.py && tribox voxelize scene.obj --resolution 160 --ids -o scene.npz && python3 materials.py
"""

import numpy as np
import tribox

material, of_triangles = None, []
with open("scene.obj") as file:
    for word, *rest in map(str.split, file):
        if word == "usemtl":
            material = rest[0]
        elif word == "f":  # a polygon is cut into triangles, whose numbers follow each other
            of_triangles += [material] * (len(rest) - 2)

of_cells = np.array(of_triangles)[tribox.Bricks.load("scene.npz").ids]  # in the order of cells() and points()
for name, cells in zip(*np.unique(of_cells, return_counts=True)):
    print(name, cells)
