/* mesh_layout.h - meshes of every layout, between pages that cannot be touched, and the streams that they stand for. */
#ifndef TRIBOX_TESTS_MESH_LAYOUT_H
#define TRIBOX_TESTS_MESH_LAYOUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "common/guard.h"
#include "common/random_draws.h"
#include "tribox.h"

enum { LAID_TRIANGLES = 5000, LAID_BYTES = 8 << 20 };

/* Which vertices the indices name. The last vertex matters: nothing may be read past it. */
typedef enum index_pattern {
    PATTERN_ORDER,       /* 0, 1, 2, 3, ...: the last vertex comes last */
    PATTERN_REVERSED,    /* the last vertex comes first */
    PATTERN_ANY,         /* of as many as there are corners */
    PATTERN_SHARED,      /* of few */
    PATTERN_NEVER_LAST,  /* any but the last */
    PATTERN_LAST_ONCE,   /* the last at one corner */
    PATTERN_LAST_ALWAYS, /* the last at a corner of every triangle */
    PATTERN_ONE,         /* one for all */
    PATTERN_NEAR,        /* what is near in number is near in the mesh */
    INDEX_PATTERNS
} index_pattern;

typedef struct layout {
    size_t count;
    unsigned index_bytes; /* 0 for none; the pattern is then ignored */
    size_t stride;        /* as in tribox_mesh: 0 stands for 12 */
    index_pattern pattern;
    int shift;      /* bytes by which positions and indices lie beside an aligned place */
    bool is_at_end; /* positions and indices end at the page after them, or begin after the page before them */
} layout;

/* Where a mesh lies, and where a call writes: nine streams, a mask, a report, each with 64 bytes to be shifted in. */
typedef struct mesh_fences {
    guarded positions, indices;
    guarded stream[9], mask, report;
} mesh_fences;

enum { LAID_WORDS = LAID_TRIANGLES / 64 + 1 };

mesh_fences mesh_fences_make(uint64_t seed);

/* Draws positions and indices, with a NaN, an infinity or a subnormal here and there. Valid until the next mesh is laid. */
tribox_mesh mesh_lay(random_source *r, const layout *l, mesh_fences f);

/* Moves runs of vertices, in the order of their numbers, beyond a face of the box: all of a run, or all but one. */
void mesh_move_beside(random_source *r, const tribox_mesh *mesh, const tribox_box *box);

/* The vertex number at a corner, and a change of it. */
size_t mesh_number(const tribox_mesh *mesh, size_t corner);
void mesh_set_number(const tribox_mesh *mesh, size_t corner, size_t number);

/* Stream 3 * a + v of the triangles from `first` on: axis a of vertex v. */
void mesh_expect(const tribox_mesh *mesh, size_t first, size_t count, float *const stream[9]);

/* A mesh in one line. */
enum { MESH_TEXT = 120 };
const char *mesh_text(const tribox_mesh *mesh, char text[MESH_TEXT]);

#endif
