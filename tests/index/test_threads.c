/* test_threads.c - threads that build an index in ranges, as one would; for the thread sanitizer. */
#include <pthread.h>

#include "common/harness.h"
#include "hostile.h"
#include "stored_mesh.h"

enum { COUNT = 40 * TRIBOX_INDEX_BLOCK + 77, THREADS = 6 };

static stored_soup stored;
static stored_mesh mesh;      /* of the same triangles, in double, in every other round */
static unsigned char *shared; /* an index that threads write */
static guarded fence;

static int make_all(void)
{
    stored = stored_soup_make(COUNT);
    mesh = stored_mesh_make(COUNT);
    fence = guarded_make(tribox_index_bytes(COUNT));
    return 0;
}

typedef struct worker {
    pthread_t thread;
    size_t first, count; /* of triangles to build over */
    tribox_options options;
    tribox_status status;
} worker;

static worker workers[THREADS];

static void run_all(void *(*work)(void *))
{
    for (int t = 0; t < THREADS; t++)
        assert_int_equal(pthread_create(&workers[t].thread, NULL, work, &workers[t]), 0);
    for (int t = 0; t < THREADS; t++) {
        assert_int_equal(pthread_join(workers[t].thread, NULL), 0);
        assert_int_equal(workers[t].status, TRIBOX_OK);
    }
}

static void *update(void *argument)
{
    worker *const w = argument;
    w->status = tribox_index_update(&stored.index, w->first, w->count, &w->options, shared);
    return NULL;
}

/* Blocks shared out among the threads: a range each, which may be empty but not of count 0, since that finishes the index. */
static void share_out(void)
{
    const size_t blocks = (COUNT + TRIBOX_INDEX_BLOCK - 1) / TRIBOX_INDEX_BLOCK;
    for (size_t t = 0; t < THREADS; t++) {
        const size_t first = blocks * t / THREADS * TRIBOX_INDEX_BLOCK, end = blocks * (t + 1) / THREADS * TRIBOX_INDEX_BLOCK;
        workers[t].first = first;
        workers[t].count = (end < COUNT ? end : COUNT) - first;
    }
}

static void draw(random_source *r, bool is_mesh)
{
    stored_soup_lay(&stored, COUNT, STORED_AT_END);
    draw_cells(r, &stored);
    spoil_soup(r, &stored, DIRT_ONE_IN_A_WORD);
    const mesh_layout layout = {.position_bytes = 8, .index_bytes = 4, .place = {1, {1e6 / 3, -7, 1e9}}};
    if (is_mesh)
        stored_mesh_lay(r, &mesh, &layout, &stored);
    shared = guarded_tail(fence, stored_index_bytes(&stored));
}

CASE(test_build)
{
    random_source r = random_named(args.seed, "build");
    for (int k = -1; k < kernels; k++) { /* -1: chosen by all threads at once */
        draw(&r, k % 2);
        share_out();
        for (int t = 0; t < THREADS; t++)
            workers[t].options = (tribox_options){.kernel = k < 0 ? NULL : names[(k + t) % kernels]};
        memset(shared, 0xff, stored_index_bytes(&stored));
        run_all(update);
        assert_int_equal(tribox_index_update(&stored.index, 0, 0, NULL, shared), TRIBOX_OK);
        stored_soup_build(&stored, names[0]);
        assert_memory_equal(shared, stored.nodes, stored_index_bytes(&stored));
    }
}

PROGRAM_AFTER(make_all, RUN(test_build))
