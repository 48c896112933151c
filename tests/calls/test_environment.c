/*
 * test_environment.c - the caller's rounding mode, flush-to-zero, traps and sticky flags change nothing that any function writes,
 * and come back as they were, on errors too.
 */
#include <math.h>

#include "calls.h"
#include "common/harness.h"
#include "common/float_environment.h"
#include "common/scenes.h"

enum { EACH = SETTINGS < 16 ? 1 : 24 }; /* a question is asked under each of so many settings, the next under the next ones */

_Static_assert((int)COUNT == (int)SCENE_TRIANGLES, "a batch fills what is asked");

static asked a;
static outputs out, blank, expected;

/* Signalling NaNs, one in each kind of number, and a subnormal one. */
static void spoil_numbers(void)
{
    const uint32_t signalling = 0x7fa00001u;
    const uint64_t wide = UINT64_C(0x7ff4000000000001);
    memcpy(&a.floats[17][1][2], &signalling, sizeof signalling);
    memcpy(&a.number[7][17], &signalling, sizeof signalling);
    memcpy(&a.corner[17][1][2], &wide, sizeof wide);
    a.floats[5][0][0] = a.number[0][5] = 0x1p-149f;
    a.corner[5][0][0] = 0x1p-1074;
}

/*
 * The numbers of a scene in place of the usual ones; a grid, an oriented box and a triangle about its box. Doubles are a third of
 * them, and no floats.
 */
static void draw(random_source *r, const scene *s, unsigned position_bytes)
{
    const double part = position_bytes == 8 ? 1 / 3.0 : 1;
    scene_batch batch;
    ask_rightly(position_bytes, &a, &out);
    scene_draw_batch(s, r, &batch);
    memcpy(a.floats, batch.u, sizeof a.floats);
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 9; k++) {
            a.number[3 * (k % 3) + k / 3][i] = a.floats[i][k / 3][k % 3];
            a.corner[i][k / 3][k % 3] = part * a.floats[i][k / 3][k % 3];
        }
    for (int k = 0; k < 3; k++) {
        const double lo = a.the_box.lo[k] = part * batch.box.lo[k], hi = a.the_box.hi[k] = part * batch.box.hi[k];
        a.the_oriented.center[k] = a.the_origin[k] = lo / 2 + hi / 2;
        a.the_oriented.half[k] = hi / 2 - lo / 2;
        a.the_oriented.axis[0][k] = k ? 0.25 : 1;
        a.the_grid.cell[k] = hi > lo ? (hi - lo) / 8 : 0.125;
        a.the_grid.origin[k] = lo - a.the_grid.cell[k] / 3;
        a.the_triangle[k] = (float)lo, a.the_triangle[3 + k] = a.floats[3][1][k], a.the_triangle[6 + k] = a.floats[4][2][k];
    }
    spoil_numbers();
    ask_follow(&a);
    outputs_prepare(&a, 0, &blank);
}

static void ask_under(const call *c, unsigned set, tribox_status due)
{
    const unsigned normal = environment_get();
    snprintf(doing, sizeof doing, "%s %s under setting %#x, kernel %s, accuracy %d", c->function, c->about, set,
             a.the_options.kernel, (int)a.the_options.accuracy);
    memcpy(&out, &blank, COMPARED);
    environment_set(set);
    const tribox_status status = c->ask(&a);
    const unsigned left = environment_get();
    environment_set(normal);
    if (left != set)
        fail_msg("%s: left as %#x", doing, left);
    if (status != due || outputs_differ(&out, &expected, COMPARED))
        fail_msg("%s: another answer", doing);
}

static void check(const call *c)
{
    static unsigned turn;
    memcpy(&out, &blank, COMPARED);
    const tribox_status due = c->ask(&a);
    memcpy(&expected, &out, COMPARED);
    for (unsigned k = turn++ % EACH; k < SETTINGS; k += EACH)
        ask_under(c, setting(k), due);
}

/* Second passes are of the same accuracy and triangles as the first. */
static void check_kernels(void)
{
    for (int k = 0; k < kernels; k++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            for (size_t n = 0; n < call_count; n++) {
                a.the_options = (tribox_options){.accuracy = (tribox_accuracy)accuracy, .kernel = names[k]};
                const bool is_listed = !accuracy && (a.the_mesh.position_bytes == 4 || !call_takes(&calls[n], "mesh"));
                if (call_takes(&calls[n], "places") ? is_listed : !k || call_takes(&calls[n], "test kernel"))
                    check(&calls[n]);
            }
}

CASE(test_scenes)
{
    for (size_t i = 0; i < scene_count(); i += arguments_are_short(&args) ? 12 : 4) {
        random_source r = random_named(args.seed, scene_at(i)->name);
        draw(&r, scene_at(i), i % 8 ? 4 : 8);
        check_kernels();
    }
}

/* Errors, and numbers that flushing to zero would change. */
CASE(test_refusals)
{
    static const uint64_t bounds[] = {
        1, UINT64_C(1) << 63 | 1, UINT64_C(0x36a) << 52, UINT64_C(0x7ff) << 52 | 1, UINT64_C(0xfff8) << 48, UINT64_C(0x7ff) << 52};
    random_source r = random_named(args.seed, "refusals");
    for (size_t b = 0; b < sizeof bounds / sizeof bounds[0]; b++) {
        draw(&r, scene_at(0), b % 2 ? 8 : 4);
        memcpy(&a.the_box.lo[b % 3], &bounds[b], sizeof bounds[b]);
        memcpy(&a.the_box.hi[(b + 1) % 3], &bounds[b], sizeof bounds[b]);
        memcpy(&a.the_oriented.half[b % 3], &bounds[b], sizeof bounds[b]);
        memcpy(&a.the_grid.cell[b % 3], &bounds[b], sizeof bounds[b]);
        memcpy(&a.the_origin[b % 3], &bounds[b], sizeof bounds[b]);
        a.index[5] = b > 2 ? 3 * COUNT : 5;
        check_kernels();
    }
}

PROGRAM(RUN(test_scenes), RUN(test_refusals))
