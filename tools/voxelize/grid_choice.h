/* grid_choice.h - the grid of tribox voxelize, from the command line and, for what that leaves open, from the mesh. */
#ifndef GRID_CHOICE_H
#define GRID_CHOICE_H

#include <stdbool.h>

#include "read/mesh.h"
#include "tribox.h"

typedef struct grid_choice {
    uint32_t resolution; /* cells along the longest side of the mesh; 0 where the cell is given */
    double cell[3], origin[3];
    bool has_origin, has_size;
    uint32_t size[3];
} grid_choice;

/* Makes the grid around these bounds, not looked at where the grid is fixed. path: that of the mesh. Returns an exit_code. */
int grid_choose_around(const grid_choice *choice, const char *path, const tribox_box *bounds, tribox_grid *grid);

/* Whether nothing of the grid is left to the mesh. */
bool grid_is_fixed(const grid_choice *choice);

/* Makes the grid; it holds the mesh where size and origin are left open. path: that of the mesh. Returns an exit_code. */
int grid_choose(const grid_choice *choice, const char *path, const mesh *m, tribox_grid *grid);

#endif
