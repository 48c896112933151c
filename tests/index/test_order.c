/*
 * test_order.c - the order of a soup is what the header says, on every kernel; boxes and meshes have the order of the soup that
 * they are; doubles have as good a one wherever they are; no input takes much longer than others.
 */
#include <float.h>
#include <math.h>
#include <time.h>

#include "common/harness.h"
#include "dispatch.h"
#include "base/environment.h"
#include "order_kinds.h"
#include "order/sort_keys.h"
#include "tribox_threads.h"

static void order_by(const char *name, const order_room *room)
{
    const tribox_kernel *const kernel = tribox_kernel_find(name);
    const size_t count = room->soup.count;
    const tribox_sort_keys places = tribox_sort_keys_in(room->scratch, count, 0);
    const tribox_environment callers = tribox_environment_enter();
    kernel->nodes->find_middles(&room->soup, NULL, 0, count, 0, &places);
    tribox_sort_keys_finish(kernel, room->scratch, count, 0, count, room->order);
    tribox_environment_leave(callers);
}

static void check_kind(random_source *r, order_kind kind, size_t count)
{
    order_room room = order_room_make(r, kind, count);
    uint32_t *const expected = malloc(4 * count + 1), *const first = malloc(4 * count + 1);
    snprintf(doing, sizeof doing, "%zu triangles, %s", count, order_kind_names[kind]);
    assert_true(expected && first);
    expect_order(&room.soup, expected);
    assert_int_equal(tribox_soup_sort(&room.soup, room.order, room.scratch), TRIBOX_OK);
    memcpy(first, room.order, 4 * count);
    for (int k = 0; count && k < kernels; k++) {
        memset(room.order, 0xff, 4 * count);
        order_by(names[k], &room);
        if (memcmp(room.order, first, 4 * count))
            fail_msg("%s: kernel %s has another order", doing, names[k]);
    }
    sort_words(&room.soup, room.order);
    if (memcmp(room.order, expected, 4 * count))
        fail_msg("%s: not the words that there have to be", doing);
    free(expected);
    free(first);
    order_room_free(&room);
}

CASE(test_words)
{
    static const size_t counts[] = {0, 1, 2, 17, 63, 64, 65, 127, 128, 129, 200, 1023, 1100, 2047, 2049, 4095, 4096, 4097, 9000};
    random_source r = random_named(args.seed, "words");
    for (order_kind kind = 0; kind < ORDER_KINDS; kind++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
            check_kind(&r, kind, counts[c]);
}

/* About the next power of 64, and where more samples are drawn. */
CASE(test_large)
{
    random_source r = random_named(args.seed, "large");
    if (args.pairs >= 100000) /* not with --short */
        check_kind(&r, KIND_RANDOM, 262145);
    check_kind(&r, KIND_HALF_WILD, 100001);
    check_kind(&r, KIND_FEW_VALUES, 30000);
    check_kind(&r, KIND_ALL_SCALES, 30000);
}

CASE(test_boxes_and_meshes)
{
    random_source r = random_named(args.seed, "forms");
    for (order_kind kind = 0; kind < ORDER_KINDS; kind++) {
        const size_t count = (size_t)random_int_between(&r, 1, 1500);
        order_room room = order_room_make(&r, kind, count);
        float *const bounds = malloc(6 * 4 * count), *const positions = malloc(9 * 4 * count);
        uint32_t *const other = malloc(4 * count);
        assert_true(bounds && positions && other);
        tribox_boxes boxes = {.count = count};
        for (int a = 0; a < 3; a++) {
            float *const lo = bounds + 2 * (size_t)a * count, *const hi = lo + count;
            boxes.lo[a] = lo;
            boxes.hi[a] = hi;
            for (size_t i = 0; i < count; i++) {
                const float u = room.stream[3 * a][i], v = room.stream[3 * a + 1][i], w = room.stream[3 * a + 2][i];
                const bool is_finite = isfinite(u) && isfinite(v) && isfinite(w);
                lo[i] = is_finite ? fminf(fminf(u, v), w) : i % 2 ? NAN : 0;
                hi[i] = is_finite ? fmaxf(fmaxf(u, v), w) : i % 2 ? 0 : INFINITY;
                for (size_t v3 = 0; v3 < 3; v3++)
                    positions[9 * i + 3 * v3 + (size_t)a] = room.stream[3 * (size_t)a + v3][i];
            }
        }
        tribox_soup_sort(&room.soup, room.order, room.scratch);
        assert_int_equal(tribox_boxes_sort(&boxes, other, room.scratch), TRIBOX_OK);
        assert_memory_equal(other, room.order, 4 * count);
        const tribox_mesh mesh = {.positions = positions, .vertices = 3 * count, .count = count};
        memset(other, 0xff, 4 * count);
        assert_int_equal(tribox_mesh_sort(&mesh, other, room.scratch), TRIBOX_OK);
        assert_memory_equal(other, room.order, 4 * count);
        free(bounds);
        free(positions);
        free(other);
        order_room_free(&room);
    }
}

/* Small triangles all over a cube, in random order: nine numbers each. */
static void draw_cloud(random_source *r, size_t count, double (*u)[3][3])
{
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            const double middle = random_double(r, 0, 1000);
            for (int v = 0; v < 3; v++)
                u[i][v][a] = middle + random_double(r, -1, 1);
        }
}

static void sort_doubles(double (*u)[3][3], size_t count, uint32_t *order)
{
    static float scratch[4 * 20000];
    const tribox_mesh mesh = {.positions = u, .vertices = 3 * count, .count = count, .position_bytes = 8};
    uint32_t *const other = malloc(4 * count);
    assert_true(other && sizeof scratch >= 16 * count);
    assert_int_equal(tribox_mesh_sort(&mesh, order, scratch), TRIBOX_OK);
    const size_t part = count / 3;
    assert_int_equal(tribox_mesh_sort_start(&mesh, part, count - part, scratch), TRIBOX_OK);
    assert_int_equal(tribox_mesh_sort_start(&mesh, 0, part, scratch), TRIBOX_OK);
    assert_int_equal(tribox_sort_finish(scratch, count, 0, count, other), TRIBOX_OK);
    assert_memory_equal(other, order, 4 * count);
    free(other);
}

/* What an order is worth: the sum of the sides of its words, without the triangles that are far away. */
static double sides_of(double (*u)[3][3], size_t count, const uint32_t *order)
{
    double sum = 0;
    for (size_t first = 0; first < count; first += 64)
        for (int a = 0; a < 3; a++) {
            double lo = 1000, hi = 0;
            for (size_t i = first; i < count && i < first + 64; i++)
                for (int v = 0; v < 3 && fabs(u[order[i]][v][a]) < 1e6; v++) {
                    lo = fmin(lo, u[order[i]][v][a]);
                    hi = fmax(hi, u[order[i]][v][a]);
                }
            sum += hi > lo ? hi - lo : 0;
        }
    return sum;
}

/* Neither strays nor the unit of length make the order of doubles worse. Finite ones come before all others. */
CASE(test_doubles)
{
    enum { COUNT = 20000 };
    static const struct {
        size_t every;
        double place;
    } strays[] = {{COUNT, 1e12}, {COUNT, -1e300}, {5, 1e12}, {5, -1e40}, {7, DBL_MAX}};
    static double u[COUNT][3][3], scaled[COUNT][3][3];
    static uint32_t order[COUNT], other[COUNT];
    random_source r = random_named(args.seed, "doubles");
    draw_cloud(&r, COUNT, u);
    sort_doubles(u, COUNT, order);
    const double worth = sides_of(u, COUNT, order);
    for (int bits = -1000; bits <= 1000; bits += 125) {
        for (size_t k = 0; k < 9 * COUNT; k++)
            (&scaled[0][0][0])[k] = ldexp((&u[0][0][0])[k], bits);
        sort_doubles(scaled, COUNT, other);
        assert_memory_equal(order, other, sizeof order);
    }
    for (size_t s = 0; s < sizeof strays / sizeof *strays; s++) {
        memcpy(scaled, u, sizeof u);
        for (size_t i = 0; i < COUNT; i += strays[s].every)
            for (size_t k = 0; k < 9; k++)
                (&scaled[i][0][0])[k] = strays[s].place;
        sort_doubles(scaled, COUNT, other);
        if (!(sides_of(scaled, COUNT, other) < 2 * worth))
            fail_msg("1 of %zu triangles at %g: sides of words %g, without them %g", strays[s].every, strays[s].place,
                     sides_of(scaled, COUNT, other), worth);
    }
    double few[4][3][3] = {{{0}}};
    few[1][0][0] = -INFINITY;
    few[2][1][1] = 1e40;
    few[3][2][2] = -DBL_MAX;
    sort_doubles(few, 4, order);
    assert_int_equal(order[3], 1);
}

static double seconds_of(const order_room *room)
{
    double least = INFINITY;
    for (int turn = 0; turn < 3; turn++) {
        const clock_t start = clock();
        tribox_soup_sort(&room->soup, room->order, room->scratch);
        const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
        least = seconds < least ? seconds : least;
    }
    return least;
}

/* What is quadratic would take a thousand times as long. */
CASE(test_time)
{
    enum { COUNT = 60000, TIMES = 10 };
    random_source r = random_named(args.seed, "time");
    double random = 0;
    for (order_kind kind = 0; kind < ORDER_KINDS; kind++) {
        order_room room = order_room_make(&r, kind, COUNT);
        const double seconds = seconds_of(&room);
        order_room_free(&room);
        random = kind == KIND_RANDOM ? seconds : random;
        if (seconds > TIMES * random + 0.05)
            fail_msg("%s: %g s, but random ones %g s", order_kind_names[kind], seconds, random);
    }
}

PROGRAM(RUN(test_words), RUN(test_large), RUN(test_time), RUN(test_boxes_and_meshes), RUN(test_doubles))
