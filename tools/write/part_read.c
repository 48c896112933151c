/* part_read.c - reads the .npz file of a part, or of the whole, and checks that it is complete. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "files/files.h"
#include "part.h"
#include "read/little.h"

enum { BRICK = 8, BRICK_CELLS = 512, TILE_MOST = 1024, BLOCK = 1024, ARRAYS = 3, AT_BYTES = 12 };

static const char again[] = "write it again";

static FILE *open_file(const char *path, uint64_t *size)
{
    FILE *const file = named_file_open(path, "rb");
    file_about about;
    if (!file)
        return message_failure("%s: cannot open the part: %s", path, strerror(errno)), NULL;
    if (named_file_about_open(file, &about) && about.kind == FILE_KIND_REGULAR)
        return *size = about.size, file;
    message_failure("%s: not a regular file; give .npz files that tribox wrote", path);
    fclose(file);
    return NULL;
}

static const zip_member *member_named(const zip_member *members, unsigned count, const char *name)
{
    for (unsigned i = 0; i < count; i++)
        if (!strcmp(members[i].name, name))
            return &members[i];
    return NULL;
}

/* Goes to the first row of a member that is an array of so many. It is to be closed in any case. */
static bool open_array(zip_reader *r, FILE *file, const zip_member *m, int array, uint64_t rows)
{
    unsigned char found[NPY_HEADER], due[NPY_HEADER];
    npy_header(due, &npz_arrays[array].npy, rows);
    return zip_reader_open(r, file, m) && zip_reader_read(r, found, sizeof found) && !memcmp(found, due, sizeof due);
}

/* A row of what the file says of the grid and of the whole. */
static bool read_row(FILE *file, const zip_member *m, int array, part_header *to)
{
    const npz_array *const a = &npz_arrays[array];
    unsigned char *const row = (unsigned char *)to + a->place;
    zip_reader r;
    const bool is_read =
        open_array(&r, file, m, array, a->rows) && zip_reader_read(&r, row, a->rows * a->npy.row_bytes) && zip_reader_is_whole(&r);
    zip_reader_close(&r);
    little_turn(row, a->rows, a->npy.row_bytes);
    return is_read;
}

static bool is_whole(const part_header *header) { return !header->shard; }

static bool is_sound(const part_header *header)
{
    const part_whole *const whole = &header->whole;
    const tribox_options options = {.accuracy = (tribox_accuracy)whole->accuracy, .axes = (uint32_t)whole->axes};
    const voxels *const v = &whole->cells;
    if (!whole->axes || whole->axes > UINT32_MAX || whole->accuracy > UINT32_MAX ||
        !isfinite(v->shift[0] + v->shift[1] + v->shift[2]) || !voxels_are_served(&v->grid, &options))
        return false;
    return is_whole(header) || (header->shard <= header->shards &&
                                (whole->position_bytes == sizeof(float) || whole->position_bytes == sizeof(double)) &&
                                whole->tile && whole->tile <= TILE_MOST && whole->tile % BRICK == 0 && header->from <= header->to &&
                                header->to <= tribox_tile_count(v->grid.size, (uint32_t)whole->tile));
}

/* Finds the arrays. A member that no part has may be one that it has, under a damaged name. end: behind those of this part. */
static int find_members(part *p, const zip_member *members, unsigned count, const zip_member *of[NPZ_END], int *end)
{
    unsigned known = 0, more = 0;
    for (int a = 0; a < NPZ_END; a++)
        of[a] = member_named(members, count, npz_arrays[a].npy.name);
    *end = of[NPZ_SHARD] || of[NPZ_TILES] || of[NPZ_WHOLE] ? NPZ_END : NPZ_SHARD;
    for (int a = 0; a < *end; a++) {
        const bool is_more = a > NPZ_AT && a < NPZ_ORIGIN;
        if (!of[a] && !is_more)
            return message_failure("%s: damaged, or no part: it lacks %s; %s", p->path, npz_arrays[a].npy.name, again);
        known += of[a] && (!is_more || a == NPZ_IDS || *end == NPZ_SHARD);
        more += of[a] && is_more;
        p->more = of[a] && is_more ? a : p->more;
    }
    if (known != count)
        return message_failure("%s: damaged: it has members that parts do not have; %s", p->path, again);
    return more < 2 ? EXIT_CODE_OK : message_failure("%s: has more than one of ids, inside and colours; leave others out", p->path);
}

/* How many rows an array has; UINT64_MAX where its header says otherwise. */
static uint64_t count_rows(FILE *file, const zip_member *m, int array)
{
    const uint64_t row_bytes = npz_arrays[array].npy.row_bytes,
                   count = m->bytes < NPY_HEADER ? 0 : (m->bytes - NPY_HEADER) / row_bytes;
    zip_reader r = {.from = NULL};
    const bool is_said = m->bytes == NPY_HEADER + count * row_bytes && open_array(&r, file, m, array, count);
    zip_reader_close(&r);
    return is_said ? count : UINT64_MAX;
}

static int find_bricks(part *p, FILE *file, const zip_member *const of[NPZ_END])
{
    const int arrays[] = {NPZ_BITS, NPZ_AT, p->more};
    uint64_t rows[3];
    for (int n = 0; n < 3; n++) { /* those of the bits again, where there are no more */
        p->arrays[n] = *of[arrays[n]];
        rows[n] = count_rows(file, of[arrays[n]], arrays[n]);
    }
    p->bricks = rows[0];
    p->header.whole.has_ids = p->more == NPZ_IDS;
    p->header.whole.has_labels = p->more == NPZ_INSIDE;
    p->header.whole.has_colours = p->more == NPZ_COLOURS;
    if (rows[0] != UINT64_MAX && rows[1] == rows[0] && rows[2] != UINT64_MAX && (p->more != NPZ_INSIDE || rows[2] == rows[0]))
        return EXIT_CODE_OK;
    return message_failure("%s: damaged: its arrays do not fit its bricks; %s", p->path, again);
}

static int lack_memory(const part *p) { return message_failure("out of memory for %s", p->path); }

static int by_place(const void *a, const void *b) { return memcmp(a, b, AT_BYTES); }

/* The bricks of a whole come in any order, but each once. */
static int check_places(const part *p, FILE *file)
{
    zip_reader r;
    unsigned char header[NPY_HEADER];
    unsigned char(*const at)[AT_BYTES] = p->bricks < SIZE_MAX / AT_BYTES ? malloc((size_t)p->bricks * AT_BYTES + 1) : NULL;
    int code = at && zip_reader_open(&r, file, &p->arrays[NPZ_AT]) ? EXIT_CODE_OK : lack_memory(p);
    if (!code) {
        bool is_read = zip_reader_read(&r, header, sizeof header);
        for (uint64_t n = 0, block; is_read && n < p->bricks; n += block) {
            block = p->bricks - n < BLOCK ? p->bricks - n : BLOCK;
            is_read = zip_reader_read(&r, at[n], (size_t)block * AT_BYTES);
        }
        zip_reader_close(&r);
        qsort(at, is_read ? (size_t)p->bricks : 0, sizeof *at, by_place);
        for (uint64_t n = 1; is_read && n < p->bricks; n++)
            is_read = by_place(at[n - 1], at[n]) != 0;
        code = is_read ? EXIT_CODE_OK : message_failure("%s: damaged: it ends early, or has a brick twice; %s", p->path, again);
    }
    free(at);
    return code;
}

static int read_about(part *p, FILE *file, uint64_t size)
{
    zip_member members[ZIP_MEMBERS_MAX];
    const zip_member *of[NPZ_END];
    int end;
    const unsigned count = zip_in_list(file, size, members);
    if (!count)
        return message_failure("%s: not a part, or only the beginning of one, or damaged; give .npz files that tribox wrote",
                               p->path);
    int code = find_members(p, members, count, of, &end);
    if (code)
        return code;
    p->header.whole.axes = TRIBOX_AXES_ALL;
    for (int a = NPZ_ORIGIN; a < end; a++)
        if (!read_row(file, of[a], a, &p->header))
            return message_failure("%s: damaged: its %s is not what was written; %s", p->path, npz_arrays[a].npy.name, again);
    if ((end == NPZ_END && is_whole(&p->header)) || !is_sound(&p->header))
        return message_failure("%s: damaged: what it says of the whole makes no sense; %s", p->path, again);
    code = find_bricks(p, file, of);
    return code || !is_whole(&p->header) ? code : check_places(p, file);
}

int part_open(part *p, const char *path)
{
    uint64_t size;
    *p = (part){.path = path};
    FILE *const file = open_file(path, &size);
    if (!file)
        return EXIT_CODE_FAILURE;
    const int code = read_about(p, file, size);
    fclose(file);
    return code;
}

static int refuse(const part *p, const char *why)
{
    if (is_whole(&p->header))
        return message_failure("%s: damaged: %s; %s", p->path, why, again);
    return message_failure("%s: damaged: %s; run shard %u of %u again", p->path, why, p->header.shard, p->header.shards);
}

/* Whether a brick on the upper border of the grid has cells beyond it. */
static bool has_strays(const uint32_t size[3], const part_brick *b)
{
    uint64_t stray = 0, row = 0, layer = 0;
    for (uint32_t i = 0; i < BRICK; i++) {
        row |= (uint64_t)(8 * (uint64_t)b->at[0] + i >= size[0]) << i;
        layer |= 8 * (uint64_t)b->at[1] + i >= size[1] ? UINT64_C(255) << 8 * i : 0;
    }
    layer |= row * UINT64_C(0x0101010101010101);
    for (uint32_t k = 0; k < BRICK; k++)
        stray |= b->bits[k] & (8 * (uint64_t)b->at[2] + k >= size[2] ? UINT64_MAX : layer);
    return stray != 0;
}

static bool is_at_border(const uint32_t size[3], const uint32_t at[3])
{
    return at[0] >= size[0] / BRICK || at[1] >= size[1] / BRICK || at[2] >= size[2] / BRICK;
}

/* Bricks lie in the tiles of a part, in their order, and there by z, then y, then x. */
typedef struct brick_place {
    uint64_t tile;
    uint32_t within;
} brick_place;

/* NULL if the brick is where one may be, else why not. next: where one may begin, of a part. */
static const char *check_brick(const part_header *h, const part_brick *b, brick_place *next)
{
    const uint32_t *const size = h->whole.cells.grid.size, tile = (uint32_t)h->whole.tile, side = tile / BRICK;
    brick_place here = {0, 0};
    for (int a = 2; a >= 0; a--) {
        if (b->at[a] > (size[a] - 1) / BRICK)
            return is_whole(h) ? "it has bricks outside the grid" : "it has bricks outside its tiles";
        if (is_whole(h))
            continue;
        here.tile = here.tile * (size[a] / tile + (size[a] % tile != 0)) + b->at[a] / side;
        here.within = here.within * side + b->at[a] % side;
    }
    if (!is_whole(h)) {
        if (here.tile < h->from || here.tile >= h->to)
            return "it has bricks outside its tiles";
        if (here.tile < next->tile || (here.tile == next->tile && here.within < next->within))
            return "its bricks are out of order";
        *next = (brick_place){here.tile, here.within + 1};
    }
    return is_at_border(size, b->at) && has_strays(size, b) ? "it has cells outside the grid" : NULL;
}

/* Bricks that have been read and not yet handed on. */
typedef struct block {
    size_t count;
    uint32_t at[BLOCK][3];
    uint64_t bits[BLOCK][8];
    part_brick bricks[BLOCK];
    union { /* in the order of the bricks */
        uint32_t ids[BLOCK * BRICK_CELLS];
        rgb colours[BLOCK * BRICK_CELLS];
        uint64_t inside[BLOCK][8];
    } more;
} block;

typedef struct reading {
    part *p;
    brick_place next; /* that a brick may have */
    uint64_t left;
    zip_reader from[ARRAYS]; /* of the part's arrays */
    part_taker *take;
    void *data;
    int code; /* of the reading, which ends it */
} reading;

static const char *not_of_cells(const part *p)
{
    return p->more == NPZ_IDS       ? "its ids are not those of its cells"
           : p->more == NPZ_COLOURS ? "its colours are not those of its cells"
                                    : "its inside is not that of its bricks";
}

/* What there is besides of all bricks, which have so many cells; NULL if it can be, else what is wrong. */
static const char *read_more(reading *r, block *b, uint64_t cells)
{
    const int more = r->p->more;
    const size_t rows = more == NPZ_INSIDE ? b->count : (size_t)cells;
    if (!more)
        return NULL;
    if (!zip_reader_read(&r->from[2], &b->more, rows * npz_arrays[more].npy.row_bytes))
        return not_of_cells(r->p);
    if (more != NPZ_COLOURS)
        little_turn(&b->more, more == NPZ_INSIDE ? 8 * rows : rows,
                    more == NPZ_INSIDE ? sizeof **b->more.inside : sizeof *b->more.ids);
    for (size_t n = 0; more == NPZ_IDS && n < rows; n++)
        if (b->more.ids[n] > INT32_MAX)
            return "it has ids that int32 does not hold";
    for (size_t i = 0, first = 0; i < b->count; first += b->bricks[i++].cells) {
        part_brick *const brick = &b->bricks[i];
        brick->ids = more == NPZ_IDS ? b->more.ids + first : NULL;
        brick->colours = more == NPZ_COLOURS ? b->more.colours + first : NULL;
        brick->inside = more == NPZ_INSIDE ? b->more.inside[i] : NULL;
        for (int k = 0; k < 8 && brick->inside; k++)
            if (brick->inside[k] & ~brick->bits[k])
                return "cells are inside that are not set";
    }
    return NULL;
}

static int read_block(reading *r, block *b)
{
    uint64_t cells = 0;
    b->count = r->left < BLOCK ? (size_t)r->left : BLOCK;
    if (!zip_reader_read(&r->from[0], b->bits, b->count * sizeof *b->bits) ||
        !zip_reader_read(&r->from[1], b->at, b->count * sizeof *b->at))
        return refuse(r->p, "it ends early, or its bricks are not what was written");
    little_turn(b->bits, 8 * b->count, sizeof **b->bits);
    little_turn(b->at, 3 * b->count, sizeof **b->at);
    for (size_t i = 0; i < b->count; i++) {
        part_brick *const brick = &b->bricks[i];
        *brick = (part_brick){.cells = (uint32_t)voxels_count(b->bits[i], 8)};
        memcpy(brick->at, b->at[i], sizeof brick->at);
        memcpy(brick->bits, b->bits[i], sizeof brick->bits);
        cells += brick->cells;
    }
    const char *why = read_more(r, b, cells);
    for (size_t i = 0; i < b->count && !why; i++)
        why = check_brick(&r->p->header, &b->bricks[i], &r->next);
    if (why)
        return refuse(r->p, why);
    r->p->cells += cells;
    r->left -= b->count;
    return EXIT_CODE_OK;
}

/* One thread reads while another hands on what it has read. */
static bool find_block(void *data, void *place, size_t n)
{
    reading *const r = data;
    const bool is_left = r->left && !r->code;
    (void)n;
    if (is_left)
        r->code = read_block(r, place);
    return is_left && !r->code;
}

static int take_block(void *data, void *place, size_t n)
{
    const reading *const r = data;
    const block *const b = place;
    int code = EXIT_CODE_OK;
    (void)n;
    for (size_t i = 0; i < b->count && !code; i++)
        code = r->take(r->data, &b->bricks[i]);
    return code;
}

static int read_bricks(reading *r, FILE *file, unsigned threads)
{
    unsigned char header[NPY_HEADER];
    const int arrays = r->p->more ? ARRAYS : ARRAYS - 1;
    const crew_work work = {.threads = threads < 2 ? threads : 2,
                            .each = 2,
                            .is_told_in_order = true,
                            .place_bytes = sizeof(block),
                            .find = find_block,
                            .tell = take_block};
    for (int a = 0; a < arrays; a++) {
        if (!zip_reader_open(&r->from[a], file, &r->p->arrays[a]))
            return lack_memory(r->p);
        if (!zip_reader_read(&r->from[a], header, sizeof header))
            return refuse(r->p, "it ends early");
    }
    int code = crew_do(&work, r);
    code = code == (int)MESSAGE_NO_MEMORY ? lack_memory(r->p) : code ? code : r->code;
    for (int a = 0; a < arrays && !code; a++)
        if (!zip_reader_is_whole(&r->from[a]))
            code = refuse(r->p, r->from[a].left ? not_of_cells(r->p) : "its checksum does not match its content");
    return code;
}

int part_read(part *p, unsigned threads, part_taker *take, void *data)
{
    uint64_t size;
    FILE *const file = open_file(p->path, &size);
    reading r = {.p = p, .left = p->bricks, .take = take, .data = data};
    if (!file)
        return EXIT_CODE_FAILURE;
    p->cells = 0;
    setvbuf(file, NULL, _IONBF, 0);
    const int code = read_bricks(&r, file, threads);
    for (int a = 0; a < ARRAYS; a++)
        zip_reader_close(&r.from[a]);
    fclose(file);
    return code;
}
