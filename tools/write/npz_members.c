/* npz_members.c - writes the grid as small arrays. */
#include "npz_members.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "read/little.h"

void npz_rows(unsigned char header[NPY_HEADER], const char *type, uint64_t rows, int columns)
{
    char shape[32];
    snprintf(shape, sizeof shape, "(%" PRIu64 ", %d)", rows, columns);
    npy_header(header, type, shape);
}

static void add_three(zip_out *zip, const char *name, const char *type, const unsigned char *bytes, size_t size)
{
    unsigned char header[NPY_HEADER];
    zip_begin_member(zip, name);
    zip_add(zip, bytes, size);
    npy_header(header, type, "(3,)");
    zip_end_member(zip, header);
}

static void add_point(zip_out *zip, const char *name, const double point[3])
{
    unsigned char bytes[3 * sizeof(double)];
    for (int a = 0; a < 3; a++) {
        uint64_t bits;
        memcpy(&bits, &point[a], sizeof bits);
        little_put64(bytes + 8 * a, bits);
    }
    add_three(zip, name, "<f8", bytes, sizeof bytes);
}

void npz_add_grid(zip_out *zip, const voxels *v)
{
    unsigned char size[12];
    for (int a = 0; a < 3; a++)
        little_put32(size + 4 * a, v->grid.size[a]);
    add_point(zip, "origin.npy", v->grid.origin);
    add_point(zip, "cell.npy", v->grid.cell);
    add_three(zip, "size.npy", "<u4", size, sizeof size);
    add_point(zip, "shift.npy", v->shift);
}
