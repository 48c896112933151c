/* grid_options.h - the options that voxelize and partition share: the mesh, and the grid around it. */
#ifndef GRID_OPTIONS_H
#define GRID_OPTIONS_H

#include "console/option_reader.h"
#include "read/mesh.h"
#include "tribox.h"

/* They stand together in the tables of both commands, from a number on that each chooses. */
enum { GRID_FORMAT, GRID_SHIFT, GRID_RESOLUTION, GRID_CELL, GRID_ORIGIN, GRID_SIZE, GRID_END };

#define GRID_ENTRIES(from) \
    [(from) + GRID_FORMAT] = {"format", 0, true}, [(from) + GRID_SHIFT] = {"shift", 0, true}, \
              [(from) + GRID_RESOLUTION] = {"resolution", 'r', true}, [(from) + GRID_CELL] = {"cell", 'c', true}, \
              [(from) + GRID_ORIGIN] = {"origin", 0, true}, [(from) + GRID_SIZE] = {"size", 0, true}

#define GRID_HELP \
    "      --format WORD       " MESH_FORMATS "; standard input needs it\n" \
    "      --shift X,Y,Z|auto  subtract this from MESH first, in double; auto: a point near its corner\n" \
    "  -r, --resolution N      N cubic cells along the longest side of the mesh; at most 262144\n" \
    "  -c, --cell S[,S,S]      length of a cell, or its lengths along x, y and z\n" \
    "      --origin X,Y,Z      lower corner of the grid; default: that of the mesh\n" \
    "      --size NX,NY,NZ     number of cells; default: just enough to hold the mesh\n"

/* The grid, from the command line and, for what that leaves open, from the mesh. */
typedef struct grid_choice {
    uint32_t resolution; /* cells along the longest side of the mesh; 0 where the cell is given */
    double cell[3], origin[3];
    bool has_origin, has_size;
    uint32_t size[3];
} grid_choice;

typedef struct grid_request {
    const char *mesh_path;
    triangle_format format; /* of the mesh; OTHER to go by its name */
    mesh_shift shift;
    grid_choice choice;
} grid_request;

/* Of a cube of so many cells along each side all tiles can be numbered (tile_set.h), so --resolution is not refused later. */
enum { GRID_CELLS_MAX = INT32_MAX, GRID_RESOLUTION_MAX = 1 << 18 };

/* Takes an option before GRID_END. Returns an exit_code. */
int grid_take(grid_request *r, int which, const char *value);

/* Checks that a mesh and one grid are given; from: where the options begin in the table. Returns an exit_code. */
int grid_check(const grid_request *r, const options_found *found, int from);

/* Refuses these options for a partition, which has its grid. Returns an exit_code. */
int grid_refuse(const grid_request *r, const options_found *found, const option_entry *table, int from);

/* Makes the grid around these bounds, not looked at where the grid is fixed. path: that of the mesh. Returns an exit_code. */
int grid_choose_around(const grid_choice *choice, const char *path, const tribox_box *bounds, tribox_grid *grid);

/* Whether nothing of the grid is left to the mesh. */
bool grid_is_fixed(const grid_choice *choice);

/* Makes the grid; it holds the mesh where size and origin are left open. path: that of the mesh. Returns an exit_code. */
int grid_choose(const grid_choice *choice, const char *path, const mesh *m, tribox_grid *grid);

#endif
