/* index_calls.c - the calls that ask an index: what they check, and the form of the answer that they have found. */
#include "base/box.h"
#include "base/environment.h"
#include "base/floats.h"
#include "index_descent.h"

/* A call: its question, and what becomes of the answers. */
typedef struct call {
    tribox_question about;
    tribox_answers answers;
    tribox_descent descent;
} call;

/* The checks of the options, once there are triangles and a region; then all is ready. */
static tribox_status prepare(call *c, const tribox_index *index, const tribox_options *options)
{
    const tribox_status status = tribox_question_check_options(&c->about, options);
    c->descent.nodes = index->nodes;
    c->descent.about = &c->about;
    c->descent.to = &c->answers;
    tribox_levels_set(&c->descent.levels, c->about.over.count);
    return status;
}

/* The checks of the region and the options of a call whose triangles may have been taken. */
static tribox_status prepare_at(call *c, bool is_taken, const tribox_index *index, const tribox_region *region,
                                const tribox_options *options)
{
    const tribox_status status = is_taken ? tribox_question_check_region(&c->about, region) : TRIBOX_BAD_ARGUMENT;
    return status ? status : prepare(c, index, options);
}

/* Answers about the region of a call in the form that is set, if it could be prepared. found: of words or a list; else NULL. */
static tribox_status answer(call *c, tribox_status prepared, size_t *found, tribox_report *report)
{
    if (prepared)
        return prepared;
    if (c->answers.form == TRIBOX_MASK)
        tribox_pairs_write_none(c->about.over.count, c->answers.mask);
    const tribox_environment callers = tribox_environment_enter();
    if (tribox_question_start(&c->about))
        tribox_descent_run(&c->descent);
    tribox_environment_leave(callers);
    if (found)
        *found = c->answers.found;
    c->about.plan.accuracy = c->about.asked;
    tribox_plan_report(&c->about.plan, (tribox_report){c->answers.overlapping, c->about.undecided}, report);
    return TRIBOX_OK;
}

tribox_status tribox_index_overlap(const tribox_index *index, const tribox_region *region, const tribox_options *options,
                                   uint64_t *mask, tribox_report *report)
{
    call c;
    const bool is_taken = tribox_question_take(&c.about, index);
    c.answers = (tribox_answers){.form = mask ? TRIBOX_MASK : TRIBOX_COUNT, .mask = mask};
    return answer(&c, prepare_at(&c, is_taken, index, region, options), NULL, report);
}

tribox_status tribox_index_words(const tribox_index *index, const tribox_region *region, const tribox_options *options, size_t room,
                                 uint32_t *number, uint64_t *bits, uint64_t *inside, size_t *found, tribox_report *report)
{
    call c;
    const bool is_taken = tribox_question_take(&c.about, index) && found && ((number && bits) || !room) &&
                          tribox_has_numbers(tribox_words_of(c.about.over.count)) && !(inside && region && region->oriented);
    c.answers = (tribox_answers){.form = TRIBOX_WORDS, .number = number, .bits = bits, .inside = inside, .room = room};
    return answer(&c, prepare_at(&c, is_taken, index, region, options), found, report);
}

/* The triangles of a call that lists them; false if no list of them can be written there. */
static bool take_for_list(call *c, const tribox_index *index, size_t room, uint32_t *list)
{
    if (!tribox_question_take(&c->about, index) || (room && !list) || !tribox_has_numbers(c->about.over.count))
        return false;
    c->answers = (tribox_answers){.form = TRIBOX_LIST, .ids = index->ids, .list = list, .room = room};
    return true;
}

tribox_status tribox_index_list(const tribox_index *index, const tribox_region *region, const tribox_options *options, size_t room,
                                uint32_t *list, size_t *found)
{
    call c;
    const bool is_taken = found && take_for_list(&c, index, room, list);
    return answer(&c, prepare_at(&c, is_taken, index, region, options), found, NULL);
}

static tribox_box box_at(const tribox_boxes *boxes, size_t i)
{
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = tribox_float_at(boxes->lo[a] + i);
        box.hi[a] = tribox_float_at(boxes->hi[a] + i);
    }
    return box;
}

tribox_status tribox_index_lists(const tribox_index *index, const tribox_boxes *boxes, const tribox_options *options, size_t room,
                                 uint32_t *list, size_t *start)
{
    call c;
    if (!start || !take_for_list(&c, index, room, list) || !tribox_boxes_are_readable(boxes))
        return TRIBOX_BAD_ARGUMENT;
    c.about.oriented = NULL;
    const tribox_status status = prepare(&c, index, options);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    for (size_t i = 0; i < boxes->count; i++) {
        const tribox_box box = box_at(boxes, i);
        start[i] = c.answers.found;
        if (tribox_box_is_finite(&box) && tribox_question_about(&c.about, &box))
            tribox_descent_run(&c.descent);
    }
    tribox_environment_leave(callers);
    start[boxes->count] = c.answers.found;
    return TRIBOX_OK;
}

tribox_status tribox_index_any(const tribox_index *index, const tribox_region *region, const tribox_options *options,
                               size_t *triangle)
{
    call c;
    const bool is_taken = tribox_question_take(&c.about, index) && triangle;
    const tribox_status status = prepare_at(&c, is_taken, index, region, options);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    if (!tribox_question_start(&c.about) || !tribox_descent_any(&c.descent, triangle))
        *triangle = c.about.over.count;
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}
