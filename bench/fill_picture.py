"""Draws cuts through bodies: their surface, and what fill="outside" and fill="parity" fill, a picture for each body.

    python3 bench/fill_picture.py examples/insides     with PYTHONPATH and TRIBOX_LIBRARY as BUILD.md says

Dark: the surface. Blue: filled. White: free.
"""

import os
import struct
import sys
import warnings
import zlib

import numpy as np
import tribox

AROUND, ACROSS, CELL, GAP = 72, 36, 4, 12
FREE, SURFACE, FILLED = (250, 250, 250), (50, 50, 60), (110, 165, 230)
GRID = tribox.Grid((0, 0, 0), (1, 1, 1), (64, 48, 48))


def ball(centre, radius, around=0, arounds=0, across=0, acrosses=0):
    """Triangles, poles on the z axis, without so many steps from one on."""
    i, j = np.meshgrid(np.arange(AROUND + 1), np.arange(ACROSS + 1), indexing="ij")
    p, q = 2 * np.pi * (i % AROUND) / AROUND, np.pi * j / ACROSS
    ring = radius * np.sin(q) * (j % ACROSS > 0)
    v = (np.stack([ring * np.cos(p), ring * np.sin(p), radius * np.cos(q)], 2) + centre).astype(np.float32)
    i, j = i[:-1, :-1], j[:-1, :-1]
    kept = ~(((i + AROUND - around) % AROUND < arounds) & (j >= across) & (j < across + acrosses))
    corners = v[:-1, :-1], v[1:, :-1], v[1:, 1:], v[:-1, 1:]
    return np.concatenate([np.stack([corners[n][kept] for n in half], 1) for half in ((0, 1, 2), (0, 2, 3))])


def halves():
    """Half a cell apart: the middle of a row of cells looks through the crack."""
    yield ball((32.1, 23.9, 24.3), 21, AROUND // 8, AROUND // 2, 0, ACROSS)
    yield ball((32.45, 23.55, 24.3), 21, AROUND // 8 + AROUND // 2, AROUND // 2, 0, ACROSS)


CLOSED = ball((32.1, 24.2, 24.3), 21)
BODIES = {
    "closed": [CLOSED],
    "hollow": [CLOSED, ball((32.1, 24.2, 24.3), 12)],
    "open": [ball((32.1, 24.2, 24.3), 21, AROUND - 3, 6, 15, 6)],
    "cracked": list(halves()),
    "doubled": [CLOSED, CLOSED],
    "crossing": [ball((23.1, 24.2, 24.3), 17), ball((41.2, 24.1, 24.2), 17)],
}


def panel(surface, solid):
    """The middle layer, y up, with lines between cells."""
    colours = np.where(surface[..., None], SURFACE, np.where(solid[..., None], FILLED, FREE)).astype(np.uint8)
    colours = colours[len(surface) // 2, ::-1]
    pixels = colours.repeat(CELL, 0).repeat(CELL, 1)
    is_line = np.add.outer(np.arange(len(pixels)) % CELL == 0, np.arange(len(pixels[0])) % CELL == 0)
    return np.where(is_line[..., None], pixels - pixels // 8, pixels)


def write_png(path, pixels):
    height, width, _ = pixels.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.reshape(height, -1)], 1).tobytes()
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
        for kind, data in ((b"IHDR", head), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


warnings.simplefilter("always")  # how many rows are odd
for name, parts in BODIES.items():
    mesh = np.concatenate(parts)
    cells = tribox.voxelize(mesh, GRID)
    solids = [tribox.voxelize(mesh, GRID, fill=fill) for fill in ("outside", "parity")]
    outside, parity = ((solid & ~cells).sum() for solid in solids)
    print(f"{name:9} {len(mesh):5} triangles: outside fills {outside:6} cells, parity {parity:6}")
    panels = [panel(cells, solid) for solid in (cells, *solids)]
    gap = np.full((len(panels[0]), GAP, 3), 255, np.uint8)
    write_png(os.path.join(sys.argv[1], name + ".png"), np.concatenate([panels[0], gap, panels[1], gap, panels[2]], 1))
