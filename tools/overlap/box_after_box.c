/* box_after_box.c - from one stage of the index to the next, and the question at each. */
#define _POSIX_C_SOURCE 200809L
#include "box_after_box.h"

#include <stdlib.h>

#include "console/clock.h"
#include "console/message.h"
#include "between_boxes.h"
#include "ordered_mesh.h"
#include "report.h"

/* What it takes to reach a stage: roughly, as that is good enough (build/bench/index). */
static const double seconds_per_triangle[] = {[INDEX_NONE] = 0, [INDEX_IN_FILE_ORDER] = 2e-9, [INDEX_ORDERED] = 100e-9};

/* FAST may say more by an index, and far triangles overlap where the axes of the box are left out. */
static bool is_for_index(const request *r, const mesh *m)
{
    const bool has_box_axes = !r->test.axes || r->test.axes & TRIBOX_AXES_BOX;
    return has_box_axes && !r->wants_inside && r->test.accuracy != TRIBOX_FAST && !m->is_double && m->triangles <= UINT32_MAX;
}

int box_after_box_start(const request *r, mesh *m, box_after_box *b)
{
    *b = (box_after_box){.r = r, .m = m, .last = is_for_index(r, m) ? INDEX_ORDERED : INDEX_NONE};
    return masks_make(m->triangles, r->wants_inside, &b->bits);
}

/* Whether there is memory for a stage. Where there is not, nothing has changed. */
static bool prepare(box_after_box *b, index_stage stage)
{
    const size_t count = b->m->soup.count;
    if (stage == INDEX_ORDERED)
        return (b->order = mesh_order(b->m)) != NULL;
    b->nodes = malloc(tribox_index_bytes(count));
    return b->nodes && (!b->r->wants_list || found_words_make(&b->words, count));
}

static int step_where_it_pays(box_after_box *b)
{
    if (b->stage == b->last || b->seconds < seconds_per_triangle[b->stage + 1] * (double)b->m->triangles)
        return EXIT_CODE_OK;
    if (!prepare(b, b->stage + 1)) {
        b->last = b->stage;
        return EXIT_CODE_OK;
    }
    b->stage++;
    b->seconds = 0;
    const tribox_status status = tribox_index_build(&b->m->soup, &b->r->test, b->nodes, &b->index);
    return message_status(status);
}

/* One box of doubles and all later ones need room for more words. */
static tribox_status ask_between(box_after_box *b, const tribox_box *box, tribox_report *report)
{
    const size_t count = b->m->soup.count;
    if ((!b->words.bits && !found_words_make(&b->words, count)) || (!b->inner.bits && !found_words_make(&b->inner, count)))
        return MESSAGE_NO_MEMORY;
    const tribox_status status = between_boxes_index(&b->index, &b->m->soup, box, &b->r->test, &b->words, &b->inner, report);
    if (!status && b->order)
        found_words_renumber(&b->words, b->order);
    return status;
}

static tribox_status ask_index(box_after_box *b, const tribox_box *box, tribox_report *report)
{
    const tribox_soup *const soup = &b->m->soup;
    const tribox_options *const test = &b->r->test;
    found_words *const w = &b->words;
    if (!b->r->wants_list)
        return tribox_index_overlap(&b->index, soup, box, test, NULL, report);
    const tribox_status status =
        tribox_index_words(&b->index, soup, box, test, w->room, w->number, w->bits, NULL, &w->count, report);
    if (!status && b->order)
        found_words_renumber(w, b->order);
    return status;
}

static int ask(box_after_box *b, answer *a)
{
    const asked_triangles all = triangles_of_mesh(b->m);
    if (b->stage == INDEX_NONE)
        return overlap_ask(b->r, &all, &b->bits, a);
    tribox_box narrow;
    tribox_report report;
    const double start = clock_seconds();
    const tribox_status status = box_is_float(&a->box, &narrow) ? ask_index(b, &narrow, &report) : ask_between(b, &a->box, &report);
    a->seconds = clock_seconds() - start;
    if (status)
        return message_status(status);
    a->overlapping = report.overlapping;
    a->undecided = report.undecided;
    return EXIT_CODE_OK;
}

int box_after_box_ask(box_after_box *b, answer *a)
{
    int code = step_where_it_pays(b);
    if (!code)
        code = ask(b, a);
    a->stage = b->stage;
    b->seconds += a->seconds;
    return code;
}

int box_after_box_list(const box_after_box *b, answer *a)
{
    return b->stage == INDEX_NONE ? report_list(b->r, a, 0, b->bits.overlap, b->m->triangles) : report_words(b->r, a, &b->words);
}

void box_after_box_end(box_after_box *b)
{
    masks_free(&b->bits);
    found_words_free(&b->words);
    found_words_free(&b->inner);
    free(b->nodes);
    free(b->order);
}
