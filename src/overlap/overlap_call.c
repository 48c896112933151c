/* overlap_call.c - one box and many triangles, of a soup or a mesh: checks, and blocks of answers. */
#include "overlap_call.h"

#include "base/bits.h"
#include "base/box.h"
#include "mesh/mesh_input.h"
#include "pairs/partial_packet.h"

bool tribox_call_take_soup(tribox_overlap_call *c, const tribox_soup *soup)
{
    if (!tribox_soup_is_readable(soup))
        return false;
    c->soup = soup;
    c->count = soup->count;
    return true;
}

bool tribox_call_take_mesh(tribox_overlap_call *c, const tribox_mesh *mesh)
{
    if (!tribox_mesh_take(mesh, &c->mesh))
        return false;
    c->soup = NULL;
    c->count = mesh->count;
    return true;
}

tribox_status tribox_call_check(tribox_overlap_call *c, bool is_taken, const tribox_box *box, const tribox_options *options)
{
    if (!box || !is_taken)
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_box_is_finite(box))
        return TRIBOX_BAD_BOX;
    c->box = box;
    const tribox_status status = tribox_plan_make(options, &c->plan);
    c->asked = c->plan.accuracy;
    return status;
}

static void make_soup_query(tribox_overlap_call *c)
{
    const bool are_floats =
        tribox_box_round(c->box, c->plan.axes & TRIBOX_AXES_BOX, c->plan.accuracy == TRIBOX_FAST, &c->rounded.box);
    const bool is_flag_asked = are_floats && c->plan.accuracy == TRIBOX_EXACT;
    c->pairs = (tribox_query){.soup = tribox_pad_triangles(c->soup, c->plan.kernel, &c->partial),
                              .box = &c->rounded.box,
                              .count = c->count,
                              .ties = is_flag_asked ? TRIBOX_TIES_WHERE_SEVERAL : TRIBOX_TIES_LEFT};
}

static void make_mesh_query(tribox_overlap_call *c, tribox_codes *codes, bool is_all_asked)
{
    const bool are_floats = tribox_mesh_has_floats(&c->mesh), has_box = c->plan.axes & TRIBOX_AXES_BOX;
    const tribox_box_pattern *pattern = NULL;
    if (are_floats) {
        tribox_float_box_make(c->box, &c->plan, &c->rounded);
        pattern = &c->rounded.pattern;
    } else {
        if (c->asked == TRIBOX_FAST) /* all that FAST saves, the error bounds, costs less than rounding */
            c->plan.accuracy = TRIBOX_CONSERVATIVE;
        tribox_local_box_make(c->box, &c->plan, &c->local);
        pattern = tribox_mesh_has_doubles(&c->mesh) ? &c->local.pattern : NULL;
    }
    c->query = (tribox_mesh_query){.answer = are_floats ? tribox_mesh_answer_floats : tribox_mesh_answer_local,
                                   .plan = &c->plan,
                                   .pattern = has_box ? pattern : NULL,
                                   .codes = c->is_empty ? NULL : codes,
                                   .is_empty = c->is_empty,
                                   .in_double = !are_floats,
                                   .about = are_floats ? (const void *)&c->rounded : &c->local};
    if (c->query.codes)
        tribox_codes_start(codes, &c->mesh, c->box, is_all_asked);
}

/* Of floats, FAST has the bits of their streams, and may miss a triangle that is inside. */
bool tribox_call_may_code(const tribox_overlap_call *c)
{
    return !c->soup && c->plan.axes & TRIBOX_AXES_BOX && tribox_codes_help(&c->mesh) &&
           (c->asked != TRIBOX_FAST || tribox_mesh_has_doubles(&c->mesh));
}

void tribox_call_start(tribox_overlap_call *c, tribox_codes *codes, bool is_all_asked)
{
    c->is_empty = tribox_box_is_empty(c->box);
    if (c->soup)
        make_soup_query(c);
    else
        make_mesh_query(c, codes, is_all_asked);
}

size_t tribox_call_answer_block(tribox_overlap_call *c, size_t first, size_t count, uint64_t *hit, tribox_report *counts)
{
    if (!c->soup) {
        tribox_answer_block *const answer = c->query.codes ? tribox_mesh_answer_coded : c->query.answer;
        return answer(&c->query, &c->mesh, first, count < TRIBOX_MESH_BLOCK ? count : TRIBOX_MESH_BLOCK, hit, counts);
    }
    const size_t words = tribox_words_of(count);
    counts->undecided += tribox_pairs_answer_block(&c->pairs, &c->plan, first / 64, words, hit);
    for (size_t w = 0; w < words; w++)
        counts->overlapping += tribox_count_bits(hit[w]);
    return count;
}

bool tribox_call_answer(tribox_overlap_call *c, uint64_t *mask, tribox_report *counts)
{
    if (!c->soup)
        return tribox_mesh_answer(&c->query, &c->mesh, mask, counts);
    if (c->is_empty)
        tribox_pairs_write_none(c->count, mask);
    else
        *counts = tribox_pairs_answer(&c->pairs, &c->plan, mask);
    return true;
}

uint64_t tribox_call_inside(const tribox_overlap_call *c, size_t first, uint64_t candidates)
{
    if (c->soup)
        return c->plan.kernel->inside(c->pairs.soup, c->pairs.box, first / 64, candidates);
    const tribox_codes *const codes = c->query.codes;
    if (!codes)
        return tribox_mesh_inside(&c->mesh, c->box, first, candidates);
    const size_t w = (first - codes->answered) / 64;
    return (candidates & codes->inside[w]) | tribox_mesh_inside(&c->mesh, c->box, first, candidates & codes->unknown[w]);
}

void tribox_call_report(const tribox_overlap_call *c, tribox_report counts, tribox_report *report)
{
    if (c->asked == TRIBOX_FAST)
        counts.undecided = 0;
    tribox_plan_report(&c->plan, counts, report);
}
