/* vdb_part.h - what the program asks of the part that knows OpenVDB, which is loaded when it is needed. */
#ifndef VDB_PART_H
#define VDB_PART_H

#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct vdb_grid {
    double origin[3]; /* of the mesh as it was before any shift */
    double cell[3], shift[3];
    uint32_t size[3];
    double unit;     /* the transform's lengths are these times it */
    int is_mask;     /* a MaskGrid in place of a BoolGrid */
    int has_labels;  /* beside it another, "inside", of the cells that are */
    int has_colours; /* beside it a Vec3SGrid, "Cd" */
    int has_ids;     /* an Int32Grid of them, of -1 where no cell is set; without colours */
} vdb_grid;

/* Where these fail they write why into `reason`, which has room for VDB_REASON bytes. */
enum { VDB_REASON = 200 };

typedef struct vdb_part {
    /* An empty tree of bricks, which stays as long as the process; NULL if it fails. */
    void *(*make)(const vdb_grid *grid, char *reason);

    /*
     * Each returns whether it did it. put: a brick as a tribox_sink gets it; inside: which of its cells are, for labels; values:
     * red, green and blue of its set cells as floats, or their ids as int32_t, in the order of the bits, where there are some.
     * can_seek: of the stream, which is at its start.
     */
    int (*put)(void *tree, const uint32_t at[3], const uint64_t bits[8], const uint64_t *inside, const void *values, char *reason);
    int (*write)(void *tree, FILE *to, int can_seek, char *reason);
} vdb_part;

/* Its file, and its one symbol. */
#define VDB_PART_FILE "tribox_vdb.so"
#define VDB_PART_SYMBOL "tribox_vdb_part"
extern const vdb_part tribox_vdb_part;

#ifdef __cplusplus
}
#endif

#endif
