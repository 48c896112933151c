/* oriented_long.c - oriented pairs of any finite doubles, sign by sign: in double where rounding turns none, else in long sums. */
#include "oriented.h"

#include "exact/exact.h"
#include "kernel.h"
#include "sums.h"

typedef struct exact_points {
    exact_place length[3][3];    /* [j][k]: of edge j along axis k of the frame */
    exact_place beyond[3][3][2]; /* [j][k]: vertex j less the lower bound of the box, and less the upper one */
    int sign_of_n[3];
    bool is_tame; /* of products of three places none underflows or overflows in double */
} exact_points;

static int sign_of_place(const exact_points *p, const exact_place *place)
{
    const exact_product product = {{place}, false};
    return sign_of_products(p->is_tame, &product, 1, 1);
}

static int sign_of_length(const exact_points *p, int j, int a) { return sign_of_place(p, &p->length[j][a]); }

static int sign_of_normal(const exact_points *p, int i) { return p->sign_of_n[i]; }

static int sign_of_side(const exact_points *p, int i, int j, int k, const int X[2])
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const exact_product product[2] = {{{&p->length[j][b], &p->beyond[k][a][X[0] - TRIBOX_LO]}, false},
                                      {{&p->length[j][a], &p->beyond[k][b][X[1] - TRIBOX_LO]}, true}};
    return sign_of_products(p->is_tame, product, 2, 2);
}

/* n_i as two products, f_0a f_1b - f_0b f_1a, each times what is given. */
static void set_normal(exact_product product[2], const exact_points *p, int i, const exact_place *times)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    product[0] = (exact_product){{&p->length[0][a], &p->length[1][b], times}, false};
    product[1] = (exact_product){{&p->length[0][b], &p->length[1][a], times}, true};
}

static int sign_of_height(const exact_points *p, const int X[3])
{
    exact_product product[6];
    for (int i = 0; i < 3; i++)
        set_normal(&product[2 * i], p, i, &p->beyond[0][i][X[i] - TRIBOX_LO]);
    return sign_of_products(p->is_tame, product, 6, 3);
}

#include "exact/sides.h"

static bool are_tame_in_frame(const double *number, int count)
{
    bool are = true;
    for (int n = 0; n < count; n++)
        are = are && is_tame_in_frame(number[n]);
    return are;
}

static bool is_tame_pair(const tribox_oriented_pair *pair)
{
    return are_tame_in_frame(pair->u[0], 9) && are_tame_in_frame(pair->box.center, 3) && are_tame_in_frame(pair->box.half, 3) &&
           are_tame_in_frame(pair->box.axis[0], 9);
}

static void set_axis(exact_points *p, const tribox_oriented_pair *pair, int k)
{
    const double *const axis = pair->box.axis[k];
    for (int j = 0; j < 3; j++) {
        exact_place *const length = &p->length[j][k], *const beyond = p->beyond[j][k];
        length->value = length->size = beyond[0].value = beyond[0].size = 0;
        length->parts = beyond[0].parts = 0;
        for (int a = 0; a < 3; a++) {
            add_difference(length, axis[a], pair->u[(j + 1) % 3][a], pair->u[j][a]);
            add_difference(&beyond[0], axis[a], pair->u[j][a], pair->box.center[a]);
        }
        beyond[1] = beyond[0];
        add_number(&beyond[0], pair->box.half[k]);
        add_number(&beyond[1], -pair->box.half[k]);
    }
}

static bool is_apart_on_axis(const exact_points *p, int k)
{
    bool is_below = true, is_above = true;
    for (int j = 0; j < 3; j++) {
        is_below = is_below && sign_of_place(p, &p->beyond[j][k][0]) < 0;
        is_above = is_above && sign_of_place(p, &p->beyond[j][k][1]) > 0;
    }
    return is_below || is_above;
}

static bool overlaps_by_signs(const tribox_oriented_pair *pair, bool is_tame, unsigned axes)
{
    exact_points p;
    p.is_tame = is_tame;
    for (int k = 0; k < 3; k++) {
        set_axis(&p, pair, k);
        if ((axes & TRIBOX_AXES_BOX) && is_apart_on_axis(&p, k))
            return false;
    }
    for (int i = 0; i < 3; i++) {
        exact_product product[2];
        set_normal(product, &p, i, NULL);
        p.sign_of_n[i] = sign_of_products(is_tame, product, 2, 2);
    }
    return are_sides_touching(&p, axes);
}

/* The power of two at most the largest of numbers; of zeros and subnormal numbers 2^-1023. */
static int greatest_power(const double *number, int count)
{
    int greatest = 0;
    for (int n = 0; n < count; n++) {
        uint64_t bits;
        memcpy(&bits, &number[n], sizeof bits);
        greatest = (int)(bits >> 52 & 0x7ff) > greatest ? (int)(bits >> 52 & 0x7ff) : greatest;
    }
    return greatest - 1023;
}

/* Divides by a power of two. A number that becomes subnormal, and may be rounded, is not tame; false if one vanishes. */
static bool divide_by_power(double *number, int count, int power)
{
    const uint64_t bits = (uint64_t)(1023 - power) << 52;
    double factor;
    bool are_left = true;
    memcpy(&factor, &bits, sizeof factor);
    for (int n = 0; n < count; n++) {
        const bool is_zero = number[n] == 0;
        number[n] *= factor;
        are_left = are_left && (number[n] == 0) == is_zero;
    }
    return are_left;
}

/* The same pair, its signs too, in units near its largest position and its largest number of an axis. False if there are none. */
static bool set_units(tribox_oriented_pair *pair)
{
    const int of_vertices = greatest_power(pair->u[0], 9), of_center = greatest_power(pair->box.center, 3);
    const int of_positions = of_vertices > of_center ? of_vertices : of_center, of_axes = greatest_power(pair->box.axis[0], 9);
    const int of_half = of_positions + of_axes, most = 1000;
    if (of_positions > most || of_positions < -most || of_axes > most || of_axes < -most || of_half > most || of_half < -most)
        return false;
    const bool are_positions_left =
        divide_by_power(pair->u[0], 9, of_positions) && divide_by_power(pair->box.center, 3, of_positions);
    return divide_by_power(pair->box.axis[0], 9, of_axes) && divide_by_power(pair->box.half, 3, of_half) && are_positions_left;
}

bool tribox_oriented_long(const tribox_oriented_pair *pair, unsigned axes)
{
    tribox_oriented_pair same = *pair;
    const bool is_tame = is_tame_pair(pair) || (set_units(&same) && is_tame_pair(&same));
    return overlaps_by_signs(is_tame ? &same : pair, is_tame, axes);
}
