/* index_answers.c - the calls that ask an index: their checks, and the forms of their answers. */
#include <string.h>

#include "bits.h"
#include "box.h"
#include "environment.h"
#include "few.h"
#include "index_query.h"
#include "soup.h"

/* Whether so many things have numbers of 32 bits. */
static bool has_numbers(size_t count) { return (uint64_t)count <= UINT64_C(1) << 32; }

/* The triangles of a word, as a list. */
static void list_word(tribox_answers *to, size_t word, uint64_t hit)
{
    const size_t count = tribox_count_bits(hit), there = to->found < to->room ? to->room - to->found : 0;
    uint32_t *const list = there ? to->list + to->found : NULL;
    for (size_t n = 0; n < count && n < there; n++, hit &= hit - 1) {
        const size_t i = 64 * word + tribox_lowest_bit(hit);
        list[n] = to->ids ? to->ids[i] : (uint32_t)i;
    }
    to->found += count;
}

static void list_full(tribox_answers *to, size_t word, size_t words)
{
    const size_t first = 64 * word, there = to->found < to->room ? to->room - to->found : 0;
    const size_t count = 64 * words < there ? 64 * words : there;
    if (to->ids && count)
        memcpy(to->list + to->found, to->ids + first, count * sizeof *to->list);
    for (size_t i = 0; !to->ids && i < count; i++)
        to->list[to->found + i] = (uint32_t)(first + i);
    to->found += 64 * words;
}

static void put_word(tribox_answers *to, size_t word, uint64_t hit, uint64_t inside)
{
    if (to->found < to->room) {
        to->number[to->found] = (uint32_t)word;
        to->bits[to->found] = hit;
        if (to->inside)
            to->inside[to->found] = inside;
    }
    to->found++;
}

void tribox_answers_take_word(const tribox_query *q, size_t word, uint64_t hit)
{
    tribox_answers *const to = q->to;
    uint64_t inside = 0;
    if (to->inside) { /* as in tribox_classify */
        const uint64_t candidates = q->plan->accuracy == TRIBOX_FAST ? ~UINT64_C(0) : hit;
        inside = candidates ? q->plan->kernel->inside(q->pairs.soup, q->pairs.box, word, candidates) : 0;
        hit |= inside;
    }
    to->counts.overlapping += tribox_count_bits(hit);
    if (to->form == TRIBOX_MASK)
        to->mask[word] = hit;
    else if (to->form == TRIBOX_WORDS && hit)
        put_word(to, word, hit, inside);
    else if (to->form == TRIBOX_LIST)
        list_word(to, word, hit);
}

void tribox_answers_take_full(const tribox_query *q, size_t word, size_t words)
{
    tribox_answers *const to = q->to;
    to->counts.overlapping += 64 * words;
    if (to->form == TRIBOX_MASK)
        memset(to->mask + word, 0xFF, words * sizeof *to->mask);
    for (size_t w = 0; to->form == TRIBOX_WORDS && w < words; w++)
        put_word(to, word + w, ~UINT64_C(0), ~UINT64_C(0));
    if (to->form == TRIBOX_LIST)
        list_full(to, word, words);
}

/* A call: its plan, its query, and what the query needs. */
typedef struct call {
    tribox_plan plan;
    tribox_few few;
    tribox_answers answers;
    tribox_query query;
} call;

static bool is_readable(const tribox_index *index, const tribox_soup *soup)
{
    return index && index->nodes && tribox_soup_is_readable(soup) && index->count == soup->count;
}

/* The checks of the options; then all of a call is ready but the box. */
static tribox_status prepare(call *c, const tribox_index *index, const tribox_soup *soup, const tribox_options *options)
{
    const tribox_status status = tribox_plan_make(options, &c->plan);
    if (status)
        return status;
    if (!(c->plan.axes & TRIBOX_AXES_BOX))
        return TRIBOX_BAD_OPTION;
    c->query.nodes = index->nodes;
    c->query.levels = tribox_levels_of(index->count);
    c->query.pairs = (tribox_pairs){.soup = tribox_few_triangles(soup, c->plan.kernel, &c->few), .count = soup->count};
    c->query.plan = &c->plan;
    c->query.may_choose = c->plan.choice.is_open;
    c->query.to = &c->answers;
    return TRIBOX_OK;
}

/* The checks of a call about one box, whose form of answer is set. */
static tribox_status prepare_at_box(call *c, const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                    const tribox_options *options)
{
    if (!box || !is_readable(index, soup))
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_box_is_finite(box))
        return TRIBOX_BAD_BOX;
    const tribox_status status = prepare(c, index, soup, options);
    c->query.pairs.box = box;
    return status;
}

static void run(call *c)
{
    if (!tribox_box_is_empty(c->query.pairs.box))
        tribox_query_run(&c->query);
}

/* One box, in the form that is set. */
static tribox_status answer(call *c, const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                            const tribox_options *options, tribox_report *report)
{
    const tribox_status status = prepare_at_box(c, index, soup, box, options);
    if (status)
        return status;
    if (c->answers.form == TRIBOX_MASK)
        tribox_pairs_write_none(soup->count, c->answers.mask);
    const tribox_environment callers = tribox_environment_enter();
    run(c);
    tribox_environment_leave(callers);
    tribox_plan_report(&c->plan, c->answers.counts, report);
    return TRIBOX_OK;
}

tribox_status tribox_index_overlap(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                   const tribox_options *options, uint64_t *mask, tribox_report *report)
{
    call c;
    c.answers = (tribox_answers){.form = mask ? TRIBOX_MASK : TRIBOX_COUNT, .mask = mask};
    return answer(&c, index, soup, box, options, report);
}

tribox_status tribox_index_words(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                 const tribox_options *options, size_t room, uint32_t *number, uint64_t *bits, uint64_t *inside,
                                 size_t *found, tribox_report *report)
{
    if (!found || (room && (!number || !bits)) || !soup || !has_numbers(tribox_words_of(soup->count)))
        return TRIBOX_BAD_ARGUMENT;
    call c;
    c.answers = (tribox_answers){.form = TRIBOX_WORDS, .number = number, .bits = bits, .inside = inside, .room = room};
    const tribox_status status = answer(&c, index, soup, box, options, report);
    if (!status)
        *found = c.answers.found;
    return status;
}

/* A list of triangles of this soup can be written. */
static bool can_list(const tribox_soup *soup, size_t room, const uint32_t *list)
{
    return (list || !room) && soup && has_numbers(soup->count);
}

tribox_status tribox_index_list(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                const tribox_options *options, const uint32_t *ids, size_t room, uint32_t *list, size_t *found)
{
    if (!found || !can_list(soup, room, list))
        return TRIBOX_BAD_ARGUMENT;
    call c;
    c.answers = (tribox_answers){.form = TRIBOX_LIST, .ids = ids, .list = list, .room = room};
    const tribox_status status = answer(&c, index, soup, box, options, NULL);
    if (!status)
        *found = c.answers.found;
    return status;
}

static tribox_box box_at(const tribox_boxes *boxes, size_t i)
{
    return (tribox_box){{boxes->lo[0][i], boxes->lo[1][i], boxes->lo[2][i]}, {boxes->hi[0][i], boxes->hi[1][i], boxes->hi[2][i]}};
}

tribox_status tribox_index_lists(const tribox_index *index, const tribox_soup *soup, const tribox_boxes *boxes,
                                 const tribox_options *options, const uint32_t *ids, size_t room, uint32_t *list, size_t *start)
{
    if (!start || !can_list(soup, room, list) || !is_readable(index, soup) || !tribox_boxes_are_readable(boxes))
        return TRIBOX_BAD_ARGUMENT;
    call c;
    c.answers = (tribox_answers){.form = TRIBOX_LIST, .ids = ids, .list = list, .room = room};
    const tribox_status status = prepare(&c, index, soup, options);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    for (size_t i = 0; i < boxes->count; i++) {
        const tribox_box box = box_at(boxes, i);
        start[i] = c.answers.found;
        c.query.pairs.box = &box;
        if (tribox_box_is_finite(&box))
            run(&c);
    }
    tribox_environment_leave(callers);
    start[boxes->count] = c.answers.found;
    return TRIBOX_OK;
}

tribox_status tribox_index_any(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                               const tribox_options *options, size_t *triangle)
{
    if (!triangle)
        return TRIBOX_BAD_ARGUMENT;
    call c;
    const tribox_status status = prepare_at_box(&c, index, soup, box, options);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    if (tribox_box_is_empty(box) || !tribox_query_any(&c.query, triangle))
        *triangle = soup->count;
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}
