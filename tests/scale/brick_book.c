#include "brick_book.h"

#include "common/float_environment.h"

brick_book brick_book_open(const tile_case *c, uint64_t *occupied)
{
    return (brick_book){
        .size = tile_case_size(c), .tile = c->tile, .occupied = occupied, .most = SIZE_MAX, .environment = environment_get()};
}

static uint64_t tile_of(const brick_book *b, const uint32_t at[3])
{
    uint64_t tile = 0;
    for (int a = 2; a >= 0; a--)
        tile = tile * ((b->size[a] + b->tile - 1) / b->tile) + 8 * (uint64_t)at[a] / b->tile;
    return tile;
}

static void check_order(brick_book *b, const uint32_t at[3])
{
    const uint64_t place[4] = {tile_of(b, at), at[2], at[1], at[0]};
    int n = 0;
    while (n < 3 && place[n] == b->last[n])
        n++;
    assert_true(!b->bricks || place[n] > b->last[n]);
    memcpy(b->last, place, sizeof place);
}

static void take_cell(brick_book *b, const uint64_t cell[3])
{
    for (int a = 0; a < 3; a++)
        assert_true(cell[a] < b->size[a]);
    b->cells++;
    if (b->occupied)
        b->occupied[(cell[2] * b->size[1] + cell[1]) * tribox_mask_words(b->size[0]) + cell[0] / 64] |= UINT64_C(1) << cell[0] % 64;
}

int brick_book_take(void *book, const uint32_t at[3], const uint64_t bits[8])
{
    brick_book *const b = book;
    const size_t before = b->cells;
    assert_int_equal(environment_get(), b->environment);
    assert_true(b->bricks < b->most);
    check_order(b, at);
    for (uint64_t k = 0; k < 8; k++)
        for (uint64_t n = 0; n < 64; n++)
            if (bits[k] >> n & 1)
                take_cell(b, (uint64_t[3]){8 * (uint64_t)at[0] + n % 8, 8 * (uint64_t)at[1] + n / 8, 8 * (uint64_t)at[2] + k});
    assert_true(b->cells > before);
    return ++b->bricks >= b->most;
}
