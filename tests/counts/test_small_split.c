/*
 * test_small_split.c - triangles against eight children in tiny floats (vec_small.h): split.h as it stands, against integers.
 *
 * A pair of small_pairs.h is a triangle and one child, which often touch; on each axis the other half is as thick as it comes. As
 * floats, as boxes of longer numbers, and as doubles less the middle; with all axes, and with the box normals alone.
 */
#include "vec_small.h"

#include "kernel/axes.h"

/* In place of corners.h: a split reads streams. */
static inline void load_corners(lane_triangle *t, const tribox_corners *corners, size_t at, bool is_near)
{
    (void)t, (void)corners, (void)at, (void)is_near;
}
static inline void load_places(lane_triangle *t, const char *const *corner) { (void)t, (void)corner; }

#include "kernel/pairs/margin.h"
#include "kernel/pairs/ties.h"
#include "kernel/pairs/local.h"
#include "kernel/pairs/packet.h"
#include "kernel/pairs/split.h"
#include "small_draws.h"
#include "small_pairs.h"

/* A box in three planes on each axis, the second of which is the middle. */
typedef struct whole_split {
    whole_pair child[8];
    whole middle[3];
} whole_split;

/* The child that was drawn may be either half. The other one is thin, as thick as the triangle, or anything. */
static void draw_split(random_source *r, whole_split *s)
{
    whole_pair p;
    draw_pair(r, &p);
    for (int c = 0; c < 8; c++)
        s->child[c] = p;
    for (int a = 0; a < 3; a++) {
        const bool is_upper = small_draw(r, 2);
        const whole from = is_upper ? p.of[a].lo : p.of[a].hi, u = p.of[a].u[small_draw(r, 3)];
        const whole any[] = {from, whole_size(u), small_any(r) * (1 << MORE_BITS), small_near(small_draw(r, 4)) << MORE_BITS};
        const whole at = any[small_draw(r, 4)], size = whole_size(at - (small_draw(r, 2) ? from : 0));
        const whole end = MORE_BITS ? from + (is_upper ? -size : size) : small_near(from + (is_upper ? -size : size));
        s->middle[a] = from;
        for (int c = 0; c < 8; c++)
            if ((c >> a & 1) != is_upper) {
                s->child[c].of[a].lo = whole_least(from, end);
                s->child[c].of[a].hi = whole_most(from, end);
            }
    }
}

/* As split.c has it of doubles, less the middle. */
static void put_halves_near(tribox_halves *to, const whole_split *s)
{
    memset(to, 0, sizeof *to);
    for (int a = 0; a < 3; a++) {
        tribox_rounded_box *const low = &to->half[0], *const high = &to->half[1];
        const float below = (float)small_rounded((double)(s->middle[a] - s->child[0].of[a].lo) * STEP);
        low->lo[a] = low->of.C[a] = -below;
        low->of.H[a] = below;
        high->hi[a] = high->of.H[a] = high->of.C[a] = (float)small_rounded((double)(s->child[7].of[a].hi - s->middle[a]) * STEP);
    }
}

static void put_split(float streams[9], tribox_halves *halves, const whole_split *s)
{
    for (int n = 0; n < 9; n++) {
        const whole u = s->child[0].of[n / 3].u[n % 3] - (SMALL_IS_NEAR ? s->middle[n / 3] : 0);
        streams[n] = (float)small_rounded((double)u * STEP);
    }
    if (SMALL_IS_NEAR) {
        put_halves_near(halves, s);
        return;
    }
    put_box(&halves->half[0], &s->child[0], true);
    put_box(&halves->half[1], &s->child[7], true);
}

static void check_children(const whole_split *s, int32_t bits, bool is_box_alone, small_tally *tally)
{
    for (int c = 0; c < 8; c++) {
        const apart is = apart_of(&s->child[c]);
        const bool is_apart = is.by[1] || (!is_box_alone && (is.by[2] || is.by[3])), is_hit = bits >> c & 1;
        tally->pairs++;
        if (bits >> 8 >> c & 1)
            continue;
        tally->overlaps += is_hit;
        tally->misses += !is_hit;
        if (is_hit != is_apart)
            continue;
        is_hit ? tally->wrong_overlaps++ : tally->wrong_misses++;
        if (small_wrong(tally) > 1)
            continue;
        printf("a wrong %s of child %d, in units of %g:\n", is_hit ? "overlap" : "miss", c, STEP);
        for (int a = 0; a < 3; a++)
            small_print_axis((char)('x' + a), &s->child[c].of[a]);
        for (int a = 0; a < 3; a++)
            small_print_axis((char)('x' + a), &s->child[c ^ 7].of[a]);
    }
}

/* What a margin of all children has to allow for: that of each (PROOFS.md 5.5, 14.6). */
static bool is_margin_enough(const lane_halves *of)
{
    bool is_enough = true;
    for (int c = 0; c < 8; c++) {
        lane_box child;
        for (int a = 0; a < 3; a++) {
            const lane_box *const half = &of->box[c >> a & 1];
            child.lo[a] = half->lo[a];
            child.hi[a] = half->hi[a];
            child.H[a] = half->H[a];
        }
        const lane_box_margin own = SMALL_IS_NEAR ? local_margin_of(&child) : box_margin_of(&child);
        is_enough &= of->margin.most <= own.most && of->margin.least >= own.least && of->margin.edges >= own.edges &&
                     of->margin.eta >= own.eta;
    }
    return is_enough;
}

int main(int argc, char **argv)
{
    const arguments args = arguments_parse(argc, argv);
    random_source r = random_named(args.seed, "small split");
    small_tally tally = {0};
    const uint64_t pairs = (uint64_t)args.pairs * 4 * PAIRS_EACH; /* eight from each draw */
    while (tally.pairs < pairs && !small_is_over(&tally)) {
        whole_split s;
        float streams[9];
        tribox_halves halves;
        lane_halves lanes;
        draw_split(&r, &s);
        put_split(streams, &halves, &s);
        const tribox_soup soup = {.x = {streams, streams + 1, streams + 2},
                                  .y = {streams + 3, streams + 4, streams + 5},
                                  .z = {streams + 6, streams + 7, streams + 8},
                                  .count = 1};
        const bool is_box_alone = small_draw(&r, 16) == 0;
        const walk_kind kind = (is_box_alone ? 1 : 132 | LOOKS_AGAIN) | WALKS_SOUP | (SMALL_IS_NEAR ? WALKS_LOCAL : 0);
        start_halves(&lanes, &halves, kind);
        if (!is_box_alone && !is_margin_enough(&lanes)) {
            printf("a margin that is not enough for every child\n");
            tally.wrong_overlaps++;
        }
        check_children(&s, split_packet(&soup, &lanes, 0, kind), is_box_alone, &tally);
    }
    return small_verdict(&tally);
}
