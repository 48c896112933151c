/* part_read.c - reads a part, and checks that it is whole. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "checksum.h"
#include "console/message.h"
#include "files/named_file.h"
#include "part.h"

enum { BRICK = 8, TILE_MOST = 1024, BLOCK = 1024 };

static bool is_size(uint32_t bytes) { return bytes == sizeof(float) || bytes == sizeof(double); }

static bool is_sound(const part_header *header)
{
    const part_whole *const whole = &header->whole;
    const tribox_options options = {.accuracy = (tribox_accuracy)whole->accuracy, .axes = whole->axes};
    const voxels v = part_voxels(whole);
    return header->shard && header->shard <= whole->shards && whole->axes &&
           (!whole->id_bytes || whole->id_bytes == sizeof(uint32_t)) && is_size(whole->position_bytes) &&
           isfinite(v.shift[0] + v.shift[1] + v.shift[2]) && whole->brick_bytes == sizeof(part_brick) && whole->tile &&
           whole->tile <= TILE_MOST && whole->tile % BRICK == 0 && voxels_are_served(&v.grid, &options) &&
           header->from <= header->to && header->to <= tribox_tile_count(whole->size, whole->tile);
}

static int check_header(const char *path, const part_header *header)
{
    static const char magic[sizeof header->magic] = PART_MAGIC, any_version[] = "tribox part ";
    if (memcmp(header->magic, any_version, sizeof any_version - 1))
        return message_failure("%s: not a part file; give the .part files that tribox voxelize --shard wrote (shards as .npz are "
                               "read as one by tribox.Bricks.load of Python)",
                               path);
    if (memcmp(header->magic, magic, sizeof magic))
        return message_failure("%s: damaged, or written by another version of tribox; run that shard again", path);
    if (header->byte_order != PART_BYTE_ORDER)
        return message_failure("%s: written on a machine of another byte order; merge it on a machine like that one", path);
    return is_sound(header) ? EXIT_CODE_OK : message_failure("%s: damaged: its header makes no sense; run that shard again", path);
}

static int refuse(const part *p, const char *why)
{
    return message_failure("%s: damaged: %s; run shard %u of %u again", p->path, why, p->header.shard, p->header.whole.shards);
}

static FILE *open_file(const char *path)
{
    FILE *const file = named_file_open(path, "rb");
    file_about about;
    if (!file) {
        message_failure("%s: cannot open the part: %s", path, strerror(errno));
    } else if (!named_file_about_open(file, &about) || about.kind != FILE_KIND_REGULAR) {
        message_failure("%s: not a regular file; give the files that tribox voxelize --shard wrote", path);
        fclose(file);
        return NULL;
    }
    return file;
}

/* Where the end is follows from the size of the file. */
static int read_ends(part *p, FILE *file)
{
    if (fread(&p->header, sizeof p->header, 1, file) != 1)
        return message_failure("%s: not a part file, or only the beginning of one; run that shard again", p->path);
    const int code = check_header(p->path, &p->header);
    if (code)
        return code;
    file_about about;
    if (!named_file_about_open(file, &about) || about.size < sizeof p->header + sizeof p->end ||
        fseeko(file, (off_t)(about.size - sizeof p->end), SEEK_SET) || fread(&p->end, sizeof p->end, 1, file) != 1)
        return refuse(p, "it ends early");
    const uint64_t size = about.size - sizeof p->header - sizeof p->end, id_bytes = p->header.whole.id_bytes;
    const bool has_room = !id_bytes || p->end.cells <= size / id_bytes;
    const uint64_t bricks = has_room ? size - p->end.cells * id_bytes : 0;
    if (!has_room || bricks % sizeof(part_brick) || bricks / sizeof(part_brick) != p->end.bricks)
        return message_failure("%s: damaged: it has %llu bytes, which do not fit its number of bricks; run shard %u of %u again",
                               p->path, (unsigned long long)about.size, p->header.shard, p->header.whole.shards);
    return EXIT_CODE_OK;
}

int part_open(part *p, const char *path)
{
    *p = (part){.path = path};
    FILE *const file = open_file(path);
    if (!file)
        return EXIT_CODE_FAILURE;
    const int code = read_ends(p, file);
    fclose(file);
    return code;
}

/* Where the bricks of a part have come to: they lie in its tiles, in their order. */
typedef struct place {
    uint32_t lo[3], hi[3]; /* bricks of the tile that the last one was in */
    uint32_t last[3];
    uint64_t tile;
    bool is_begun;
} place;

/* The tile of a brick within the grid; UINT64_MAX for one outside. */
static uint64_t enter_tile(const part_header *h, const uint32_t at[3], place *here)
{
    const uint32_t side = h->whole.tile / BRICK;
    uint64_t tile = 0;
    for (int a = 2; a >= 0; a--) {
        const uint32_t size = h->whole.size[a], tiles = size / h->whole.tile + (size % h->whole.tile != 0);
        if (at[a] > (size - 1) / BRICK)
            return UINT64_MAX;
        tile = tile * tiles + at[a] / side;
        here->lo[a] = at[a] / side * side;
        here->hi[a] = here->lo[a] + side;
    }
    return tile;
}

static bool is_within(const place *here, const uint32_t at[3])
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
static const char *check_brick(const part_header *h, const part_brick *b, place *here)
{
    if (is_within(here, b->at)) {
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
    return is_at_border(h->whole.size, b->at) && has_strays(h->whole.size, b) ? "it has cells outside the grid" : NULL;
}

typedef struct reading {
    const part *p;
    place here;
    uint64_t left, cells, sum;
} reading;

static int take_block(reading *r, const part_brick *bricks, size_t count, part_take *take, void *data)
{
    int code = EXIT_CODE_OK;
    r->sum = checksum_bytes(r->sum, bricks, count * sizeof *bricks);
    for (size_t i = 0; i < count && !code; i++) {
        const char *const why = check_brick(&r->p->header, &bricks[i], &r->here);
        r->cells += bricks[i].cells;
        code = why ? refuse(r->p, why) : take(data, &bricks[i], NULL);
    }
    r->left -= count;
    return code;
}

static int take_with_ids(reading *r, FILE *file, part_take *take, void *data)
{
    part_brick brick;
    uint32_t ids[512];
    if (fread(&brick, sizeof brick, 1, file) != 1)
        return refuse(r->p, "it ends early");
    const char *const why = check_brick(&r->p->header, &brick, &r->here);
    if (why)
        return refuse(r->p, why);
    if (brick.cells != voxels_count(brick.bits, 8))
        return refuse(r->p, "its cells are not as many as it says");
    if (fread(ids, sizeof *ids, brick.cells, file) != brick.cells)
        return refuse(r->p, "it ends early");
    r->sum = checksum_bytes(checksum_bytes(r->sum, &brick, sizeof brick), ids, brick.cells * sizeof *ids);
    r->cells += brick.cells;
    r->left--;
    return take(data, &brick, ids);
}

static int read_bricks(reading *r, FILE *file, part_brick *block, part_take *take, void *data)
{
    int code = EXIT_CODE_OK;
    part_header header;
    if (fread(&header, sizeof header, 1, file) != 1 || memcmp(&header, &r->p->header, sizeof header))
        return refuse(r->p, "it has changed meanwhile");
    r->sum = checksum_bytes(r->sum, &header, sizeof header);
    while (r->left && !code && r->p->header.whole.id_bytes)
        code = take_with_ids(r, file, take, data);
    while (r->left && !code) {
        const size_t wanted = r->left < BLOCK ? (size_t)r->left : BLOCK;
        code = fread(block, sizeof *block, wanted, file) == wanted ? take_block(r, block, wanted, take, data)
                                                                   : refuse(r->p, "it ends early");
    }
    if (code)
        return code;
    r->sum = checksum_bytes(r->sum, &r->p->end, offsetof(part_end, checksum));
    if (r->sum != r->p->end.checksum)
        return refuse(r->p, "its checksum does not match its content");
    return r->cells == r->p->end.cells ? EXIT_CODE_OK : refuse(r->p, "its cells are not as many as it says");
}

int part_read(const part *p, part_take *take, void *data)
{
    reading r = {.p = p, .left = p->end.bricks, .sum = CHECKSUM_EMPTY};
    FILE *const file = open_file(p->path);
    part_brick *const block = file ? malloc(BLOCK * sizeof *block) : NULL;
    int code = EXIT_CODE_FAILURE;
    if (block) {
        setvbuf(file, NULL, p->header.whole.id_bytes ? _IOFBF : _IONBF, p->header.whole.id_bytes ? BLOCK * sizeof *block : 0);
        code = read_bricks(&r, file, block, take, data);
    } else if (file) {
        message_failure("out of memory for %s", p->path);
    }
    free(block);
    if (file)
        fclose(file);
    return code;
}
