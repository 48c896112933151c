/*
 * test_fences.c - no function reads beside its input or changes it, or writes beside its output: each array lies between pages that
 * cannot be touched, those of the input in memory that cannot be written. And threads that ask at once, all of one input, get what one
 * alone gets.
 */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "calls.h"
#include "common/guard.h"

static asked a;
static outputs out, blank, expected;

/* Arrays: the pointer to each, and its bytes; first the inputs. */
#define AT(member, bytes) \
    { \
        offsetof(asked, member), bytes \
    }
#define STREAM(member) AT(member, COUNT * sizeof(float))
#define STREAMS(member) STREAM(member[0]), STREAM(member[1]), STREAM(member[2])
#define FACE(n) AT(face[n], ROWS * sizeof(uint32_t))
static const struct place {
    size_t at, bytes;
} places[] = {
    STREAMS(the_soup.x),
    STREAMS(the_soup.y),
    STREAMS(the_soup.z),
    STREAMS(the_boxes.lo),
    STREAMS(the_boxes.hi),
    AT(the_mesh.positions, 0), /* of either width */
    AT(the_mesh.indices, 3 * COUNT * sizeof(uint32_t)),
    AT(the_soup_index.nodes, NODES),
    AT(the_mesh_index.nodes, NODES),
    AT(the_mesh_index.ids, COUNT * sizeof(uint32_t)),
    AT(triangle, 9 * sizeof(float)),
    AT(origin, 3 * sizeof(double)),
    AT(size, 3 * sizeof(uint32_t)),
    AT(order_in, COUNT * sizeof(uint32_t)),
    AT(starts_in, (TILES + 1) * sizeof(size_t)),
    AT(list_in, 0), /* as long as the last start says */
    AT(surface, ROWS * sizeof(uint64_t)),
    AT(mask_in, 2 * sizeof(uint64_t)),
    AT(outside, 0), /* a bit for each label */
    AT(side_a, ROWS * sizeof(uint32_t)),
    AT(side_b, ROWS * sizeof(uint32_t)),
    STREAMS(to),
    STREAM(to[3]),
    STREAM(to[4]),
    STREAM(to[5]),
    STREAM(to[6]),
    STREAM(to[7]),
    STREAM(to[8]),
    FACE(0),
    FACE(1),
    FACE(2),
    FACE(3),
    FACE(4),
    FACE(5),
    AT(mask, 2 * sizeof(uint64_t)),
    AT(inside, 2 * sizeof(uint64_t)),
    AT(bits_out, 2 * sizeof(uint64_t)),
    AT(occupied, ROWS * sizeof(uint64_t)),
    AT(solid, ROWS * sizeof(uint64_t)),
    AT(report, sizeof(tribox_report)),
    AT(found, sizeof(size_t)),
    AT(odd_rows, sizeof(size_t)),
    AT(start, 0), /* of tiles, cells or boxes */
    AT(places, 0),
    AT(list, COUNT * sizeof(uint32_t)),
    AT(order, COUNT * sizeof(uint32_t)),
    AT(ids, CELLS * sizeof(uint32_t)),
    AT(listed, 0),
    AT(label_count, sizeof(uint32_t)),
    AT(parents, 2 * ROWS * sizeof(uint32_t)),
    AT(nodes, NODES),
    AT(scratch, 0),
    AT(runs, 0),
};
enum { INPUTS = 31, PLACES = sizeof places / sizeof places[0] };

static void **pointer(size_t n) { return (void **)(void *)((char *)&a + places[n].at); }

/* How many bytes a place has in a call. */
static size_t bytes_of(const call *c, size_t n)
{
    const size_t at = places[n].at;
    if (places[n].bytes)
        return places[n].bytes;
    if (at == offsetof(asked, the_mesh.positions))
        return 9 * COUNT * (a.the_mesh.position_bytes == 8 ? 8 : 4);
    if (at == offsetof(asked, list_in) || at == offsetof(asked, listed))
        return a.tile_starts[TILES] * sizeof(uint32_t);
    if (at == offsetof(asked, outside))
        return (a.out->labels + 63) / 64 * sizeof(uint64_t);
    if (at == offsetof(asked, runs))
        return tribox_fill_labels_bytes(a.the_grid.size);
    if (at == offsetof(asked, places) || at == offsetof(asked, start))
        return sizeof(size_t) * (call_takes(c, "uncounted") ? CELLS + 1u
                                 : call_takes(c, "boxes")   ? COUNT + 1u
                                 : call_takes(c, "range")   ? TILES
                                                            : TILES + 1u);
    return call_takes(c, "ids_sink") ? tribox_bricks_ids_bytes(TILE)
           : call_takes(c, "sink")   ? tribox_bricks_bytes(TILE)
           : call_takes(c, "sorted") ? KEYS
                                     : tribox_fill_bytes(a.the_grid.size);
}

/* At the end of their pages, or at the start. Scratch is where it is aligned as the caller's. */
static void ask_in_fences(const call *c, bool is_at_end)
{
    static guarded fences[PLACES];
    void *from[PLACES];
    const asked before = a;
    snprintf(doing, sizeof doing, "%s %s between pages", c->function, c->about);
    for (size_t n = 0; n < PLACES; n++) {
        const size_t bytes = bytes_of(c, n);
        fences[n] = fences[n].first ? fences[n] : guarded_make(sizeof(outputs));
        from[n] = *pointer(n);
        guarded_read_only(fences[n], false);
        void *const to = is_at_end ? guarded_tail(fences[n], bytes) : fences[n].first;
        memcpy(to, from[n], bytes);
        guarded_read_only(fences[n], n < INPUTS);
        *pointer(n) = to;
    }
    const tribox_status status = c->ask(&a);
    assert_int_equal(status, TRIBOX_OK);
    for (size_t n = INPUTS; n < PLACES; n++)
        if (places[n].at != offsetof(asked, scratch) || call_takes(c, "sorted"))
            memcpy(from[n], *pointer(n), bytes_of(c, n));
    a = before;
}

static void test_fences(void **state)
{
    (void)state;
    catch_faults();
    for (int k = 0; k < 4; k++) {
        ask_rightly(k / 2 ? 8 : 4, &a, &out);
        outputs_prepare(&a, 0, &blank);
        for (const call *c = calls; c < calls + call_count; c++) {
            memcpy(&out, &blank, sizeof out);
            assert_int_equal(c->ask(&a), TRIBOX_OK);
            memcpy(&expected, &out, sizeof out);
            memcpy(&out, &blank, sizeof out);
            ask_in_fences(c, k % 2);
            if (memcmp(&out, &expected, call_takes(c, "sorted") ? COMPARED : offsetof(outputs, scratch)))
                fail_msg("%s: another answer", doing);
        }
    }
}

typedef struct worker {
    pthread_t thread;
    asked a;
    outputs out;
} worker;

static void *work(void *own)
{
    worker *const w = own;
    for (size_t n = 0; n < call_count; n++)
        calls[n].ask(&w->a);
    return NULL;
}

static void test_threads(void **state)
{
    enum { THREADS = 6 };
    static worker workers[THREADS], alone;
    (void)state;
    for (unsigned bytes = 4; bytes <= 8; bytes += 4) {
        ask_rightly(bytes, &a, &out);
        for (int t = -1; t < THREADS; t++) {
            worker *const w = t < 0 ? &alone : &workers[t];
            w->a = a;
            ask_into(&w->a, &w->out);
            w->a.sink = &w->a.the_sink, w->a.ids_sink = &w->a.the_ids_sink;
            w->a.x = w->a.to, w->a.y = w->a.to + 3, w->a.z = w->a.to + 6;
            outputs_prepare(&a, 0, &w->out);
        }
        for (int t = 0; t < THREADS; t++)
            assert_int_equal(pthread_create(&workers[t].thread, NULL, work, &workers[t]), 0);
        work(&alone);
        for (int t = 0; t < THREADS; t++) {
            assert_int_equal(pthread_join(workers[t].thread, NULL), 0);
            assert_memory_equal(&workers[t].out, &alone.out, offsetof(outputs, scratch));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fences), cmocka_unit_test(test_threads)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
