/*
 * oriented_oracle.c - q_k = axis_k . (p - center) for the three vertices, in rational numbers; what is left of that triangle after
 * six cuts (Sutherland and Hodgman) lies in the box.
 */
#include "oriented_oracle.h"

#include <assert.h>
#include <gmp.h>

/* Each of six cuts adds at most one corner to the first three. */
enum { CORNERS_MAX = 9 };

typedef struct polygon {
    mpq_t at[CORNERS_MAX][3];
    mpq_t value[CORNERS_MAX]; /* on the half-space at hand: negative outside of it */
    int count;
} polygon;

static polygon polygons[2];
static mpq_t half[3], offset[3], product, step;

static void prepare(void)
{
    static bool is_ready;
    if (is_ready)
        return;
    is_ready = true;
    for (int p = 0; p < 2; p++)
        for (int c = 0; c < CORNERS_MAX; c++) {
            mpq_init(polygons[p].value[c]);
            for (int k = 0; k < 3; k++)
                mpq_init(polygons[p].at[c][k]);
        }
    for (int k = 0; k < 3; k++)
        mpq_inits(half[k], offset[k], NULL);
    mpq_inits(product, step, NULL);
}

static void move_vertex(const double u[3], const tribox_oriented_box *box, mpq_t q[3])
{
    for (int a = 0; a < 3; a++) {
        mpq_set_d(offset[a], u[a]);
        mpq_set_d(product, box->center[a]);
        mpq_sub(offset[a], offset[a], product);
    }
    for (int k = 0; k < 3; k++) {
        mpq_set_ui(q[k], 0, 1);
        for (int a = 0; a < 3; a++) {
            mpq_set_d(product, box->axis[k][a]);
            mpq_mul(product, product, offset[a]);
            mpq_add(q[k], q[k], product);
        }
    }
}

static void load(const double u[3][3], const tribox_oriented_box *box, const double change[3])
{
    prepare();
    polygons[0].count = 3;
    for (int j = 0; j < 3; j++)
        move_vertex(u[j], box, polygons[0].at[j]);
    for (int k = 0; k < 3; k++) {
        mpq_set_d(half[k], box->half[k]);
        mpq_set_d(product, change[k]);
        mpq_add(half[k], half[k], product);
    }
}

/* half - q, or half + q */
static void set_values(polygon *p, int k, bool is_upper)
{
    for (int c = 0; c < p->count; c++) {
        if (is_upper)
            mpq_sub(p->value[c], half[k], p->at[c][k]);
        else
            mpq_add(p->value[c], half[k], p->at[c][k]);
    }
}

/* The point of the side from corner c to corner d where the value is zero. */
static void cross(const polygon *from, int c, int d, mpq_t to[3])
{
    mpq_sub(step, from->value[c], from->value[d]);
    mpq_div(step, from->value[c], step);
    for (int k = 0; k < 3; k++) {
        mpq_sub(product, from->at[d][k], from->at[c][k]);
        mpq_mul(product, product, step);
        mpq_add(to[k], from->at[c][k], product);
    }
}

static void cut(const polygon *from, polygon *to)
{
    to->count = 0;
    for (int c = 0; c < from->count; c++) {
        const int d = (c + 1) % from->count;
        assert(to->count + 2 <= CORNERS_MAX || c + 1 == from->count);
        if (mpq_sgn(from->value[c]) >= 0) {
            for (int k = 0; k < 3; k++)
                mpq_set(to->at[to->count][k], from->at[c][k]);
            to->count++;
        }
        if (mpq_sgn(from->value[c]) * mpq_sgn(from->value[d]) < 0)
            cross(from, c, d, to->at[to->count++]);
    }
}

static bool is_something_left(void)
{
    for (int side = 0; side < 6; side++) {
        polygon *const from = &polygons[side % 2], *const to = &polygons[(side + 1) % 2];
        set_values(from, side / 2, side % 2);
        cut(from, to);
        if (!to->count)
            return false;
    }
    return true;
}

/* No half-space has all three vertices outside. */
static bool do_bounds_meet(void)
{
    for (int side = 0; side < 6; side++) {
        polygon *const p = &polygons[0];
        set_values(p, side / 2, side % 2);
        if (mpq_sgn(p->value[0]) < 0 && mpq_sgn(p->value[1]) < 0 && mpq_sgn(p->value[2]) < 0)
            return false;
    }
    return true;
}

bool oriented_oracle_within(const double u[3][3], const tribox_oriented_box *box, const double change[3], bool bounds_alone)
{
    load(u, box, change);
    if (mpq_sgn(half[0]) < 0 || mpq_sgn(half[1]) < 0 || mpq_sgn(half[2]) < 0)
        return false;
    return do_bounds_meet() && (bounds_alone || is_something_left());
}

static const double no_change[3];

bool oriented_oracle(const double u[3][3], const tribox_oriented_box *box)
{
    return oriented_oracle_within(u, box, no_change, false);
}

bool oriented_oracle_bounds(const double u[3][3], const tribox_oriented_box *box)
{
    return oriented_oracle_within(u, box, no_change, true);
}

static void print_three(FILE *out, const char *name, int k, const double v[3])
{
    fprintf(out, "  %s %d  %a, %a, %a\n", name, k, v[0], v[1], v[2]);
}

void oriented_explain(FILE *out, const double u[3][3], const tribox_oriented_box *box)
{
    for (int j = 0; j < 3; j++)
        print_three(out, "vertex", j, u[j]);
    print_three(out, "center", 0, box->center);
    print_three(out, "half  ", 0, box->half);
    for (int k = 0; k < 3; k++)
        print_three(out, "axis  ", k, box->axis[k]);
}
