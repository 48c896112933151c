/* vdb_filter.h - what tribox-vdb, the program that knows OpenVDB, reads from its standard input. */
#ifndef VDB_FILTER_H
#define VDB_FILTER_H

#include <stdint.h>

typedef struct vdb_grid {
    double origin[3]; /* of the mesh as it was before any shift */
    double cell[3], shift[3];
    double unit; /* the transform's lengths are these times it */
    uint32_t size[3];
    uint32_t is_mask;     /* a MaskGrid in place of a BoolGrid */
    uint32_t has_labels;  /* beside it another, "inside", of the cells that are */
    uint32_t has_colours; /* beside it a Vec3SGrid, "Cd" */
    uint32_t has_ids;     /* an Int32Grid of them, of -1 where no cell is set; without colours */
    uint32_t path_bytes;  /* 0: the grid is only tried, and another follows */
} vdb_grid;

/*
 * A grid is answered by a line on standard error: VDB_READY, or why not, before the program ends. After it come the bytes of the
 * path of a file that is there, or of "-" for standard output, and then bricks up to one of VDB_LAST values. A brick is followed by
 * 8 words of its cells that are inside, where there are labels, and by its values: three floats each, red, green and blue as light,
 * or ids of int32, in the order of the bits. The file is whole where the program then ends with 0, else a line says why; where the
 * file failed it is VDB_ERRNO and a number. All is in the order of bytes of the machine.
 */
typedef struct vdb_brick {
    uint32_t at[3];
    uint32_t values; /* as many as set cells, or 0 where the grid has none */
    uint64_t bits[8];
} vdb_brick;

#define VDB_LAST UINT32_MAX
#define VDB_READY "ready\n"
#define VDB_ERRNO "errno "

#endif
