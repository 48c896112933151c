/* index_forms.c - calls to the index that are timed, and their verification. */
#include "index_forms.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/rivals.h"
#include "console/message.h"

static const char *const names[FORMS] = {"list", "count", "any", "words", "mask", "linear"};

const char *index_form_name(index_form form) { return names[form]; }

bool answer_room_make(size_t triangles, size_t elsewhere_bytes, answer_room *made)
{
    const size_t words = tribox_mask_words(triangles) + 1, bytes = words * (3 * sizeof(uint64_t) + 65 * sizeof(uint32_t));
    uint64_t *const storage = malloc(bytes);
    void *const elsewhere = malloc(elsewhere_bytes);
    *made = (answer_room){.bits = storage, .storage = storage, .elsewhere = elsewhere, .elsewhere_bytes = elsewhere_bytes};
    if (!storage || !elsewhere) {
        answer_room_free(made);
        return message_failure("out of memory for answers") == EXIT_CODE_OK;
    }
    memset(storage, 0, bytes);
    memset(elsewhere, 1, elsewhere_bytes);
    made->mask = storage + words;
    made->linear = storage + 2 * words;
    made->number = (uint32_t *)(storage + 3 * words);
    made->list = made->number + words;
    return true;
}

void answer_room_free(answer_room *made)
{
    free(made->storage);
    free(made->elsewhere);
}

static tribox_region region_of(const index_question *q, size_t b)
{
    return q->boxes ? (tribox_region){.box = &q->boxes[b]} : (tribox_region){.oriented = &q->turned[b]};
}

static bool ask_list(const index_question *q, size_t b, const tribox_options *options, tribox_report *report)
{
    const tribox_region region = region_of(q, b);
    return !tribox_index_list(q->index, &region, options, q->triangles, q->room->list, &report->overlapping);
}

static bool ask_count(const index_question *q, size_t b, const tribox_options *options, tribox_report *report)
{
    const tribox_region region = region_of(q, b);
    return !tribox_index_overlap(q->index, &region, options, NULL, report);
}

/* Counts whether there is one; which it is stands in number[0]. */
static bool ask_any(const index_question *q, size_t b, const tribox_options *options, tribox_report *report)
{
    const tribox_region region = region_of(q, b);
    size_t triangle;
    const bool is_answered = !tribox_index_any(q->index, &region, options, &triangle);
    q->room->number[0] = (uint32_t)triangle;
    report->overlapping = triangle < q->triangles;
    return is_answered;
}

/* Counts words. */
static bool ask_words(const index_question *q, size_t b, const tribox_options *options, tribox_report *report)
{
    const tribox_region region = region_of(q, b);
    return !tribox_index_words(q->index, &region, options, tribox_mask_words(q->triangles), q->room->number, q->room->bits, NULL,
                               &report->overlapping, NULL);
}

static bool ask_mask(const index_question *q, size_t b, const tribox_options *options, tribox_report *report)
{
    const tribox_region region = region_of(q, b);
    return !tribox_index_overlap(q->index, &region, options, q->room->mask, report);
}

static bool ask_linear(const index_question *q, size_t b, const tribox_options *options, tribox_report *report)
{
    uint64_t *const mask = q->room->linear;
    return !(!q->boxes ? tribox_overlap_oriented(q->soup, &q->turned[b], options, mask, report)
             : q->soup ? tribox_overlap(q->soup, &q->boxes[b], options, mask, report)
                       : tribox_mesh_overlap(q->mesh, &q->boxes[b], options, mask, report));
}

typedef bool ask_form(const index_question *q, size_t b, const tribox_options *options, tribox_report *report);

/* contestant.pairs: boxes. */
static inline bool run_form(const contestant *self, ask_form *ask)
{
    tribox_report one;
    for (size_t b = 0; b < (size_t)self->pairs; b++)
        if (!ask(self->question, b, &self->options, &one))
            return false;
    return true;
}

#define RUN(form) \
    static bool run_##form(const contestant *self, uint64_t *mask, tribox_report *report) \
    { \
        (void)mask; \
        (void)report; \
        return run_form(self, ask_##form); \
    }
RUN(list)
RUN(count)
RUN(any)
RUN(words)
RUN(mask)
RUN(linear)

void index_warm_up(const contestant *self, uint64_t *mask) { self->run(self, mask, NULL); }

static void empty_caches(const contestant *self, uint64_t *mask)
{
    const answer_room *const room = ((const index_question *)self->question)->room;
    mask[0] = loads_words(room->elsewhere, room->elsewhere_bytes / sizeof(uint32_t));
}

contestant index_contestant(const index_question *question, index_form form, bool is_cold, const char *kernel)
{
    static bool (*const run[FORMS])(const contestant *, uint64_t *, tribox_report *) = {run_list,  run_count, run_any,
                                                                                        run_words, run_mask,  run_linear};
    const bool is_linear = form == FORM_LINEAR;
    contestant made = {.run = run[form], .question = question, .options = {.kernel = kernel}};
    made.pairs = (double)(is_linear ? question->linear_count : question->count);
    made.prepare = is_cold ? empty_caches : is_linear ? NULL : index_warm_up;
    snprintf(made.name, sizeof made.name, "%s", names[form]);
    return made;
}

double index_hits(const index_question *q, const char *kernel)
{
    double hits = 0;
    for (size_t b = 0; b < q->count; b++) {
        tribox_report one = {0, 0};
        ask_count(q, b, &(tribox_options){.kernel = kernel}, &one);
        hits += (double)one.overlapping;
    }
    return hits / (double)q->count;
}

static bool is_set(const uint64_t *mask, size_t i) { return mask[i / 64] >> i % 64 & 1; }

/* The list is to be the set bits in ascending order, each by the number that it has in the file. */
static bool is_list_right(const index_question *q, size_t found)
{
    size_t at = 0;
    for (size_t i = 0; i < q->triangles; i++)
        if (is_set(q->room->linear, i)) {
            if (at == found || q->room->list[at] != (q->ids ? q->ids[i] : (uint32_t)i))
                return false;
            at++;
        }
    return at == found;
}

static bool are_words_right(const index_question *q, size_t found)
{
    const size_t words = tribox_mask_words(q->triangles);
    size_t at = 0;
    for (size_t w = 0; w < words; w++)
        if (q->room->linear[w]) {
            if (at == found || q->room->number[at] != w || q->room->bits[at] != q->room->linear[w])
                return false;
            at++;
        }
    return at == found;
}

/* Forms that are wrong about a box; a refusal is wrong, too. */
static unsigned find_wrong(const index_question *q, size_t b, const tribox_options *options)
{
    const size_t words = tribox_mask_words(q->triangles);
    tribox_report linear, mask, count, list, found, any;
    unsigned wrong = 0;
    if (!ask_linear(q, b, options, &linear))
        return 1u << FORM_LINEAR;
    memset(q->room->mask, 0xff, words * sizeof *q->room->mask);
    if (!ask_mask(q, b, options, &mask) || mask.overlapping != linear.overlapping ||
        memcmp(q->room->mask, q->room->linear, words * sizeof *q->room->mask) != 0)
        wrong |= 1u << FORM_MASK;
    if (!ask_count(q, b, options, &count) || count.overlapping != linear.overlapping)
        wrong |= 1u << FORM_COUNT;
    if (!ask_list(q, b, options, &list) || list.overlapping != linear.overlapping || !is_list_right(q, list.overlapping))
        wrong |= 1u << FORM_LIST;
    if (!ask_words(q, b, options, &found) || !are_words_right(q, found.overlapping))
        wrong |= 1u << FORM_WORDS;
    if (!ask_any(q, b, options, &any) || any.overlapping != (linear.overlapping > 0) ||
        (any.overlapping && !is_set(q->room->linear, q->room->number[0])))
        wrong |= 1u << FORM_ANY;
    return wrong;
}

bool index_forms_verify(const index_question *question, size_t boxes, const char *kernel)
{
    for (size_t b = 0; b < boxes && b < question->count; b++) {
        const unsigned wrong = find_wrong(question, b, &(tribox_options){.kernel = kernel});
        for (int f = 0; f < FORMS; f++)
            if (wrong >> f & 1)
                return message_failure("%s, box %zu: %s is wrong", question->name, b, names[f]) == EXIT_CODE_OK;
    }
    return true;
}
