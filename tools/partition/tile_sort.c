/* tile_sort.c - threads take blocks of triangles, look at them, ask the library for their tiles, and gather them by tile. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/progress.h"
#include "tile_runs.h"
#include "voxelize/tile_work.h"
#include "write/part.h"

enum { NUMBERS = 9 };

size_t tile_runs_block(const pieces *all, uint64_t memory, unsigned threads)
{
    enum { LEAST = 64, MOST = 1 << 18, BESIDE = 28 }; /* bytes of lists, entries and numbers a triangle */
    const uint64_t each = pieces_room(all) + 9 * all->read_bytes + BESIDE, block = memory / 4 / threads / each;
    return block < LEAST ? LEAST : block > MOST ? MOST : (size_t)block;
}

static tally tally_of_none(void)
{
    return (tally){.bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}},
                   .first_not_finite = UINT64_MAX,
                   .fits_float = true};
}

static double least(double a, double b) { return a < b ? a : b; }
static double most(double a, double b) { return a > b ? a : b; }

static void add_tally(tally *to, const tally *from)
{
    for (int a = 0; a < 3; a++) {
        to->bounds.lo[a] = fmin(to->bounds.lo[a], from->bounds.lo[a]);
        to->bounds.hi[a] = fmax(to->bounds.hi[a], from->bounds.hi[a]);
    }
    to->triangles += from->triangles;
    to->not_finite += from->not_finite;
    to->first_not_finite = from->first_not_finite < to->first_not_finite ? from->first_not_finite : to->first_not_finite;
    mesh_sums_add(&to->sums, &from->sums, 0); /* numbered through */
    to->fits_float &= from->fits_float;
}

/* Returns whether it is finite. */
static bool add_triangle(tally *t, uint64_t number, const double u[NUMBERS])
{
    double zero = 0; /* or NaN */
    for (int k = 0; k < NUMBERS; k++)
        zero += 0 * u[k];
    if (!(zero == 0)) {
        t->not_finite++;
        t->first_not_finite = number < t->first_not_finite ? number : t->first_not_finite;
        return false;
    }
    for (int a = 0; a < 3; a++) {
        t->bounds.lo[a] = least(t->bounds.lo[a], least(least(u[a], u[3 + a]), u[6 + a]));
        t->bounds.hi[a] = most(t->bounds.hi[a], most(most(u[a], u[3 + a]), u[6 + a]));
    }
    return true;
}

static bool fits(const double u[NUMBERS])
{
    bool is_float = true;
    for (int k = 0; k < NUMBERS; k++)
        is_float &= float_fit_of(u[k]) == FLOAT_FIT_EXACT;
    return is_float;
}

static tally tally_of_block(const pieces *all, const piece_block *block, const void *positions, bool has_sums)
{
    tally t = tally_of_none();
    for (size_t i = 0; i < block->count; i++) {
        double u[NUMBERS];
        pieces_triangle(all, positions, i, u);
        if (add_triangle(&t, block->number + i, u) && has_sums)
            mesh_sums_add(&t.sums, &(mesh_sums){part_triangle_checksum(u), 0}, block->number + i);
        t.fits_float &= all->write_bytes != sizeof(double) || fits(u);
    }
    t.triangles = block->count;
    return t;
}

/* What the threads share. */
typedef struct sorting {
    tile_runs *runs; /* NULL: triangles are only looked at */
    const pieces *all;
    folder_out *out;
    progress bar;
    pthread_mutex_t lock; /* of what follows */
    size_t next;          /* block */
    uint64_t kept;        /* bytes of runs in memory */
    tally found;
    int code; /* of the first failure, which ends the work */
} sorting;

/* What a thread works on. */
typedef struct block_sort {
    sorting *s;
    void *positions; /* of the block, nine numbers a triangle */
    size_t *starts;  /* of the lists of the tiles that the block may be in */
    uint32_t *list;  /* as long as was needed until now */
    size_t list_room;
    uint32_t *share;  /* of each triangle: in how many tiles it is, then its work in each */
    tile_run run;     /* the last */
    size_t run_bytes; /* of its room */
} block_sort;

typedef enum trouble { TROUBLE_MEMORY, TROUBLE_READ, TROUBLE_WRITE, TROUBLE_STATUS } trouble;

/* Says it where it is the first. reason: errno, or a status. */
static void fail(sorting *s, trouble what, int reason, const piece *unread)
{
    pthread_mutex_lock(&s->lock);
    if (!s->code) {
        progress_end(&s->bar);
        s->code = what == TROUBLE_READ     ? pieces_refuse(unread, reason)
                  : what == TROUBLE_WRITE  ? folder_out_failure(s->out, reason)
                  : what == TROUBLE_STATUS ? message_status((tribox_status)reason)
                  : s->runs ? message_failure("out of memory to sort the triangles; give less with --memory, or fewer --threads")
                            : message_failure("out of memory to read the mesh");
    }
    pthread_mutex_unlock(&s->lock);
}

static bool take_block(sorting *s, piece_block *block, size_t *number)
{
    pthread_mutex_lock(&s->lock);
    const bool is_left = s->next < s->all->blocks && !s->code;
    if (is_left)
        *block = pieces_block(s->all, *number = s->next++);
    pthread_mutex_unlock(&s->lock);
    return is_left;
}

/* The layers of tiles along z that bounds may be in, with one to spare on both sides. */
static void find_layers(const tribox_grid *grid, uint32_t side, const tribox_box *bounds, double layer[2])
{
    const double end = ceil((double)grid->size[2] / side) - 1, length = grid->cell[2] * side;
    layer[0] = fmin(fmax(floor((bounds->lo[2] - grid->origin[2]) / length) - 1, 0), end);
    layer[1] = fmin(fmax(floor((bounds->hi[2] - grid->origin[2]) / length) + 1, 0), end);
}

/* The tiles that a block may be in: fewer than all are cleared and looked through. */
static tribox_tiles find_tiles(const tile_runs *r, const tribox_box *bounds)
{
    const size_t layer = tribox_tile_count((const uint32_t[3]){r->grid->size[0], r->grid->size[1], 1}, r->tile);
    double layers[2];
    if (bounds->lo[0] > bounds->hi[0])
        return (tribox_tiles){r->tile, 0, 0};
    find_layers(r->grid, r->tile, bounds, layers);
    return (tribox_tiles){r->tile, (size_t)layers[0] * layer, (size_t)(layers[1] - layers[0] + 1) * layer};
}

static bool grow_list(block_sort *b, size_t needed)
{
    if (needed <= b->list_room)
        return true;
    free(b->list);
    b->list_room = needed + needed / 8;
    b->list = malloc(b->list_room * sizeof *b->list);
    return b->list;
}

static tribox_status list_tiles(block_sort *b, size_t count, const tribox_tiles *tiles)
{
    const tribox_options exact = {.accuracy = TRIBOX_EXACT};
    const tribox_mesh triangles = {
        .positions = b->positions, .vertices = 3 * count, .count = count, .position_bytes = b->s->all->write_bytes};
    const tribox_grid *const grid = b->s->runs->grid;
    b->starts[0] = 0;
    if (!tiles->count)
        return TRIBOX_OK;
    const tribox_status status = tribox_mesh_tile_lists(&triangles, grid, tiles, &exact, b->starts, NULL);
    if (status)
        return status;
    if (!grow_list(b, b->starts[tiles->count]))
        return MESSAGE_NO_MEMORY;
    return tribox_mesh_tile_lists(&triangles, grid, tiles, &exact, b->starts, b->list);
}

static void share_work(const block_sort *b, size_t count, size_t places)
{
    memset(b->share, 0, count * sizeof *b->share);
    for (size_t p = 0; p < places; p++)
        b->share[b->list[p]]++;
    for (size_t t = 0; t < count; t++)
        if (b->share[t]) {
            double u[NUMBERS];
            pieces_triangle(b->s->all, b->positions, t, u);
            b->share[t] = (uint32_t)tile_work_of(b->s->runs->grid, b->s->runs->tile, u, b->share[t]);
        }
}

/* Returns where the next go. */
static unsigned char *gather(const block_sort *b, size_t from, size_t to, unsigned char *at, uint64_t *work)
{
    const size_t bytes = NUMBERS * b->s->all->write_bytes;
    const unsigned char *const positions = b->positions;
    *work = 0;
    for (size_t p = from; p < to; p++) {
        const size_t t = b->list[p];
        if (bytes == sizeof(float[NUMBERS])) /* of a length that the compiler knows */
            memcpy(at, positions + t * sizeof(float[NUMBERS]), sizeof(float[NUMBERS]));
        else
            memcpy(at, positions + t * sizeof(double[NUMBERS]), sizeof(double[NUMBERS]));
        *work += b->share[t];
        at += bytes;
    }
    return at;
}

static tribox_status make_run(block_sort *b, const tribox_tiles *tiles, uint64_t first)
{
    size_t filled = 0, r = 0;
    const size_t places = b->starts[tiles->count];
    for (size_t i = 0; i < tiles->count; i++)
        filled += b->starts[i] < b->starts[i + 1];
    const size_t bytes = filled * sizeof(partition_tile) + places * NUMBERS * b->s->all->write_bytes;
    b->run_bytes = bytes + (b->s->runs->has_numbers ? places * sizeof(uint32_t) : 0);
    unsigned char *const room = malloc(b->run_bytes ? b->run_bytes : 1);
    if (!room)
        return MESSAGE_NO_MEMORY;
    partition_tile *const records = (void *)room;
    uint32_t *const numbers = b->s->runs->has_numbers ? (void *)(room + bytes) : NULL;
    unsigned char *at = room + filled * sizeof *records;
    b->run = (tile_run){.tiles = records,
                        .count = filled,
                        .places = places,
                        .triangles = at,
                        .numbers = numbers,
                        .position_bytes = b->s->all->write_bytes,
                        .room = room};
    for (size_t i = 0; i < tiles->count; i++)
        if (b->starts[i] < b->starts[i + 1]) {
            records[r] = (partition_tile){.tile = tiles->first + i, .first = b->starts[i]};
            at = gather(b, b->starts[i], b->starts[i + 1], at, &records[r++].work);
        }
    for (size_t p = 0; numbers && p < places; p++)
        numbers[p] = (uint32_t)(first + b->list[p]);
    return TRIBOX_OK;
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

/* Whether the run stays in memory. */
static bool keep(sorting *s, const block_sort *b, size_t number, const tally *found)
{
    tile_runs *const r = s->runs;
    pthread_mutex_lock(&s->lock);
    const bool is_kept = r && s->kept + b->run_bytes <= r->memory / 2;
    if (r) {
        s->kept += is_kept ? b->run_bytes : 0;
        r->spilled += is_kept ? 0 : b->run_bytes;
        add_run(r, &b->run);
        r->runs[number] = b->run;
    }
    add_tally(&s->found, found);
    if (!s->code)
        progress_tell(&s->bar, (double)s->found.triangles / (double)s->all->triangles);
    pthread_mutex_unlock(&s->lock);
    return is_kept;
}

static void do_block(block_sort *b, const piece_block *block, size_t number, unsigned thread)
{
    sorting *const s = b->s;
    if (!pieces_read(s->all, block, b->positions)) {
        fail(s, TROUBLE_READ, errno, block->from);
        return;
    }
    const tally found = tally_of_block(s->all, block, b->positions, s->runs);
    tribox_status status = TRIBOX_OK;
    if (s->runs) {
        const tribox_tiles tiles = find_tiles(s->runs, &found.bounds);
        status = list_tiles(b, block->count, &tiles);
        if (!status)
            share_work(b, block->count, b->starts[tiles.count]);
        if (!status)
            status = make_run(b, &tiles, block->number);
    }
    if (status) {
        fail(s, status == MESSAGE_NO_MEMORY ? TROUBLE_MEMORY : TROUBLE_STATUS, (int)status, NULL);
    } else if (!keep(s, b, number, &found) && s->runs) {
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
    piece_block block;
    size_t number;
    block_sort b = {.s = s, .positions = malloc(s->all->block * pieces_room(s->all))};
    if (s->runs) {
        b.share = malloc(s->all->block * sizeof *b.share);
        b.starts = malloc((s->runs->tiles + 1) * sizeof *b.starts);
    }
    if (!b.positions || (s->runs && (!b.share || !b.starts)))
        fail(s, TROUBLE_MEMORY, 0, NULL);
    while (take_block(s, &block, &number))
        do_block(&b, &block, number, thread);
    free(b.positions);
    free(b.starts);
    free(b.list);
    free(b.share);
}

static int map_files(tile_runs *r, const folder_out *out)
{
    for (int f = 0; f < THREADS_MAX; f++)
        if (!run_file_map(&r->files[f]))
            return message_failure("%s: cannot map what was written beside it", out->path);
    for (size_t i = 0; i < r->count; i++)
        if (r->runs[i].file)
            run_file_find(&r->runs[i]);
    return EXIT_CODE_OK;
}

static int run(sorting *s, const char *what, unsigned threads, bool is_quiet, tally *found)
{
    s->found = tally_of_none();
    s->bar = progress_start_of(what, "triangles", (double)s->all->triangles, !is_quiet);
    pthread_mutex_init(&s->lock, NULL);
    crew_run(threads, work, s);
    pthread_mutex_destroy(&s->lock);
    progress_end(&s->bar);
    *found = s->found;
    return s->code;
}

int tile_sort_look(const pieces *all, unsigned threads, bool is_quiet, tally *found)
{
    return run(&(sorting){.all = all}, "reading", threads, is_quiet, found);
}

int tile_sort(tile_runs *r, const pieces *all, unsigned threads, bool is_quiet, folder_out *out, tally *found)
{
    const int code = run(&(sorting){.runs = r, .all = all, .out = out}, "sorting", threads, is_quiet, found);
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
