/* taken_cells.c - each thread sets cells of its own, of the triangles that it has read. */
#define _POSIX_C_SOURCE 200809L
#include "taken_cells.h"

#include "console/clock.h"
#include "console/crew.h"
#include "console/pages.h"
#include "voxelize_ways.h"

/* Of several threads together: those for each of which a thread takes less time to start than to put them together. */
enum { JOINED_WORDS = 1 << 18 };

static bool begin(void *data, const tribox_box *bounds, size_t triangles)
{
    taken_cells *const t = data;
    if (grid_choose_around(&t->r->from.choice, NULL, bounds, &t->grid) || !voxelize_is_small(t->r, &t->grid, triangles))
        return false;
    t->triangles = triangles;
    t->words.count = voxels_layer_words(&t->grid) * t->grid.size[2];
    if (t->words.count <= OWN_WORDS_BYTES / sizeof *t->words.all)
        t->words.all = pages_take(t->words.count * sizeof *t->words.all);
    t->bar = progress_start("voxelizing", !t->r->result.is_quiet);
    return t->words.all;
}

static void add_block(taken_cells *t, size_t triangles, tribox_report found)
{
    pthread_mutex_lock(&t->lock);
    t->done += triangles;
    t->report.overlapping += found.overlapping;
    t->report.undecided += found.undecided;
    progress_tell(&t->bar, (double)t->done / (double)t->triangles);
    pthread_mutex_unlock(&t->lock);
}

/* Cells of the other threads are counted when they are put together. */
static bool take(void *data, unsigned thread, const tribox_mesh *block)
{
    taken_cells *const t = data;
    const double start = clock_seconds();
    tribox_report found = {0, 0};
    uint64_t *const words = own_words_of(&t->words, thread);
    const bool is_taken = words && !tribox_mesh_voxelize(block, &t->grid, NULL, &t->r->test, words, &found);
    t->seconds[thread] += clock_seconds() - start;
    if (thread)
        found.overlapping = 0;
    if (is_taken)
        add_block(t, block->count, found);
    return is_taken;
}

static void drop(void *data)
{
    taken_cells *const t = data;
    progress_end(&t->bar);
    own_words_free(&t->words);
    pages_free(t->words.all, t->words.count * sizeof *t->words.all);
    t->words = (own_words){.all = NULL};
}

/* Where all triangles are asked about all cells the time is not that of reading, and threads share it better when all is read. */
static bool asks_boxes(const tribox_options *options) { return !options->axes || options->axes & TRIBOX_AXES_BOX; }

bool taken_cells_start(const voxelize_request *r, taken_cells *t, mesh_taker *taker)
{
    *t = (taken_cells){.r = r};
    *taker = (mesh_taker){.begin = begin, .take = take, .drop = drop, .data = t};
    pthread_mutex_init(&t->lock, NULL);
    const bool needs_mesh = r->fill == FILL_PARITY || r->fill == FILL_MIDDLES;
    return !needs_mesh && !r->is_thin && !r->has_colours && asks_boxes(&r->test);
}

static void join(void *data, size_t strip)
{
    taken_cells *const t = data;
    add_block(t, 0, (tribox_report){.overlapping = own_words_join(&t->words, strip)});
}

uint64_t *taken_cells_end(taken_cells *t, voxelize_answer *a)
{
    const double start = clock_seconds();
    unsigned others = 0;
    a->seconds = t->seconds[0];
    for (unsigned n = 1; n < THREADS_MAX; n++) {
        others += t->words.own[n] != NULL;
        a->seconds = t->seconds[n] > a->seconds ? t->seconds[n] : a->seconds;
    }
    const size_t gaining = 1 + others * t->words.count / JOINED_WORDS;
    if (others)
        crew_each(gaining < others ? (unsigned)gaining : others, own_words_strips(&t->words), join, t);
    a->seconds += clock_seconds() - start;
    a->report = t->report;
    progress_end(&t->bar);
    return t->words.all;
}

void taken_cells_free(taken_cells *t)
{
    drop(t);
    pthread_mutex_destroy(&t->lock);
}
