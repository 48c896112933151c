/* index_question.c - what is asked of an index, and how nodes compare with it. */
#include "index_question.h"

#include "base/box.h"
#include "local_bounds.h"
#include "mesh/mesh_input.h"
#include "pairs/partial_packet.h"

bool tribox_question_take(tribox_question *q, const tribox_index *index)
{
    return tribox_indexed_take(index, &q->over) && index->nodes;
}

tribox_status tribox_question_check_region(tribox_question *q, const tribox_region *region)
{
    if (!region || !region->box == !region->oriented)
        return TRIBOX_BAD_ARGUMENT;
    q->oriented = region->oriented;
    if (region->box)
        q->box = *region->box;
    return (q->oriented ? tribox_oriented_is_finite(q->oriented) : tribox_box_is_finite(&q->box)) ? TRIBOX_OK : TRIBOX_BAD_BOX;
}

tribox_status tribox_question_check_options(tribox_question *q, const tribox_options *options)
{
    const tribox_status status = tribox_plan_make(options, &q->plan);
    if (status)
        return status;
    if (!(q->plan.axes & TRIBOX_AXES_BOX) || (q->oriented && !tribox_oriented_has_axes(&q->plan)))
        return TRIBOX_BAD_OPTION;
    const bool are_floats = !q->over.soup && tribox_mesh_has_floats(&q->over.mesh);
    if (q->oriented && q->plan.accuracy == TRIBOX_EXACT && tribox_oriented_is_upright(q->oriented, &q->box))
        q->oriented = NULL;
    q->asked = q->plan.accuracy;
    q->may_choose = q->plan.choice.is_adaptive;
    q->undecided = 0;
    if (q->over.soup) {
        q->pairs = (tribox_query){.soup = tribox_pad_triangles(q->over.soup, q->plan.kernel, &q->partial),
                                  .box = &q->rounded.box,
                                  .count = q->over.count};
        return TRIBOX_OK;
    }
    if (!are_floats && !q->oriented && q->asked == TRIBOX_FAST)
        q->plan.accuracy = TRIBOX_CONSERVATIVE;
    q->blocks = (tribox_mesh_query){.answer = are_floats ? tribox_mesh_answer_floats : tribox_mesh_answer_local,
                                    .answer_corners = are_floats ? tribox_mesh_floats_corners(&q->plan)
                                                                 : tribox_mesh_local_corners(&q->over.mesh),
                                    .plan = &q->plan,
                                    .about = are_floats ? (const void *)&q->rounded : &q->local};
    return TRIBOX_OK;
}

/* Bounds that are floats compare with the box as the floats do that they are. */
static void take_inner(tribox_node_box *nodes, const tribox_rounded_box *box)
{
    for (int a = 0; a < 3; a++) {
        nodes->outer[a] = nodes->inner[a] = box->lo[a];
        nodes->outer[3 + a] = nodes->inner[3 + a] = box->hi[a];
    }
}

bool tribox_question_about(tribox_question *q, const tribox_box *box)
{
    q->box = *box;
    if (tribox_box_is_empty(box))
        return false;
    if (!q->over.are_doubles) {
        tribox_box_round(box, true, q->plan.accuracy == TRIBOX_FAST, &q->rounded.box);
        take_inner(&q->nodes, &q->rounded.box);
    }
    if (!q->over.soup && q->blocks.answer == tribox_mesh_answer_local)
        tribox_local_box_make(&q->box, &q->plan, &q->local);
    return true;
}

bool tribox_question_start(tribox_question *q)
{
    const tribox_box box = q->box;
    if (!q->oriented)
        return tribox_question_about(q, &box);
    if (tribox_oriented_is_empty(q->oriented))
        return false;
    if (q->over.soup)
        tribox_oriented_ask_soup(&q->turned, q->pairs.soup, q->oriented, &q->plan);
    else
        tribox_oriented_ask_mesh(&q->turned, &q->over.mesh, q->oriented, &q->plan);
    return true;
}

/* Bounds of doubles are points seen from the origin of their node once they are wide enough. */
static tribox_touch touch_turned(const tribox_question *q, const tribox_node *node, unsigned children)
{
    tribox_node wide;
    tribox_rounded_frame frame;
    if (!q->over.are_doubles)
        return q->plan.kernel->nodes->touch_oriented(node, children, &q->turned.frame);
    tribox_node_widen(node, &wide);
    tribox_frame_round(q->oriented, node->origin, false, &frame);
    return q->plan.kernel->nodes->touch_oriented(&wide, children, &frame);
}

tribox_touch tribox_question_touch(tribox_question *q, const tribox_node *node, unsigned children)
{
    if (q->oriented)
        return touch_turned(q, node, children);
    if (q->over.are_doubles)
        tribox_node_box_seen(&q->box, node->origin, &q->nodes);
    return q->plan.kernel->nodes->touch(node, children, &q->nodes);
}
