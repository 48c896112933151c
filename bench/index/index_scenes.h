/* index_scenes.h - soups to be asked about many boxes, mesh files and a terrain, and the boxes. */
#ifndef BENCH_INDEX_SCENES_H
#define BENCH_INDEX_SCENES_H

#include <stdbool.h>

#include "tribox.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct soup_room {
    tribox_soup soup;          /* the streams, to be read */
    float *x[3], *y[3], *z[3]; /* the same, to be written */
    void *storage;
} soup_room;

/* Streams that begin on cache lines, no two of them at the same place of a page. False, with a message, if memory fails. */
bool soup_room_make(size_t count, soup_room *made);

void soup_room_free(soup_room *made);

/* Triangle i as vertices: u[v][a] is axis a of vertex v. */
void soup_room_put(soup_room *to, size_t i, const float u[3][3]);
void soup_triangle(const tribox_soup *soup, size_t i, float u[3][3]);

typedef struct index_scene {
    char name[64];
    soup_room room; /* in the order of the file; finite triangles alone */
    tribox_box bounds;
} index_scene;

/*
 * The meshes of the folder $TRIBOX_MESHES that are taken where none is named: those that goals are about, and one of few huge
 * triangles. None, with a message, where there is no such folder. Returns how many.
 */
size_t index_scene_usual(const char *const **names);

/* Whether the goals are about the mesh of this name. */
bool index_scene_has_goals(const char *name);

/* A mesh file, if there is no slash in its name in the folder $TRIBOX_MESHES; false, with a message, if it cannot be read. */
bool index_scene_read(const char *name, index_scene *made);

/* A height field over a square, about so many triangles, in rows as scanners leave them. False, with a message, if memory fails. */
bool index_scene_terrain(size_t triangles, uint64_t seed, index_scene *made);

void index_scene_free(index_scene *made);

/* The length of the longest side. */
double index_scene_extent(const index_scene *scene);

/* How many boxes make so many pairs with all triangles, from 1 to most. */
size_t index_scene_boxes_within(const index_scene *scene, size_t pairs, size_t most);

/* Cubes whose edge is `part` of the greatest extent, each around a random point of a random triangle. */
void index_scene_boxes(const index_scene *scene, double part, size_t count, uint64_t seed, tribox_box *boxes);

#ifdef __cplusplus
}
#endif

#endif
