/* sweep_work.h - what tribox sweep times: a mesh against one box, cells of a grid, or the leaves of an octree. */
#ifndef SWEEP_WORK_H
#define SWEEP_WORK_H

#include "read/mesh.h"
#include "timing/work.h"

typedef enum sweep_kind { SWEEP_OCTREE, SWEEP_GRID, SWEEP_BOX } sweep_kind;

typedef struct sweep_wish {
    sweep_kind kind;
    tribox_box box; /* of SWEEP_BOX */
    unsigned depth; /* of SWEEP_OCTREE; 0 for one that suits the mesh, and then written */
    unsigned along; /* of SWEEP_GRID: cells along the longest side */
} sweep_wish;

/* Makes the work. Returns an exit_code; on success timing_work_free gives the memory back. path: of the mesh, for messages. */
int sweep_work_make(const char *path, const mesh *m, sweep_wish *wish, timing_work *work);

/* The wish in words, as in "the leaves of an octree of depth 6, ...". */
void sweep_work_describe(const sweep_wish *wish, const timing_work *work, char *text, size_t size);

#endif
