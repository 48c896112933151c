/*
 * stored.h - triangles, an index over them and the caller's numbers of them, each between pages that cannot be touched: a soup; and
 * if a test says so a mesh of the same, of floats or doubles, by vertex numbers or not, in every layout, and of doubles anywhere.
 */
#ifndef TRIBOX_TESTS_STORED_H
#define TRIBOX_TESTS_STORED_H

#include <stdint.h>

#include "common/guard.h"
#include "common/laid_mesh.h"
#include "tribox.h"

enum { STORED_STREAMS = 9 };

/* Of doubles, how they come from the floats of the soup: u * scale + offset[axis]. */
typedef struct mesh_place {
    double scale, offset[3];
} mesh_place;

typedef struct mesh_layout {
    mesh_form form;
    mesh_place place;
} mesh_layout;

typedef struct stored_soup {
    guarded stream_fence[STORED_STREAMS], ids_fence, nodes_fence;
    float *stream[STORED_STREAMS]; /* stream[3 * a + v]: axis a of vertex v */
    uint32_t *ids;                 /* no two alike, in no order */
    unsigned char *nodes;
    tribox_soup soup;
    laid_fences mesh_fences;
    tribox_mesh mesh;
    mesh_layout layout;           /* of the mesh */
    tribox_index index, with_ids; /* over the soup, until a mesh is laid or a test sets something else; with ids too */
} stored_soup;

/* What most tests of an index have. */
extern stored_soup stored;

/* Makes fences for so many triangles at most, with room to shift all in, and for their mesh. */
void stored_make(size_t room);
void stored_mesh_make(size_t room);

/*
 * A soup of so many triangles, whose numbers are to be written. All ends at the pages after it; or else begins after those before
 * it, the index as many bytes beside an aligned place as `shift` says, the streams as many floats.
 */
enum { STORED_AT_END = -1, STORED_SHIFTS = 16 };
void stored_soup_lay(size_t count, int shift);

/* Lays out the soup's numbers as they are as a mesh, and makes that what the index is over. Writes some of them once more. */
mesh_layout draw_layout(random_source *r, size_t triangles);
void stored_mesh_lay(random_source *r, const mesh_layout *layout);
void stored_mesh_write(size_t first, size_t count);

/* A box about the soup's numbers, moved with the mesh; then each bound by an ulp of double up or down, or not. */
tribox_box box_in_place(random_source *r, const tribox_box *box);

/* Fills the index's memory with poison, then builds the index of what it is over, as that is now. */
void stored_build(const char *kernel);

static inline size_t stored_index_bytes(void) { return tribox_index_bytes(stored.soup.count); }

/* How many overlap, without a look at the triangles: that would fault. */
size_t count_unseen(const tribox_region *region, const tribox_options *options, const char *how);

#endif
