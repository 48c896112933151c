/* box_scenes.h - soups to be asked about many boxes, in order by cuts; the forms in which an index answers, and who is timed. */
#ifndef BENCH_BOX_SCENES_H
#define BENCH_BOX_SCENES_H

#include "asked.h"

typedef struct soup_room {
    tribox_soup soup;          /* the streams, to be read */
    float *x[3], *y[3], *z[3]; /* the same, to be written */
} soup_room;

/* Of asked_allocate, as all here: streams that begin on cache lines, no two of them at the same place of a page. */
void soup_room_make(size_t count, soup_room *made);

/* Triangle i as vertices: u[v][a] is axis a of vertex v. */
void soup_triangle(const tribox_soup *soup, size_t i, float u[3][3]);

typedef struct index_scene {
    char name[64];
    soup_room room; /* in the order of the file; finite triangles alone */
    tribox_box bounds;
} index_scene;

/* A mesh of a file. False, with a message, if it cannot be read. */
bool index_scene_read(const char *name, index_scene *made);

/* A torus of 200,000 triangles; as many anywhere, a hundredth of the whole long; twelve across the whole. */
typedef enum made_scene { SCENE_TORUS, SCENE_SMALL, SCENE_HUGE, MADE_SCENES } made_scene;
void index_scene_make(made_scene which, uint64_t seed, index_scene *made);

/* Its triangles as one job against its bounds. False, with a message, if memory fails. */
bool index_scene_work(const index_scene *scene, timing_work *made);

/* The grid of so many cubes along the longest side. */
tribox_grid index_scene_grid(const index_scene *scene, uint32_t along);

typedef bool index_scene_answer(asked *q, const index_scene *at, size_t number);

/*
 * Asks about the meshes of the command line and then about a terrain of so many triangles, if any: a height field over a square, in
 * rows as scanners leave them. Where no mesh is named, and it shall not be quick, about those of the folder $TRIBOX_MESHES that
 * goals are about, and one of few huge triangles; with a message where there is no such folder.
 */
bool index_scenes_ask(asked *q, size_t terrain, index_scene_answer *ask);

/* Whether the goals are about the mesh of this name. */
bool index_scene_has_goals(const char *name);

/* The length of the longest side. */
double index_scene_extent(const index_scene *scene);

/* How many boxes make so many pairs with all triangles, from 1 to most. */
size_t index_scene_boxes_within(const index_scene *scene, size_t pairs, size_t most);

/* Cubes whose edge is `part` of the greatest extent, each around a random point of a random triangle. */
void index_scene_boxes(const index_scene *scene, double part, size_t count, uint64_t seed, tribox_box *boxes);

/* Nanoseconds of a triangle, the least of some tries. */
typedef struct order_cost {
    double order, gather, build;
} order_cost;

typedef struct ordered_soup {
    soup_room room;
    uint32_t *ids; /* the triangles' numbers in the file */
    void *memory;
    tribox_index index;
    order_cost cost;
} ordered_soup;

/* tries: of which the least times are kept. kernel: of the index. False, with a message, if the library fails. */
bool ordered_soup_make(const index_scene *scene, int tries, const char *kernel, ordered_soup *made);

typedef enum index_form { FORM_LIST, FORM_COUNT, FORM_ANY, FORM_WORDS, FORM_MASK, FORM_LINEAR, FORMS } index_form;

const char *index_form_name(index_form form);

/* Room for the answer to one box. */
typedef struct answer_room {
    uint32_t *list, *number;
    uint64_t *bits, *mask, *linear;
    void *elsewhere; /* other memory, to empty the caches with */
    size_t elsewhere_bytes;
} answer_room;

void answer_room_make(size_t triangles, size_t elsewhere_bytes, answer_room *made);

/* Boxes, axis-aligned or turned, asked one after the other of an index over a soup or a mesh. */
typedef struct index_question {
    const char *name;
    const tribox_index *index;
    const uint32_t *ids; /* NULL in the order of the file */
    size_t triangles;
    const tribox_soup *soup; /* NULL for a mesh */
    const tribox_mesh *mesh;
    const tribox_box *boxes; /* NULL for turned ones */
    const tribox_oriented_box *turned;
    size_t count, linear_count; /* boxes; without an index the first ones */
    answer_room *room;
} index_question;

/*
 * Asks everything once, before each pass and outside its time, as others that read much come between two passes: what is timed is a
 * pass with warm caches.
 */
void index_warm_up(const contestant *self, uint64_t *mask);

/* Linear is timed as its caches are. is_cold: all are, with caches that hold other things before each pass. */
contestant index_contestant(const index_question *question, index_form form, bool is_cold, const char *kernel);

/* The mean of what overlaps a box. */
double index_hits(const index_question *question, const char *kernel);

/*
 * Whether every form is right about the first `boxes` boxes, by the call without an index: bit for bit, lists in the numbers of the
 * file. If not, false with a message.
 */
bool index_forms_verify(const index_question *question, size_t boxes, const char *kernel);

#endif
