/* test_thin.c - segments and slivers through the box: what each accuracy promises of them, FAST less than the others. */
#include "common/ask.h"

#include <math.h>

#include "common/harness.h"

enum { COUNT = 4096, WORDS = COUNT / 64 };

static const tribox_box box = {{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}};
static const tribox_box half_box = {{-0.25f, -0.25f, -0.25f}, {0.25f, 0.25f, 0.25f}};

/* Triangles, as streams too, and which of them reach into the middle half of the box. */
typedef struct thin {
    float u[COUNT][3][3], stream[3][3][COUNT]; /* stream[axis][vertex] */
    uint64_t middle[WORDS];
} thin;

static tribox_soup soup_of(const thin *t)
{
    tribox_soup soup = {.count = COUNT};
    for (int j = 0; j < 3; j++) {
        soup.x[j] = t->stream[0][j];
        soup.y[j] = t->stream[1][j];
        soup.z[j] = t->stream[2][j];
    }
    return soup;
}

/* Two vertices anywhere about the box. */
static void draw_ends(random_source *r, float u[3][3])
{
    for (int j = 0; j < 2; j++)
        for (int a = 0; a < 3; a++)
            u[j][a] = (float)random_double(r, -2, 2);
}

/* A segment: vertex 2 on vertex 0 (kind 0), on vertex 1 (1), or somewhere between them (2). */
static void draw_segment(random_source *r, int kind, float u[3][3])
{
    const double along = kind == 0 ? 0 : kind == 1 ? 1 : random_double(r, 0, 1);
    draw_ends(r, u);
    for (int a = 0; a < 3; a++)
        u[2][a] = along == 1 ? u[1][a] : (float)(u[0][a] + along * ((double)u[1][a] - u[0][a]));
}

/* Vertex 2 off the middle of the longest edge by 2^-power of its length, on the axis on which that edge is shortest. */
static void draw_sliver(random_source *r, int power, float u[3][3])
{
    double length = 0;
    int across = 0;
    draw_ends(r, u);
    for (int a = 0; a < 3; a++) {
        length = hypot(length, (double)u[1][a] - u[0][a]);
        across = fabsf(u[1][a] - u[0][a]) < fabsf(u[1][across] - u[0][across]) ? a : across;
    }
    for (int a = 0; a < 3; a++)
        u[2][a] = (float)(0.5 * ((double)u[0][a] + u[1][a]) + (a == across ? ldexp(length, -power) : 0));
}

static void complete(thin *t)
{
    for (int i = 0; i < COUNT; i++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                t->stream[a][j][i] = t->u[i][j][a];
    const tribox_soup soup = soup_of(t);
    ask_soup(&soup, &half_box, &(tribox_options){0}, t->middle);
}

/* The answers of one kernel to all of them; fails at the first pair that must be found and is not. */
static void check_found(const thin *t, const char *test, const tribox_options *options, const uint64_t *must)
{
    uint64_t mask[WORDS];
    const tribox_soup soup = soup_of(t);
    const origin where = {.scene = test, .seed = args.seed, .function = "tribox_overlap", .options = *options};
    ask_soup(&soup, &box, options, mask);
    for (size_t i = 0; i < COUNT; i++)
        if (bit_of(must, i) && !bit_of(mask, i)) {
            const pair_f64 pair = pair_of_floats(t->u[i][0], &box);
            fail_pair(&where, &pair, false);
        }
}

static void check_accuracy(const thin *t, const char *test, tribox_accuracy accuracy, const uint64_t *must)
{
    for (int k = 0; k < kernels; k++)
        check_found(t, test, &(tribox_options){.accuracy = accuracy, .kernel = names[k]}, must);
}

static thin drawn;

/* EXACT and CONSERVATIVE find every segment and sliver that clipping finds. */
CASE(test_exact_and_conservative_find_all)
{
    random_source r = random_named(args.seed, "thin");
    uint64_t truth[WORDS] = {0};
    for (int i = 0; i < COUNT; i++) {
        if (i % 2)
            draw_segment(&r, random_int(&r, 3), drawn.u[i]);
        else
            draw_sliver(&r, random_int_between(&r, 10, 30), drawn.u[i]);
        const pair_f64 pair = pair_of_floats(drawn.u[i][0], &box);
        truth[i / 64] |= (uint64_t)oracle_clip(&pair) << i % 64;
    }
    complete(&drawn);
    check_accuracy(&drawn, "thin", TRIBOX_EXACT, truth);
    check_accuracy(&drawn, "thin", TRIBOX_CONSERVATIVE, truth);
}

/* FAST: up to 2^12 times as long as high and 7 times as long as the box (2^16 / k in the manual), the normal is good enough. */
CASE(test_fast_finds_slivers)
{
    random_source r = random_named(args.seed, "slivers");
    for (int i = 0; i < COUNT; i++)
        draw_sliver(&r, random_int_between(&r, 4, 12), drawn.u[i]);
    complete(&drawn);
    check_accuracy(&drawn, "slivers", TRIBOX_FAST, drawn.middle);
}

/* FAST: an edge of length zero makes every part of the normal zero, if it is f_0 or f_1. */
CASE(test_fast_finds_segments_without_an_edge)
{
    random_source r = random_named(args.seed, "segments without an edge");
    for (int i = 0; i < COUNT; i++) {
        draw_segment(&r, 1, drawn.u[i]);
        if (i % 2)
            memcpy(drawn.u[i][1], drawn.u[i][0], sizeof drawn.u[i][1]);
    }
    complete(&drawn);
    check_accuracy(&drawn, "segments without an edge", TRIBOX_FAST, drawn.middle);
}

static size_t count_lost(const thin *t, const char *kernel)
{
    uint64_t mask[WORDS];
    size_t lost = 0;
    const tribox_soup soup = soup_of(t);
    ask_soup(&soup, &box, &(tribox_options){.accuracy = TRIBOX_FAST, .kernel = kernel}, mask);
    for (size_t i = 0; i < COUNT; i++)
        lost += bit_of(t->middle, i) && !bit_of(mask, i);
    return lost;
}

/* FAST: of segments that go there and back it may lose most in small boxes, in this one a third, and not the half. */
CASE(test_fast_loses_a_third_of_segments)
{
    random_source r = random_named(args.seed, "segments");
    for (int i = 0; i < COUNT; i++) {
        const float share = (float)random_double(&r, 0, 1);
        draw_segment(&r, 0, drawn.u[i]);
        for (int a = 0; a < 3; a++)
            drawn.u[i][1][a] = -share * drawn.u[i][0][a];
    }
    complete(&drawn);
    for (int k = 0; k < kernels; k++)
        assert_in_range(count_lost(&drawn, names[k]), 0, COUNT * 2 / 5);
}

PROGRAM(RUN(test_exact_and_conservative_find_all), RUN(test_fast_finds_slivers), RUN(test_fast_finds_segments_without_an_edge),
        RUN(test_fast_loses_a_third_of_segments))
