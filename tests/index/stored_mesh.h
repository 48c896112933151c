/*
 * stored_mesh.h - the triangles of a stored soup as a mesh: of floats or doubles, by vertex numbers or not, in every layout, and of
 * doubles anywhere. Positions and vertex numbers lie at pages that cannot be touched.
 */
#ifndef TRIBOX_TESTS_STORED_MESH_H
#define TRIBOX_TESTS_STORED_MESH_H

#include "common/laid_mesh.h"
#include "stored_soup.h"

/* Of doubles, how they come from the floats of the soup: u * scale + offset[axis]. */
typedef struct mesh_place {
    double scale, offset[3];
} mesh_place;

typedef struct mesh_layout {
    mesh_form form;
    mesh_place place;
} mesh_layout;

typedef struct stored_mesh {
    laid_fences fences;
    tribox_mesh mesh;
    mesh_layout layout;
} stored_mesh;

/* For so many triangles at most. */
stored_mesh stored_mesh_make(size_t room);

mesh_layout draw_layout(random_source *r, size_t triangles);

/* Lays out the soup's numbers as they are, and makes the mesh what the soup's index is over. */
void stored_mesh_lay(random_source *r, stored_mesh *m, const mesh_layout *layout, stored_soup *s);

/* Writes the numbers of triangles first .. first + count - 1 once more. */
void stored_mesh_write(stored_mesh *m, const stored_soup *s, size_t first, size_t count);

/* From now on reading a position or a vertex number faults, or no longer does. */
void stored_mesh_hide(const stored_mesh *m, bool is_hidden);

/* A box about the soup's numbers, moved with them; then each bound by an ulp of double up or down, or not. */
tribox_box box_in_place(random_source *r, const mesh_layout *layout, const tribox_box *box);

#endif
