/* colours.h - colours of a mesh's triangles, and of cells, among them those of a palette. */
#ifndef COLOURS_H
#define COLOURS_H

#include <stddef.h>

#include "read/triangle_file.h"
#include "rgb.h"
#include "write/file_out.h"

typedef struct mesh_colours {
    rgb *of;          /* each triangle; NULL: it has none that are read */
    size_t triangles; /* of the mesh */
    const char *from; /* whose they are, in a word: "faces" */
} mesh_colours;

/*
 * Reads a mesh file again, for its colours alone. A polygon has one colour, and so have the triangles that it is cut into.
 *
 * PLY, OFF: that of the face; where faces have none, the mean of the colours of its corners.
 * OBJ: the mean of its corners, where all of them have one, `v X Y Z R G B`; else Kd of its material; else grey.
 * What libassimp reads: the same of glTF and its like, the colour of the corners times that of the material.
 * Whole numbers go to 255, those of 16 bits to 65535, others to 1.
 *
 * triangles: of the mesh, as it was read before. outputs: none of these may be a file of materials. has_to: a mesh without colours
 * is a failure. Returns an exit_code; on success mesh_colours_free gives the memory back.
 */
int mesh_colours_read(const char *path, triangle_format format, size_t triangles, const file_out_names *outputs, bool has_to,
                      mesh_colours *colours);
void mesh_colours_free(mesh_colours *colours);

/* Colours as numbers of a palette, for formats that have one. */
enum { PALETTE_MAX = 255 };

typedef struct palette {
    rgb of[PALETTE_MAX];
    int count;
    unsigned char *place; /* in it, of each cube of 4 x 4 x 4 colours; NULL: they are as they are, in rising order */
} palette;

/* Which colour of the palette, from 0, stands for one of those that it was made of. */
int palette_find(const palette *p, rgb colour);

typedef struct coloured_brick {
    uint32_t at[3];
    uint64_t bits[8];
    uint64_t first; /* where its colours begin, which are in the order of its bits */
} coloured_brick;

typedef struct cell_colours {
    coloured_brick *bricks;
    size_t count, room, cells_room;
    rgb *of;
    uint64_t cells;
    uint32_t *number; /* of each place of a brick: which one is there; UINT32_MAX for none */
    uint32_t size[3]; /* of the grid, in bricks */
    palette palette;  /* of them, for formats that have one; else empty */
} cell_colours;

/* Adds a brick of so many set cells; returns where their colours go, NULL where there is no memory. */
rgb *cell_colours_add(cell_colours *c, const uint32_t at[3], const uint64_t bits[8], uint64_t cells);

/* Makes the palette, and says where that changes colours. path: of what is written. Returns an exit_code. */
int cell_colours_make_palette(cell_colours *c, const char *path);

/* Finds the places of all bricks in a grid of so many cells. False where there is no memory. */
bool cell_colours_place(cell_colours *c, const uint32_t cells[3]);

/* The colours of a brick that is there, or of a set cell. */
const rgb *cell_colours_of_brick(const cell_colours *c, const uint32_t at[3]);
rgb cell_colours_at(const cell_colours *c, const uint32_t cell[3]);

void cell_colours_free(cell_colours *c);

#endif
