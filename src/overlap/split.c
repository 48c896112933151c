/* split.c - which of the eight children of a box each listed triangle overlaps: the calls. */
#include <string.h>

#include "base/bits.h"
#include "base/box.h"
#include "base/environment.h"
#include "grid/listed.h"
#include "mesh/mesh_local.h"
#include "pairs/settle.h"

/* Child c has half c >> a & 1 on axis a. */
typedef struct split_call {
    tribox_triangles triangles;
    const uint32_t *list;
    size_t count;
    tribox_box half[2]; /* of the box, on each axis */
    double middle[3];
    tribox_halves rounded;
    tribox_plan plan; /* its accuracy is what runs: doubles, and small builds, take FAST as CONSERVATIVE */
    tribox_split_kind kind;
    bool are_hits_certain; /* else the kernel compares alone, and what that leaves is undecided */
    tribox_report counts;
} split_call;

/* Pairs of a triangle and a child, until they fill a batch. */
typedef struct gathering {
    tribox_batch batch;
    size_t place[TRIBOX_BATCH]; /* in the block */
    unsigned char child[TRIBOX_BATCH];
    unsigned count;
} gathering;

/* No sum of two doubles that overflows has a half that is rounded. */
static double nearest_middle(double lo, double hi)
{
    const double sum = lo + hi;
    return tribox_is_finite_double(sum) ? sum / 2 : lo / 2 + hi / 2;
}

/* False if the middle is not in the box. In our environment, as all that follows. */
static bool set_halves(split_call *s, const tribox_box *box, const double middle[3])
{
    s->half[0] = s->half[1] = *box;
    for (int a = 0; a < 3; a++) {
        const double at = middle ? middle[a] : nearest_middle(box->lo[a], box->hi[a]);
        s->half[0].hi[a] = s->half[1].lo[a] = s->middle[a] = at;
        if (!(box->lo[a] <= at && at <= box->hi[a]))
            return false;
    }
    return true;
}

/* Of doubles, less the middle: where every child has a corner. */
static void move_halves(split_call *s)
{
    for (int a = 0; a < 3; a++) {
        tribox_rounded_box *const low = &s->rounded.half[0], *const high = &s->rounded.half[1];
        const float below = (float)(s->middle[a] - s->half[0].lo[a]), above = (float)(s->half[1].hi[a] - s->middle[a]);
        low->lo[a] = low->of.C[a] = -below;
        high->hi[a] = high->of.H[a] = high->of.C[a] = above;
        low->of.H[a] = below;
        low->hi[a] = low->of.origin[a] = high->lo[a] = high->of.origin[a] = 0;
    }
}

static void choose_walk(split_call *s)
{
    const bool is_box_alone = s->plan.axes == TRIBOX_AXES_BOX;
    if (s->plan.accuracy == TRIBOX_FAST && (s->triangles.are_doubles || TRIBOX_WALKS_SOUPS_ALONE))
        s->plan.accuracy = TRIBOX_CONSERVATIVE;
    s->are_hits_certain = true;
    if (!s->triangles.are_doubles) {
        for (int half = 0; half < 2; half++)
            tribox_box_round(&s->half[half], true, s->plan.accuracy == TRIBOX_FAST, &s->rounded.half[half]);
        s->kind = is_box_alone ? TRIBOX_SPLIT_BOX : s->plan.accuracy == TRIBOX_FAST ? TRIBOX_SPLIT_BY_SIGN : TRIBOX_SPLIT_BY_MARGIN;
        return;
    }
    const bool is_for_all = !is_box_alone && tribox_is_ordinary(&s->half[0]) && tribox_is_ordinary(&s->half[1]);
    move_halves(s);
    s->kind = is_for_all ? TRIBOX_SPLIT_LOCAL : TRIBOX_SPLIT_LOCAL_BOX;
    s->are_hits_certain = is_for_all || is_box_alone;
}

/* Adds those that overlap to the bytes of the block. */
static void settle_children(split_call *s, gathering *g, uint8_t *hit)
{
    const tribox_verdict verdict = tribox_settle_batch(&g->batch, g->count, &s->plan);
    for (uint64_t left = verdict.overlapping; left; left &= left - 1) {
        const unsigned i = tribox_lowest_bit(left);
        hit[g->place[i]] |= (uint8_t)(1u << g->child[i]);
    }
    s->counts.undecided += tribox_count_bits(verdict.finite);
    g->count = 0;
}

/* Whether the bounds and numbers of pair i are apart on an axis. NaN is not: the next stage finds it. */
static bool is_pair_apart(const tribox_batch *batch, unsigned i)
{
    bool apart = false;
    for (int a = 0; a < 3; a++) {
        const double u = batch->number[3 * a][i], v = batch->number[3 * a + 1][i], w = batch->number[3 * a + 2][i];
        const double lo = batch->number[9 + a][i], hi = batch->number[12 + a][i];
        apart |= (bool)((u < lo) & (v < lo) & (w < lo)) | (bool)((u > hi) & (v > hi) & (w > hi));
    }
    return apart;
}

static void gather_child(split_call *s, gathering *g, const double number[9], size_t place, unsigned child, uint8_t *hit)
{
    for (int n = 0; n < 9; n++)
        g->batch.number[n][g->count] = number[n];
    for (int a = 0; a < 3; a++) {
        const tribox_box *const half = &s->half[child >> a & 1];
        g->batch.number[9 + a][g->count] = half->lo[a];
        g->batch.number[12 + a][g->count] = half->hi[a];
    }
    if (is_pair_apart(&g->batch, g->count))
        return;
    g->place[g->count] = place;
    g->child[g->count++] = (unsigned char)child;
    if (g->count == TRIBOX_BATCH)
        settle_children(s, g, hit);
}

static void settle_block(split_call *s, size_t first, size_t count, const int32_t *bits, uint8_t *hit)
{
    gathering g;
    g.count = 0;
    for (size_t i = 0; i < count; i++) {
        double number[9];
        if (!(bits[i] >> 8))
            continue;
        tribox_triangles_read(&s->triangles, s->list ? s->list[first + i] : first + i, 1, number, 1);
        for (unsigned left = (unsigned)bits[i] >> 8; left; left &= left - 1)
            gather_child(s, &g, number, i, tribox_lowest_bit(left), hit);
    }
    if (g.count)
        settle_children(s, &g, hit);
}

static size_t count_bits_of(const uint8_t *bytes, size_t count)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i += sizeof(uint64_t)) {
        uint64_t word = 0;
        memcpy(&word, bytes + i, count - i < sizeof word ? count - i : sizeof word);
        found += tribox_count_bits(word);
    }
    return found;
}

/* Triangles of a block as streams that fill a packet. Bits past the last triangle are scratch. */
typedef struct split_block {
    tribox_listed listed;
    int32_t bits[TRIBOX_LISTED_STREAM];
    uint8_t hit[TRIBOX_LISTED];
} split_block;

/* Few triangles are gathered into a packet of zeros. */
static void clear_packet(tribox_listed *listed)
{
    for (int n = 0; n < 9; n++)
        memset(listed->u[n], 0, TRIBOX_LANES_MAX * sizeof(float));
}

static tribox_soup stream_block(const split_call *s, size_t first, size_t count, split_block *block)
{
    const size_t lanes = s->plan.kernel->lanes;
    if (!s->list && s->triangles.is_soup && count >= lanes)
        return tribox_soup_part(s->triangles.soup, first, count);
    if (count < lanes)
        clear_packet(&block->listed);
    tribox_soup soup = tribox_listed_gather(&s->triangles, s->plan.kernel, s->middle, s->list, first, count, &block->listed);
    soup.count = count < lanes ? lanes : count;
    return soup;
}

static void answer_block(split_call *s, size_t first, size_t count, split_block *block)
{
    const tribox_soup soup = stream_block(s, first, count, block);
    const bool any = s->plan.kernel->split[s->kind](&soup, &s->rounded, block->bits) || !s->are_hits_certain;
    for (size_t i = 0; !s->are_hits_certain && i < count; i++)
        block->bits[i] = (block->bits[i] | block->bits[i] << 8) & 0xff00;
    for (size_t i = 0; i < count; i++)
        block->hit[i] = (uint8_t)block->bits[i];
    if (any)
        settle_block(s, first, count, block->bits, block->hit);
    s->counts.overlapping += count_bits_of(block->hit, count);
}

static void split_blocks(split_call *s, uint8_t *children)
{
    split_block block;
    choose_walk(s);
    for (size_t at = 0; at < s->count; at += TRIBOX_LISTED) {
        const size_t some = s->count - at < TRIBOX_LISTED ? s->count - at : TRIBOX_LISTED;
        answer_block(s, at, some, &block);
        if (children)
            memcpy(children + at, block.hit, some);
    }
}

static tribox_status check(split_call *s, bool is_taken, const tribox_box *box, const double *middle, const tribox_options *options)
{
    if (!box || !is_taken || !tribox_is_addressable(s->count) || (!s->list && s->count != s->triangles.count))
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_box_is_finite(box))
        return TRIBOX_BAD_BOX;
    for (int a = 0; middle && a < 3; a++)
        if (!tribox_is_finite_double(middle[a]))
            return TRIBOX_BAD_BOX;
    const tribox_status status = tribox_plan_make(options, &s->plan);
    return status || s->plan.axes == TRIBOX_AXES_ALL || s->plan.axes == TRIBOX_AXES_BOX ? status : TRIBOX_BAD_OPTION;
}

static bool are_there(const split_call *s)
{
    return s->list ? tribox_listed_are_there(&s->triangles, s->plan.kernel, s->list, s->count)
                   : tribox_triangles_have_vertices(&s->triangles, s->plan.kernel);
}

static tribox_status answer_checked(split_call *s, const tribox_box *box, const double *middle, uint8_t *children)
{
    const bool is_empty = tribox_box_is_empty(box);
    if (!is_empty && !set_halves(s, box, middle))
        return TRIBOX_BAD_BOX;
    if (!are_there(s))
        return TRIBOX_BAD_VERTEX;
    if (!is_empty)
        split_blocks(s, children);
    else if (children && s->count)
        memset(children, 0, s->count);
    return TRIBOX_OK;
}

static tribox_status split(split_call *s, bool is_taken, const tribox_box *box, const double *middle, const tribox_options *options,
                           uint8_t *children, tribox_report *report)
{
    tribox_status status = check(s, is_taken, box, middle, options);
    if (status)
        return status;
    const tribox_accuracy asked = s->plan.accuracy;
    const tribox_environment callers = tribox_environment_enter();
    s->counts = (tribox_report){0, 0};
    status = answer_checked(s, box, middle, children);
    tribox_environment_leave(callers);
    s->plan.accuracy = asked;
    if (!status)
        tribox_plan_report(&s->plan, s->counts, report);
    return status;
}

tribox_status tribox_split(const tribox_soup *soup, const uint32_t *list, size_t count, const tribox_box *box,
                           const double middle[3], const tribox_options *options, uint8_t *children, tribox_report *report)
{
    split_call s;
    s.list = list;
    s.count = count;
    return split(&s, tribox_triangles_of_soup(soup, &s.triangles), box, middle, options, children, report);
}

tribox_status tribox_mesh_split(const tribox_mesh *mesh, const uint32_t *list, size_t count, const tribox_box *box,
                                const double middle[3], const tribox_options *options, uint8_t *children, tribox_report *report)
{
    split_call s;
    s.list = list;
    s.count = count;
    return split(&s, tribox_triangles_of_mesh(mesh, &s.triangles), box, middle, options, children, report);
}
