/* volume_npy.c - an array of NumPy's, a byte per cell: bool, or a label; or an id of int32. */
#include "npy_header.h"
#include "volume.h"

static void write_header(FILE *to, const voxels *v)
{
    unsigned char header[NPY_HEADER];
    char shape[64];
    snprintf(shape, sizeof shape, "(%u, %u, %u)", v->grid.size[2], v->grid.size[1], v->grid.size[0]);
    npy_header(header, v->ids ? "<i4" : voxels_have_labels(v) ? "|u1" : "|b1", shape);
    fwrite(header, 1, sizeof header, to);
}

const volume_frame volume_npy = {.before = write_header};
