/*
 * test_small_packets.c - whole packets in tiny floats (vec_small.h): packet.h, margin.h and ties.h as they stand, against integers.
 *
 * Pairs in space, every sequence of groups, soups and boxes, both looks; or, where SMALL_IS_NEAR, triangles of longer numbers,
 * rounded as local.h says; or, where SMALL_IS_WIDE, boxes of longer numbers, rounded as rounded_box.h says. What a packet does not
 * leave open is a hit or a miss, and neither may be wrong (PROOFS.md 1 to 5, 14). Not tried is is_valid, as tiny floats do not
 * overflow.
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

/* No walk here is of few. */
static inline void load_places(lane_triangle *t, const char *const *corner) { (void)t, (void)corner; }

#include "kernel/pairs/margin.h"
#include "kernel/pairs/ties.h"
#include "kernel/pairs/local.h"
#include "kernel/pairs/packet.h"
#include "small_draws.h"
#include "small_pairs.h"

/* The pair as a walk sees it, as a soup, as boxes and as a mesh of doubles. */
typedef struct small_input {
    float streams[9], triangle[3][3], bounds[6];
    double corner[9], near[3];
    tribox_soup soup;
    tribox_rounded_box box[2]; /* as it is rounded without the box normals, and with them */
    tribox_boxes boxes;
    tribox_corners corners;
    tribox_query soups, meshes, triangles;
} small_input;

/* Where the walks of doubles take them (local.h): the box from zero on. */
static void put_near(small_input *to, const whole_pair *p)
{
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            to->corner[3 * j + a] = (double)p->of[a].u[j] * STEP;
        to->near[a] = (double)p->of[a].lo * STEP;
        to->box[1].of.origin[a] = 0;
        to->box[1].hi[a] = to->box[1].of.H[a] = (float)small_rounded((double)(p->of[a].hi - p->of[a].lo) * STEP);
    }
}

static void put_pair(small_input *to, const whole_pair *p)
{
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            to->streams[3 * a + j] = to->triangle[j][a] = (float)((double)p->of[a].u[j] * STEP);
        to->bounds[a] = (float)((double)p->of[a].lo * STEP);
        to->bounds[3 + a] = (float)((double)p->of[a].hi * STEP);
    }
    put_box(&to->box[0], p, false);
    put_box(&to->box[1], p, true);
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
    to->soups = (tribox_query){.soup = &to->soup, .count = 1};
    to->meshes = (tribox_query){.corners = &to->corners, .box = &to->box[1], .count = 1};
    to->triangles = (tribox_query){.triangle = &to->triangle[0][0], .boxes = &to->boxes, .count = 1};
}

#define ENTRY(sequence, how) sequence,
static const unsigned sequences[TRIBOX_SEQUENCES] = {TRIBOX_FOR_EACH_SEQUENCE(ENTRY)};
static const unsigned near_sequences[] = {1, 132}; /* of batch.h */

PACKET(joint, load_axis, overlaps_by_joint_margin)
PACKET(apart, load_axis, overlaps_by_margin)

/* The kind is no constant here, as it is in the kernels: thirty instances of a packet take too long to compile. */
static bool is_hit_by(const tribox_query *from, walk_kind kind, uint64_t *open)
{
    lane_pairs p;
    start_pairs(&p, from, kind);
    if (group_alone(groups_of(kind)))
        return packet_soup_alone_BY_MARGIN(&p, from, 0, kind, open);
    const bool is_joint = groups_of(kind) % 100 == 32;
    return is_joint ? packet_joint(&p, from, 0, kind, open) : packet_apart(&p, from, 0, kind, open);
}

static void print_pair(const whole_pair *p, walk_kind kind, bool is_miss)
{
    const char *const form = kind & WALKS_LOCAL ? "doubles" : kind & WALKS_SOUP ? "soup" : "boxes";
    printf("a wrong %s of sequence %u, %s%s, in units of %g:\n", is_miss ? "miss" : "overlap", groups_of(kind), form,
           kind & LOOKS_AGAIN ? ", second look" : "", STEP);
    for (int a = 0; a < 3; a++)
        small_print_axis((char)('x' + a), &p->of[a]);
}

/* Both looks, the second one where walks take it (batch.h). */
static void try_pair(small_input *input, const whole_pair *p, const apart *is, unsigned sequence, bool is_soup, small_tally *tally)
{
    const bool is_box_asked = sequence_has(sequence, 1);
    const bool is_apart =
        (is->by[1] && is_box_asked) || (is->by[2] && sequence_has(sequence, 2)) || (is->by[3] && sequence_has(sequence, 3));
    input->soups.box = &input->box[is_box_asked];
    for (int again = 0; again < (is_box_asked && sequence != 1 ? 2 : 1); again++) {
        const walk_kind kind = sequence | WALKS_BY_MARGIN | (is_soup ? WALKS_SOUP : 0) | (again ? LOOKS_AGAIN : 0) |
                               (SMALL_IS_NEAR ? WALKS_MESH | WALKS_LOCAL : 0);
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
            const bool is_soup = MORE_BITS || group_alone(sequence) || small_draw(&r, 2);
            if (!(is.by[1] && sequence_has(sequence, 1)) || small_draw(&r, 16) == 0) /* else nothing is rounded */
                try_pair(&input, &p, &is, sequence, is_soup, &tally);
        }
    }
    return small_verdict(&tally);
}
