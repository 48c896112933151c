/* tile_runs.c - makes runs by threads that take blocks, and keeps them or puts them into files. */
#define _POSIX_C_SOURCE 200809L
#include "tile_runs.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "block_sort.h"
#include "console/crew.h"
#include "console/message.h"
#include "console/progress.h"
#include "voxelize/tile_work.h"

int tile_runs_start(tile_runs *r, const tribox_grid *grid, uint32_t tile, bool has_numbers, size_t count, uint64_t memory)
{
    const size_t tiles = tribox_tile_count(grid->size, tile);
    *r = (tile_runs){.grid = grid, .tile = tile, .tiles = tiles, .has_numbers = has_numbers, .memory = memory};
    r->runs = calloc(count ? count : 1, sizeof *r->runs);
    r->counts = calloc(r->tiles, sizeof *r->counts);
    r->work = calloc(r->tiles, sizeof *r->work);
    r->files = calloc(THREADS_MAX, sizeof *r->files);
    if (!r->runs || !r->counts || !r->work || !r->files)
        return message_failure("out of memory for the table of tiles");
    r->count = count;
    return EXIT_CODE_OK;
}

void tile_runs_free(tile_runs *r)
{
    for (size_t i = 0; i < r->count; i++)
        free(r->runs[i].room);
    for (int f = 0; r->files && f < THREADS_MAX; f++)
        run_file_close(&r->files[f]);
    free(r->files);
    free(r->runs);
    free(r->counts);
    free(r->work);
    *r = (tile_runs){.count = 0};
}

size_t tile_runs_block(const pieces *all, uint64_t memory, unsigned threads)
{
    enum { LEAST = 64, MOST = 1 << 18, BESIDE = 28 }; /* bytes of lists, entries and numbers a triangle */
    const uint64_t each = pieces_room(all) + 9 * all->read_bytes + BESIDE, block = memory / 4 / threads / each;
    return block < LEAST ? LEAST : block > MOST ? MOST : (size_t)block;
}

typedef enum trouble { TROUBLE_NONE, TROUBLE_MEMORY, TROUBLE_READ, TROUBLE_WRITE, TROUBLE_STATUS } trouble;

/* What the threads share. */
typedef struct sorting {
    tile_runs *runs;
    const pieces *all;
    folder_out *out;
    progress bar;
    pthread_mutex_t lock; /* of what follows */
    size_t next;          /* block */
    uint64_t kept;        /* bytes of runs in memory */
    tally found;
    trouble trouble; /* the first ends the work */
    int reason;      /* errno, or a status */
    const piece *unread;
} sorting;

static bool take_block(sorting *s, piece_block *block, size_t *number)
{
    pthread_mutex_lock(&s->lock);
    const bool is_left = s->next < s->all->blocks && !s->trouble;
    if (is_left)
        *block = pieces_block(s->all, *number = s->next++);
    pthread_mutex_unlock(&s->lock);
    return is_left;
}

static void fail(sorting *s, trouble what, int reason, const piece *unread)
{
    pthread_mutex_lock(&s->lock);
    if (!s->trouble) {
        s->trouble = what;
        s->reason = reason;
        s->unread = unread;
    }
    pthread_mutex_unlock(&s->lock);
}

static void add_run(tile_runs *r, const tile_run *run)
{
    const uint64_t beside = run->from ? TILE_WORK : 0;
    for (size_t i = 0; i < run->count; i++) {
        const partition_tile *const tile = &run->tiles[i];
        r->counts[tile->tile] += tile_run_count(run, i);
        r->work[tile->tile] += tile->work > beside ? tile->work - beside : 0;
    }
}

/* Takes the room over, or says that it has to go into a file. */
static bool keep(sorting *s, const block_sort *b, size_t number, const tally *found)
{
    tile_runs *const r = s->runs;
    const size_t bytes = b->run_bytes;
    pthread_mutex_lock(&s->lock);
    const bool is_kept = s->kept + bytes <= r->memory / 2;
    s->kept += is_kept ? bytes : 0;
    r->spilled += is_kept ? 0 : bytes;
    add_run(r, &b->run);
    r->runs[number] = b->run;
    tally_add(&s->found, found);
    progress_tell(&s->bar, (double)s->found.triangles / (double)s->all->triangles);
    pthread_mutex_unlock(&s->lock);
    return is_kept;
}

static void do_block(sorting *s, block_sort *b, const piece_block *block, size_t number, unsigned thread)
{
    if (!pieces_read(s->all, block, b->positions)) {
        fail(s, TROUBLE_READ, errno, block->from);
        return;
    }
    const tally found = tally_of_block(s->all, block, b->positions, true);
    const tribox_status status = block_sort_run(b, s->runs->grid, block, &found.bounds);
    if (status) {
        fail(s, status == MESSAGE_NO_MEMORY ? TROUBLE_MEMORY : TROUBLE_STATUS, (int)status, NULL);
    } else if (!keep(s, b, number, &found)) {
        tile_run *const run = &s->runs->runs[number];
        run->room = NULL;
        errno = 0;
        if (!run_file_put(&s->runs->files[thread], s->out, run))
            fail(s, TROUBLE_WRITE, errno, NULL);
        free(b->run.room);
    }
}

static void work(void *data, unsigned thread)
{
    sorting *const s = data;
    block_sort b;
    piece_block block;
    size_t number;
    if (!block_sort_open(&b, s->all, s->runs->grid, s->runs->tile, s->runs->has_numbers))
        fail(s, TROUBLE_MEMORY, 0, NULL);
    while (take_block(s, &block, &number))
        do_block(s, &b, &block, number, thread);
    block_sort_close(&b);
}

static int map_files(tile_runs *r, const folder_out *out)
{
    for (int f = 0; f < THREADS_MAX; f++)
        if (run_file_is_open(&r->files[f]) && !run_file_map(&r->files[f]))
            return message_failure("%s: cannot map what was written beside it", out->path);
    for (size_t i = 0; i < r->count; i++)
        if (r->runs[i].file)
            run_file_find(&r->runs[i]);
    return EXIT_CODE_OK;
}

static int tell(const sorting *s)
{
    switch (s->trouble) {
    case TROUBLE_NONE:
        return EXIT_CODE_OK;
    case TROUBLE_READ:
        return pieces_refuse(s->unread, s->reason);
    case TROUBLE_WRITE:
        return folder_out_failure(s->out, s->reason);
    case TROUBLE_STATUS:
        return message_status((tribox_status)s->reason);
    case TROUBLE_MEMORY:
        break;
    }
    return message_failure("out of memory to sort the triangles; give less with --memory, or fewer --threads");
}

int tile_runs_sort(tile_runs *r, const pieces *all, unsigned threads, bool is_quiet, folder_out *out, tally *found)
{
    sorting s = {.runs = r, .all = all, .out = out, .found = tally_of_none()};
    s.bar = progress_start_of("sorting", "triangles", (double)all->triangles, !is_quiet);
    pthread_mutex_init(&s.lock, NULL);
    crew_run(threads, work, &s);
    pthread_mutex_destroy(&s.lock);
    progress_end(&s.bar);
    *found = s.found;
    const int code = tell(&s);
    return code ? code : map_files(r, out);
}

void tile_runs_take(tile_runs *r, size_t number, const partition *p, uint64_t before)
{
    r->runs[number] = (tile_run){.tiles = p->tiles,
                                 .count = (size_t)p->header.records,
                                 .places = p->header.places,
                                 .triangles = p->triangles.bytes,
                                 .numbers = p->header.number_bytes ? p->numbers.bytes : NULL,
                                 .before = before,
                                 .position_bytes = p->header.position_bytes,
                                 .from = p};
    add_run(r, &r->runs[number]);
}
