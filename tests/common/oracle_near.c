#include "oracle.h"

#include <gmp.h>

/* A pair in integers, its extents F and distances m, and an axis with what is found along it. */
typedef struct room {
    mpz_t u[3][3], bound[2][3], F[3], m[3], axis[3], least[2], most[2], gap, allowed, term;
} room;

static void for_all(room *r, void (*act)(mpz_t))
{
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            act(r->u[j][a]);
        act(r->bound[0][a]);
        act(r->bound[1][a]);
        act(r->F[a]);
        act(r->m[a]);
        act(r->axis[a]);
    }
    for (int body = 0; body < 2; body++) {
        act(r->least[body]);
        act(r->most[body]);
    }
    act(r->gap);
    act(r->allowed);
    act(r->term);
}

static void init(mpz_t z) { mpz_init(z); }
static void clear(mpz_t z) { mpz_clear(z); }

static void raise_to(mpz_t z, const mpz_t least)
{
    if (mpz_cmp(z, least) < 0)
        mpz_set(z, least);
}

static void load(room *r, const pair_f64 *pair)
{
    const oracle_integers in = oracle_integers_of(pair);
    for (int k = 0; k < 15; k++) {
        mpz_t *const to = k < 9 ? &r->u[k / 3][k % 3] : &r->bound[k / 3 - 3][k % 3];
        mpz_set_d(*to, (double)in.odd[k]);
        mpz_mul_2exp(*to, *to, in.shift[k]);
    }
    for (int a = 0; a < 3; a++)
        for (int j = 0; j < 3; j++) {
            mpz_sub(r->term, r->u[j][a], r->u[(j + 1) % 3][a]);
            mpz_abs(r->term, r->term);
            raise_to(r->F[a], r->term);
            for (int side = 0; side < 2; side++) {
                mpz_sub(r->term, r->u[j][a], r->bound[side][a]);
                mpz_abs(r->term, r->term);
                raise_to(r->m[a], r->term);
            }
        }
}

/* Allows F of one axis, or of two, times m of another. */
static void allow(room *r, int first, int second, int far)
{
    mpz_mul(r->term, r->F[first], r->m[far]);
    if (second >= 0)
        mpz_mul(r->term, r->term, r->F[second]);
    mpz_add(r->allowed, r->allowed, r->term);
}

static void put_axis(room *r, int number)
{
    mpz_set_ui(r->allowed, 0);
    for (int a = 0; a < 3; a++)
        mpz_set_ui(r->axis[a], 0);
    if (number == ORACLE_PLANE) {
        for (int i = 0; i < 3; i++) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            for (int turn = 0; turn < 2; turn++) {
                mpz_sub(r->gap, r->u[1][turn ? b : a], r->u[0][turn ? b : a]);
                mpz_sub(r->term, r->u[2][turn ? a : b], r->u[0][turn ? a : b]);
                mpz_mul(r->gap, r->gap, r->term);
                if (turn)
                    mpz_sub(r->axis[i], r->axis[i], r->gap);
                else
                    mpz_add(r->axis[i], r->axis[i], r->gap);
            }
            allow(r, a, b, i);
        }
        return;
    }
    const int i = (number - ORACLE_EDGES) / 3, j = (number - ORACLE_EDGES) % 3, a = (i + 1) % 3, b = (i + 2) % 3;
    mpz_sub(r->axis[a], r->u[j][b], r->u[(j + 1) % 3][b]);
    mpz_sub(r->axis[b], r->u[(j + 1) % 3][a], r->u[j][a]);
    allow(r, a, -1, b);
    allow(r, b, -1, a);
}

/* Where a body ends along the axis: body 0 is the triangle, of three points, body 1 the box, of eight. */
static void project(room *r, int body, int points)
{
    for (int k = 0; k < points; k++) {
        mpz_set_ui(r->gap, 0);
        for (int a = 0; a < 3; a++)
            mpz_addmul(r->gap, r->axis[a], body ? r->bound[k >> a & 1][a] : r->u[k][a]);
        if (k == 0 || mpz_cmp(r->gap, r->least[body]) < 0)
            mpz_set(r->least[body], r->gap);
        if (k == 0 || mpz_cmp(r->gap, r->most[body]) > 0)
            mpz_set(r->most[body], r->gap);
    }
}

static bool is_axis_near(room *r, int number, unsigned bits)
{
    put_axis(r, number);
    project(r, 0, 3);
    project(r, 1, 8);
    mpz_sub(r->gap, r->least[0], r->most[1]);
    mpz_sub(r->term, r->least[1], r->most[0]);
    raise_to(r->gap, r->term);
    mpz_mul_2exp(r->gap, r->gap, bits);
    return mpz_cmp(r->gap, r->allowed) < 0;
}

bool oracle_is_near(const pair_f64 *pair, oracle_axes truth, unsigned groups, unsigned bits)
{
    static const unsigned box_normals = (1u << ORACLE_PLANE) - 1;
    room r;
    bool is_near =
        pair_f64_is_finite(pair) && !box_is_empty(&pair->box) && !(groups & TRIBOX_AXES_BOX && truth.apart & box_normals);
    for_all(&r, init);
    load(&r, pair);
    for (int k = ORACLE_PLANE; is_near && k < ORACLE_AXES; k++)
        if (truth.apart >> k & 1 && groups & (k == ORACLE_PLANE ? TRIBOX_AXES_PLANE : TRIBOX_AXES_EDGES))
            is_near = is_axis_near(&r, k, bits);
    for_all(&r, clear);
    return is_near;
}
