/* sweep.c - enters, verifies and times the orders; and counts what makes them fast or slow. */
#include "sweep.h"

#include <math.h>
#include <string.h>

const unsigned sweep_orders[SWEEP_ORDERS] = {SWEEP_DEFAULT, 123, 132, 213, 231, 312, 321};
const tribox_accuracy sweep_accuracies[SWEEP_ACCURACIES] = {TRIBOX_FAST, TRIBOX_CONSERVATIVE, TRIBOX_EXACT};

const unsigned sweep_axes[SWEEP_AXES] = {
    TRIBOX_AXES_BOX,   TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE,  TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES, TRIBOX_AXES_PLANE,
    TRIBOX_AXES_EDGES, TRIBOX_AXES_PLANE | TRIBOX_AXES_EDGES};

static void enter_all(sweep *s, const timing_work *work)
{
    const char *kernel;
    s->count = 0;
    for (int o = 1; o < SWEEP_ORDERS; o++)
        s->list[s->count++] = contestant_paper(work, sweep_orders[o]);
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++) {
        for (int a = 0; a < SWEEP_ACCURACIES; a++)
            for (int o = 0; o < SWEEP_ORDERS; o++)
                s->list[s->count++] = contestant_kernel(
                    work, &(tribox_options){sweep_accuracies[a], TRIBOX_AXES_ALL, sweep_orders[o], .kernel = kernel});
        for (int x = 0; x < SWEEP_AXES; x++)
            s->list[s->count++] = contestant_kernel(work, &(tribox_options){.axes = sweep_axes[x], .kernel = kernel});
    }
}

const char *sweep_run(sweep *s, const timing_work *work, effort how, generator *turns)
{
    enter_all(s, work);
    return contest_run(s, work, how, turns);
}

bool sweep_is_of(const contestant *one, const char *kernel)
{
    return kernel && one->options.kernel ? !strcmp(one->options.kernel, kernel) : one->options.kernel == kernel;
}

const contestant *sweep_find(const sweep *s, const char *kernel, tribox_accuracy accuracy, unsigned axes, unsigned order)
{
    for (const contestant *one = s->list; one < s->list + s->count; one++)
        if (sweep_is_of(one, kernel) && one->options.accuracy == accuracy && one->options.axes == axes &&
            one->options.axis_order == order)
            return one;
    return NULL;
}

static size_t index_of(const sweep *s, const contestant *of) { return (size_t)(of - s->list); }

const score *sweep_score(const sweep *s, const contestant *of) { return &s->scores[index_of(s, of)]; }

double sweep_time(const sweep *s, const contestant *of) { return measure_least(&s->taken, index_of(s, of)); }

bool sweep_beats(const sweep *s, const contestant *one, const contestant *other)
{
    const size_t won = measure_wins(&s->taken, index_of(s, one), index_of(s, other));
    return sweep_time(s, one) < 0.99 * sweep_time(s, other) && 4 * won >= 3 * s->taken.rounds;
}

const contestant *sweep_best(const sweep *s, const char *kernel, tribox_accuracy accuracy)
{
    const contestant *best = NULL;
    for (int o = 1; o < SWEEP_ORDERS; o++) {
        const contestant *const one = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, sweep_orders[o]);
        if (!best || sweep_time(s, one) < sweep_time(s, best))
            best = one;
    }
    return best;
}

/*
 * Why: the thirteen axes once more, in double and one pair at a time, from the formulas of the paper and not from the library:
 * counts that do not depend on the machine, to set beside the times that do.
 */

const unsigned *const why_orders = sweep_orders + 1;
const unsigned why_lanes[WHY_WIDTHS] = {1, 4, 8, 16};

/* A triangle against a box, in double: bit k is for axis k. */
typedef struct why_axes {
    unsigned apart; /* the axis separates the two */
    unsigned outer; /* the same, of an edge axis the outer side alone, as the kernels test it besides the box normals */
} why_axes;

enum { BOX_BITS = 7, PLANE_BITS = 1 << WHY_PLANE, EDGE_BITS = 0x1ff << WHY_EDGES };

/* Bullet 1: the numbers of the input themselves. */
static unsigned box_bits(const float u[3][3], const tribox_box *box)
{
    unsigned bits = 0;
    for (int a = 0; a < 3; a++) {
        const bool is_below = u[0][a] < box->lo[a] && u[1][a] < box->lo[a] && u[2][a] < box->lo[a];
        const bool is_above = u[0][a] > box->hi[a] && u[1][a] > box->hi[a] && u[2][a] > box->hi[a];
        bits |= (unsigned)(is_below || is_above) << a;
    }
    return bits;
}

/* A triangle about the centre of its box, in the paper's letters. */
typedef struct shape {
    double v[3][3], f[3][3], n[3], h[3];
} shape;

static shape shape_of(const float u[3][3], const tribox_box *box)
{
    shape s;
    for (int a = 0; a < 3; a++) {
        const double lo = (double)box->lo[a], hi = (double)box->hi[a];
        s.h[a] = (hi - lo) / 2;
        for (int j = 0; j < 3; j++) {
            s.v[j][a] = (double)u[j][a] - (lo + hi) / 2;
            s.f[j][a] = (double)u[(j + 1) % 3][a] - (double)u[j][a];
        }
    }
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        s.n[i] = s.f[0][a] * s.f[1][b] - s.f[0][b] * s.f[1][a];
    }
    return s;
}

/* Bullet 2. */
static bool is_apart_on_plane(const shape *s)
{
    const double d = s->n[0] * s->v[0][0] + s->n[1] * s->v[0][1] + s->n[2] * s->v[0][2];
    return fabs(d) > s->h[0] * fabs(s->n[0]) + s->h[1] * fabs(s->n[1]) + s->h[2] * fabs(s->n[2]);
}

/* Bullet 3, axis e_i x f_j: p of the edge, q of the third vertex, r of the box. The outer side is the one away from q. */
static void ask_edge(const shape *s, int i, int j, why_axes *found)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3, third = (j + 2) % 3;
    const double *const f = s->f[j];
    const double p = s->v[j][a] * f[b] - s->v[j][b] * f[a];
    const double q = s->v[third][a] * f[b] - s->v[third][b] * f[a];
    const double r = s->h[a] * fabs(f[b]) + s->h[b] * fabs(f[a]);
    const unsigned bit = 1u << (WHY_EDGES + 3 * i + j);
    const bool is_outer = signbit(s->n[i]) ? p > r : -p > r;
    found->apart |= fmin(p, q) > r || fmax(p, q) < -r ? bit : 0;
    found->outer |= is_outer ? bit : 0;
}

static why_axes why_axes_of(const float triangle[3][3], const tribox_box *box)
{
    const shape s = shape_of(triangle, box);
    why_axes found;
    found.apart = found.outer = box_bits(triangle, box) | (is_apart_on_plane(&s) ? PLANE_BITS : 0u);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            ask_edge(&s, i, j, &found);
    return found;
}

static bool is_finite(const float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            if (!isfinite(u[j][a]))
                return false;
    return true;
}

static unsigned bits_of_group(unsigned group) { return group == 1 ? BOX_BITS : group == 2 ? PLANE_BITS : EDGE_BITS; }

/* The k-th group of an order. */
static unsigned group_at(unsigned order, int k) { return (k == 0 ? order / 100 : k == 1 ? order / 10 : order) % 10; }

static void count_axes(unsigned bits, size_t counts[WHY_AXES])
{
    for (int axis = 0; axis < WHY_AXES; axis++)
        counts[axis] += bits >> axis & 1;
}

static void count_pair(why *found, why_axes axes)
{
    found->pairs++;
    found->overlapping += !axes.apart;
    count_axes(axes.apart, found->apart);
    if (!(axes.apart & (axes.apart - 1)))
        count_axes(axes.apart, found->only);
    if (!(axes.apart & BOX_BITS))
        count_axes(axes.apart, found->unboxed);
    for (int o = 0; o < WHY_ORDERS; o++)
        for (int k = 0; k < 3; k++) {
            const unsigned rejecting = axes.outer & bits_of_group(group_at(why_orders[o], k));
            if (rejecting) {
                found->order[o].first[__builtin_ctz(rejecting)]++;
                break;
            }
        }
}

/* Packets of a word that have a bit set. */
static size_t packets_with(uint64_t left, unsigned lanes)
{
    size_t packets = 0;
    for (unsigned lane = 0; lane < 64; lane += lanes)
        packets += (left >> lane & ~UINT64_C(0) >> (64 - lanes)) != 0;
    return packets;
}

/* A word of 64 pairs: bit i of rejected[k] is set if axis k rejects pair i. */
static void count_packets(why *found, const uint64_t rejected[WHY_AXES], size_t count)
{
    uint64_t by_group[4] = {0};
    for (unsigned group = 1; group <= 3; group++)
        for (int axis = 0; axis < WHY_AXES; axis++)
            by_group[group] |= bits_of_group(group) >> axis & 1 ? rejected[axis] : 0;
    const uint64_t left_by_x = ~rejected[0], left_by_xy = left_by_x & ~rejected[1];
    for (int w = 0; w < WHY_WIDTHS; w++) {
        const unsigned lanes = why_lanes[w];
        const size_t axes_loaded = 64 / lanes + packets_with(left_by_x, lanes) + packets_with(left_by_xy, lanes);
        found->packets[w] += 64 / lanes;
        for (int o = 0; o < WHY_ORDERS; o++) {
            uint64_t left = ~UINT64_C(0);
            for (int k = 0; k < 3; k++) {
                left &= ~by_group[group_at(why_orders[o], k)];
                found->order[o].packets_left[w][k] += packets_with(left, lanes);
            }
            /* A last word that is not full is copied as a whole before it is walked. */
            const bool is_lazy = group_at(why_orders[o], 0) == 1 && count == 64;
            found->order[o].bytes[w] += is_lazy ? 12 * lanes * axes_loaded : 36 * count;
        }
    }
}

static void count_word(why *found, const timing_job *job, size_t first)
{
    static const float zeros[3][3]; /* the lanes past the end of a soup hold zeros */
    const size_t rest = job->soup.count - first, count = rest < 64 ? rest : 64;
    uint64_t rejected[WHY_AXES] = {0};
    for (size_t lane = 0; lane < 64; lane++) {
        const bool is_there = lane < count;
        const float(*const triangle)[3] = is_there ? job->triangles[first + lane] : zeros;
        if (!is_finite(triangle))
            continue;
        const why_axes axes = why_axes_of(triangle, &job->box);
        if (is_there)
            count_pair(found, axes);
        for (int axis = 0; axis < WHY_AXES; axis++)
            rejected[axis] |= (uint64_t)(axes.outer >> axis & 1) << lane;
    }
    count_packets(found, rejected, count);
}

void why_find(const timing_work *work, why *found)
{
    memset(found, 0, sizeof *found);
    for (size_t i = 0; i < work->count; i++)
        for (size_t first = 0; first < work->jobs[i].soup.count; first += 64)
            count_word(found, &work->jobs[i], first);
}
