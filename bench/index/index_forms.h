/* index_forms.h - the forms in which an index answers, against the call without one, each for many boxes in turn. */
#ifndef BENCH_INDEX_FORMS_H
#define BENCH_INDEX_FORMS_H

#include <stdbool.h>

#include "timing/timing.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum index_form { FORM_LIST, FORM_COUNT, FORM_ANY, FORM_WORDS, FORM_MASK, FORM_LINEAR, FORMS } index_form;

const char *index_form_name(index_form form);

/* Room for the answer to one box. */
typedef struct answer_room {
    uint32_t *list, *number;
    uint64_t *bits, *mask, *linear;
    void *storage;
    void *elsewhere; /* other memory, to empty the caches with */
    size_t elsewhere_bytes;
} answer_room;

/* False, with a message, if memory fails. */
bool answer_room_make(size_t triangles, size_t elsewhere_bytes, answer_room *made);

void answer_room_free(answer_room *made);

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

#ifdef __cplusplus
}
#endif

#endif
