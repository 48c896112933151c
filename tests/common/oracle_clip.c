/*
 * oracle_clip.c - clip the triangle against the six half-spaces of the box, after Sutherland and Hodgman: they overlap when
 * something is left.
 *
 * A point of the triangle is (b_0 u_0 + b_1 u_1 + b_2 u_2) / (b_0 + b_1 + b_2) with whole weights b_j >= 0. On a half-space its
 * value is the same mean of the vertices' values, so nothing is ever divided, and segments and points are not special cases. An
 * oriented box is such a box in its frame, where the vertices are moved first.
 */
#include "oracle.h"

#include <assert.h>
#include <gmp.h>

/* Each of six cuts adds at most one corner to the first three. */
enum { CORNERS_MAX = 9 };

/* Weights longer than this are divided by what they have in common; shorter ones are not worth it. */
enum { LONG_BITS = 1024 };

typedef struct corner {
    mpz_t weight[3];
    mpz_t value; /* on the half-space at hand: negative outside of it */
} corner;

typedef struct polygon {
    corner at[CORNERS_MAX];
    int count;
} polygon;

static polygon polygons[2];
static mpz_t number[15], vertex_value[3], common;

static void prepare(void)
{
    static bool is_ready;
    if (is_ready)
        return;
    is_ready = true;
    for (int k = 0; k < CORNERS_MAX; k++)
        for (int p = 0; p < 2; p++) {
            mpz_init(polygons[p].at[k].value);
            for (int j = 0; j < 3; j++)
                mpz_init(polygons[p].at[k].weight[j]);
        }
    for (int k = 0; k < 15; k++)
        mpz_init(number[k]);
    for (int j = 0; j < 3; j++)
        mpz_init(vertex_value[j]);
    mpz_init(common);
}

static void load(const pair_f64 *pair)
{
    const oracle_integers in = oracle_integers_of(pair);
    for (int k = 0; k < 15; k++) {
        mpz_set_si(number[k], in.odd[k]);
        mpz_mul_2exp(number[k], number[k], in.shift[k]);
    }
}

static void set_values(polygon *p, int axis, bool is_upper)
{
    for (int j = 0; j < 3; j++) {
        if (is_upper)
            mpz_sub(vertex_value[j], number[12 + axis], number[3 * j + axis]);
        else
            mpz_sub(vertex_value[j], number[3 * j + axis], number[9 + axis]);
    }
    for (int k = 0; k < p->count; k++) {
        corner *const c = &p->at[k];
        mpz_mul(c->value, c->weight[0], vertex_value[0]);
        mpz_addmul(c->value, c->weight[1], vertex_value[1]);
        mpz_addmul(c->value, c->weight[2], vertex_value[2]);
    }
}

static void shorten(corner *c)
{
    mpz_gcd(common, c->weight[0], c->weight[1]);
    mpz_gcd(common, common, c->weight[2]);
    for (int j = 0; j < 3; j++)
        mpz_divexact(c->weight[j], c->weight[j], common);
}

/* Where the side from p to q, of values of opposite sign, has the value zero: |value of q| * p + |value of p| * q. */
static void cross(corner *to, const corner *p, const corner *q)
{
    bool is_long = false;
    for (int j = 0; j < 3; j++) {
        mpz_mul(to->weight[j], p->weight[j], q->value);
        mpz_submul(to->weight[j], q->weight[j], p->value);
        mpz_abs(to->weight[j], to->weight[j]);
        is_long = is_long || mpz_sizeinbase(to->weight[j], 2) > LONG_BITS;
    }
    if (is_long)
        shorten(to);
}

static corner *next_corner(polygon *p)
{
    assert(p->count < CORNERS_MAX);
    return &p->at[p->count++];
}

static void cut(const polygon *from, polygon *to)
{
    to->count = 0;
    for (int k = 0; k < from->count; k++) {
        const corner *const p = &from->at[k], *const q = &from->at[(k + 1) % from->count];
        if (mpz_sgn(p->value) >= 0) {
            corner *const kept = next_corner(to);
            for (int j = 0; j < 3; j++)
                mpz_set(kept->weight[j], p->weight[j]);
        }
        if (mpz_sgn(p->value) * mpz_sgn(q->value) < 0)
            cross(next_corner(to), p, q);
    }
}

/* Of the numbers at hand. */
static bool is_something_left(void)
{
    polygons[0].count = 3;
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++)
            mpz_set_si(polygons[0].at[k].weight[j], k == j);
    for (int side = 0; side < 6; side++) {
        polygon *const from = &polygons[side % 2], *const to = &polygons[(side + 1) % 2];
        set_values(from, side / 2, side % 2);
        cut(from, to);
        if (!to->count)
            return false;
    }
    return true;
}

bool oracle_clip(const pair_f64 *pair)
{
    prepare();
    load(pair);
    return is_something_left();
}

/* The sum of axis[a] (u[a] - center[a]). */
static void move_vertex(const double u[3], const double center[3], const double axis[3], mpq_t q, mpq_t term[2])
{
    for (int a = 0; a < 3; a++) {
        mpq_set_d(term[0], u[a]);
        mpq_set_d(term[1], center[a]);
        mpq_sub(term[0], term[0], term[1]);
        mpq_set_d(term[1], axis[a]);
        mpq_mul(term[0], term[0], term[1]);
        mpq_add(q, q, term[0]);
    }
}

/* Vertices in the frame and half lengths, times what makes whole numbers of them: a power of two. */
static void load_moved(const double u[3][3], const tribox_oriented_box *box, const double change[3])
{
    mpq_t moved[12], term[2];
    mpq_inits(term[0], term[1], NULL);
    mpz_set_ui(common, 1);
    for (int n = 0; n < 12; n++) {
        mpq_init(moved[n]);
        if (n < 9)
            move_vertex(u[n / 3], box->center, box->axis[n % 3], moved[n], term);
        else {
            mpq_set_d(moved[n], box->half[n - 9]);
            mpq_set_d(term[0], change[n - 9]);
            mpq_add(moved[n], moved[n], term[0]);
        }
        mpz_lcm(common, common, mpq_denref(moved[n]));
    }
    for (int n = 0; n < 12; n++) {
        mpz_t *const to = &number[n < 9 ? n : n + 3];
        mpz_divexact(*to, common, mpq_denref(moved[n]));
        mpz_mul(*to, *to, mpq_numref(moved[n]));
        if (n >= 9)
            mpz_neg(number[n], *to);
        mpq_clear(moved[n]);
    }
    mpq_clears(term[0], term[1], NULL);
}

/* The box is not empty, and no side of it has all three vertices outside. */
static bool do_bounds_meet(void)
{
    bool do_meet = true;
    for (int k = 0; k < 3; k++) {
        int below = 0, above = 0;
        for (int j = 0; j < 3; j++) {
            below += mpz_cmp(number[3 * j + k], number[9 + k]) < 0;
            above += mpz_cmp(number[3 * j + k], number[12 + k]) > 0;
        }
        do_meet = do_meet && mpz_sgn(number[12 + k]) >= 0 && below < 3 && above < 3;
    }
    return do_meet;
}

bool oriented_oracle_within(const double u[3][3], const tribox_oriented_box *box, const double change[3], bool bounds_alone)
{
    prepare();
    load_moved(u, box, change);
    return do_bounds_meet() && (bounds_alone || is_something_left());
}

bool oriented_oracle(const double u[3][3], const tribox_oriented_box *box, bool bounds_alone)
{
    return oriented_oracle_within(u, box, (const double[3]){0, 0, 0}, bounds_alone);
}

void oriented_explain(FILE *out, const double u[3][3], const tribox_oriented_box *box)
{
    const double *const rows[] = {u[0], u[1], u[2], box->center, box->half, box->axis[0], box->axis[1], box->axis[2]};
    static const char *const what[] = {"vertex 0", "vertex 1", "vertex 2", "center", "half", "axis 0", "axis 1", "axis 2"};
    for (int k = 0; k < 8; k++)
        fprintf(out, "  %-8s  %a, %a, %a\n", what[k], rows[k][0], rows[k][1], rows[k][2]);
}
