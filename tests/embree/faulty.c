#include "faulty.h"

#include <math.h>

enum { LANES = 8, LOST_AT_END = 5, FLIP_ONE_IN = 10000 };

const char *fault_name(fault f)
{
    static const char *const names[FAULTS] = {"none",
                                              "no edge axes",
                                              "no plane",
                                              "no box axes",
                                              "one edge axis lost",
                                              "open, not closed",
                                              "box shrunk 1e-3",
                                              "box shrunk 1e-6",
                                              "box inflated 1e-3",
                                              "box inflated 1e-6",
                                              "plane radius short",
                                              "plane one-sided",
                                              "wrong vertices",
                                              "six-separating",
                                              "lane copied",
                                              "last five lost",
                                              "single flips"};
    return names[f];
}

/* Doubled and about the centre of the box. */
typedef struct body {
    double v[3][3], h[3];
} body;

static double stretch_of(fault f)
{
    switch (f) {
    case FAULT_SHRUNK:
        return 1 - 1e-3;
    case FAULT_SHRUNK_A_LITTLE:
        return 1 - 1e-6;
    case FAULT_INFLATED:
        return 1 + 1e-3;
    case FAULT_INFLATED_A_LITTLE:
        return 1 + 1e-6;
    default:
        return 1;
    }
}

static body body_of(fault f, const triangle *t, const tribox_boxes *boxes, size_t i)
{
    body b;
    for (int a = 0; a < 3; a++) {
        const double lo = boxes->lo[a][i], hi = boxes->hi[a][i];
        b.h[a] = (hi - lo) * stretch_of(f);
        for (int j = 0; j < 3; j++)
            b.v[j][a] = ((double)t->u[j][a] - lo) + ((double)t->u[j][a] - hi);
    }
    return b;
}

static bool is_apart(fault f, double least, double most, double radius)
{
    return f == FAULT_OPEN ? least >= radius || most <= -radius : least > radius || most < -radius;
}

static bool is_apart_on_box(fault f, const body *b)
{
    for (int a = 0; a < 3; a++) {
        const double least = fmin(fmin(b->v[0][a], b->v[1][a]), b->v[2][a]);
        const double most = fmax(fmax(b->v[0][a], b->v[1][a]), b->v[2][a]);
        if (is_apart(f, least, most, b->h[a]))
            return true;
    }
    return false;
}

static bool is_apart_on_plane(fault f, const body *b)
{
    double place = 0, sum = 0, most = 0, last = 0;
    for (int i = 0; i < 3; i++) {
        const int p = (i + 1) % 3, q = (i + 2) % 3;
        const double n =
            (b->v[1][p] - b->v[0][p]) * (b->v[2][q] - b->v[1][q]) - (b->v[1][q] - b->v[0][q]) * (b->v[2][p] - b->v[1][p]);
        place += n * b->v[0][i];
        last = b->h[i] * fabs(n);
        sum += last;
        most = fmax(most, last);
    }
    const double radius = f == FAULT_PLANE_RADIUS_SHORT ? sum - last : f == FAULT_SIX_SEPARATING ? most : sum;
    if (sum == 0)
        return false;
    return is_apart(f, place, f == FAULT_PLANE_ONE_SIDED ? INFINITY : place, radius);
}

/* The axis e_i x edge j: the two vertices of another edge do not bound the triangle's interval. */
static bool is_apart_on_edge(fault f, const body *b, int i, int j)
{
    const int p = (i + 1) % 3, q = (i + 2) % 3;
    const double fp = b->v[(j + 1) % 3][p] - b->v[j][p], fq = b->v[(j + 1) % 3][q] - b->v[j][q];
    const int first = f == FAULT_WRONG_VERTICES && i == 0 && j == 0 ? (j + 1) % 3 : (j + 2) % 3;
    const double at[2] = {b->v[first][p] * fq - b->v[first][q] * fp, b->v[j][p] * fq - b->v[j][q] * fp};
    if (fp == 0 && fq == 0)
        return false;
    return is_apart(f, fmin(at[0], at[1]), fmax(at[0], at[1]), b->h[p] * fabs(fq) + b->h[q] * fabs(fp));
}

static bool overlaps(fault f, const triangle *t, const tribox_boxes *boxes, size_t box)
{
    const body b = body_of(f, t, boxes, box);
    if (f != FAULT_NO_BOX && is_apart_on_box(f, &b))
        return false;
    if (f != FAULT_NO_PLANE && is_apart_on_plane(f, &b))
        return false;
    for (int i = 0; i < 3 && f != FAULT_NO_EDGES; i++)
        for (int j = 0; j < 3; j++)
            if (!(f == FAULT_ONE_EDGE_AXIS_LOST && i == 1 && j == 2) && is_apart_on_edge(f, &b, i, j))
                return false;
    return true;
}

/* Faults of the batch, not of an axis: what becomes of answer `is_met` of a box when its neighbour was given `before`. */
static bool spoilt(faulty *x, size_t t, size_t box, bool is_met, bool before)
{
    switch (x->fault) {
    case FAULT_LANE_COPIED:
        return box % LANES == 3 ? before : is_met;
    case FAULT_LAST_LOST:
        return is_met && t + LOST_AT_END < x->triangles;
    case FAULT_FLIPS:
        return is_met ^ !random_int(&x->r, FLIP_ONE_IN);
    default:
        return is_met;
    }
}

static void faulty_answer(answerer *self, size_t t, const triangle *u, const tribox_boxes *boxes, uint64_t *mask)
{
    faulty *const x = (faulty *)(void *)self;
    bool before = false;
    for (size_t k = 0; k < tribox_mask_words(boxes->count); k++)
        mask[k] = 0;
    for (size_t box = 0; box < boxes->count; box++) {
        const bool truth = overlaps(FAULT_NONE, u, boxes, box);
        const bool answer = spoilt(x, t, box, overlaps(x->fault, u, boxes, box), before);
        before = truth;
        mask[box / 64] |= (uint64_t)answer << box % 64;
        x->false_no += truth && !answer;
        x->false_yes += answer && !truth;
    }
}

faulty faulty_make(fault f, size_t triangles, uint64_t seed)
{
    return (faulty){.base = {.answer = faulty_answer}, .fault = f, .triangles = triangles, .r = random_named(seed, fault_name(f))};
}
