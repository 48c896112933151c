/* part.c - what a part says of the grid and the mesh. */
#include "part.h"

#include <string.h>

void part_set_grid(part_whole *whole, const voxels *v)
{
    memcpy(whole->origin, v->grid.origin, sizeof whole->origin);
    memcpy(whole->cell, v->grid.cell, sizeof whole->cell);
    memcpy(whole->size, v->grid.size, sizeof whole->size);
    memcpy(whole->shift, v->shift, sizeof whole->shift);
}

voxels part_voxels(const part_whole *whole)
{
    voxels v = {.slabs = 0};
    memcpy(v.grid.origin, whole->origin, sizeof whole->origin);
    memcpy(v.grid.cell, whole->cell, sizeof whole->cell);
    memcpy(v.grid.size, whole->size, sizeof whole->size);
    memcpy(v.shift, whole->shift, sizeof whole->shift);
    return v;
}

uint64_t part_triangle_checksum(const double u[9])
{
    double zero = 0; /* or NaN */
    for (int k = 0; k < 9; k++)
        zero += 0 * u[k];
    return zero == 0 ? checksum_bytes(CHECKSUM_EMPTY, u, sizeof(double[9])) : 0;
}

mesh_sums mesh_sums_of(const mesh *m)
{
    mesh_sums sums = {0, 0};
    double u[9];
    for (size_t t = 0; t < m->triangles; t++) {
        mesh_triangle(m, t, u);
        mesh_sums_add(&sums, &(mesh_sums){part_triangle_checksum(u), 0}, t);
    }
    return sums;
}
