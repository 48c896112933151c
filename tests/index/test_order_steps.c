/*
 * test_order_steps.c - an order made step by step, by threads or one after the other, is the order of the single call, which takes
 * no more stack than the header says.
 */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>

#include "common/harness.h"
#include "common/thread_stack.h"
#include "order_kinds.h"
#include "tribox_threads.h"

enum { COUNT = 20000, PARTS = 8, SHARE = (COUNT + PARTS - 1) / PARTS };

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
    static uint32_t expected[COUNT];
    for (order_kind kind = 0; kind < ORDER_KINDS; kind++) {
        order_room room = order_room_make(&r, kind, COUNT);
        tribox_soup_sort(&room.soup, room.order, room.scratch);
        memcpy(expected, room.order, sizeof expected);
        memset(room.order, 0xff, sizeof expected);
        memset(room.scratch, 0xff, 16 * COUNT);
        task part[PARTS];
        for (size_t k = 0; k < PARTS; k++) {
            part[k] = (task){.room = &room, .first = k * SHARE, .count = k < PARTS - 1 ? SHARE : COUNT - k * SHARE};
            assert_int_equal(pthread_create(&part[k].thread, NULL, start, &part[k]), 0);
        }
        for (size_t k = 0; k < PARTS; k++)
            assert_int_equal(pthread_join(part[k].thread, NULL), 0);
        finish(&(task){.room = &room, .count = COUNT, .depth = 3});
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
    order_room room = order_room_make(&r, KIND_RANDOM, COUNT);
    const size_t taken = stack_of(order_all, &room);
    order_room_free(&room);
    if (taken > STATED)
        fail_msg("%zu bytes of stack, %d are stated", taken, STATED);
}

PROGRAM(RUN(test_threads), RUN(test_by_hand), RUN(test_stack))
