/*
 * tile_sort.c - threads take blocks of triangles, look at them, ask the library for their tiles, and make a run of each, which
 * stays in memory as long as there is some and then goes into a nameless file. Then they take a few tiles at a time and copy what
 * each run has of them to its place in a file; the index comes last.
 */
#define _POSIX_C_SOURCE 200809L
#include "tile_sort.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/progress.h"
#include "files/files.h"
#include "voxelize/tile_set.h"
#include "write/part.h"

enum { NUMBERS = 9 };

/* ------------------------------------------------------------------------------------------------------------------------- runs */

/* Of one thread. The tiles are apart, as they are looked at over and over: pages of a map among triangles would be dear. */
typedef struct run_file {
    FILE *tiles, *rest; /* rest: triangles of a run, then their numbers; NULL: there is no file yet */
    uint64_t tiles_written, rest_written;
    file_map map; /* of the tiles */
} run_file;

/* Triangles as they are in a partition: by rising tile, those of a tile in the order of the mesh. */
typedef struct tile_run {
    tile_list list;                 /* whose work is without what a tile costs by itself, and whose checksum is not set */
    const unsigned char *triangles; /* NULL in a file */
    const uint32_t *numbers;        /* of these triangles; NULL where there are none, and in a file */
    uint64_t before;                /* what is added to them */
    unsigned position_bytes;
    const partition_piece *from; /* NULL, or a partition whose run this is, with work and checksums as there */
    void *room;                  /* NULL, or what the list and triangles lie in */
    const run_file *file;        /* NULL, or where the list is */
    uint64_t tiles_at;
    FILE *of_triangles, *of_numbers; /* NULL, or the files, and where in them */
    uint64_t triangles_at, numbers_at;
} tile_run;

struct tile_runs {
    const tribox_grid *grid;
    uint32_t tile; /* cells along a side */
    size_t tiles;  /* of the grid; 0 for partitions, which have the list */
    bool has_numbers;
    uint64_t memory; /* bytes that runs, and what it takes to make and to write them, may take */
    tile_run *runs;
    size_t count;
    uint64_t *counts; /* triangles of each tile */
    uint64_t *work;   /* of each tile, without what it costs by itself */
    run_file *files;  /* one for each thread */
    uint64_t spilled; /* bytes */
    tile_list list;   /* of all runs, where checksums go */
};

static tile_runs *make_runs(const tile_runs *like)
{
    tile_runs *const r = malloc(sizeof *r);
    if (r) {
        *r = *like;
        r->runs = calloc(r->count + 1, sizeof *r->runs);
        r->counts = calloc(r->tiles + 1, sizeof *r->counts);
        r->work = calloc(r->tiles + 1, sizeof *r->work);
        r->files = calloc(THREADS_MAX, sizeof *r->files);
    }
    if (r && r->runs && r->counts && r->work && r->files)
        return r;
    tile_runs_free(r);
    return message_failure("out of memory for the table of tiles"), NULL;
}

tile_runs *tile_runs_make(const tribox_grid *grid, uint32_t tile, bool has_numbers, size_t count, uint64_t memory)
{
    return make_runs(&(tile_runs){.grid = grid,
                                  .tile = tile,
                                  .tiles = tribox_tile_count(grid->size, tile),
                                  .has_numbers = has_numbers,
                                  .count = count,
                                  .memory = memory});
}

tile_runs *tile_runs_of_partition(const partition *p, uint64_t memory)
{
    uint64_t before = 0;
    tile_runs *const r = make_runs(&(tile_runs){.count = p->count, .memory = memory, .list = p->list});
    for (size_t i = 0; r && i < p->count; before += p->pieces[i++].header.triangles)
        r->runs[i] = (tile_run){.list = p->pieces[i].list,
                                .before = before,
                                .position_bytes = p->pieces[i].header.position_bytes,
                                .from = &p->pieces[i],
                                .of_triangles = p->pieces[i].files[PARTITION_TRIANGLES],
                                .of_numbers = p->pieces[i].files[PARTITION_NUMBERS]};
    return r;
}

void tile_runs_free(tile_runs *r)
{
    if (!r)
        return;
    for (size_t i = 0; r->runs && i < r->count; i++)
        free(r->runs[i].room);
    for (int f = 0; r->files && f < THREADS_MAX; f++) {
        file_map_close(&r->files[f].map);
        if (r->files[f].rest)
            fclose(r->files[f].rest);
        if (r->files[f].tiles)
            fclose(r->files[f].tiles);
    }
    if (r->tiles)
        free(r->list.tiles);
    free(r->files);
    free(r->runs);
    free(r->counts);
    free(r->work);
    free(r);
}

static void add_run(tile_runs *r, size_t number, const tile_run *run)
{
    r->runs[number] = *run;
    for (size_t i = 0; i < run->list.count; i++) {
        const partition_tile *const tile = &run->list.tiles[i];
        r->counts[tile->tile] += tile_list_triangles(&run->list, i);
        r->work[tile->tile] += tile->work;
    }
}

/* Once all are there. */
static int lay_list(tile_runs *r)
{
    size_t filled = 0;
    for (size_t t = 0; t < r->tiles; t++)
        filled += r->counts[t] != 0;
    r->list.tiles = malloc((filled + 1) * sizeof *r->list.tiles);
    if (!r->list.tiles)
        return message_failure("out of memory for the table of tiles");
    for (size_t t = 0; t < r->tiles; t++)
        if (r->counts[t])
            r->list.tiles[r->list.count++] = (partition_tile){.tile = t, .first = r->counts[t], .work = TILE_WORK + r->work[t]};
    return tile_list_lay(&r->list);
}

static FILE *open_stream(const folder_out *out)
{
    FILE *const stream = folder_out_spill(out);
    if (stream)
        setvbuf(stream, NULL, _IONBF, 0);
    return stream;
}

/* Puts a run into the file, which is made in the folder if it is not there yet. False with errno. */
static bool put_run(run_file *file, const folder_out *out, tile_run *run)
{
    const size_t places = (size_t)run->list.places, tiles = run->list.count * sizeof *run->list.tiles;
    const size_t triangles = places * NUMBERS * run->position_bytes, numbers = run->numbers ? places * sizeof *run->numbers : 0;
    if (!file->tiles)
        file->tiles = open_stream(out);
    if (file->tiles && !file->rest)
        file->rest = open_stream(out);
    if (!file->rest)
        return false;
    errno = 0;
    run->file = file;
    run->tiles_at = file->tiles_written;
    run->of_triangles = run->of_numbers = file->rest;
    run->triangles_at = file->rest_written;
    run->numbers_at = run->triangles_at + triangles;
    file->tiles_written += tiles;
    file->rest_written += triangles + numbers;
    return fwrite(run->list.tiles, 1, tiles, file->tiles) == tiles &&
           fwrite(run->triangles, 1, triangles, file->rest) == triangles &&
           (!numbers || fwrite(run->numbers, 1, numbers, file->rest) == numbers);
}

/* Once all are there. The room that a run had has gone. */
static int map_files(tile_runs *r, const folder_out *out)
{
    for (int f = 0; f < THREADS_MAX; f++)
        if (r->files[f].rest && !file_map_of_stream(&r->files[f].map, r->files[f].tiles))
            return message_failure("%s: out of memory to map what was written beside it", out->path);
    for (size_t i = 0; i < r->count; i++)
        if (r->runs[i].file) {
            r->runs[i].list.tiles = (void *)((unsigned char *)r->runs[i].file->map.bytes + r->runs[i].tiles_at);
            r->runs[i].triangles = NULL;
            r->runs[i].numbers = NULL;
        }
    return EXIT_CODE_OK;
}

/* ---------------------------------------------------------------------------------------------------------------------- sorting */

size_t tile_sort_block(const pieces *all, uint64_t memory, unsigned threads)
{
    enum { LEAST = 64, MOST = 1 << 18, BESIDE = 28 }; /* bytes of lists, entries and numbers a triangle */
    const uint64_t each = pieces_room(all) + 9 * all->read_bytes + BESIDE, block = memory / 4 / threads / each;
    return block < LEAST ? LEAST : block > MOST ? MOST : (size_t)block;
}

static void add_tally(tally *to, const tally *from)
{
    triangles_seen_add(&from->seen, &to->seen);
    to->triangles += from->triangles;
    mesh_sums_add(&to->sums, &from->sums, 0); /* numbered through */
    to->fits_float &= from->fits_float;
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
    tally t = {.triangles = block->count, .seen = no_triangles_seen, .fits_float = true};
    for (size_t i = 0; i < block->count; i++) {
        double u[NUMBERS];
        pieces_triangle(all, positions, i, u);
        if (triangles_see(block->number + i, u, &t.seen) && has_sums)
            mesh_sums_add(&t.sums, &(mesh_sums){part_triangle_checksum(u), 0}, block->number + i);
        t.fits_float &= all->write_bytes != sizeof(double) || fits(u);
    }
    return t;
}

/* What the threads share. */
typedef struct sorting {
    tile_runs *runs; /* NULL: triangles are only looked at */
    const pieces *all;
    folder_out *out;
    progress bar;
    size_t threads;              /* that have begun */
    atomic_uint_fast64_t in_use; /* bytes of runs in memory */
    tally found;
} sorting;

typedef enum trouble { NO_TROUBLE, TROUBLE_MEMORY, TROUBLE_READ, TROUBLE_WRITE, TROUBLE_STATUS } trouble;

/* What a thread works on. */
typedef struct block_sort {
    sorting *s;
    run_file *file;  /* for runs that memory does not hold */
    void *positions; /* of the block, nine numbers a triangle */
    size_t *starts;  /* of the lists of the tiles that the block may be in */
    uint32_t *list;  /* as long as was needed until now */
    size_t list_room;
    uint32_t *share;  /* of each triangle: in how many tiles it is, then its work in each */
    tile_run run;     /* the last */
    size_t run_bytes; /* of its room */
    piece_block block;
    tally found;
    int reason; /* of a trouble: errno, or a status */
} block_sort;

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
    b->run = (tile_run){.list = {records, filled, places},
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

/* Into a file if it is not to stay in memory. */
static bool place_run(block_sort *b)
{
    sorting *const s = b->s;
    if (atomic_fetch_add(&s->in_use, b->run_bytes) + b->run_bytes <= s->runs->memory / 2)
        return true;
    atomic_fetch_sub(&s->in_use, b->run_bytes);
    return put_run(b->file, s->out, &b->run);
}

static int sort_block(void *data, void *place, size_t n)
{
    const sorting *const s = data;
    block_sort *const b = place;
    b->block = pieces_block(s->all, n);
    if (!pieces_read(s->all, &b->block, b->positions))
        return b->reason = errno, TROUBLE_READ;
    b->found = tally_of_block(s->all, &b->block, b->positions, s->runs);
    if (!s->runs)
        return NO_TROUBLE;
    const tribox_tiles tiles = find_tiles(s->runs, &b->found.seen.bounds);
    tribox_status status = list_tiles(b, b->block.count, &tiles);
    if (!status)
        share_work(b, b->block.count, b->starts[tiles.count]);
    if (!status)
        status = make_run(b, &tiles, b->block.number);
    if (status)
        return b->reason = (int)status, status == MESSAGE_NO_MEMORY ? TROUBLE_MEMORY : TROUBLE_STATUS;
    return place_run(b) ? NO_TROUBLE : (b->reason = errno, TROUBLE_WRITE);
}

static int lack_memory(const sorting *s)
{
    return s->runs ? message_failure("out of memory to sort the triangles; give less with --memory, or fewer --threads")
                   : message_failure("out of memory to read the mesh");
}

static int tell_trouble(void *data, void *place, int code)
{
    sorting *const s = data;
    const block_sort *const b = place;
    progress_end(&s->bar);
    return code == TROUBLE_READ     ? pieces_refuse(b->block.from, b->reason)
           : code == TROUBLE_WRITE  ? folder_out_failure(s->out, b->reason)
           : code == TROUBLE_STATUS ? message_status((tribox_status)b->reason)
                                    : lack_memory(s);
}

static int tell_block(void *data, void *place, size_t n)
{
    sorting *const s = data;
    block_sort *const b = place;
    if (s->runs)
        add_run(s->runs, n, &b->run);
    if (b->run.file) {
        s->runs->spilled += b->run_bytes;
        s->runs->runs[n].room = NULL;
        free(b->run.room);
    }
    b->run.room = NULL;
    add_tally(&s->found, &b->found);
    progress_tell(&s->bar, (double)s->found.triangles / (double)s->all->triangles);
    return EXIT_CODE_OK;
}

static void free_block(void *place)
{
    block_sort *const b = place;
    free(b->positions);
    free(b->starts);
    free(b->list);
    free(b->share);
    free(b->run.room);
}

static bool make_block(void *data, void *place)
{
    sorting *const s = data;
    block_sort *const b = place;
    b->s = s;
    b->positions = malloc(s->all->block * pieces_room(s->all));
    if (s->runs) {
        b->file = &s->runs->files[s->threads++];
        b->share = malloc(s->all->block * sizeof *b->share);
        b->starts = malloc((s->runs->tiles + 1) * sizeof *b->starts);
    }
    return b->positions && (!s->runs || (b->share && b->starts));
}

static int walk_blocks(sorting *s, const char *what, unsigned threads, tally *found)
{
    const crew_work work = {.count = s->all->blocks,
                            .threads = threads,
                            .place_bytes = sizeof(block_sort),
                            .begin = make_block,
                            .end = free_block,
                            .step = sort_block,
                            .tell = tell_block,
                            .refuse = tell_trouble};
    s->found = (tally){.seen = no_triangles_seen, .fits_float = true};
    s->bar = progress_start_of(what, "triangles", (double)s->all->triangles);
    const int code = crew_do(&work, s);
    progress_end(&s->bar);
    *found = s->found;
    return code == (int)MESSAGE_NO_MEMORY ? lack_memory(s) : code;
}

int tile_sort_look(const pieces *all, unsigned threads, tally *found)
{
    return walk_blocks(&(sorting){.all = all}, "reading", threads, found);
}

int tile_sort(tile_runs *r, const pieces *all, unsigned threads, folder_out *out, tally *found)
{
    int code = walk_blocks(&(sorting){.runs = r, .all = all, .out = out}, "sorting", threads, found);
    if (!code)
        code = map_files(r, out);
    return code ? code : lay_list(r);
}

/* ---------------------------------------------------------------------------------------------------------------------- writing */

/* What the threads share. */
typedef struct writing {
    folder_out *out;
    const tile_runs *runs;
    const partition_header *header;
    tile_list list;        /* that of the runs: checksums are set */
    size_t triangle_bytes; /* in the file */
    size_t room;           /* triangles that a thread has in memory, an even number */
    progress bar;
    size_t next;   /* record */
    uint64_t done; /* triangles */
} writing;

/* What a thread has of some tiles: of all of them, or so much of one that does not fit into the room. */
typedef struct window {
    writing *w;
    size_t from, to;                  /* records */
    uint64_t start, end;              /* places in the file */
    unsigned char *bytes, *read;      /* read: for those of a run in a file */
    uint32_t *numbers, *numbers_read; /* the same of numbers; NULL without */
    uint64_t *at;                     /* where the next triangle of each record goes */
    const partition_piece *damaged;   /* NULL, or whose tiles are not what was written */
} window;

static bool find_records(void *data, void *place, size_t n)
{
    writing *const w = data;
    window *const v = place;
    (void)n;
    v->from = v->to = w->next;
    while (v->to < w->list.count &&
           (v->to == v->from || tile_list_start(&w->list, v->to + 1) - tile_list_start(&w->list, v->from) <= w->room))
        v->to++;
    w->next = v->to;
    return v->from < v->to;
}

static bool read_at(FILE *stream, uint64_t at, size_t size, void *to)
{
    size_t got;
    errno = 0;
    return named_file_read_at(stream, at, to, size, &got) && got == size;
}

/* Some triangles of a run and, where they have some, their numbers. */
typedef struct brought {
    uint64_t first;
    const unsigned char *triangles;
    const uint32_t *numbers;
} brought;

/* They are read if they are in a file. */
static bool bring(const window *v, const tile_run *run, uint64_t first, size_t count, brought *b)
{
    const size_t bytes = NUMBERS * run->position_bytes, number = sizeof *v->numbers;
    if (run->triangles) {
        *b = (brought){first, run->triangles + first * bytes, v->numbers ? run->numbers + first : NULL};
        return true;
    }
    *b = (brought){first, v->read, v->numbers_read};
    return read_at(run->of_triangles, run->triangles_at + first * bytes, count * bytes, v->read) &&
           (!v->numbers || read_at(run->of_numbers, run->numbers_at + first * number, count * number, v->numbers_read));
}

/* Those from `first` on, to place `place`: as wide, and counted, as they are to be. */
static void copy(const window *v, const tile_run *run, const brought *b, uint64_t first, size_t count, uint64_t place)
{
    const size_t from = (size_t)(first - b->first), to = (size_t)(place - v->start);
    partition_copy(v->bytes + to * v->w->triangle_bytes, v->w->header->position_bytes,
                   b->triangles + from * NUMBERS * run->position_bytes, run->position_bytes, count);
    for (size_t t = 0; b->numbers && t < count; t++)
        v->numbers[to + t] = (uint32_t)(run->before + b->numbers[from + t]);
}

static uint64_t greatest(uint64_t a, uint64_t b) { return a > b ? a : b; }
static uint64_t smallest(uint64_t a, uint64_t b) { return a < b ? a : b; }

/* What a run has of the window lies there, and is brought, at once. What a partition wrote is looked at before it is copied. */
static bool copy_run(window *v, const tile_run *run)
{
    const partition_tile *const records = v->w->list.tiles;
    const size_t begin = tile_list_find(&run->list, records[v->from].tile);
    const size_t end = tile_list_find(&run->list, records[v->to - 1].tile + 1);
    const uint64_t after = tile_list_start(&run->list, end);
    brought b = {.triangles = NULL};
    for (size_t i = begin, r = v->from; i < end; i++) {
        while (records[r].tile < run->list.tiles[i].tile)
            r++;
        const uint64_t place = v->at[r - v->from], next = place + tile_list_triangles(&run->list, i);
        const uint64_t from = greatest(place, v->start), to = smallest(next, v->end);
        v->at[r - v->from] = next;
        if (from >= to)
            continue;
        if (run->from && from == place && !partition_is_sound(run->from, i)) {
            v->damaged = run->from;
            return false;
        }
        const uint64_t first = run->list.tiles[i].first + (from - place);
        if (!b.triangles && !bring(v, run, first, (size_t)smallest(after - first, v->end - from), &b))
            return false;
        copy(v, run, &b, first, (size_t)(to - from), from);
    }
    return true;
}

/* Checksums of triangles and of their numbers, each going on from one window to the next. */
typedef struct sums {
    uint64_t triangles, numbers;
} sums;

/* But for the end of a tile a window has an even number of triangles, so whole words. */
static void add_sums(const window *v, sums *s)
{
    writing *const w = v->w;
    for (size_t r = v->from; r < v->to; r++) {
        const uint64_t first = greatest(tile_list_start(&w->list, r), v->start),
                       after = smallest(tile_list_start(&w->list, r + 1), v->end);
        const size_t from = (size_t)(first - v->start), count = (size_t)(after - first);
        if (first == w->list.tiles[r].first)
            *s = (sums){CHECKSUM_EMPTY, v->numbers ? CHECKSUM_EMPTY : 0};
        s->triangles = checksum_bytes(s->triangles, v->bytes + from * w->triangle_bytes, count * w->triangle_bytes);
        if (v->numbers)
            s->numbers = checksum_bytes(s->numbers, v->numbers + from, count * sizeof *v->numbers);
        w->list.tiles[r].checksum = s->triangles + s->numbers;
    }
}

/* The system takes one write to a file at a time anyway. */
static bool write_window(window *v, sums *s)
{
    const writing *const w = v->w;
    const size_t count = (size_t)(v->end - v->start), each = w->triangle_bytes, number = sizeof *v->numbers;
    for (size_t r = v->from; r < v->to; r++)
        v->at[r - v->from] = w->list.tiles[r].first;
    for (size_t i = 0; i < w->runs->count; i++)
        if (!copy_run(v, &w->runs->runs[i]))
            return false;
    add_sums(v, s);
    errno = 0;
    return named_file_write_at(w->out->file[1], v->start * each, v->bytes, count * each) &&
           (!v->numbers || named_file_write_at(w->out->file[2], v->start * number, v->numbers, count * number));
}

static int write_step(void *data, void *place, size_t n)
{
    const writing *const w = data;
    window *const v = place;
    const uint64_t end = tile_list_start(&w->list, v->to);
    sums s = {0, 0};
    bool is_written = true;
    (void)n;
    for (v->end = tile_list_start(&w->list, v->from); is_written && v->end < end;) {
        v->start = v->end;
        v->end = smallest(end, v->start + w->room);
        is_written = write_window(v, &s);
    }
    return is_written ? 0 : errno ? errno : EIO;
}

static int tell_failure(void *data, void *place, int reason)
{
    writing *const w = data;
    const window *const v = place;
    progress_end(&w->bar);
    return v->damaged ? partition_refuse_triangles(v->damaged, 1) : folder_out_failure(w->out, reason);
}

static int tell_window(void *data, void *place, size_t n)
{
    writing *const w = data;
    const window *const v = place;
    (void)n;
    w->done += tile_list_start(&w->list, v->to) - tile_list_start(&w->list, v->from);
    progress_tell(&w->bar, (double)w->done / (double)w->list.places);
    return EXIT_CODE_OK;
}

static void free_window(void *place)
{
    window *const v = place;
    free(v->bytes);
    free(v->read);
    free(v->at);
    free(v->numbers);
    free(v->numbers_read);
}

static bool make_window(void *data, void *place)
{
    writing *const w = data;
    window *const v = place;
    const bool has_numbers = w->header->number_bytes;
    v->w = w;
    v->bytes = malloc(w->room * w->triangle_bytes);
    v->read = malloc(w->room * w->triangle_bytes);
    v->at = malloc(w->room * sizeof *v->at);
    v->numbers = has_numbers ? malloc(w->room * sizeof *v->numbers) : NULL;
    v->numbers_read = has_numbers ? malloc(w->room * sizeof *v->numbers) : NULL;
    return v->bytes && v->read && v->at && (!has_numbers || (v->numbers && v->numbers_read));
}

static void write_index(folder_out *out, partition_header *header, const tile_list *list)
{
    header->records = list->count;
    header->places = list->places;
    header->checksum = checksum_bytes(CHECKSUM_EMPTY, header, offsetof(partition_header, checksum));
    header->checksum = checksum_bytes(header->checksum, list->tiles, list->count * sizeof *list->tiles);
    fwrite(header, sizeof *header, 1, out->file[PARTITION_INDEX]);
    fwrite(list->tiles, sizeof *list->tiles, list->count, out->file[PARTITION_INDEX]);
}

int tile_write(folder_out *out, const tile_runs *runs, unsigned threads, partition_header *header, uint64_t *spilled)
{
    enum { LEAST = 64 };
    const uint64_t each = 2 * (NUMBERS * header->position_bytes + header->number_bytes) + sizeof(uint64_t);
    const uint64_t most = runs->memory / 4 / threads / each / 2 * 2;
    const uint64_t share = runs->list.places / 4 / threads / 2 * 2,
                   room = share < most ? share : most; /* all have something to do */
    writing w = {.out = out,
                 .runs = runs,
                 .header = header,
                 .list = runs->list,
                 .triangle_bytes = NUMBERS * header->position_bytes,
                 .room = room < LEAST ? LEAST : (size_t)room};
    const crew_work work = {.threads = threads,
                            .place_bytes = sizeof(window),
                            .begin = make_window,
                            .end = free_window,
                            .find = find_records,
                            .step = write_step,
                            .tell = tell_window,
                            .refuse = tell_failure};
    *spilled = runs->spilled;
    w.bar = progress_start_of("writing", "triangles", (double)w.list.places);
    int code = crew_do(&work, &w);
    progress_end(&w.bar);
    if (code == (int)MESSAGE_NO_MEMORY)
        code = message_failure("out of memory to write the triangles; give less with --memory, or fewer --threads");
    if (!code)
        write_index(out, header, &w.list);
    return code;
}
