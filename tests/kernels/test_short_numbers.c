/*
 * test_short_numbers.c - where the inexact flag never rises, doubles.h decides ties of short numbers, and no pair wrongly.
 *
 * Triangles through a corner of their box, in whole numbers of all lengths, so that the plane or an edge axis touches it exactly;
 * then with a number moved by as little as it can be. And where it rises, so do walks of soups in float, block by block. Judged by
 * integers.
 */
#include <math.h>

#include "common/fences.h"
#include "common/harness.h"
#include "dispatch.h"
#include "exact/exact.h"

extern const tribox_settle_kernel tribox_settle_unflagged;

static double whole(random_source *r, int bits)
{
    return (double)((int64_t)(random_bits(r) >> (64 - bits)) - (INT64_C(1) << (bits - 1)));
}

/* Its plane, or one of its edges, goes through a corner of the box, which lies on the other side of it or anywhere. */
static tribox_pair draw_touching(random_source *r, int bits, int box_bits)
{
    static const int weight[3][3][2] = {{{1, 0}, {0, 1}, {-1, -1}}, {{1, 0}, {-1, 0}, {0, 1}}, {{0, 0}, {1, 0}, {0, 1}}};
    const int kind = random_int(r, 3);
    double corner[3], edge[2][3], normal[3];
    tribox_pair pair;
    for (int a = 0; a < 3; a++) {
        corner[a] = whole(r, bits);
        for (int e = 0; e < 2; e++)
            edge[e][a] = whole(r, bits);
    }
    for (int a = 0; a < 3; a++)
        normal[a] = edge[0][(a + 1) % 3] * edge[1][(a + 2) % 3] - edge[0][(a + 2) % 3] * edge[1][(a + 1) % 3];
    for (int a = 0; a < 3; a++) {
        const double length = fabs(whole(r, box_bits));
        const bool is_below = random_int(r, 8) ? normal[a] > 0 : random_int(r, 2);
        pair.lo[a] = is_below ? corner[a] - length : corner[a];
        pair.hi[a] = is_below ? corner[a] : corner[a] + length;
        for (int j = 0; j < 3; j++)
            pair.u[j][a] = corner[a] + weight[kind][j][0] * edge[0][a] + weight[kind][j][1] * edge[1][a];
    }
    return pair;
}

/* Number n of a pair, in the order of a batch. */
static double *number_of(tribox_pair *pair, int n)
{
    return n < 9 ? &pair->u[n % 3][n / 3] : n < 12 ? &pair->lo[n - 9] : &pair->hi[n - 12];
}

static bool is_apart_on_box_normals(const tribox_pair *pair)
{
    for (int a = 0; a < 3; a++)
        if (fmin(fmin(pair->u[0][a], pair->u[1][a]), pair->u[2][a]) > pair->hi[a] ||
            fmax(fmax(pair->u[0][a], pair->u[1][a]), pair->u[2][a]) < pair->lo[a])
            return true;
    return false;
}

/* Of up to 26 bits, in any unit: whole, or with a number moved a little. */
static tribox_pair draw_pair(random_source *r)
{
    tribox_pair pair;
    do {
        const int bits = random_int_between(r, 2, 26);
        pair = draw_touching(r, bits, random_int_between(r, 1, bits));
        if (random_int(r, 2))
            *number_of(&pair, random_int(r, 15)) += ldexp(random_int(r, 2) ? 1 : -1, -random_int(r, 20));
    } while (is_apart_on_box_normals(&pair) || pair.lo[0] > pair.hi[0] || pair.lo[1] > pair.hi[1] || pair.lo[2] > pair.hi[2]);
    const int unit = random_int(r, 2) ? 0 : random_int_between(r, -990, 990);
    for (int n = 0; n < 15; n++)
        *number_of(&pair, n) = ldexp(*number_of(&pair, n), unit);
    return pair;
}

/* The longest distance on an axis in units of the last bit of any number; more than 2^16 may stay open. */
static bool is_short(const tribox_pair *pair)
{
    double longest = 0;
    int unit = 0;
    tribox_pair copy = *pair;
    for (int a = 0; a < 3; a++)
        for (int j = 0; j < 3; j++)
            longest = fmax(longest, fmax(pair->u[j][a] - pair->lo[a], pair->hi[a] - pair->u[j][a]));
    if (longest < 0x1p-190 || longest > 0x1p190)
        return false;
    frexp(longest, &unit);
    for (int n = 0; n < 15; n++) {
        const double in_units = ldexp(*number_of(&copy, n), 16 - unit);
        if (in_units != nearbyint(in_units))
            return false;
    }
    return true;
}

static void put(tribox_batch *batch, unsigned at, tribox_pair *pair)
{
    for (int n = 0; n < 15; n++)
        batch->number[n][at] = *number_of(pair, n);
}

static void fail_pair(tribox_pair *pair, const char *what)
{
    for (int n = 0; n < 15; n++)
        print_error("%a ", *number_of(pair, n));
    fail_msg("this pair is %s", what);
}

CASE(test_ties)
{
    random_source r = random_named(args.seed, "short numbers");
    const size_t rounds = arguments_rounds(&args, TRIBOX_BATCH / 2);
    size_t decided = 0, ties = 0;
    for (size_t round = 0; round < rounds; round++) {
        tribox_batch batch;
        tribox_pair pairs[TRIBOX_BATCH];
        for (unsigned i = 0; i < TRIBOX_BATCH; i++) {
            pairs[i] = draw_pair(&r);
            put(&batch, i, &pairs[i]);
        }
        const tribox_verdict verdict = tribox_settle_unflagged.in_double(&batch, NULL, TRIBOX_BATCH, TRIBOX_AXES_ALL, true);
        const tribox_verdict by_bounds = tribox_settle_unflagged.in_double(&batch, NULL, TRIBOX_BATCH, TRIBOX_AXES_ALL, false);
        for (unsigned i = 0; i < TRIBOX_BATCH; i++) {
            const bool is_open = verdict.undecided >> i & 1;
            if (is_open && is_short(&pairs[i]))
                fail_pair(&pairs[i], "short and left open");
            if (!is_open && (verdict.overlapping >> i & 1) != tribox_exact_overlap(&pairs[i], TRIBOX_AXES_ALL))
                fail_pair(&pairs[i], "decided wrongly");
            decided += !is_open;
            ties += !is_open && by_bounds.undecided >> i & 1;
        }
    }
    printf("%zu decided, %zu of them ties\n", decided, ties);
    assert_true(ties > decided / 10);
}

/* Floats on a lattice of few bits, many of them on the box, in any unit; before the first of them, or none, anything. */
static void draw_soup(random_source *r, size_t count, float *const number[9], tribox_box *box)
{
    const size_t lattice = random_int(r, 2) ? random_below(r, count) : 0;
    const int bits = random_int_between(r, 2, 14), unit = random_int(r, 4) ? random_int_between(r, -30, 30) : -149;
    for (int a = 0; a < 3; a++) {
        box->lo[a] = ldexp(whole(r, bits), unit);
        box->hi[a] = box->lo[a] + (random_int(r, 8) ? ldexp(fabs(whole(r, bits)), unit) : 0);
        for (size_t i = 0; i < count; i++)
            for (int j = 0; j < 3; j++)
                number[3 * a + j][i] = (float)(i < lattice        ? ldexp(whole(r, 30), unit + bits - 30)
                                               : random_int(r, 8) ? ldexp(whole(r, bits), unit)
                                               : i % 2            ? box->lo[a]
                                                                  : box->hi[a]);
    }
    const size_t first = random_below(r, count);
    for (size_t i = first; i < count && random_int(r, 3); i += random_below(r, count) / 8) { /* long ones from somewhere on */
        float *const moved = &number[random_int(r, 9)][i];
        *moved = random_int(r, 9) ? nextafterf(*moved, i % 2 ? INFINITY : -INFINITY) : random_int(r, 2) ? NAN : INFINITY;
    }
    if (!random_int(r, 4)) /* no float any more */
        box->hi[random_int(r, 3)] += ldexp(1, unit - 40);
}

static bool is_overlap(const tribox_pair *pair)
{
    for (int n = 0; n < 9; n++)
        if (!isfinite(pair->u[n % 3][n / 3]))
            return false;
    return !is_apart_on_box_normals(pair) && tribox_exact_overlap(pair, TRIBOX_AXES_ALL);
}

CASE(test_walks)
{
    enum { MOST = 64 * 70 + 37 };
    uint64_t mask[MOST / 64 + 1];
    random_source r = random_named(args.seed, "short walks");
    guarded memory[9];
    stream_fences_make(MOST, memory);
    for (size_t round = arguments_rounds(&args, MOST / 8); round--;) {
        const size_t count = random_int(&r, 2) ? MOST : 1 + random_below(&r, 300);
        float *number[9];
        tribox_box box;
        const tribox_soup soup = streams_lay(memory, count, AT_END, number);
        draw_soup(&r, count, number, &box);
        assert_int_equal(tribox_overlap(&soup, &box, &(tribox_options){.kernel = KERNEL_NAME}, mask, NULL), TRIBOX_OK);
        for (size_t i = 0; i < count; i++) {
            tribox_pair pair;
            for (int a = 0; a < 3; a++) {
                for (int j = 0; j < 3; j++)
                    pair.u[j][a] = number[3 * a + j][i];
                pair.lo[a] = box.lo[a];
                pair.hi[a] = box.hi[a];
            }
            if ((mask[i / 64] >> i % 64 & 1) != is_overlap(&pair))
                fail_pair(&pair, "walked wrongly");
        }
    }
    for (int k = 0; k < 9; k++)
        guarded_free(memory[k]);
}

static int find_kernel(void)
{
    if (tribox_kernel_find(KERNEL_NAME))
        return 0;
    puts("this processor cannot run " KERNEL_NAME ": skipped");
    return 77;
}

PROGRAM_AFTER(find_kernel, RUN(test_ties), RUN(test_walks))
