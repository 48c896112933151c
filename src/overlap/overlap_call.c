/* overlap_call.c - one box and many triangles, of a soup or a mesh: checks, and blocks of answers. */
#include "overlap_call.h"

#include "base/bits.h"
#include "base/box.h"
#include "mesh/mesh_input.h"

bool tribox_call_take_mesh(tribox_overlap_call *c, const tribox_mesh *mesh)
{
    if (!tribox_mesh_take(mesh, &c->mesh))
        return false;
    c->soup = NULL;
    c->count = mesh->count;
    return true;
}

void tribox_call_start_mesh(tribox_overlap_call *c, tribox_codes *codes, bool is_all_asked)
{
    const bool are_floats = tribox_mesh_has_floats(&c->mesh), has_box = c->plan.axes & TRIBOX_AXES_BOX;
    const tribox_box_pattern *pattern = NULL;
    c->is_few_of_mesh =
        are_floats && !c->is_empty && c->count && c->count <= TRIBOX_MESH_FEW && tribox_mesh_are_corners_walked(&c->plan);
    if (c->is_few_of_mesh) {
        tribox_box_round(c->box, true, c->plan.accuracy == TRIBOX_FAST, &c->rounded.box);
        c->query = (tribox_mesh_query){.answer = tribox_mesh_answer_few, .plan = &c->plan, .about = &c->rounded};
        return;
    }
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

size_t tribox_call_answer_part(tribox_overlap_call *c, size_t first, size_t count, uint64_t *hit, tribox_report *counts)
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
