/*
 * test_fences.c - no function reads beside its input or changes it, or writes beside its output: each array lies between pages
 * that cannot be touched, those of the input in memory that cannot be written, and a byte past where it would be aligned if it may
 * lie anywhere. And threads that ask at once, all of one input, get what one alone gets.
 */
#ifndef __wasm__
#include <pthread.h>
#endif

#include "calls.h"
#include "common/harness.h"

static asked a;
static outputs out, blank, expected;

/* Arrays: their bytes, 0 where these depend on the call, and the pointers to them, to which 0 is added. */
#define AT(member) offsetof(asked, member)
#define AT3(member) AT(member[0]), AT(member[1]), AT(member[2])
static const struct {
    bool is_input, is_anywhere;
    size_t bytes, at[16];
} rows[] = {
    {true, true, COUNT * sizeof(float), {AT3(the_soup.x), AT3(the_soup.y), AT3(the_soup.z), AT3(the_boxes.lo), AT3(the_boxes.hi)}},
    {true, true, 3 * COUNT * sizeof(uint32_t), {AT(the_mesh.indices)}},
    {true, true, NODES, {AT(the_soup_index.nodes), AT(the_mesh_index.nodes)}},
    {true, false, COUNT * sizeof(uint32_t), {AT(the_mesh_index.ids), AT(order_in)}},
    {true, false, 9 * sizeof(float), {AT(triangle)}},
    {true, false, 3 * sizeof(double), {AT(origin)}},
    {true, false, 3 * sizeof(uint32_t), {AT(size)}},
    {true, false, (TILES + 1) * sizeof(size_t), {AT(starts_in)}},
    {true, false, ROWS * sizeof(uint64_t), {AT(surface)}},
    {true, false, 2 * sizeof(uint64_t), {AT(mask_in)}},
    {true, false, ROWS * sizeof(uint32_t), {AT(side_a), AT(side_b)}},
    {true, true, 0, {AT(the_mesh.positions)}},
    {true, false, 0, {AT(list_in), AT(outside)}},
    {false, true, COUNT * sizeof(float), {AT3(to), AT(to[3]), AT(to[4]), AT(to[5]), AT(to[6]), AT(to[7]), AT(to[8])}},
    {false, false, ROWS * sizeof(uint32_t), {AT3(face), AT(face[3]), AT(face[4]), AT(face[5])}},
    {false, false, 2 * sizeof(uint64_t), {AT(mask), AT(inside), AT(bits_out)}},
    {false, false, ROWS * sizeof(uint64_t), {AT(occupied), AT(solid)}},
    {false, false, sizeof(tribox_report), {AT(report)}},
    {false, false, sizeof(size_t), {AT(found), AT(odd_rows)}},
    {false, false, COUNT * sizeof(uint32_t), {AT(list), AT(order)}},
    {false, false, CELLS * sizeof(uint32_t), {AT(ids)}},
    {false, false, sizeof(uint32_t), {AT(label_count)}},
    {false, false, 2 * ROWS * sizeof(uint32_t), {AT(parents)}},
    {false, true, NODES, {AT(nodes)}},
    {false, false, 0, {AT(start), AT(places), AT(listed), AT(runs)}},
    {false, true, 0, {AT(scratch)}},
};

/* The same, one by one. */
static struct place {
    bool is_input, is_anywhere;
    size_t bytes, at;
    guarded fence;
} places[80];
static size_t place_count;

static void list_places(void)
{
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++)
        for (const size_t *at = rows[r].at; *at; at++)
            places[place_count++] =
                (struct place){rows[r].is_input, rows[r].is_anywhere, rows[r].bytes, *at, guarded_make(sizeof(outputs))};
}

static void **pointer(const struct place *p) { return (void **)(void *)((char *)&a + p->at); }

static size_t longest_list(void)
{
    size_t longest = 0;
    for (int t = 0; t < TILES; t++)
        longest = a.tile_starts[t + 1] - a.tile_starts[t] > longest ? a.tile_starts[t + 1] - a.tile_starts[t] : longest;
    return longest;
}

/* How many bytes a place has in a call. */
static size_t bytes_of(const call *c, const struct place *p)
{
    const size_t at = p->at;
    if (p->bytes)
        return p->bytes;
    if (at == AT(the_mesh.positions))
        return 9 * COUNT * (a.the_mesh.position_bytes == 8 ? 8 : 4);
    if (at == AT(list_in) || at == AT(listed))
        return a.tile_starts[TILES] * sizeof(uint32_t);
    if (at == AT(outside))
        return (a.out->labels + 63) / 64 * sizeof(uint64_t);
    if (at == AT(runs))
        return (tribox_fill_labels_bytes(a.the_grid.size) + 7) / 8 * 8; /* aligned as before */
    if (at == AT(places) || at == AT(start))
        return sizeof(size_t) * (call_takes(c, "uncounted") ? CELLS + 1u
                                 : call_takes(c, "boxes")   ? COUNT + 1u
                                 : call_takes(c, "range")   ? TILES
                                                            : TILES + 1u);
    return call_takes(c, "ids_sink")     ? tribox_bricks_ids_bytes(TILE)
           : call_takes(c, "lists_sink") ? tribox_bricks_lists_bytes(TILE, longest_list())
           : call_takes(c, "sink")       ? tribox_bricks_bytes(TILE)
           : call_takes(c, "sorted")     ? KEYS
                                         : tribox_fill_bytes(a.the_grid.size);
}

/* At the end of their pages, or at the start. */
static void ask_in_fences(const call *c, bool is_at_end)
{
    const asked before = a;
    snprintf(doing, sizeof doing, "%s %s between pages", c->function, c->about);
    for (struct place *p = places; p < places + place_count; p++) {
        const size_t bytes = bytes_of(c, p);
        guarded_read_only(p->fence, false);
        void *const to = is_at_end ? guarded_tail(p->fence, bytes) : p->fence.first + (p->is_anywhere && !call_takes(c, "sorted"));
        memcpy(to, *pointer(p), bytes);
        guarded_read_only(p->fence, p->is_input);
        *pointer(p) = to;
    }
    const asked fenced = a;
    assert_int_equal(c->ask(&fenced), TRIBOX_OK);
    a = before;
    for (const struct place *p = places; p < places + place_count; p++)
        if (!p->is_input && (p->at != AT(scratch) || call_takes(c, "sorted")))
            memcpy(*pointer(p), *(void *const *)(const void *)((const char *)&fenced + p->at), bytes_of(c, p));
}

CASE(test_fences)
{
    list_places();
    for (int k = 0; k < 4; k++) {
        ask_rightly(k / 2 ? 8 : 4, &a, &out);
        outputs_prepare(&a, 0, &blank);
        for (const call *c = calls; c < calls + call_count; c++)
            for (int are_few = 0; are_few <= call_takes(c, "range"); are_few++) { /* the last, of which no packet is full */
                a.first = are_few ? COUNT - 3 : 0, a.count = COUNT - a.first;
                memcpy(&out, &blank, sizeof out);
                assert_int_equal(c->ask(&a), TRIBOX_OK);
                memcpy(&expected, &out, sizeof out);
                memcpy(&out, &blank, sizeof out);
                ask_in_fences(c, k % 2);
                if (outputs_differ(&out, &expected, call_takes(c, "sorted") ? COMPARED : offsetof(outputs, scratch)))
                    fail_msg("%s: another answer", doing);
            }
    }
}

#ifndef __wasm__
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

CASE(test_threads)
{
    enum { THREADS = 6 };
    static worker workers[THREADS], alone;
    for (unsigned bytes = 4; bytes <= 8; bytes += 4) {
        ask_rightly(bytes, &a, &out);
        for (int t = -1; t < THREADS; t++) {
            worker *const w = t < 0 ? &alone : &workers[t];
            w->a = a;
            ask_into(&w->a, &w->out);
            w->a.sink = &w->a.the_sink, w->a.ids_sink = &w->a.the_ids_sink, w->a.lists_sink = &w->a.the_lists_sink;
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

PROGRAM(RUN(test_fences), RUN(test_threads))
#else
PROGRAM(RUN(test_fences))
#endif
