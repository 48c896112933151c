/* box_scenes.h - soups to be asked about many boxes, in order by cuts; the forms in which an index answers, and who is timed. */
#ifndef BENCH_BOX_SCENES_H
#define BENCH_BOX_SCENES_H

#include "asked.h"
#include "soups.h"

/* The finite triangles of a file, in its order, against their bounds. False, with a message, if it cannot be read. */
bool scene_read(const char *path, scene *made);

/* The grid of so many cubes along the longest side of its box. */
tribox_grid scene_grid(const scene *at, uint32_t along);

typedef bool scene_answer(asked *q, scene *at);

/*
 * Asks about the scene of the command line, or else about `count` of `names`, which are the usual ones if it is NULL; with many
 * boxes as scene_make has them.
 */
bool scenes_ask_named(asked *q, const char *const *names, size_t count, bool has_boxes, scene_answer *ask);

/* Nine scenes for comparisons of answers, and `thin`. */
enum { SCENES_COMPARED = 9 };
extern const char *const scenes_compared[SCENES_COMPARED + 1];

/*
 * Asks about three shapes that are made here, if they are of the kinds; about the meshes of the command line; and about a terrain
 * of so many triangles, if any: a height field over a square, in rows as scanners leave them. SCENES_USUAL: where no mesh is named,
 * and it shall not be quick, about four of the folder $TRIBOX_MESHES, one of few huge triangles; with a message where there is
 * no such folder.
 */
enum { SCENES_MADE = 1, SCENES_USUAL = 2 };
bool scenes_ask(asked *q, unsigned kinds, size_t terrain, scene_answer *ask);

/* The length of the longest side of its box. */
double scene_extent(const scene *at);

/* How many boxes make so many pairs with all triangles, from 1 to most. */
size_t scene_boxes_within(const scene *at, size_t pairs, size_t most);

/* Cubes whose edge is `part` of the greatest extent, each around a random point of a random triangle. */
void scene_boxes(const scene *at, double part, size_t count, uint64_t seed, tribox_box *boxes);

/* The box in float, turned about x by an angle of which e is the cosine and d the sine, and then by 0.7 about z. */
tribox_oriented_box scene_turned(const tribox_box *box, float e, float d);

/* Cosine and sine of 0.5. */
#define SCENE_TURN 0.87758256f, 0.47942554f

/* In order by cuts. Refers to itself: it stays where it is made. What it has is asked_allocate's. */
typedef struct ordered_soup {
    const tribox_soup *file;
    tribox_soup soup;
    float *to[9];  /* its streams */
    uint32_t *ids; /* the triangles' numbers in the file */
    void *memory, *scratch;
    tribox_index index;
} ordered_soup;

/* kernel: of the index. False, with a message, if the library fails. */
bool ordered_soup_make(const scene *at, const char *kernel, ordered_soup *made);

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
    size_t triangles;
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
