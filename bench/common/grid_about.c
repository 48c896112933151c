/* grid_about.c - a grid of cubes about a mesh. */
#include "grid_about.h"

#include <math.h>

tribox_grid grid_about(const mesh *m, uint32_t resolution)
{
    tribox_box box = {{0, 0, 0}, {1, 1, 1}};
    double longest = 0;
    tribox_grid grid;
    mesh_bounds(m, &box);
    for (int a = 0; a < 3; a++)
        longest = fmax(longest, box.hi[a] - box.lo[a]);
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = box.lo[a];
        grid.cell[a] = longest / resolution * 1.00001;
        grid.size[a] = (uint32_t)fmax(1, ceil((box.hi[a] - box.lo[a]) / grid.cell[a]));
    }
    return grid;
}
