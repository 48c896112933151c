/*
 * fuzz_oriented.c - tribox_overlap_oriented and tribox_mesh_overlap_oriented: triangles and an oriented box, of any three axes;
 * floats, or doubles next to them, at any scale.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "answers.h"
#include "ensure.h"
#include "oriented_oracle.h"
#include "tight_memory.h"
#include "target.h"

typedef struct fuzz_case {
    asked asked;
    tribox_soup soup;
    tribox_mesh mesh;
    tribox_oriented_box box;
    double u[PAIRS_DRAWN][3][3];
    bool is_finite, is_empty;
    bool is_mesh; /* is asked; else the soup */
} fuzz_case;

static bool are_finite(const double *numbers, int count)
{
    for (int k = 0; k < count; k++)
        if (!isfinite(numbers[k]))
            return false;
    return true;
}

/* The rotation of a quaternion of four small numbers, rounded. */
static void draw_rotation(input *in, double axis[3][3])
{
    double q[4], square = 0;
    for (int k = 0; k < 4; k++) {
        q[k] = (double)input_byte(in) - 127.5;
        square += q[k] * q[k];
    }
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        axis[k][k] = (double)(float)(1 - 2 * (q[a] * q[a] + q[b] * q[b]) / square);
        axis[k][a] = (double)(float)(2 * (q[k] * q[a] + q[b] * q[3]) / square);
        axis[k][b] = (double)(float)(2 * (q[k] * q[b] - q[a] * q[3]) / square);
    }
}

static void draw_floats(input *in, double *to, int count)
{
    float numbers[9];
    input_numbers(in, numbers, count);
    for (int k = 0; k < count; k++)
        to[k] = (double)numbers[k];
}

static tribox_oriented_box draw_box(input *in)
{
    tribox_oriented_box box;
    draw_floats(in, box.center, 3);
    draw_floats(in, box.half, 3);
    const bool is_rotation = input_byte(in) & 1;
    if (is_rotation)
        draw_rotation(in, box.axis);
    else
        draw_floats(in, box.axis[0], 9);
    for (int k = 0; k < 3; k++) /* a negative half length makes the whole box empty: enough for one byte in sixteen */
        if (input_byte(in) % 16)
            box.half[k] = fabs(box.half[k]);
    return box;
}

/* A vertex whose places along the axes of a rotation are eighths of the half lengths: but for rounding, often in contact. */
static void draw_vertex_in_frame(input *in, const tribox_oriented_box *box, float u[3])
{
    double place[3];
    for (int k = 0; k < 3; k++)
        place[k] = ((double)(input_byte(in) & 31) - 16) / 8 * box->half[k];
    for (int a = 0; a < 3; a++)
        u[a] = (float)(box->center[a] + place[0] * box->axis[0][a] + place[1] * box->axis[1][a] + place[2] * box->axis[2][a]);
}

static void draw_triangle(input *in, const tribox_oriented_box *box, float u[3][3])
{
    if (input_byte(in) & 1)
        input_triangle(in, u);
    else
        for (int j = 0; j < 3; j++)
            draw_vertex_in_frame(in, box, u[j]);
}

static const char *name_of(const fuzz_case *q) { return q->is_mesh ? "tribox_mesh_overlap_oriented" : "tribox_overlap_oriented"; }

static void explain(const fuzz_case *q, const tribox_options *o, size_t i)
{
    const double(*const u)[3] = (const double(*)[3])q->u[i % q->asked.drawn];
    if (q->is_finite && are_finite(u[0], 9))
        oriented_explain(stderr, u, &q->box);
    ensure(false, "%s, accuracy %d, axes %u, order %u, kernel %s: bit %zu of %zu is wrong", name_of(q), (int)o->accuracy, o->axes,
           o->axis_order, o->kernel, i, q->asked.count);
}

/* What is true of a triangle, by all axes and by its bounds alone. */
typedef struct truth {
    bool is_possible, overlaps, bounds_overlap;
} truth;

static void find_truths(const fuzz_case *q, truth truths[PAIRS_DRAWN])
{
    for (unsigned i = 0; i < q->asked.drawn; i++) {
        const double(*const u)[3] = (const double(*)[3])q->u[i];
        truths[i] = (truth){.is_possible = are_finite(u[0], 9) && !q->is_empty};
        if (!truths[i].is_possible)
            continue;
        truths[i].overlaps = oriented_oracle(u, &q->box);
        truths[i].bounds_overlap = oriented_oracle_bounds(u, &q->box);
        ensure(truths[i].bounds_overlap || !truths[i].overlaps, "the two oracles contradict each other");
    }
}

static bool is_right(const truth *t, bool bit, const tribox_options *o)
{
    const bool by_bounds = o->axes == TRIBOX_AXES_BOX;
    if (!t->is_possible || o->accuracy == TRIBOX_FAST)
        return t->is_possible || !bit;
    if (o->accuracy == TRIBOX_EXACT)
        return bit == (by_bounds ? t->bounds_overlap : t->overlaps);
    return bit || !(by_bounds ? t->bounds_overlap : t->overlaps);
}

static tribox_status ask_library(const fuzz_case *q, const tribox_options *o, uint64_t *mask, tribox_report *report)
{
    return q->is_mesh ? tribox_mesh_overlap_oriented(&q->mesh, &q->box, o, mask, report)
                      : tribox_overlap_oriented(&q->soup, &q->box, o, mask, report);
}

/* Nothing is written where the call refuses. */
static void ask(const fuzz_case *q, const tribox_options *o, const truth *truths)
{
    const char *const call = name_of(q);
    const size_t count = q->asked.count;
    const bool is_open = o->accuracy == TRIBOX_EXACT && o->axes && o->axes != TRIBOX_AXES_ALL && o->axes != TRIBOX_AXES_BOX;
    const unsigned wrong = q->asked.how.wrong | (is_open ? 1u << TRIBOX_BAD_OPTION : 0) | (q->is_finite ? 0 : 1u << TRIBOX_BAD_BOX);
    uint64_t *const mask = tight_mask(count);
    tribox_report report, alone;
    memset(&report, POISON, sizeof report);
    if (!status_fits(call, wrong, ask_library(q, o, mask, &report))) {
        ensure(is_poisoned(mask, tribox_mask_words(count) * sizeof *mask) && is_poisoned(&report, sizeof report),
               "%s writes although it refuses", call);
        return;
    }
    for (size_t i = 0; i < count; i++)
        if (!is_right(&truths[i % q->asked.drawn], mask_bit(mask, i), o))
            explain(q, o, i);
    ensure(report.overlapping == mask_population(call, mask, count), "%s reports %zu overlapping", call, report.overlapping);
    ensure(report.undecided <= (o->accuracy == TRIBOX_FAST ? 0 : count), "%s, accuracy %d, kernel %s, reports %zu of %zu undecided",
           call, (int)o->accuracy, o->kernel, report.undecided, count);
    if (o->kernel != runnable_kernels()[0])
        return;
    status_fits(call, 0, ask_library(q, o, NULL, &alone));
    ensure(alone.overlapping == report.overlapping, "%s without a mask counts otherwise", call);
}

/* Numbers next to floats, at another scale. */
static void widen(input *in, double *numbers, int count, int exponent, bool is_widened)
{
    for (int k = 0; k < count; k++) {
        const double share = is_widened ? ((double)input_byte(in) - 128) * 0x1p-33 : 0;
        numbers[k] = ldexp(numbers[k] + numbers[k] * share, exponent);
    }
}

/* Which numbers are doubles that are no floats; triangles that are cannot be a soup. */
enum { BOX_IS_WIDE = 1, TRIANGLES_ARE_WIDE = 2, IS_SCALED = 4 };
static void widen_case(input *in, fuzz_case *q, unsigned form)
{
    const int exponent = form & IS_SCALED ? 8 * (int)input_byte(in) - 1024 : 0;
    widen(in, q->box.center, 3, exponent, form & BOX_IS_WIDE);
    widen(in, q->box.half, 3, exponent, form & BOX_IS_WIDE);
    widen(in, q->box.axis[0], 9, 0, form & BOX_IS_WIDE);
    for (unsigned i = 0; i < q->asked.drawn; i++)
        widen(in, q->u[i][0], 9, exponent, form & TRIANGLES_ARE_WIDE);
}

/* Nine doubles each. */
static void lay_mesh(fuzz_case *q, size_t shift)
{
    double *const positions = tight_memory(q->asked.count * sizeof q->u[0], shift);
    for (size_t i = 0; i < q->asked.count; i++)
        memcpy((char *)positions + i * sizeof q->u[0], q->u[i % q->asked.drawn], sizeof q->u[0]);
    q->mesh = (tribox_mesh){
        .positions = positions, .vertices = 3 * q->asked.count, .count = q->asked.count, .position_bytes = sizeof(double)};
}

static void ask_kernels(const fuzz_case *q, const truth *truths)
{
    tribox_options o = q->asked.how.options;
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            o.kernel = q->asked.how.wrong ? q->asked.how.options.kernel : *kernel;
            o.accuracy = q->asked.how.wrong ? q->asked.how.options.accuracy : (tribox_accuracy)accuracy;
            ask(q, &o, truths);
        }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = input_of(data, size);
    fuzz_case q = {.asked = {.how = input_options(&in)}};
    truth truths[PAIRS_DRAWN];
    asked *const a = &q.asked;
    const size_t shift = input_below(&in, 4);
    a->count = input_count(&in) % 75; /* the integers of the library are slow here */
    q.box = draw_box(&in);
    const unsigned form = input_byte(&in) % 8;
    do
        draw_triangle(&in, &q.box, a->pair[a->drawn++].u);
    while (!input_is_over(&in) && a->drawn < PAIRS_DRAWN && a->drawn < a->count);
    for (unsigned k = 0; k < 9 * a->drawn; k++)
        q.u[k / 9][k / 3 % 3][k % 3] = (double)a->pair[k / 9].u[k / 3 % 3][k % 3];
    widen_case(&in, &q, form);
    q.is_finite = are_finite(q.box.center, 3) && are_finite(q.box.half, 3) && are_finite(&q.box.axis[0][0], 9);
    q.is_empty = q.box.half[0] < 0 || q.box.half[1] < 0 || q.box.half[2] < 0;
    q.soup = asked_soup(a, shift);
    lay_mesh(&q, shift);
    if (q.is_finite)
        find_truths(&q, truths);
    if (!(form & (TRIANGLES_ARE_WIDE | IS_SCALED)))
        ask_kernels(&q, truths);
    q.is_mesh = true;
    ask_kernels(&q, truths);
    tight_memory_free_all();
    return 0;
}
