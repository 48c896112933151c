/* volume_npy.c - an array of NumPy's, a byte per cell. */
#include "npy_header.h"
#include "volume.h"
#include "volume_bytes.h"

void volume_write_npy(FILE *to, const voxels *v, progress *bar)
{
    unsigned char header[NPY_HEADER];
    char shape[64];
    snprintf(shape, sizeof shape, "(%u, %u, %u)", v->grid.size[2], v->grid.size[1], v->grid.size[0]);
    npy_header(header, "|b1", shape);
    fwrite(header, 1, sizeof header, to);
    volume_write_bytes(to, v, bar);
}
