/* index_calls.c - the calls that ask an index: what they check, and the form of the answer that they have found. */
#include "base/box.h"
#include "base/environment.h"
#include "pairs/partial_packet.h"
#include "index_descent.h"
#include "base/soup.h"

/* A call: its plan, its query, and what the query needs. */
typedef struct call {
    tribox_plan plan;
    tribox_partial_packet partial;
    tribox_rounded_box rounded;
    tribox_oriented_question oriented;
    tribox_answers answers;
    tribox_descent descent;
} call;

static bool is_readable(const tribox_index *index, const tribox_soup *soup)
{
    return index && index->nodes && tribox_soup_is_readable(soup) && index->count == soup->count;
}

/* The checks of the options; then all of a call is ready but the box. */
static tribox_status prepare_call(call *c, const tribox_index *index, const tribox_soup *soup, const tribox_options *options)
{
    const tribox_status status = tribox_plan_make(options, &c->plan);
    if (status)
        return status;
    if (!(c->plan.axes & TRIBOX_AXES_BOX))
        return TRIBOX_BAD_OPTION;
    c->descent.nodes = index->nodes;
    tribox_levels_set(&c->descent.levels, index->count);
    c->descent.pairs = (tribox_query){.soup = tribox_pad_triangles(soup, c->plan.kernel, &c->partial), .count = soup->count};
    c->descent.oriented = NULL;
    c->descent.plan = &c->plan;
    c->descent.may_choose = c->plan.choice.is_adaptive;
    c->descent.to = &c->answers;
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
    const tribox_status status = prepare_call(c, index, soup, options);
    c->descent.pairs.box = &c->rounded;
    c->rounded.exact = *box; /* rounded later, in our environment */
    return status;
}

/* The same for an oriented box. */
static tribox_status prepare_at_oriented(call *c, const tribox_index *index, const tribox_soup *soup,
                                         const tribox_oriented_box *box, const tribox_options *options)
{
    if (!box || !is_readable(index, soup))
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_oriented_is_finite(box))
        return TRIBOX_BAD_BOX;
    const tribox_status status = prepare_call(c, index, soup, options);
    c->descent.oriented = &c->oriented;
    c->oriented.box = box; /* asked later, in our environment */
    return status || tribox_oriented_has_axes(&c->plan) ? status : TRIBOX_BAD_OPTION;
}

/* Rounds the box. False if nothing overlaps it, as it is empty. Needs tribox_environment_enter(). */
static bool start_at_box(call *c)
{
    const tribox_oriented_box *const oriented = c->oriented.box;
    if (c->descent.oriented && tribox_oriented_is_empty(oriented))
        return false;
    if (c->descent.oriented) {
        tribox_oriented_ask_soup(&c->oriented, c->descent.pairs.soup, oriented, &c->plan);
        return true;
    }
    const tribox_box box = c->rounded.exact;
    tribox_box_round(&box, true, &c->rounded);
    return !tribox_box_is_empty(&box);
}

/* Answers about the box of a call in the form that is set, if it could be prepared. found: of words or a list; else NULL. */
static tribox_status answer(call *c, tribox_status prepared, size_t *found, tribox_report *report)
{
    if (prepared)
        return prepared;
    if (c->answers.form == TRIBOX_MASK)
        tribox_pairs_write_none(c->descent.pairs.count, c->answers.mask);
    const tribox_environment callers = tribox_environment_enter();
    if (start_at_box(c))
        tribox_descent_run(&c->descent);
    tribox_environment_leave(callers);
    if (found)
        *found = c->answers.found;
    tribox_plan_report(&c->plan, c->answers.counts, report);
    return TRIBOX_OK;
}

static void set_mask(call *c, uint64_t *mask)
{
    c->answers = (tribox_answers){.form = mask ? TRIBOX_MASK : TRIBOX_COUNT, .mask = mask};
}

tribox_status tribox_index_overlap(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                   const tribox_options *options, uint64_t *mask, tribox_report *report)
{
    call c;
    set_mask(&c, mask);
    return answer(&c, prepare_at_box(&c, index, soup, box, options), NULL, report);
}

tribox_status tribox_index_overlap_oriented(const tribox_index *index, const tribox_soup *soup, const tribox_oriented_box *box,
                                            const tribox_options *options, uint64_t *mask, tribox_report *report)
{
    call c;
    set_mask(&c, mask);
    return answer(&c, prepare_at_oriented(&c, index, soup, box, options), NULL, report);
}

tribox_status tribox_index_words(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                 const tribox_options *options, size_t room, uint32_t *number, uint64_t *bits, uint64_t *inside,
                                 size_t *found, tribox_report *report)
{
    if (!found || (room && (!number || !bits)) || !soup || !tribox_has_numbers(tribox_words_of(soup->count)))
        return TRIBOX_BAD_ARGUMENT;
    call c;
    c.answers = (tribox_answers){.form = TRIBOX_WORDS, .number = number, .bits = bits, .inside = inside, .room = room};
    return answer(&c, prepare_at_box(&c, index, soup, box, options), found, report);
}

/* False if no list of triangles of this soup can be written there. */
static bool set_list(call *c, const tribox_soup *soup, const uint32_t *ids, size_t room, uint32_t *list)
{
    c->answers = (tribox_answers){.form = TRIBOX_LIST, .ids = ids, .list = list, .room = room};
    return (list || !room) && soup && tribox_has_numbers(soup->count);
}

tribox_status tribox_index_list(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                const tribox_options *options, const uint32_t *ids, size_t room, uint32_t *list, size_t *found)
{
    call c;
    if (!found || !set_list(&c, soup, ids, room, list))
        return TRIBOX_BAD_ARGUMENT;
    return answer(&c, prepare_at_box(&c, index, soup, box, options), found, NULL);
}

tribox_status tribox_index_list_oriented(const tribox_index *index, const tribox_soup *soup, const tribox_oriented_box *box,
                                         const tribox_options *options, const uint32_t *ids, size_t room, uint32_t *list,
                                         size_t *found)
{
    call c;
    if (!found || !set_list(&c, soup, ids, room, list))
        return TRIBOX_BAD_ARGUMENT;
    return answer(&c, prepare_at_oriented(&c, index, soup, box, options), found, NULL);
}

static tribox_box box_at(const tribox_boxes *boxes, size_t i)
{
    return (tribox_box){{boxes->lo[0][i], boxes->lo[1][i], boxes->lo[2][i]}, {boxes->hi[0][i], boxes->hi[1][i], boxes->hi[2][i]}};
}

tribox_status tribox_index_lists(const tribox_index *index, const tribox_soup *soup, const tribox_boxes *boxes,
                                 const tribox_options *options, const uint32_t *ids, size_t room, uint32_t *list, size_t *start)
{
    call c;
    if (!start || !set_list(&c, soup, ids, room, list) || !is_readable(index, soup) || !tribox_boxes_are_readable(boxes))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_status status = prepare_call(&c, index, soup, options);
    if (status)
        return status;
    c.descent.pairs.box = &c.rounded;
    const tribox_environment callers = tribox_environment_enter();
    for (size_t i = 0; i < boxes->count; i++) {
        const tribox_box box = box_at(boxes, i);
        start[i] = c.answers.found;
        c.rounded.exact = box;
        if (tribox_box_is_finite(&box) && start_at_box(&c))
            tribox_descent_run(&c.descent);
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
    if (!start_at_box(&c) || !tribox_descent_any(&c.descent, triangle))
        *triangle = soup->count;
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}
