/*
 * test_order.c - the order of a soup is what the header says, on every kernel, and made step by step, by threads or one after the
 * other; boxes and meshes have the order of the soup that they are; doubles have as good a one wherever they are; no input takes
 * much longer than others, nor more stack than the header says. And the key of a rank, by which it is cut, is that by sorting.
 */
#define _POSIX_C_SOURCE 200809L
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <time.h>

#include "base/bits.h"
#include "base/environment.h"
#include "common/harness.h"
#include "common/thread_stack.h"
#include "dispatch.h"
#include "order/sort_keys.h"
#include "order_kinds.h"
#include "scalar/vec_scalar.h"
#include "kernel/nodes/rank.h"
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

enum { STEPPED = 20000, PARTS = 8, SHARE = (STEPPED + PARTS - 1) / PARTS };

/* What a thread does: a part of the start, or all of a part from its cut on, handing on the second half. */
typedef struct task {
    pthread_t thread;
    const order_room *room;
    size_t first, count;
    int depth;
} task;

static void *start(void *argument)
{
    const task *const t = argument;
    assert_int_equal(tribox_soup_sort_start(&t->room->soup, t->first, t->count, t->room->scratch), TRIBOX_OK);
    return NULL;
}

static void *finish(void *argument)
{
    const task *const t = argument;
    const order_room *const room = t->room;
    const size_t total = room->soup.count;
    size_t before = 0;
    if (t->depth)
        assert_int_equal(tribox_sort_cut(room->scratch, total, t->first, t->count, &before), TRIBOX_OK);
    if (!before) {
        assert_int_equal(tribox_sort_finish(room->scratch, total, t->first, t->count, room->order), TRIBOX_OK);
        return NULL;
    }
    task one = {.room = room, .first = t->first, .count = before, .depth = t->depth - 1};
    task other = {.room = room, .first = t->first + before, .count = t->count - before, .depth = t->depth - 1};
    assert_int_equal(pthread_create(&other.thread, NULL, finish, &other), 0);
    finish(&one);
    assert_int_equal(pthread_join(other.thread, NULL), 0);
    return NULL;
}

CASE(test_threads)
{
    random_source r = random_named(args.seed, "threads");
    static uint32_t expected[STEPPED];
    for (order_kind kind = 0; kind < ORDER_KINDS; kind++) {
        order_room room = order_room_make(&r, kind, STEPPED);
        tribox_soup_sort(&room.soup, room.order, room.scratch);
        memcpy(expected, room.order, sizeof expected);
        memset(room.order, 0xff, sizeof expected);
        memset(room.scratch, 0xff, 16 * STEPPED);
        task part[PARTS];
        for (size_t k = 0; k < PARTS; k++) {
            part[k] = (task){.room = &room, .first = k * SHARE, .count = k < PARTS - 1 ? SHARE : STEPPED - k * SHARE};
            assert_int_equal(pthread_create(&part[k].thread, NULL, start, &part[k]), 0);
        }
        for (size_t k = 0; k < PARTS; k++)
            assert_int_equal(pthread_join(part[k].thread, NULL), 0);
        finish(&(task){.room = &room, .count = STEPPED, .depth = 3});
        assert_memory_equal(room.order, expected, sizeof expected);
        order_room_free(&room);
    }
}

/* Cut to the end by hand: of parts that are not cut any more, numbers are only written. */
static void cut_to_words(const order_room *room, size_t first, size_t count)
{
    size_t before = SIZE_MAX;
    assert_int_equal(tribox_sort_cut(room->scratch, room->soup.count, first, count, &before), TRIBOX_OK);
    assert_int_equal(before == 0, count <= 64);
    if (before) {
        assert_true(before < count && before % 64 == 0);
        cut_to_words(room, first + before, count - before);
        cut_to_words(room, first, before);
    } else
        assert_int_equal(tribox_sort_finish(room->scratch, room->soup.count, first, count, room->order), TRIBOX_OK);
}

CASE(test_by_hand)
{
    random_source r = random_named(args.seed, "by hand");
    uint32_t expected[4200];
    for (size_t count = 1; count <= 4200; count += 1 + (size_t)random_int(&r, 600)) {
        order_room room = order_room_make(&r, (order_kind)random_int(&r, ORDER_KINDS), count);
        tribox_soup_sort(&room.soup, room.order, room.scratch);
        memcpy(expected, room.order, 4 * count);
        memset(room.order, 0xff, 4 * count);
        for (size_t first = 0, part; first < count; first += part) {
            part = 1 + (size_t)random_int(&r, (int)(count - first));
            assert_int_equal(tribox_soup_sort_start(&room.soup, first, part, room.scratch), TRIBOX_OK);
        }
        cut_to_words(&room, 0, count);
        assert_memory_equal(room.order, expected, 4 * count);
        order_room_free(&room);
    }
}

static void *order_all(void *argument)
{
    const order_room *const room = argument;
    assert_int_equal(tribox_soup_sort(&room->soup, room->order, room->scratch), TRIBOX_OK);
    return NULL;
}

CASE(test_stack)
{
    enum { STATED = 64 * 1024 };
    if (!is_ordinary_build())
        skip();
    random_source r = random_named(args.seed, "stack");
    order_room room = order_room_make(&r, KIND_RANDOM, STEPPED);
    const size_t taken = stack_of(order_all, &room);
    order_room_free(&room);
    if (taken > STATED)
        fail_msg("%zu bytes of stack, %d are stated", taken, STATED);
}

enum { MOST = 3000 };

static float middles[MOST];
static uint32_t numbers[MOST];

static int by_image(const void *one, const void *other)
{
    const uint64_t a = *(const uint64_t *)one, b = *(const uint64_t *)other;
    return a < b ? -1 : a > b;
}

static void demand_key(place_key key, uint64_t expected) { assert_int_equal(image_of_key(key), expected); }

/* By counting bits, which no input is likely to need; samples find it however many keys there are. */
CASE(test_ranks)
{
    random_source r = random_named(args.seed, "ranks");
    static uint64_t images[MOST];
    for (int round = 0; round < 300; round++) {
        const size_t count = 1 + (size_t)random_int(&r, round % 2 ? 100 : MOST);
        for (size_t i = 0; i < count; i++) {
            middles[i] = round % 3 ? (float)random_int_between(&r, -5, 5) : (float)random_double(&r, -1, 1);
            middles[i] = random_int(&r, 20) ? middles[i] : INFINITY;
            numbers[i] = (uint32_t)(count - i) * (round % 5 ? 1 : UINT32_MAX / MOST); /* from 2^31 on, too */
            images[i] = image_of_key((place_key){middles[i], numbers[i]});
        }
        qsort(images, count, sizeof *images, by_image);
        for (size_t k = 0; k < 5; k++) {
            const size_t rank = k < 2 ? k * (count - 1) : (size_t)random_int(&r, (int)count);
            demand_key(rank_by_bits(middles, numbers, count, rank), images[rank]);
            demand_key(key_of_rank(middles, numbers, count, rank), images[rank]);
        }
    }
}

/* Of random keys and of ordered ones, as many as limits and lists just hold, and so many that few are left in limits. */
static void check_samples(random_source *r, size_t count, bool is_ordered)
{
    float *const many = malloc(count * sizeof *many);
    uint32_t *const number = malloc(count * sizeof *number);
    assert_true(many && number);
    for (size_t i = 0; i < count; i++) {
        many[i] = is_ordered ? (float)i : (float)random_double(r, -1, 1);
        number[i] = (uint32_t)i;
    }
    for (size_t rank = count / 8; rank < count; rank += count / 3) {
        key_list list;
        place_key key;
        assert_true(find_by_samples(many, number, count, rank, &list, &key));
        demand_key(rank_by_bits(many, number, count, rank), image_of_key(key));
    }
    free(many);
    free(number);
}

CASE(test_samples)
{
    random_source r = random_named(args.seed, "samples");
    const size_t most = args.pairs >= 10000000 ? 10000000 : 3000000; /* more with --long */
    for (int is_ordered = 0; is_ordered < 2; is_ordered++) {
        check_samples(&r, most, is_ordered);
        for (size_t count = 18000; count < 30000; count += 1000)
            check_samples(&r, count, is_ordered);
    }
}

PROGRAM(RUN(test_words), RUN(test_large), RUN(test_time), RUN(test_boxes_and_meshes), RUN(test_doubles), RUN(test_threads),
        RUN(test_by_hand), RUN(test_stack), RUN(test_ranks), RUN(test_samples))
