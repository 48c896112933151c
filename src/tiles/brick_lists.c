/*
 * brick_lists.c - bricks handed on with the triangles of each cell: pairs, which kernels list in place of bits, are cut where
 * bricks end, put in order of bricks, and put into lists a brick at a time.
 *
 * A tile is done in parts, each of so many bricks that its pieces fit; where those of one brick alone do not, it is voxelized
 * twice, to count its pairs and to put them into lists, as tribox_cell_lists does.
 */
#include "base/environment.h"
#include "brick_call.h"
#include "tile_lists.h"

enum { BRICK = 8, CELLS = TRIBOX_BRICK_IDS, ROWS = CELLS / BRICK, OF_ENTRY = 4 };

/* Right of numbers below 2^25 where `by` is at most 2^5, and below 2^20 where it is at most 2^10 (PROOFS.md 7.14). */
typedef struct divisor {
    uint32_t by;
    uint64_t inverse; /* times 2^32, rounded up */
} divisor;

static divisor divisor_of(uint32_t by) { return (divisor){by, (UINT64_C(1) << 32) / by + 1}; }
static inline uint32_t divide(uint32_t n, divisor d) { return (uint32_t)(n * d.inverse >> 32); }

typedef struct part part;
typedef void take_piece(part *p, tribox_piece piece);

/* Bricks of a tile, beside each other, as a window. */
struct part {
    tribox_bricks_call *call;
    tribox_tile_box bricks; /* of the tile */
    tribox_window window;
    divisor row_halves, rows;
    const uint32_t *list; /* the tile's triangles */
    size_t listed;
    bool is_rising; /* whether they are in order */
    size_t pieces;
    bool is_full;
    take_piece *take; /* NULL: they are kept, as long as there is room */
    uint64_t bits[BRICK];
};

static size_t bricks_of(uint32_t side)
{
    const size_t along = side / BRICK, all = along * along * along;
    return all < TRIBOX_PART_BRICKS ? all : TRIBOX_PART_BRICKS;
}

/* Pieces of few triangles are about as many as a tile has rows, of many about as many as these. Less than 2^32. */
static size_t room_for(uint32_t side, size_t most)
{
    return 16 * ((size_t)side * side + (most < 1 << 26 ? most : 1 << 26)) + OF_ENTRY;
}

size_t tribox_brick_lists_bytes_of(uint32_t side, size_t most)
{
    const size_t of_each = CELLS * sizeof(uint32_t) + 16 * 2 * sizeof(tribox_piece);
    const size_t others = room_for(side, 0) * 2 * sizeof(tribox_piece) + (bricks_of(side) + 2 * (CELLS + 1) + 2) * sizeof(uint32_t);
    return most > (SIZE_MAX - others) / of_each ? SIZE_MAX : others + most * of_each;
}

void tribox_brick_lists_use(tribox_brick_lists *l, uint32_t side, size_t most, void *scratch)
{
    l->room = room_for(side, most);
    l->pieces = scratch;
    l->ordered = l->pieces + l->room;
    l->of_bricks = (uint32_t *)(void *)(l->ordered + l->room);
    l->starts = l->of_bricks + bricks_of(side) + 1;
    l->next = l->starts + CELLS + 1;
    l->triangles = l->next + CELLS;
}

/* The pieces of an entry, 4 at the most. Returns how many there are. */
static inline unsigned cut_entry(const part *p, uint32_t half, uint32_t bits, uint32_t number, tribox_piece to[OF_ENTRY])
{
    const uint32_t row = divide(half, p->row_halves), from = (half - row * p->row_halves.by) * OF_ENTRY;
    const uint32_t k = divide(row, p->rows), j = row - k * p->rows.by;
    const uint32_t beam = k / BRICK * (uint32_t)p->bricks.tiles[1] + j / BRICK;
    uint32_t key = (beam * (uint32_t)p->bricks.tiles[0] + from) << TRIBOX_PIECE_BRICK | (k % BRICK * BRICK + j % BRICK)
                                                                                            << TRIBOX_PIECE_ROW;
    unsigned count = 0;
    for (unsigned n = 0; n < OF_ENTRY; n++, bits >>= BRICK, key += 1u << TRIBOX_PIECE_BRICK) {
        to[count] = (tribox_piece){key | (bits & 0xff), number};
        count += (bits & 0xff) != 0;
    }
    return count;
}

static void take_pairs(void *taker, const tribox_writes *listed, uint32_t first)
{
    part *const p = taker;
    tribox_brick_lists *const l = &p->call->lists;
    for (unsigned n = 0; n < listed->count && !p->is_full; n++) {
        tribox_piece some[OF_ENTRY], *const to = p->take ? some : l->pieces + p->pieces;
        const unsigned count =
            cut_entry(p, (uint32_t)listed->half[n], (uint32_t)listed->bits[n], first + (uint32_t)listed->number[n], to);
        for (unsigned i = 0; p->take && i < count; i++)
            p->take(p, some[i]);
        p->pieces += p->take ? 0 : count;
        p->is_full = l->room - p->pieces < OF_ENTRY;
    }
}

/* Returns how many cells were undecided. */
static size_t voxelize_part(part *p, take_piece *take)
{
    tribox_voxels voxels, *const v = &voxels;
    const tribox_pair_sink sink = {take_pairs, p};
    tribox_ends ends;
    const tribox_environment callers = tribox_environment_enter();
    v->plan = p->call->plan;
    tribox_voxels_begin(v, &p->call->triangles, p->call->grid, &p->window, NULL);
    tribox_voxels_ask_pairs(v, &sink);
    p->row_halves = divisor_of((uint32_t)v->sinks.row_halves);
    p->rows = divisor_of(p->window.size[1]);
    p->take = take;
    p->pieces = 0;
    p->is_full = false;
    tribox_bricks_put(p->call, v, p->list, p->listed, &ends);
    tribox_environment_leave(callers);
    return v->counts.undecided;
}

/* Orders the pieces by brick; of_bricks[b] is where those of brick b end. */
static void order_pieces(const part *p, size_t bricks)
{
    const tribox_brick_lists *const l = &p->call->lists;
    uint32_t sum = 0;
    memset(l->of_bricks, 0, bricks * sizeof *l->of_bricks);
    for (size_t n = 0; n < p->pieces; n++)
        l->of_bricks[l->pieces[n].key >> TRIBOX_PIECE_BRICK]++;
    for (size_t b = 0; b < bricks; b++) {
        const uint32_t count = l->of_bricks[b];
        l->of_bricks[b] = sum;
        sum += count;
    }
    for (size_t n = 0; n < p->pieces; n++)
        l->ordered[l->of_bricks[l->pieces[n].key >> TRIBOX_PIECE_BRICK]++] = l->pieces[n];
}

static uint32_t row_of_piece(tribox_piece piece) { return piece.key >> TRIBOX_PIECE_ROW & (ROWS - 1); }

/* The cells of a piece, each counted where its list begins. */
TRIBOX_INLINE void count_cells(tribox_piece piece, uint32_t *starts, uint64_t bits[BRICK])
{
    const uint32_t row = row_of_piece(piece);
    uint32_t *const counts = starts + (size_t)row * BRICK;
    bits[row / BRICK] |= (uint64_t)(piece.key & 0xff) << row % BRICK * BRICK;
    for (unsigned i = 0; i < BRICK; i++)
        counts[i] += piece.key >> i & 1;
}

TRIBOX_INLINE void put_cells(tribox_piece piece, const uint32_t *starts, uint32_t *next, uint32_t *triangles, bool is_rising)
{
    const size_t first = (size_t)row_of_piece(piece) * BRICK;
    for (uint32_t bits = piece.key & 0xff; bits; bits &= bits - 1) {
        const size_t c = first + tribox_lowest_bit(bits), at = next[c]++;
        if (is_rising)
            tribox_list_put(triangles + starts[c], at - starts[c], piece.number);
        else
            triangles[at] = piece.number;
    }
}

static void count_piece(part *p, tribox_piece piece)
{
    const tribox_brick_lists *const l = &p->call->lists;
    count_cells(piece, l->starts, p->bits);
}

static void put_piece(part *p, tribox_piece piece)
{
    const tribox_brick_lists *const l = &p->call->lists;
    put_cells(piece, l->starts, l->next, l->triangles, p->is_rising);
}

static void begin_brick(part *p)
{
    memset(p->call->lists.starts, 0, CELLS * sizeof *p->call->lists.starts);
    memset(p->bits, 0, sizeof p->bits);
}

/* Where lists begin. False if there are too many pairs to number. */
static bool sum_brick(const part *p)
{
    const tribox_brick_lists *const l = &p->call->lists;
    uint64_t sum = 0;
    for (size_t c = 0; c < CELLS; c += BRICK) {
        if (!(p->bits[c / 64] >> c % 64 & 0xff)) {
            for (size_t i = 0; i < BRICK; i++)
                l->starts[c + i] = (uint32_t)sum;
            continue;
        }
        for (size_t i = 0; i < BRICK; i++) {
            const uint32_t count = l->starts[c + i];
            l->starts[c + i] = (uint32_t)sum;
            sum += count;
        }
    }
    l->starts[CELLS] = (uint32_t)sum;
    memcpy(l->next, l->starts, CELLS * sizeof *l->next);
    return sum <= UINT32_MAX;
}

/* Moves a number down a heap, of which the greatest is to come first. */
static void sift(uint32_t *list, size_t at, size_t count)
{
    const uint32_t number = list[at];
    for (size_t below; (below = 2 * at + 1) < count; at = below) {
        below += below + 1 < count && list[below + 1] > list[below];
        if (list[below] <= number)
            break;
        list[at] = list[below];
    }
    list[at] = number;
}

/* Of triangles that were not listed in order: in place, whatever their number. */
static void sort_list(uint32_t *list, size_t count)
{
    for (size_t at = count / 2; at-- > 0;)
        sift(list, at, count);
    for (size_t left = count; left-- > 1;) {
        const uint32_t greatest = list[0];
        list[0] = list[left];
        list[left] = greatest;
        sift(list, 0, left);
    }
}

/* Returns whether to go on. */
static bool hand_on(part *p, size_t brick)
{
    const tribox_brick_lists *const l = &p->call->lists;
    const int64_t *const along = p->bricks.tiles;
    const int64_t in_part[3] = {(int64_t)brick % along[0], (int64_t)brick / along[0] % along[1],
                                (int64_t)brick / along[0] / along[1]};
    uint32_t at[3];
    for (int a = 0; a < 3; a++)
        at[a] = p->window.first[a] / BRICK + (uint32_t)in_part[a];
    for (size_t c = 0; !p->is_rising && c < CELLS; c++)
        sort_list(l->triangles + l->starts[c], l->starts[c + 1] - l->starts[c]);
    for (int k = 0; k < BRICK; k++)
        p->call->outlet.cells += tribox_count_bits(p->bits[k]);
    return l->sink.take(l->sink.data, at, p->bits, l->starts, l->triangles) == 0;
}

/* The bricks of the pieces that were kept. */
static tribox_status emit_pieces(part *p, size_t bricks)
{
    const tribox_brick_lists *const l = &p->call->lists;
    const tribox_piece *const ordered = l->ordered;
    uint32_t *const starts = l->starts, *const next = l->next, *const triangles = l->triangles;
    const bool is_rising = p->is_rising;
    order_pieces(p, bricks);
    for (size_t b = 0, at = 0; b < bricks; at = l->of_bricks[b++]) {
        const size_t end = l->of_bricks[b];
        if (at == end)
            continue;
        begin_brick(p);
        for (size_t n = at; n < end; n++)
            count_cells(ordered[n], starts, p->bits);
        if (!sum_brick(p))
            return TRIBOX_BAD_GRID;
        for (size_t n = at; n < end; n++)
            put_cells(ordered[n], starts, next, triangles, is_rising);
        if (!hand_on(p, b))
            return TRIBOX_STOPPED;
    }
    return TRIBOX_OK;
}

/* A part of one brick that has more pieces than can be kept. */
static tribox_status emit_crowded(part *p)
{
    begin_brick(p);
    voxelize_part(p, count_piece);
    if (!sum_brick(p))
        return TRIBOX_BAD_GRID;
    voxelize_part(p, put_piece);
    return hand_on(p, 0) ? TRIBOX_OK : TRIBOX_STOPPED;
}

static void cut_part(part *p, const tribox_tiling *bricks, const tribox_window *tile)
{
    p->bricks = tribox_tiling_part(bricks, bricks->first);
    for (int a = 0; a < 3; a++) {
        const uint32_t from = BRICK * (uint32_t)p->bricks.base[a], cells = BRICK * (uint32_t)p->bricks.tiles[a];
        p->window.first[a] = tile->first[a] + from;
        p->window.size[a] = cells < tile->size[a] - from ? cells : tile->size[a] - from;
    }
}

static bool do_numbers_rise(const uint32_t *list, size_t count)
{
    bool do_all = true;
    for (size_t n = 1; n < count; n++)
        do_all &= list[n - 1] <= list[n];
    return do_all;
}

tribox_status tribox_brick_lists_of_tile(tribox_bricks_call *s, size_t number, const uint32_t *list, size_t count)
{
    const tribox_window tile = tribox_brick_tile_window(&s->tiling, number);
    tribox_tiling bricks = {.side = BRICK, .tiles = tribox_tile_count(tile.size, BRICK)};
    part p = {.call = s, .list = list, .listed = count, .is_rising = do_numbers_rise(list, count)};
    tribox_status status = TRIBOX_OK;
    size_t most = TRIBOX_PART_BRICKS;
    for (int a = 0; a < 3; a++)
        bricks.along[a] = (tile.size[a] + BRICK - 1) / BRICK;
    while (!status && bricks.first < bricks.tiles) {
        bricks.end = bricks.tiles - bricks.first < most ? bricks.tiles : bricks.first + most;
        cut_part(&p, &bricks, &tile);
        const size_t cut = (size_t)(p.bricks.tiles[0] * p.bricks.tiles[1] * p.bricks.tiles[2]);
        const size_t undecided = voxelize_part(&p, NULL);
        if (p.is_full && cut > 1) {
            most = cut / 2;
            continue;
        }
        s->counts.undecided += undecided;
        status = p.is_full ? emit_crowded(&p) : emit_pieces(&p, cut);
        bricks.first += cut;
    }
    return status;
}
