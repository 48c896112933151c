/*
 * test_small_packets.c - whole packets in tiny floats (vec_small.h): packet.h, margin.h and ties.h as they stand, against integers.
 *
 * Pairs in space, every sequence of groups, soups and boxes, both looks; or, where SMALL_IS_NEAR, triangles of longer numbers,
 * rounded as near.h says. What a packet does not leave open is a hit or a miss, and neither may be wrong (PROOFS.md 1 to 5, 14).
 * Not tried is is_valid, as tiny floats do not overflow.
 */
#include "vec_small.h"

#include "kernel/axes.h"

/* In place of corners.h: one triangle of doubles, relative to the box and rounded. */
static inline void load_corners(lane_triangle *t, const tribox_corners *corners, size_t at, bool is_near)
{
    double u[9];
    memcpy(u, corners->base, sizeof u);
    for (int k = 0; k < 9; k++)
        t->u[k / 3][k % 3] = small_rounded(u[k] - corners->origin[k % 3]);
    (void)at, (void)is_near;
}

#include "kernel/pairs/margin.h"
#include "kernel/pairs/ties.h"
#include "kernel/pairs/local.h"
#include "kernel/pairs/packet.h"
#include "small_draws.h"

/* Are the pairs of doubles (near.h)? */
#if !defined(SMALL_IS_NEAR)
#define SMALL_IS_NEAR 0
#endif

enum {
    PAIRS_EACH = 20, /* 2 million by default */
    NEAR_BITS = 5    /* so many more has a double than a tiny float */
};

/* Axis by axis, in units of SMALL_ONE. */
typedef struct whole_pair {
    small_axis of[3];
} whole_pair;

/* Groups of axes that separate a pair. */
typedef struct apart {
    bool by[4]; /* by the number of the paper's bullet: 1 the box normals, 2 the plane, 3 the edges */
} apart;

/* Do triangle and box cover nothing in common along w? */
static bool is_apart_along(const whole_pair *p, const whole w[3])
{
    whole least = 0, most = 0, first = INT64_MAX, last = INT64_MIN;
    for (int a = 0; a < 3; a++) {
        least += w[a] * (w[a] > 0 ? p->of[a].lo : p->of[a].hi);
        most += w[a] * (w[a] > 0 ? p->of[a].hi : p->of[a].lo);
    }
    for (int j = 0; j < 3; j++) {
        const whole at = w[0] * p->of[0].u[j] + w[1] * p->of[1].u[j] + w[2] * p->of[2].u[j];
        first = whole_least(first, at);
        last = whole_most(last, at);
    }
    return first > most || last < least;
}

/* Across the triangle. */
static void normal_of(const whole_pair *p, whole w[3])
{
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        w[i] = (p->of[a].u[1] - p->of[a].u[0]) * (p->of[b].u[2] - p->of[b].u[0]) -
               (p->of[b].u[1] - p->of[b].u[0]) * (p->of[a].u[2] - p->of[a].u[0]);
    }
}

/* Across the edge from vertex j and axis i. */
static void across_edge(const whole_pair *p, int i, int j, whole w[3])
{
    const int a = (i + 1) % 3, b = (i + 2) % 3, k = (j + 1) % 3;
    w[i] = 0;
    w[a] = p->of[b].u[j] - p->of[b].u[k];
    w[b] = p->of[a].u[k] - p->of[a].u[j];
}

static apart apart_of(const whole_pair *p)
{
    apart is = {{false}};
    whole w[3];
    for (int i = 0; i < 3; i++) {
        const whole e[3] = {i == 0, i == 1, i == 2};
        is.by[1] |= is_apart_along(p, e);
        for (int j = 0; j < 3; j++) {
            across_edge(p, i, j, w);
            is.by[3] |= is_apart_along(p, w);
        }
    }
    normal_of(p, w);
    is.by[2] = is_apart_along(p, w);
    return is;
}

/* The vertices anywhere, or within a few steps of the first, and that often near zero, where the steps can be small. */
static void draw_vertices(random_source *r, whole_pair *p)
{
    const bool is_tiny = small_draw(r, 2);
    const int steps = is_tiny ? 2 << small_draw(r, SMALL_BITS) : 2 << small_draw(r, SMALL_BITS + SMALL_BINADES);
    for (int a = 0; a < 3; a++) {
        whole *const u = p->of[a].u;
        u[0] = small_one_of(r, is_tiny ? 2 * SMALL_HALF : SMALL_NUMBERS);
        for (int j = 1; j < 3; j++)
            u[j] = small_draw(r, 4) ? small_near(u[0] + small_draw(r, 2 * (unsigned)steps + 1) - steps)
                                    : u[small_draw(r, (unsigned)j)];
    }
}

static void draw_box(random_source *r, whole_pair *p)
{
    const bool is_thin = small_draw(r, 2);
    for (int a = 0; a < 3; a++) {
        const whole x = small_draw(r, 2) ? small_any(r) : small_beside(r, p->of[a].u[small_draw(r, 3)]);
        whole y = small_beside(r, is_thin ? x : p->of[a].u[small_draw(r, 3)]);
        if (!is_thin && small_draw(r, 2))
            y = small_any(r);
        p->of[a].lo = whole_least(x, y);
        p->of[a].hi = whole_most(x, y);
    }
}

/* On which the triangle has no extent, and the box little. */
static void flatten(random_source *r, small_axis *x)
{
    x->u[1] = x->u[2] = x->lo = x->u[0];
    x->hi = whole_most(x->lo, small_beside(r, x->lo));
}

/* Numbers of more bits, of which those that were equal often stay so. */
static whole lengthened(random_source *r, whole a, whole more)
{
    return a * (1 << NEAR_BITS) + (small_draw(r, 2) ? more : small_draw(r, 1 << NEAR_BITS));
}

static void lengthen(random_source *r, whole_pair *p)
{
    for (int a = 0; a < 3; a++) {
        small_axis *const x = &p->of[a];
        const whole more = small_draw(r, 1 << NEAR_BITS);
        for (int j = 0; j < 3; j++)
            x->u[j] = lengthened(r, x->u[j], more);
        const whole lo = lengthened(r, x->lo, more), hi = lengthened(r, x->hi, more);
        x->lo = whole_least(lo, hi);
        x->hi = whole_most(lo, hi);
    }
}

/* Moves one bound of the box so that the two all but touch along w, on the side that w or -w points to. */
static void let_touch(random_source *r, whole_pair *p, whole w[3])
{
    int last = 0;
    for (int a = 0; a < 3; a++)
        if (whole_size(w[a]) > whole_size(w[last]))
            last = a;
    if (w[last] == 0)
        return;
    const whole sign = small_draw(r, 2) ? 1 : -1;
    whole first = INT64_MAX;
    for (int a = 0; a < 3; a++)
        w[a] *= sign;
    for (int j = 0; j < 3; j++)
        first = whole_least(first, w[0] * p->of[0].u[j] + w[1] * p->of[1].u[j] + w[2] * p->of[2].u[j]);
    for (int a = 0; a < 3; a++)
        if (a != last)
            first -= w[a] * (w[a] > 0 ? p->of[a].hi : p->of[a].lo);
    const whole at = SMALL_IS_NEAR ? first / w[last] + small_draw(r, 3) - 1 : small_beside(r, small_near(first / w[last]));
    whole *const lo = &p->of[last].lo, *const hi = &p->of[last].hi;
    *(w[last] > 0 ? hi : lo) = at;
    if (*lo > *hi || small_draw(r, 2))
        *lo = *hi = at;
}

/* All numbers anywhere: without the box normals, what has an edge along an axis is never certain. */
static small_axis loose_axis(random_source *r)
{
    small_axis x;
    for (int j = 0; j < 3; j++)
        x.u[j] = small_any(r);
    const whole y = small_any(r), z = small_any(r);
    x.lo = whole_least(y, z);
    x.hi = whole_most(y, z);
    return x;
}

static void draw_pair(random_source *r, whole_pair *p)
{
    whole w[3];
    const int form = small_draw(r, 6);
    draw_vertices(r, p);
    draw_box(r, p);
    for (int a = 0; a < 3 && form < 3; a++)
        p->of[a] = form == 0 ? loose_axis(r) : small_any_axis(r);
    if (form == 1)
        flatten(r, &p->of[small_draw(r, 3)]);
    if (SMALL_IS_NEAR)
        lengthen(r, p);
    const int touches = small_draw(r, 4), i = small_draw(r, 3), j = small_draw(r, 3);
    if (touches == 0) {
        normal_of(p, w);
        let_touch(r, p, w);
    } else if (touches == 1) {
        across_edge(p, i, j, w);
        let_touch(r, p, w);
    }
}

/* The pair as a walk sees it, as a soup, as boxes and as a mesh of doubles. */
typedef struct small_input {
    float streams[9], triangle[3][3], bounds[6];
    double corner[9], near[3];
    tribox_soup soup;
    tribox_rounded_box box;
    tribox_boxes boxes;
    tribox_corners corners;
    tribox_query soups, meshes, triangles;
} small_input;

/* Where the walks of doubles take them (near.h): the box from zero on. */
static void put_near(small_input *to, const whole_pair *p)
{
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            to->corner[3 * j + a] = (double)p->of[a].u[j] * SMALL_ONE;
        to->near[a] = (double)p->of[a].lo * SMALL_ONE;
        to->box.lo[a] = 0;
        to->box.hi[a] = to->box.H[a] = (float)small_rounded((double)(p->of[a].hi - p->of[a].lo) * SMALL_ONE);
    }
}

static void put_pair(small_input *to, const whole_pair *p)
{
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            to->streams[3 * a + j] = to->triangle[j][a] = (float)((double)p->of[a].u[j] * SMALL_ONE);
        to->bounds[a] = to->box.lo[a] = (float)((double)p->of[a].lo * SMALL_ONE);
        to->bounds[3 + a] = to->box.hi[a] = (float)((double)p->of[a].hi * SMALL_ONE);
        to->box.H[a] = to->box.C[a] = (float)small_rounded((double)(p->of[a].hi - p->of[a].lo) * SMALL_ONE);
    }
}

static void start_input(small_input *to)
{
    memset(to, 0, sizeof *to);
    to->soup.count = to->boxes.count = 1;
    for (int k = 0; k < 3; k++) {
        to->soup.x[k] = &to->streams[k];
        to->soup.y[k] = &to->streams[3 + k];
        to->soup.z[k] = &to->streams[6 + k];
        to->boxes.lo[k] = &to->bounds[k];
        to->boxes.hi[k] = &to->bounds[3 + k];
    }
    to->corners = (tribox_corners){.base = (const char *)to->corner, .origin = to->near};
    to->soups = (tribox_query){.soup = &to->soup, .box = &to->box, .count = 1};
    to->meshes = (tribox_query){.corners = &to->corners, .box = &to->box, .count = 1};
    to->triangles = (tribox_query){.triangle = &to->triangle[0][0], .boxes = &to->boxes, .count = 1};
}

#define ENTRY(sequence) sequence,
static const unsigned sequences[TRIBOX_SEQUENCES] = {TRIBOX_FOR_EACH_SEQUENCE(ENTRY)};
static const unsigned near_sequences[] = {1, 132}; /* of batch.h */

/* The kind is no constant here, as it is in the kernels: thirty instances of a packet take too long to compile. */
static bool is_hit_by(const tribox_query *from, walk_kind kind, uint64_t *open)
{
    lane_pairs p;
    start_pairs(&p, from, kind);
    return packet(&p, from, 0, kind, open);
}

static void print_pair(const whole_pair *p, walk_kind kind, bool is_miss)
{
    const char *const form = kind.is_local ? "doubles" : kind.is_soup ? "soup" : "boxes";
    printf("a wrong %s of sequence %u, %s%s, in units of %g:\n", is_miss ? "miss" : "overlap", kind.sequence, form,
           kind.looks_again ? ", second look" : "", SMALL_ONE);
    for (int a = 0; a < 3; a++)
        small_print_axis((char)('x' + a), &p->of[a]);
}

/* Both looks, the second one where walks take it (batch.h). */
static void try_pair(const small_input *input, const whole_pair *p, const apart *is, unsigned sequence, bool is_soup,
                     small_tally *tally)
{
    const bool is_box_asked = sequence_has(sequence, 1);
    const bool is_apart =
        (is->by[1] && is_box_asked) || (is->by[2] && sequence_has(sequence, 2)) || (is->by[3] && sequence_has(sequence, 3));
    for (int again = 0; again < (is_box_asked && sequence != 1 ? 2 : 1); again++) {
        const walk_kind kind = {sequence, TRIBOX_BY_MARGIN, is_soup, SMALL_IS_NEAR, SMALL_IS_NEAR, again};
        uint64_t open;
        const bool is_hit = is_hit_by(SMALL_IS_NEAR ? &input->meshes : is_soup ? &input->soups : &input->triangles, kind, &open);
        tally->pairs++;
        if (open)
            continue;
        tally->overlaps += is_hit;
        tally->misses += !is_hit;
        if (is_hit != is_apart)
            continue;
        is_hit ? tally->wrong_overlaps++ : tally->wrong_misses++;
        if (small_wrong(tally) == 1)
            print_pair(p, kind, !is_hit);
    }
}

int main(int argc, char **argv)
{
    const arguments args = arguments_parse(argc, argv);
    random_source r = random_named(args.seed, "small packets");
    small_tally tally = {0};
    small_input input;
    start_input(&input);
    const uint64_t pairs = (uint64_t)args.pairs * PAIRS_EACH;
    while (tally.pairs < pairs && !small_is_over(&tally)) {
        whole_pair p;
        draw_pair(&r, &p);
        if (SMALL_IS_NEAR)
            put_near(&input, &p);
        else
            put_pair(&input, &p);
        const apart is = apart_of(&p);
        for (int form = 0; form < 3; form++) {
            const unsigned sequence =
                SMALL_IS_NEAR ? near_sequences[small_draw(&r, 2)] : sequences[small_draw(&r, TRIBOX_SEQUENCES)];
            const bool is_soup = SMALL_IS_NEAR || small_draw(&r, 2);
            if (!(is.by[1] && sequence_has(sequence, 1)) || small_draw(&r, 16) == 0) /* else nothing is rounded */
                try_pair(&input, &p, &is, sequence, is_soup, &tally);
        }
    }
    return small_verdict(&tally);
}
