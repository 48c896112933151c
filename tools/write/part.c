/* part.c - writes a part, and what its header says of the whole. */
#define _POSIX_C_SOURCE 200809L
#include "part.h"

#include <errno.h>
#include <string.h>

_Static_assert(sizeof(part_header) == 176 && sizeof(part_brick) == 80 && sizeof(part_end) == 24,
               "these are a file format: they have no padding and do not change");

bool part_is_name(const char *path)
{
    const size_t length = strlen(path);
    return length > 5 && !strcmp(path + length - 5, ".part");
}

void part_set_grid(part_whole *whole, const voxels *v)
{
    memcpy(whole->origin, v->grid.origin, sizeof whole->origin);
    memcpy(whole->cell, v->grid.cell, sizeof whole->cell);
    memcpy(whole->size, v->grid.size, sizeof whole->size);
    memcpy(whole->shift, v->shift, sizeof whole->shift);
    whole->brick_bytes = sizeof(part_brick);
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

static void write_bytes(part_writer *w, const void *bytes, size_t size)
{
    if (fwrite(bytes, 1, size, w->to) != size && !w->reason)
        w->reason = errno ? errno : EIO;
}

static void put(part_writer *w, const void *bytes, size_t size)
{
    w->end.checksum = checksum_bytes(w->end.checksum, bytes, size);
    write_bytes(w, bytes, size);
}

part_writer part_start(FILE *to, const part_header *header)
{
    part_writer w = {.to = to, .end.checksum = CHECKSUM_EMPTY};
    put(&w, header, sizeof *header);
    return w;
}

void part_put(part_writer *w, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    part_brick brick = {.at = {at[0], at[1], at[2]}, .cells = (uint32_t)voxels_count(bits, 8)};
    memcpy(brick.bits, bits, sizeof brick.bits);
    w->end.bricks++;
    w->end.cells += brick.cells;
    put(w, &brick, sizeof brick);
    if (ids)
        put(w, ids, brick.cells * sizeof *ids);
}

void part_finish(part_writer *w)
{
    const part_end end = w->end;
    put(w, &end, sizeof end - sizeof end.checksum);
    write_bytes(w, &w->end.checksum, sizeof w->end.checksum);
}
