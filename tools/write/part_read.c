/* part_read.c - reads the .npz file of a part, or of the whole, and checks that it is complete. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "files/files.h"
#include "npz.h"
#include "read/little.h"

enum { BRICK = 8, BRICK_CELLS = 512, TILE_MOST = 1024, BLOCK = 1024, AT_BYTES = 12, BITS_BYTES = 64 };

static const char again[] = "write it again";

static FILE *open_file(const char *path, uint64_t *size)
{
    FILE *const file = named_file_open(path, "rb");
    file_about about;
    if (!file) {
        message_failure("%s: cannot open the part: %s", path, strerror(errno));
    } else if (!named_file_about_open(file, &about) || about.kind != FILE_KIND_REGULAR) {
        message_failure("%s: not a regular file; give .npz files that tribox wrote", path);
        fclose(file);
        return NULL;
    }
    *size = file ? about.size : 0;
    return file;
}

static const zip_member *member_named(const zip_member *members, unsigned count, const char *name)
{
    for (unsigned i = 0; i < count; i++)
        if (!strcmp(members[i].name, name))
            return &members[i];
    return NULL;
}

/* Whether a member is an array of so many rows. */
static bool has_header(zip_reader *r, int array, uint64_t count)
{
    unsigned char found[NPY_HEADER], due[NPY_HEADER];
    npz_header(due, array, count);
    return zip_reader_read(r, found, sizeof found) && !memcmp(found, due, sizeof due);
}

static bool read_row(FILE *file, const zip_member *m, int array, uint64_t numbers[NPZ_NUMBERS_MOST])
{
    unsigned char bytes[8 * NPZ_NUMBERS_MOST];
    const npz_array *const row = &npz_arrays[array];
    zip_reader r;
    const bool is_read = zip_reader_open(&r, file, m) && has_header(&r, array, row->rows) &&
                         zip_reader_read(&r, bytes, row->rows * (size_t)row->row_bytes) && zip_reader_is_whole(&r);
    zip_reader_close(&r);
    for (unsigned n = 0; n < row->rows && is_read; n++)
        numbers[n] = row->row_bytes == 4 ? little_get32(bytes + 4 * n) : little_get64(bytes + 8 * n);
    return is_read;
}

static bool is_size(uint32_t bytes) { return bytes == sizeof(float) || bytes == sizeof(double); }

static bool is_whole(const part_header *header) { return !header->shard; }

static bool is_sound(const part_header *header)
{
    const part_whole *const whole = &header->whole;
    const tribox_options options = {.accuracy = (tribox_accuracy)whole->accuracy, .axes = whole->axes};
    const voxels *const v = &whole->cells;
    if (!whole->axes || !isfinite(v->shift[0] + v->shift[1] + v->shift[2]) || !voxels_are_served(&v->grid, &options))
        return false;
    return is_whole(header) ||
           (header->shard <= whole->shards && is_size(whole->position_bytes) && whole->tile && whole->tile <= TILE_MOST &&
            whole->tile % BRICK == 0 && header->from <= header->to && header->to <= tribox_tile_count(v->grid.size, whole->tile));
}

/* How many of the arrays from one to before another there are. */
static unsigned count_named(const zip_member *members, unsigned count, int from, int end)
{
    unsigned known = 0;
    for (int a = from; a < end; a++)
        known += member_named(members, count, npz_arrays[a].name) != NULL;
    return known;
}

/* A member that no part has may be one that it has, under a damaged name. end: behind the arrays that have to be there. */
static int check_names(const part *p, const zip_member *members, unsigned count, int end)
{
    for (int r = NPZ_ORIGIN; r < end; r++)
        if (!member_named(members, count, npz_arrays[r].name))
            return message_failure("%s: damaged, or no part: it lacks %s; %s", p->path, npz_arrays[r].name, again);
    const unsigned known = count_named(members, count, 0, end < NPZ_END ? NPZ_ORIGIN : NPZ_ARRAYS);
    if (known + (unsigned)(end - NPZ_ORIGIN) != count)
        return message_failure("%s: damaged: it has members that parts do not have; %s", p->path, again);
    return count_named(members, count, NPZ_MORE, NPZ_ORIGIN) < 2
               ? EXIT_CODE_OK
               : message_failure("%s: has more than one of ids, inside and colours; leave others out", p->path);
}

/* How many rows an array has; UINT64_MAX where its header says otherwise. */
static uint64_t count_rows(FILE *file, const zip_member *m, int array)
{
    const uint64_t row_bytes = (uint64_t)npz_arrays[array].row_bytes,
                   count = m->bytes < NPY_HEADER ? 0 : (m->bytes - NPY_HEADER) / row_bytes;
    zip_reader r;
    const bool is_right = m->bytes == NPY_HEADER + count * row_bytes && zip_reader_open(&r, file, m);
    const bool is_said = is_right && has_header(&r, array, count);
    if (is_right)
        zip_reader_close(&r);
    return is_said ? count : UINT64_MAX;
}

static int find_bricks(part *p, FILE *file, const zip_member *members, unsigned count)
{
    uint64_t found[NPZ_ARRAYS] = {0};
    for (int a = 0; a < NPZ_ORIGIN; a++) {
        const zip_member *const m = member_named(members, count, npz_arrays[a].name);
        const int place = a < NPZ_MORE ? a : NPZ_MORE;
        if (!m && a < NPZ_MORE)
            return message_failure("%s: damaged: it lacks %s; %s", p->path, npz_arrays[a].name, again);
        if (!m)
            continue;
        p->more = a < NPZ_MORE ? 0 : a;
        p->arrays[place] = *m;
        found[place] = count_rows(file, m, a);
    }
    p->header.whole.has_ids = p->more == NPZ_IDS;
    p->header.whole.has_labels = p->more == NPZ_INSIDE;
    p->header.whole.has_colours = p->more == NPZ_COLOURS;
    p->bricks = found[NPZ_BITS];
    if (found[NPZ_BITS] == UINT64_MAX || found[NPZ_AT] != found[NPZ_BITS] || found[NPZ_MORE] == UINT64_MAX ||
        (p->more == NPZ_INSIDE && found[NPZ_MORE] != p->bricks))
        return message_failure("%s: damaged: its arrays do not fit its bricks; %s", p->path, again);
    return EXIT_CODE_OK;
}

static int by_place(const void *a, const void *b) { return memcmp(a, b, AT_BYTES); }

/* The bricks of a whole come in any order, but each once. */
static int check_places(const part *p, FILE *file)
{
    zip_reader r;
    unsigned char header[NPY_HEADER];
    unsigned char(*const at)[AT_BYTES] = p->bricks < SIZE_MAX / AT_BYTES ? malloc((size_t)p->bricks * AT_BYTES + 1) : NULL;
    int code =
        at && zip_reader_open(&r, file, &p->arrays[NPZ_AT]) ? EXIT_CODE_OK : message_failure("out of memory for %s", p->path);
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
    npz_about about = {{{0}}};
    const unsigned count = zip_in_list(file, size, members);
    if (!count)
        return message_failure("%s: not a part, or only the beginning of one, or damaged; give .npz files that tribox wrote",
                               p->path);
    const int end = count_named(members, count, NPZ_SHARD, NPZ_END) ? NPZ_END : NPZ_SHARD;
    int code = check_names(p, members, count, end);
    if (code)
        return code;
    for (int r = NPZ_ORIGIN; r < end; r++)
        if (!read_row(file, member_named(members, count, npz_arrays[r].name), r, about.of[r]))
            return message_failure("%s: damaged: its %s is not what was written; %s", p->path, npz_arrays[r].name, again);
    if (end == NPZ_SHARD)
        about.of[NPZ_WHOLE][5] = TRIBOX_AXES_ALL;
    if (!npz_take_about(&p->header, &about) || (end == NPZ_END && is_whole(&p->header)) || !is_sound(&p->header))
        return message_failure("%s: damaged: what it says of the whole makes no sense; %s", p->path, again);
    code = find_bricks(p, file, members, count);
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
    return message_failure("%s: damaged: %s; run shard %u of %u again", p->path, why, p->header.shard, p->header.whole.shards);
}

static int lack_memory(const part *p) { return message_failure("out of memory for %s", p->path); }

/* Where the bricks of a part have come to: they lie in its tiles, in their order. */
typedef struct tile_place {
    uint32_t lo[3], hi[3]; /* bricks of the tile that the last one was in */
    uint32_t last[3];
    uint64_t tile;
    bool is_begun;
} tile_place;

/* The tile of a brick within the grid; UINT64_MAX for one outside. */
static uint64_t enter_tile(const part_header *h, const uint32_t at[3], tile_place *here)
{
    const uint32_t side = h->whole.tile / BRICK;
    uint64_t tile = 0;
    for (int a = 2; a >= 0; a--) {
        const uint32_t size = h->whole.cells.grid.size[a], tiles = size / h->whole.tile + (size % h->whole.tile != 0);
        if (at[a] > (size - 1) / BRICK)
            return UINT64_MAX;
        tile = tile * tiles + at[a] / side;
        here->lo[a] = at[a] / side * side;
        here->hi[a] = here->lo[a] + side;
    }
    return tile;
}

static bool is_within(const tile_place *here, const uint32_t at[3])
{
    bool is_in = here->is_begun;
    for (int a = 0; a < 3; a++)
        is_in &= at[a] >= here->lo[a] && at[a] < here->hi[a];
    return is_in;
}

/* By z, then y, then x. */
static bool comes_after(const uint32_t at[3], const uint32_t last[3])
{
    return at[2] != last[2] ? at[2] > last[2] : at[1] != last[1] ? at[1] > last[1] : at[0] > last[0];
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

/* NULL if the brick is where one may be, else why not. */
static const char *check_brick(const part_header *h, const part_brick *b, tile_place *here)
{
    if (is_whole(h)) {
        for (int a = 0; a < 3; a++)
            if (b->at[a] > (h->whole.cells.grid.size[a] - 1) / BRICK)
                return "it has bricks outside the grid";
    } else if (is_within(here, b->at)) {
        if (!comes_after(b->at, here->last))
            return "its bricks are out of order";
    } else {
        const uint64_t before = here->tile, tile = enter_tile(h, b->at, here);
        if (tile < h->from || tile >= h->to)
            return "it has bricks outside its tiles";
        if (here->is_begun && tile <= before)
            return "its bricks are out of order";
        here->tile = tile;
        here->is_begun = true;
    }
    memcpy(here->last, b->at, sizeof here->last);
    const uint32_t *const size = h->whole.cells.grid.size;
    return is_at_border(size, b->at) && has_strays(size, b) ? "it has cells outside the grid" : NULL;
}

/* Bricks that have been read and not yet handed on. */
typedef struct block {
    size_t count;
    unsigned char at[BLOCK][AT_BYTES], bits[BLOCK][BITS_BYTES];
    part_brick bricks[BLOCK];
    union { /* in the order of the bricks */
        uint32_t ids[BLOCK * BRICK_CELLS];
        rgb colours[BLOCK * BRICK_CELLS];
        uint64_t inside[BLOCK][8];
    } more;
} block;

typedef struct reading {
    part *p;
    tile_place here;
    uint64_t left;
    zip_reader from[NPZ_ARRAYS];
    part_taker *take;
    void *data;
    int code; /* of the reading, which ends it */
} reading;

static part_brick brick_of(const unsigned char at[AT_BYTES], const unsigned char bits[BITS_BYTES])
{
    part_brick b = {.ids = NULL};
    for (int a = 0; a < 3; a++)
        b.at[a] = little_get32(at + 4 * a);
    for (int k = 0; k < 8; k++)
        b.bits[k] = little_get64(bits + 8 * k);
    b.cells = (uint32_t)voxels_count(b.bits, 8);
    return b;
}

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
    const char *why = more && !zip_reader_read(&r->from[NPZ_MORE], &b->more, rows * (size_t)npz_arrays[more].row_bytes)
                          ? not_of_cells(r->p)
                          : NULL;
    for (size_t n = 0; more == NPZ_IDS && n < rows && !why; n++) {
        b->more.ids[n] = little_get32((const unsigned char *)&b->more.ids[n]);
        if (b->more.ids[n] > INT32_MAX)
            why = "it has ids that int32 does not hold";
    }
    for (size_t i = 0, first = 0; i < b->count && !why; first += b->bricks[i++].cells) {
        part_brick *const brick = &b->bricks[i];
        brick->ids = more == NPZ_IDS ? b->more.ids + first : NULL;
        brick->colours = more == NPZ_COLOURS ? b->more.colours + first : NULL;
        brick->inside = more == NPZ_INSIDE ? b->more.inside[i] : NULL;
        for (int k = 0; k < 8 && brick->inside; k++) {
            b->more.inside[i][k] = little_get64((const unsigned char *)&b->more.inside[i][k]);
            if (brick->inside[k] & ~brick->bits[k])
                why = "cells are inside that are not set";
        }
    }
    return why;
}

static int read_block(reading *r, block *b)
{
    const part_header *const header = &r->p->header;
    uint64_t cells = 0;
    b->count = r->left < BLOCK ? (size_t)r->left : BLOCK;
    if (!zip_reader_read(&r->from[NPZ_AT], b->at, b->count * sizeof *b->at) ||
        !zip_reader_read(&r->from[NPZ_BITS], b->bits, b->count * sizeof *b->bits))
        return refuse(r->p, "it ends early, or its bricks are not what was written");
    for (size_t i = 0; i < b->count; i++) {
        b->bricks[i] = brick_of(b->at[i], b->bits[i]);
        cells += b->bricks[i].cells;
    }
    const char *why = read_more(r, b, cells);
    for (size_t i = 0; i < b->count && !why; i++)
        why = check_brick(header, &b->bricks[i], &r->here);
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

static int keep_block(void *data, void *place, size_t n)
{
    (void)data, (void)place, (void)n;
    return EXIT_CODE_OK;
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

static void *make_block(void *data)
{
    (void)data;
    return malloc(sizeof(block));
}

static int read_bricks(reading *r, FILE *file, unsigned threads)
{
    unsigned char header[NPY_HEADER];
    const int arrays = r->p->more ? NPZ_ARRAYS : NPZ_MORE;
    const crew_work work = {.threads = threads < 2 ? threads : 2,
                            .each = 2,
                            .is_told_in_order = true,
                            .begin = make_block,
                            .end = free,
                            .find = find_block,
                            .step = keep_block,
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
    for (int a = 0; a < NPZ_ARRAYS; a++)
        zip_reader_close(&r.from[a]);
    fclose(file);
    return code;
}
