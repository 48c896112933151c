/* index_forms.h - the forms in which an index answers, against tribox_overlap without one, each for many boxes in turn. */
#ifndef BENCH_INDEX_FORMS_H
#define BENCH_INDEX_FORMS_H

#include "ordered_soup.h"
#include "timing/contestant.h"

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

typedef struct index_question {
    const ordered_soup *soup;
    const tribox_box *boxes;
    size_t count;
    answer_room *room;
} index_question;

/*
 * Asks everything once, before each pass and outside its time, as others that read much come between two passes: what is timed is a
 * pass with warm caches.
 */
void index_warm_up(const contestant *self, uint64_t *mask);

/* Asks about one box after the other, with warm caches; linear as it finds them. kernel: NULL for the widest. */
contestant index_contestant(const index_question *question, index_form form, const char *kernel);

/* The same with caches that hold other things before each pass. */
contestant index_contestant_cold(const index_question *question, index_form form, const char *kernel);

/*
 * Whether every form is right about the first `boxes` boxes, by tribox_overlap: bit for bit, lists in the numbers of the file. If
 * not, false with a message.
 */
bool index_forms_verify(const index_question *question, size_t boxes, const char *kernel);

#ifdef __cplusplus
}
#endif

#endif
