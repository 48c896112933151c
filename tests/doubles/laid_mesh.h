/* laid_mesh.h - triangles of doubles, or of floats, laid out as a mesh of any layout, between pages that cannot be touched. */
#ifndef TRIBOX_TESTS_LAID_MESH_H
#define TRIBOX_TESTS_LAID_MESH_H

#include <stdbool.h>
#include <stddef.h>

#include "common/guard.h"
#include "common/random_draws.h"
#include "tribox.h"

/* How vertices follow each other, and the numbers of each. */
typedef enum vertex_order {
    ROWS,        /* x, y, z together: axis_stride 0 or the size of a number */
    SPREAD_ROWS, /* x, y, z together with gaps between them */
    COLUMNS,     /* all x, then all y, then all z */
    VERTEX_ORDERS
} vertex_order;

typedef struct mesh_form {
    unsigned position_bytes; /* as in tribox_mesh */
    unsigned index_bytes;    /* 0 for none */
    unsigned axes;           /* as in tribox_mesh */
    vertex_order order;
    size_t gap;     /* bytes between what could be next to each other */
    int shift;      /* bytes by which positions and indices lie beside an aligned place */
    bool is_at_end; /* they end at the page after them, or begin after the page before them */
    bool is_shared; /* vertices that are the same are one; with indices */
} mesh_form;

/* As most have them. */
extern const mesh_form nine_doubles;

/* Any. Floats only if all numbers are such; without indices at times. */
mesh_form mesh_form_draw(random_source *r, bool may_be_floats);

/* How many triangles, and how many bytes of positions, fit the fences. */
enum { LAID_MOST = 5000, LAID_F64_BYTES = 2 << 20 };

typedef struct laid_fences {
    guarded positions, indices;
} laid_fences;

/* Filled with bytes at random: what lies between numbers. */
laid_fences laid_fences_make(uint64_t seed);

/*
 * Lays out triangles; vertex j of the mesh's triangles is vertex turn[j] of these. Vertices with indices are numbered in any order.
 * Valid until the next mesh is laid into the same fences.
 */
tribox_mesh laid_mesh_of(random_source *r, const mesh_form *form, const double (*u)[3][3], size_t count, const int turn[3],
                         laid_fences f);

/* Where axis a of the vertex at a corner lies. */
unsigned char *laid_mesh_at(const tribox_mesh *mesh, size_t corner, int a);

/* Axis a of the vertex at a corner, widened. */
double laid_mesh_number(const tribox_mesh *mesh, size_t corner, int a);

/* A mesh in one line. */
enum { LAID_TEXT = 160 };
const char *laid_mesh_text(const tribox_mesh *mesh, char text[LAID_TEXT]);

#endif
