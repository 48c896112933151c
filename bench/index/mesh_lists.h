/*
 * mesh_lists.h - lists of the same boxes by indices over a soup, over the mesh of floats that it is when welded, and over the same
 * mesh in double, far from zero; and of boxes whose bounds are no floats.
 */
#ifndef BENCH_MESH_LISTS_H
#define BENCH_MESH_LISTS_H

#include "ordered_soup.h"
#include "timing/contestant.h"

typedef enum mesh_list_of { LIST_OF_SOUP, LIST_OF_WIDE_BOXES, LIST_OF_MESH, LIST_OF_MESH_IN_DOUBLE, MESH_LISTS } mesh_list_of;

typedef struct mesh_lists {
    const ordered_soup *soup;
    float (*floats)[3];
    double (*doubles)[3];
    uint32_t *indices; /* in the order of the soup; vertices are numbered as they come in the file */
    tribox_mesh mesh[2];
    tribox_index index[2];
    void *nodes[2];
    const tribox_box *boxes;
    tribox_box *wide, *moved; /* an ulp of double smaller; with the mesh of doubles */
    size_t count;
    uint32_t *list;
} mesh_lists;

/* boxes, and list, for all triangles of the soup: used until mesh_lists_free. False, with a message, if memory fails. */
bool mesh_lists_make(const index_scene *scene, const ordered_soup *soup, const tribox_box *boxes, size_t count, uint32_t *list,
                     const char *kernel, mesh_lists *made);

void mesh_lists_free(mesh_lists *made);

/* Whether lists of the first boxes are those of the calls without an index; if not, false with a message. */
bool mesh_lists_are_right(const mesh_lists *question, size_t boxes, uint64_t *mask, const char *kernel);

/* Times are a box's. */
contestant mesh_lists_contestant(const mesh_lists *question, mesh_list_of of, const char *kernel);

/* A triangle's. */
contestant mesh_lists_build(const mesh_lists *question, bool in_double, const char *kernel);

#endif
