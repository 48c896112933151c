/* laid_mesh.h - triangles of doubles, or of floats, laid out as a mesh of any layout, between pages that cannot be touched. */
#ifndef TRIBOX_TESTS_LAID_MESH_H
#define TRIBOX_TESTS_LAID_MESH_H

#include <stdbool.h>
#include <stddef.h>

#include "common/guard.h"
#include "common/mesh_numbers.h"
#include "common/random_draws.h"
#include "tribox.h"

/* How vertices follow each other, and the numbers of each. */
typedef enum vertex_order {
    ROWS,        /* x, y, z together: axis_stride 0 or the size of a number */
    SPREAD_ROWS, /* x, y, z together with gaps between them */
    COLUMNS,     /* all x, then all y, then all z */
    VERTEX_ORDERS
} vertex_order;

/* Which vertices the indices name. The last vertex matters: nothing may be read past it. */
typedef enum index_pattern {
    PATTERN_EACH,        /* one for each corner, in any order; the last ones may be named by none */
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

typedef struct mesh_form {
    unsigned position_bytes; /* as in tribox_mesh */
    unsigned index_bytes;    /* 0 for none */
    unsigned axes;           /* as in tribox_mesh */
    vertex_order order;
    size_t gap;     /* bytes between what could be next to each other */
    int shift;      /* bytes by which positions and indices lie beside an aligned place */
    bool is_at_end; /* they end at the page after them, or begin after the page before them */
    bool is_shared; /* vertices that are the same are one; with indices that name each */
    index_pattern pattern;
} mesh_form;

/* Any that names each vertex. Floats only if all numbers are such; without indices at times. */
mesh_form mesh_form_draw(random_source *r, bool may_be_floats);

/* How many triangles, and how many bytes of positions, fit the fences. */
enum { LAID_MOST = 5000, LAID_BYTES = 8 << 20 };

typedef struct laid_fences {
    guarded positions, indices;
} laid_fences;

/* Filled with bytes at random: what lies between numbers. Of the sizes above, or for more. */
laid_fences laid_fences_make(uint64_t seed);
laid_fences laid_fences_for(uint64_t seed, size_t triangles, size_t bytes);

/*
 * Lays out triangles; vertex j of the mesh's triangles is vertex turn[j] of these. By patterns that name not each vertex once it
 * has other triangles, of the same vertices. Without indices, too, there may be more vertices than it needs. Valid until the next
 * mesh is laid into the same fences.
 */
tribox_mesh laid_mesh_of(random_source *r, const mesh_form *form, const double (*u)[3][3], size_t count, const int turn[3],
                         laid_fences f);

/* A mesh in one line. */
enum { LAID_TEXT = 160 };
const char *laid_mesh_text(const tribox_mesh *mesh, char text[LAID_TEXT]);

#endif
