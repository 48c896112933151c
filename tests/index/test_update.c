/*
 * test_update.c - an index that is brought up to date, in one range or in many, is byte for byte the one that is built; and every
 * kernel builds the same bytes.
 */
#include <pthread.h>

#include "common/harness.h"
#include "common/fences.h"
#include "hostile.h"

enum { COUNT_MAX = 64 * TRIBOX_INDEX_BLOCK + 100, PAIRS = 100000, ROUNDS = 36, MANY = 40 * TRIBOX_INDEX_BLOCK + 77, THREADS = 6 };

static guarded fence;         /* of the index that is updated */
static unsigned char *shared; /* an index that threads write */

static int make_all(void)
{
    stored_make(COUNT_MAX);
    fence = guarded_make(tribox_index_bytes(COUNT_MAX) + STORED_SHIFTS);
    stored_mesh_make(COUNT_MAX);
    return 0;
}

static tribox_options any_kernel(random_source *r) { return (tribox_options){.kernel = names[random_int(r, kernels)]}; }

/* A soup or a mesh. */
static void draw(random_source *r, size_t count) { draw_stored_form(r, soup_kind_at(random_below(r, soup_kind_count())), count); }

/* Other triangles in a range: finite ones, and some that are not. */
static void change(random_source *r, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++) {
        for (int k = 0; k < STORED_STREAMS; k++)
            stored.stream[k][i] = random_sign_of_zero(r, (float)random_int_between(r, -60, 60));
        if (random_int(r, 50) == 0)
            spoil_triangle(r, i);
    }
    if (stored.index.mesh)
        stored_mesh_write(first, count);
}

/* A copy of the index as it is now, to be updated. */
static fenced copied(void)
{
    const fenced copy = fenced_place(fence, stored_index_bytes(), AT_END);
    memcpy(copy.at, stored.nodes, copy.bytes);
    return copy;
}

static void update(const fenced *index, size_t first, size_t count, const tribox_options *options)
{
    snprintf(doing, sizeof doing, "tribox_index_update: triangles %zu and %zu more of %zu, kernel %s", first, count,
             stored.soup.count, options->kernel);
    const tribox_status status = tribox_index_update(&stored.index, first, count, options, index->at);
    if (status)
        fail_msg("%s: %s", doing, tribox_status_text(status));
    assert_nothing_beside(index);
}

static void demand_as_built(const fenced *index, const char *kernel)
{
    stored_build(kernel);
    if (memcmp(index->at, stored.nodes, index->bytes))
        fail_msg("%s: not the bytes of a build", doing);
}

/* Every byte is written, whatever stood there, and by every kernel alike; an update of the whole soup is a build. */
CASE(test_kernels)
{
    static const size_t counts[] = {0, 1, 3, 63, 64, 65, 100, 4095, 4096, 4097, 5000, 70000};
    random_source r = random_named(args.seed, "kernels");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw(&r, counts[round % (sizeof counts / sizeof counts[0])]);
        const fenced index = fenced_place(fence, stored_index_bytes(), round % 2 ? AT_END : (int)(round % STORED_SHIFTS));
        for (int k = 0; k < kernels; k++) {
            memset(index.at, 0x5a + k, index.bytes);
            snprintf(doing, sizeof doing, "tribox_index_build: %zu triangles, kernel %s", stored.soup.count, names[k]);
            const tribox_options options = {.kernel = names[k]};
            assert_int_equal(tribox_index_build(&stored.index, &options, index.at), TRIBOX_OK);
            assert_nothing_beside(&index);
            demand_as_built(&index, names[0]);
            memset(index.at, 0x5a + k, index.bytes);
            update(&index, 0, stored.soup.count, &options);
            demand_as_built(&index, names[0]);
        }
    }
}

/* Every range of a short soup. */
CASE(test_every_range)
{
    enum { COUNT = 150 };
    random_source r = random_named(args.seed, "every range");
    draw(&r, COUNT);
    for (size_t first = 0; first <= COUNT; first++)
        for (size_t count = 0; count <= COUNT - first; count++) {
            const tribox_options options = any_kernel(&r);
            stored_build(options.kernel);
            const fenced index = copied();
            change(&r, first, count);
            update(&index, first, count, &options);
            demand_as_built(&index, names[0]);
        }
}

/* A place where a word, a node or the soup begins or ends, or one beside it. */
static size_t draw_place(random_source *r, size_t count)
{
    const size_t place = random_below(r, count + 1), unit = random_int(r, 2) ? 64 : TRIBOX_INDEX_BLOCK;
    const size_t near = random_int(r, 3) ? place / unit * unit : place;
    if (random_int(r, 6) == 0)
        return count;
    return near && random_int(r, 4) == 0 ? near - 1 : near;
}

/*
 * Ranges of long soups. Those of whole blocks leave the upper nodes to a call of count 0, unless they are the whole soup.
 */
static void check_range(random_source *r)
{
    const size_t count = stored.soup.count, one = draw_place(r, count), other = draw_place(r, count);
    const size_t first = one < other ? one : other, end = one < other ? other : one;
    const tribox_options options = any_kernel(r);
    stored_build(options.kernel);
    const fenced index = copied();
    change(r, first, end - first);
    update(&index, first, end - first, &options);
    const bool is_whole_blocks = first % TRIBOX_INDEX_BLOCK == 0 && (end % TRIBOX_INDEX_BLOCK == 0 || end == count);
    if (is_whole_blocks && end - first < count)
        update(&index, 0, 0, &options);
    demand_as_built(&index, names[0]);
}

CASE(test_ranges)
{
    static const size_t counts[] = {4096, 4097, 8191, 8192, 3 * 4096 + 17, 5 * 4096 + 64};
    random_source r = random_named(args.seed, "ranges");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw(&r, counts[round % (sizeof counts / sizeof counts[0])]);
        for (int k = 0; k < 5; k++)
            check_range(&r);
    }
}

/* Three levels, and blocks of them in any order over memory that was never an index. */
CASE(test_blocks)
{
    random_source r = random_named(args.seed, "blocks");
    draw(&r, COUNT_MAX);
    const size_t blocks = (COUNT_MAX + TRIBOX_INDEX_BLOCK - 1) / TRIBOX_INDEX_BLOCK;
    size_t *const order = malloc(blocks * sizeof *order);
    assert_non_null(order);
    for (size_t b = 0; b < blocks; b++) {
        const size_t k = random_below(&r, b + 1);
        order[b] = order[k];
        order[k] = b;
    }
    const fenced index = fenced_place(fence, stored_index_bytes(), AT_END);
    for (size_t b = 0; b < blocks; b++) {
        const size_t first = order[b] * TRIBOX_INDEX_BLOCK, left = COUNT_MAX - first;
        const tribox_options options = any_kernel(&r);
        update(&index, first, left < TRIBOX_INDEX_BLOCK ? left : TRIBOX_INDEX_BLOCK, &options);
    }
    const tribox_options options = any_kernel(&r);
    update(&index, random_below(&r, COUNT_MAX), 0, &options);
    demand_as_built(&index, names[0]);
    check_range(&r);
    check_range(&r);
    free(order);
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

static void *update_range(void *argument)
{
    worker *const w = argument;
    w->status = tribox_index_update(&stored.index, w->first, w->count, &w->options, shared);
    return NULL;
}

/* Blocks shared out among the threads: a range each, which may be empty but not of count 0, since that finishes the index. */
static void share_out(void)
{
    const size_t blocks = (MANY + TRIBOX_INDEX_BLOCK - 1) / TRIBOX_INDEX_BLOCK;
    for (size_t t = 0; t < THREADS; t++) {
        const size_t first = blocks * t / THREADS * TRIBOX_INDEX_BLOCK, end = blocks * (t + 1) / THREADS * TRIBOX_INDEX_BLOCK;
        workers[t].first = first;
        workers[t].count = (end < MANY ? end : MANY) - first;
    }
}

/* In every other round as a mesh of doubles. */
static void draw_many(random_source *r, bool is_mesh)
{
    stored_soup_lay(MANY, STORED_AT_END);
    draw_cells(r);
    spoil_soup(r, DIRT_ONE_IN_A_WORD);
    const mesh_layout layout = {.form = {.position_bytes = 8, .index_bytes = 4}, .place = {1, {1e6 / 3, -7, 1e9}}};
    if (is_mesh)
        stored_mesh_lay(r, &layout);
    shared = guarded_tail(fence, stored_index_bytes());
}

/* Threads that build an index in ranges, as one would; for the thread sanitizer. */
CASE(test_threads)
{
    random_source r = random_named(args.seed, "build");
    for (int k = -1; k < kernels; k++) { /* -1: chosen by all threads at once */
        draw_many(&r, k % 2);
        share_out();
        for (int t = 0; t < THREADS; t++)
            workers[t].options = (tribox_options){.kernel = k < 0 ? NULL : names[(k + t) % kernels]};
        memset(shared, 0xff, stored_index_bytes());
        run_all(update_range);
        assert_int_equal(tribox_index_update(&stored.index, 0, 0, NULL, shared), TRIBOX_OK);
        stored_build(names[0]);
        assert_memory_equal(shared, stored.nodes, stored_index_bytes());
    }
}

PROGRAM_AFTER(make_all, RUN(test_kernels), RUN(test_every_range), RUN(test_ranges), RUN(test_blocks), RUN(test_threads))
