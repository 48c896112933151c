/* test_fill_crossings.c - every kernel turns the bits that exact signs alone turn. */
#include "common/harness.h"
#include "dispatch.h"
#include "fill_case.h"
#include "fill/fill_crossings.h"

enum { PAIRS = 100000, ROUNDS = 1500 };

static fill_case drawn;

typedef struct turned {
    uint64_t solid[CASE_WORDS_MAX], beyond[ORACLE_CELLS / 64 + 1];
} turned;

static void start(const fill_case *c, tribox_crossings *to, turned *t)
{
    memset(t, 0, sizeof *t);
    to->rows = tribox_rows_of(c->at.size);
    const tribox_window all = tribox_whole_window(&c->grid);
    to->middles = tribox_middles_of(&c->grid, &all);
    to->handlers = &tribox_exact_crossings;
    to->solid = t->solid;
    to->beyond = t->beyond;
    to->turns.count = 0;
}

static size_t see(const fill_case *c, size_t first, tribox_seen_along *seen)
{
    const size_t left = (size_t)c->at.count - first, count = left < TRIBOX_SEEN_ALONG ? left : TRIBOX_SEEN_ALONG;
    for (size_t i = 0; i < count; i++)
        for (int n = 0; n < 9; n++)
            seen->number[n][i] = c->at.u[first + i][n % 3][n / 3];
    return count;
}

static void cross(const fill_case *c, const tribox_kernel *kernel, turned *t)
{
    static tribox_seen_along seen;
    static tribox_crossings to;
    start(c, &to, t);
    for (size_t first = 0; first < (size_t)c->at.count; first += TRIBOX_SEEN_ALONG)
        kernel->rows->cross(&to, &seen, see(c, first, &seen));
    tribox_crossings_finish(&to);
}

static void cross_exactly(const fill_case *c, turned *t)
{
    static tribox_crossings to;
    start(c, &to, t);
    for (int i = 0; i < c->at.count; i++) {
        double u[3][3];
        memcpy(u, c->at.u[i], sizeof u);
        if (tribox_are_finite_doubles(&u[0][0], 9))
            tribox_crossings_exactly(&to, u);
    }
    tribox_crossings_finish(&to);
}

CASE(test_kernels)
{
    static turned exact, found;
    size_t places = 0;
    random_source r = random_named(args.seed, "fill crossings");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS) / (arguments_are_short(&args) ? 10 : 1); round++) {
        fill_case_draw(&r, round % fill_case_scenes(), &drawn);
        const tribox_window all = tribox_whole_window(&drawn.grid);
        if (!tribox_middles_of(&drawn.grid, &all).has_places)
            continue;
        places++;
        cross_exactly(&drawn, &exact);
        for (size_t k = 0; k < tribox_kernel_count(); k++) {
            if (!tribox_kernel_runs_here(k))
                continue;
            cross(&drawn, tribox_kernel_at(k), &found);
            if (memcmp(&found, &exact, sizeof exact))
                fail_msg("round %zu: %s, %d triangles, %s: %s crosses elsewhere", round, drawn.scene, drawn.at.count, drawn.body,
                         tribox_kernel_at(k)->name);
        }
    }
    assert_true(places);
}

PROGRAM(RUN(test_kernels))
