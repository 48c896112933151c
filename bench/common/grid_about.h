/* grid_about.h - a grid of cubes about a mesh, as benchmarks of voxels take it. */
#ifndef BENCH_GRID_ABOUT_H
#define BENCH_GRID_ABOUT_H

#include "read/mesh.h"

/* `resolution` cubes along the longest side of its box, so that what lies on the far side lies inside. */
tribox_grid grid_about(const mesh *m, uint32_t resolution);

#endif
