/*
 * test_split.c - each bit is that of a call of tribox_overlap, or tribox_mesh_overlap, about that child: EXACT alike, CONSERVATIVE
 * never without one, and FAST of a soup as that says, or as EXACT does. For every scene, kernel, form of the list, and
 * middle.
 */
#include <float.h>
#include <math.h>

#include "common/fences.h"
#include "common/harness.h"
#include "common/scenes.h"
#include "common/laid_mesh.h"
#include "common/soup_or_mesh.h"
#include "common/window_bits.h"
#include "scenes_f64.h"

enum { TRIANGLES = 100, LISTED_MOST = 2100 };

static laid_fences fences;
static guarded list_fence, bytes_fence, stream_fences[9];

/* What is asked, in one of its forms; the truth about every triangle and child. */
typedef struct asked {
    soup_or_mesh of;
    tribox_box box;
    double middle[3];
    bool has_middle;
    bool is_fast_known;                        /* a soup, and nothing underflows: then FAST depends on its kernel alone */
    uint8_t truth[TRIANGLES], fast[TRIANGLES]; /* by the kernel that is asked */
} asked;

static tribox_status split(const asked *q, const uint32_t *list, size_t count, const tribox_options *options, uint8_t *children,
                           tribox_report *report)
{
    return CALL(split, &q->of, list, count, &q->box, q->has_middle ? q->middle : NULL, options, children, report);
}

static double nearest_middle(double lo, double hi) { return (double)(((long double)lo + (long double)hi) / 2); }

/* Of all triangles, by calls about each child. */
static void ask_children(const asked *q, const tribox_options *options, uint8_t *bits)
{
    memset(bits, 0, TRIANGLES);
    for (int c = 0; c < 8; c++) {
        uint64_t mask[(TRIANGLES + 63) / 64];
        tribox_box child = q->box;
        for (int a = 0; a < 3; a++) {
            const double middle = q->has_middle ? q->middle[a] : nearest_middle(q->box.lo[a], q->box.hi[a]);
            *(c >> a & 1 ? &child.lo[a] : &child.hi[a]) = middle;
        }
        assert_int_equal(CALL(overlap, &q->of, &child, options, mask, NULL), TRIBOX_OK);
        for (size_t i = 0; i < q->of.mesh.count; i++)
            bits[i] |= (uint8_t)(bit_of(mask, i) << c);
    }
}

static bool is_right(const asked *q, size_t i, uint8_t got, tribox_accuracy accuracy)
{
    const uint8_t due = q->truth[i];
    return accuracy == TRIBOX_EXACT                      ? got == due
           : accuracy == TRIBOX_FAST && q->is_fast_known ? !((got ^ due) & (got ^ q->fast[i]))
           : accuracy == TRIBOX_CONSERVATIVE             ? !(due & ~got)
                                                         : true;
}

/* In pages of their own, at their end. */
static void check_list(const asked *q, const uint32_t *numbers, size_t count, const tribox_options *options)
{
    uint32_t *const list = numbers ? guarded_tail(list_fence, count * sizeof *numbers) : NULL;
    uint8_t *const children = guarded_tail(bytes_fence, count);
    size_t bits = 0;
    tribox_report report, alone;
    if (list)
        memcpy(list, numbers, count * sizeof *numbers);
    memset(children, 0x5a, count);
    assert_int_equal(split(q, list, count, options, children, &report), TRIBOX_OK);
    for (size_t i = 0; i < count; i++) {
        const uint8_t due = q->truth[list ? list[i] : i], got = children[i];
        if (!is_right(q, list ? list[i] : i, got, options->accuracy))
            fail_msg("%s: %s, accuracy %d, axes %u: triangle %zu of %zu has %02x and not %02x", doing, options->kernel,
                     (int)options->accuracy, options->axes, i, count, got, due);
        for (int c = 0; c < 8; c++)
            bits += got >> c & 1;
    }
    assert_int_equal(report.overlapping, bits);
    assert_true(report.undecided <= (options->accuracy == TRIBOX_FAST ? 0 : 8 * count));
    assert_int_equal(split(q, list, count, options, NULL, &alone), TRIBOX_OK);
    assert_memory_equal(&alone, &report, sizeof report);
}

static void check(random_source *r, asked *q, bool has_long_lists)
{
    static uint32_t list[LISTED_MOST];
    const unsigned axes = random_int(r, 5) ? 0 : TRIBOX_AXES_BOX;
    ask_children(q, &(tribox_options){.axes = axes}, q->truth);
    const size_t counts[] = {0, 1, random_below(r, 70), has_long_lists ? random_below(r, LISTED_MOST) : 17};
    for (int k = 0; k < kernels; k++) {
        const tribox_options exact = {.kernel = names[k], .axes = axes};
        ask_children(q, &(tribox_options){.kernel = names[k], .axes = axes, .accuracy = TRIBOX_FAST}, q->fast);
        for (size_t n = 0; n < sizeof counts / sizeof counts[0]; n++) {
            for (size_t i = 0; i < counts[n]; i++)
                list[i] = (uint32_t)(random_int(r, 8) ? (i + n) % q->of.mesh.count : random_below(r, q->of.mesh.count));
            check_list(q, list, counts[n],
                       n % 2 ? &exact
                             : &(tribox_options){.kernel = names[k], .axes = axes, .accuracy = (tribox_accuracy)random_int(r, 3)});
        }
        check_list(q, NULL, q->of.mesh.count, &exact);
    }
}

/* At an end, in the middle, on a vertex, an ulp beside it, or anywhere; or at one end on all axes. */
static void draw_middle(random_source *r, asked *q, const double (*u)[3][3])
{
    const int end = random_int(r, 8);
    q->has_middle = random_int(r, 3);
    for (int a = 0; a < 3; a++) {
        const double lo = q->box.lo[a], hi = q->box.hi[a], at = u[random_below(r, q->of.mesh.count)][random_int(r, 3)][a];
        const double middle = nearest_middle(lo, hi);
        const double any[] = {lo, hi, middle, at, nextafter(at, hi), nextafterf((float)at, (float)hi), lo * 0.25 + hi * 0.75};
        const double drawn = any[end < 2 ? end : random_int(r, sizeof any / sizeof any[0])];
        q->middle[a] = drawn >= lo && drawn <= hi ? drawn : middle;
    }
}

/* As a soup, where they are floats, and as a mesh of any layout. */
static void check_forms(random_source *r, const tribox_box *box, const double (*u)[3][3], size_t count, bool are_floats,
                        bool is_ordinary)
{
    static asked q;
    const mesh_form form = mesh_form_draw(r, are_floats);
    if (box_is_empty(box))
        return;
    q.box = *box;
    q.of.mesh = laid_mesh_of(r, &form, u, count, (const int[3]){0, 1, 2}, fences);
    q.of.soup = streams_of_triangles(stream_fences, AT_END, u, count);
    draw_middle(r, &q, u);
    for (int is_mesh = !are_floats; is_mesh < 2; is_mesh++) {
        q.of.is_mesh = is_mesh;
        q.is_fast_known = !is_mesh && is_ordinary;
        check(r, &q, !random_int(r, 8));
    }
}

/* The scenes of floats, now and then with numbers that are not finite, then those of doubles. */
CASE(test_scenes)
{
    static scene_batch narrow;
    static batch_f64 batch;
    const size_t floats = scene_count();
    for (size_t i = 0; i < floats + scene_f64_count(); i++) {
        const scene *const of_floats = i < floats ? scene_at(i) : NULL;
        const char *const name = of_floats ? of_floats->name : scene_f64_at(i - floats)->name;
        random_source r = random_named(args.seed, name);
        for (int round = 0; round < (arguments_are_short(&args) ? 2 : 12); round++) {
            if (of_floats) {
                scene_draw_batch(of_floats, &r, &narrow);
                batch.box = narrow.box;
                for (int k = 0; k < 9 * SCENE_TRIANGLES; k++)
                    batch.u[k / 9][k / 3 % 3][k % 3] = narrow.u[k / 9][k / 3 % 3][k % 3];
                for (int k = 0; k < 9 && round % 4 == 3; k++)
                    batch.u[7 * k][k / 3][k % 3] = k % 2 ? NAN : k % 4 ? INFINITY : -INFINITY;
            } else
                scene_f64_at(i - floats)->draw(&r, &batch);
            snprintf(doing, sizeof doing, "%s of %s, seed %" PRIu64 ", round %d", name, of_floats ? "floats" : "doubles", args.seed,
                     round);
            check_forms(&r, &batch.box, (const double(*)[3][3])batch.u, 1 + random_below(&r, BATCH_F64), of_floats,
                        of_floats && strcmp(of_floats->family, "range") && strcmp(of_floats->family, "scales"));
        }
    }
}

/*
 * Small triangles, an edge of which grazes a corner of the box: what the sides of the box round off decides, and nothing else
 * does. In some boxes an upper bound is zero, next to which floats are so near each other that products of lengths vanish.
 */
CASE(test_grazing)
{
    static double u[TRIANGLES][3][3];
    random_source r = random_named(args.seed, "grazing");
    for (int round = 0; round < (arguments_are_short(&args) ? 40 : 200); round++) {
        tribox_box box;
        double size[3];
        for (int a = 0; a < 3; a++) {
            const bool is_at_zero = round % 4 == 0 && random_int(&r, 2);
            box.hi[a] = is_at_zero ? 0 : (float)(random_int_between(&r, -1000, 1000) / 999.0);
            box.lo[a] = (float)(box.hi[a] - random_int_between(&r, 500, 2000) / 999.0);
            size[a] = is_at_zero ? ldexp(1, -random_int_between(&r, 30, 80)) : 1 / 6400.0;
        }
        for (size_t i = 0; i < TRIANGLES; i++) {
            const double at = random_int(&r, 1000) / 1000.0;
            for (int a = 0; a < 3; a++) {
                const double along = random_int_between(&r, -99, 99) * size[a];
                const double corner = random_int(&r, 2) && box.hi[a] != 0 ? box.lo[a] : box.hi[a];
                u[i][0][a] = (float)(corner - at * along);
                u[i][1][a] = (float)(corner + (1 - at) * along);
                u[i][2][a] = (float)(corner + random_int_between(&r, -99, 99) * size[a]);
            }
        }
        check_forms(&r, &box, (const double(*)[3][3])u, TRIANGLES, true, round % 4);
    }
}

/* The nearest double to the middle, however large or small the bounds; middles that are not in the box; the empty box. */
CASE(test_middles)
{
    static const double bounds[][2] = {{-DBL_MAX, DBL_MAX}, {DBL_MAX, DBL_MAX},       {0x1.fffffffffffffp1022, DBL_MAX},
                                       {0, 0x1p-1074},      {0x1p-1074, 0x1.8p-1073}, {1, 1 + 0x1p-52},
                                       {-0x1p-1074, 0}};
    for (size_t n = 0; n < sizeof bounds / sizeof bounds[0]; n++) {
        const double lo = bounds[n][0], hi = bounds[n][1], middle = nearest_middle(lo, hi);
        const tribox_box box = {{lo, 0, 0}, {hi, 1, 1}};
        double at[3][3][3] = {{{0}}};
        for (int v = 0; v < 9; v++) {
            at[v / 3][v % 3][0] = v < 3 ? middle : v < 6 ? nextafter(middle, -INFINITY) : nextafter(middle, INFINITY);
            at[v / 3][v % 3][1] = at[v / 3][v % 3][2] = 0.25;
        }
        const tribox_mesh mesh = {.positions = at, .vertices = 9, .count = 3, .position_bytes = 8};
        uint8_t children[3];
        assert_int_equal(tribox_mesh_split(&mesh, NULL, 3, &box, NULL, NULL, children, NULL), TRIBOX_OK);
        assert_int_equal(children[0], 3);
        assert_int_equal(children[1], at[1][0][0] >= lo);
        assert_int_equal(children[2], at[2][0][0] <= hi ? 2 : 0);
        for (int side = 0; side < 2; side++) {
            const double beside[3] = {side ? nextafter(hi, INFINITY) : nextafter(lo, -INFINITY), 0, 0};
            tribox_report report = {9, 9};
            memset(children, 0x5a, 3);
            assert_int_equal(tribox_mesh_split(&mesh, NULL, 3, &box, beside, NULL, children, &report), TRIBOX_BAD_BOX);
            assert_int_equal(children[0] + children[1] + children[2] + (int)report.overlapping, 3 * 0x5a + 9);
            const tribox_box empty = {{0, 2, 0}, {1, 1, 1}};
            assert_int_equal(tribox_mesh_split(&mesh, NULL, 3, &empty, side ? (const double[3]){9} : NULL, NULL, children, &report),
                             TRIBOX_OK);
            assert_int_equal(children[0] + children[1] + children[2] + (int)report.overlapping, 0);
        }
    }
}

static int set_up(void)
{
    fences = laid_fences_make(args.seed);
    list_fence = guarded_make(LISTED_MOST * sizeof(uint32_t));
    stream_fences_make(TRIANGLES, stream_fences);
    bytes_fence = guarded_make(LISTED_MOST);
    return 0;
}

PROGRAM_AFTER(set_up, RUN(test_scenes), RUN(test_grazing), RUN(test_middles))
