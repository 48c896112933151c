/* overlap_f64.c - many triangles of doubles against one box: the calls. */
#include "base/bits.h"
#include "base/box.h"
#include "base/environment.h"
#include "mesh_f64.h"
#include "mesh_input.h"
#include "pairs/pairs.h"

/* One call. */
typedef struct call_f64 {
    tribox_accuracy asked;
    tribox_mesh mesh;
    tribox_plan plan;
    tribox_local_box local;
    tribox_mesh_query query;
} call_f64;

/* What every call checks. FAST is taken as CONSERVATIVE: all it saves, the error bounds, costs less than rounding. */
static tribox_status check_mesh_box(const tribox_mesh *mesh, const tribox_box_f64 *box, const tribox_options *options,
                                    call_f64 *call)
{
    if (!box || !tribox_mesh_is_readable_f64(mesh))
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_box_is_finite_f64(box))
        return TRIBOX_BAD_BOX;
    const tribox_status status = tribox_plan_make(options, &call->plan);
    if (status)
        return status;
    call->asked = call->plan.accuracy;
    if (call->asked == TRIBOX_FAST)
        call->plan.accuracy = TRIBOX_CONSERVATIVE;
    call->mesh = tribox_mesh_with_strides(mesh);
    return TRIBOX_OK;
}

/* Needs tribox_environment_enter(). */
static void start_mesh_call(call_f64 *call, const tribox_box_f64 *box)
{
    const bool is_compared = call->plan.axes & TRIBOX_AXES_BOX && tribox_mesh_is_direct(&call->mesh);
    tribox_local_box_make(box, &call->plan, &call->local);
    call->query = (tribox_mesh_query){.answer = tribox_mesh_answer_f64,
                                      .plan = &call->plan,
                                      .pattern = is_compared ? &call->local.pattern : NULL,
                                      .is_empty = tribox_box_is_empty_f64(box),
                                      .in_double = true,
                                      .about = &call->local};
}

static void write_report(call_f64 *call, tribox_report counts, tribox_report *report)
{
    call->plan.accuracy = call->asked;
    tribox_plan_report(&call->plan, counts, report);
}

/* True if floats hold the box exactly: a mesh of floats then takes tribox_overlap_indexed. */
static bool is_box_of_floats(const tribox_box_f64 *box, tribox_box *same)
{
    bool are_floats = true;
    for (int a = 0; a < 3; a++) {
        same->lo[a] = (float)box->lo[a];
        same->hi[a] = (float)box->hi[a];
        are_floats &= same->lo[a] == box->lo[a] && same->hi[a] == box->hi[a];
    }
    return are_floats;
}

tribox_status tribox_overlap_indexed_f64(const tribox_mesh *mesh, const tribox_box_f64 *box, const tribox_options *options,
                                         uint64_t *mask, tribox_report *report)
{
    call_f64 call;
    tribox_box same;
    tribox_report counts = {0, 0};
    const tribox_status status = check_mesh_box(mesh, box, options, &call);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    if (tribox_mesh_is_readable(mesh) && is_box_of_floats(box, &same)) {
        tribox_environment_leave(callers);
        tribox_options in_float = options ? *options : (tribox_options){0};
        in_float.accuracy = call.plan.accuracy;
        const tribox_status answered = tribox_overlap_indexed(mesh, &same, &in_float, mask, &counts);
        if (answered == TRIBOX_OK)
            write_report(&call, counts, report);
        return answered;
    }
    start_mesh_call(&call, box);
    const bool is_answered = tribox_mesh_answer(&call.query, &call.mesh, mask, &counts);
    tribox_environment_leave(callers);
    if (!is_answered)
        return TRIBOX_BAD_VERTEX;
    write_report(&call, counts, report);
    return TRIBOX_OK;
}

/* The first triangle whose bit differs from that of `usual`, or the count of triangles. False if an index names no vertex. */
static bool first_unlike_in_block(const call_f64 *call, uint64_t usual, size_t *found)
{
    const size_t count = call->mesh.count;
    tribox_report counts = {0, 0};
    for (size_t first = 0, done; first < count; first += done) {
        uint64_t hit[TRIBOX_MESH_BLOCK / 64];
        const size_t left = count - first, asked = left < TRIBOX_MESH_STREAMED ? left : TRIBOX_MESH_STREAMED;
        done = tribox_mesh_answer_f64(&call->query, &call->mesh, first, asked, hit, &counts);
        if (!done)
            return false;
        for (size_t w = 0; w < tribox_words_of(done); w++)
            if (hit[w] != usual) { /* past the last triangle bits are zero: at the latest, the first unlike is one past it */
                *found = first + 64 * w + tribox_lowest_bit(hit[w] ^ usual);
                return true;
            }
    }
    *found = count;
    return true;
}

tribox_status tribox_mesh_find(const tribox_mesh *mesh, const tribox_box_f64 *box, const tribox_options *options,
                               tribox_find_what what, size_t *triangle)
{
    call_f64 call;
    size_t found = 0;
    bool is_answered = true;
    const bool is_known = triangle && (unsigned)what <= TRIBOX_FIRST_MISS;
    const uint64_t usual = what == TRIBOX_FIRST_HIT ? 0 : ~UINT64_C(0);
    const tribox_status status = is_known ? check_mesh_box(mesh, box, options, &call) : TRIBOX_BAD_ARGUMENT;
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    start_mesh_call(&call, box);
    if (call.query.is_empty)
        found = usual ? 0 : mesh->count;
    else
        is_answered = first_unlike_in_block(&call, usual, &found);
    tribox_environment_leave(callers);
    if (is_answered)
        *triangle = found;
    return is_answered ? TRIBOX_OK : TRIBOX_BAD_VERTEX;
}

/* Every block's answer, and which of it lies inside. Vertices have been checked. */
static tribox_report classify_mesh(const call_f64 *call, uint64_t *mask, uint64_t *inside)
{
    tribox_report counts = {0, 0};
    for (size_t first = 0, done; first < call->mesh.count; first += done) {
        uint64_t unasked[TRIBOX_MESH_BLOCK / 64], *const hit = mask ? mask + first / 64 : unasked;
        const size_t left = call->mesh.count - first, asked = left < TRIBOX_MESH_BLOCK ? left : TRIBOX_MESH_BLOCK;
        done = tribox_mesh_answer_f64(&call->query, &call->mesh, first, asked, hit, &counts);
        for (size_t w = 0; inside && w < tribox_words_of(done); w++)
            inside[first / 64 + w] = tribox_mesh_inside_f64(&call->mesh, call->local.box, first + 64 * w, hit[w]);
    }
    return counts;
}

tribox_status tribox_classify_f64(const tribox_mesh *mesh, const tribox_box_f64 *box, const tribox_options *options, uint64_t *mask,
                                  uint64_t *inside, tribox_report *report)
{
    call_f64 call;
    const tribox_status status = check_mesh_box(mesh, box, options, &call);
    if (status)
        return status;
    if (!tribox_mesh_is_in_range(&call.mesh, call.plan.kernel, 0, mesh->count))
        return TRIBOX_BAD_VERTEX;
    tribox_report counts = {0, 0};
    const tribox_environment callers = tribox_environment_enter();
    start_mesh_call(&call, box);
    if (call.query.is_empty) {
        tribox_pairs_write_none(mesh->count, mask);
        tribox_pairs_write_none(mesh->count, inside);
    } else {
        counts = classify_mesh(&call, mask, inside);
    }
    tribox_environment_leave(callers);
    write_report(&call, counts, report);
    return TRIBOX_OK;
}
