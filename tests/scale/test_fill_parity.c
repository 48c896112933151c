/* test_fill_parity.c - what is filled are the cells whose middles have an odd number of crossings below them, by integers. */
#include "common/harness.h"
#include "common/float_environment.h"
#include "fill_case.h"

enum { PAIRS = 100000, ROUNDS = 150 };

static fill_case drawn;
static bool is_inside[ORACLE_CELLS], is_odd[ORACLE_CELLS];

/* The answer of the library, between pages that cannot be touched. */
typedef struct answer {
    uint64_t solid[CASE_WORDS_MAX];
    size_t inside, odd_rows;
} answer;

static void ask(const fill_case *c, const uint64_t *occupied, answer *a)
{
    const size_t bytes = fill_case_words(c) * sizeof *a->solid, scratch_bytes = tribox_fill_bytes(fill_case_size(c));
    const guarded solid = guarded_make(bytes), walls = guarded_make(bytes), scratch = guarded_make(scratch_bytes);
    memset(solid.first, 0xa5, solid.size);
    memset(scratch.first, 0x5a, scratch.size);
    memcpy(guarded_tail(walls, bytes), occupied, bytes);
    guarded_read_only(walls, true);
    const fill_mesh mesh = fill_mesh_make(c);
    assert_int_equal(fill_case_parity(c, &mesh, guarded_tail(walls, bytes), guarded_tail(solid, bytes),
                                      guarded_tail(scratch, scratch_bytes), &a->inside, &a->odd_rows),
                     TRIBOX_OK);
    memcpy(a->solid, guarded_tail(solid, bytes), bytes);
    fill_mesh_free(mesh);
    guarded_free(solid);
    guarded_free(walls);
    guarded_free(scratch);
}

static bool bit(const fill_case *c, const uint64_t *words, size_t row, uint32_t i)
{
    return words[row * ((c->at.size[0] + 63) / 64) + i / 64] >> i % 64 & 1;
}

static size_t rows_of(const fill_case *c) { return (size_t)c->at.size[1] * c->at.size[2]; }

static void check_answer(const fill_case *c, const uint64_t *occupied, const answer *a)
{
    size_t inside = 0, odd = 0;
    const uint32_t end = (c->at.size[0] + 63) / 64 * 64;
    for (size_t row = 0; row < rows_of(c); row++) {
        odd += is_odd[row];
        for (uint32_t i = 0; i < end; i++) {
            const bool is_cell = i < c->at.size[0], is_wall = is_cell && bit(c, occupied, row, i);
            const bool is_filled = is_cell && !is_wall && is_inside[row * c->at.size[0] + i];
            inside += is_filled;
            if (bit(c, a->solid, row, i) != (is_wall || is_filled))
                fail_msg("%s: cell %u of row %zu is %s", doing, i, row, bit(c, a->solid, row, i) ? "filled" : "not filled");
        }
    }
    if (a->inside != inside || a->odd_rows != odd)
        fail_msg("%s: %zu inside and %zu odd rows, not %zu and %zu", doing, inside, odd, a->inside, a->odd_rows);
}

/* Free cells that share a face are both inside or both outside a closed mesh. */
static void check_regions(const fill_case *c)
{
    const size_t step[3] = {1, c->at.size[0], (size_t)c->at.size[0] * c->at.size[1]};
    for (uint32_t k = 0; k < c->at.size[2]; k++)
        for (uint32_t j = 0; j < c->at.size[1]; j++)
            for (uint32_t i = 0; i < c->at.size[0]; i++) {
                const uint32_t at[3] = {i, j, k};
                const size_t row = (size_t)k * c->at.size[1] + j, rows[3] = {row, row + 1, row + c->at.size[1]};
                for (int a = 0; a < 3; a++)
                    if (at[a] + 1 < c->at.size[a] && !bit(c, c->occupied, row, i) && !bit(c, c->occupied, rows[a], i + !a) &&
                        is_inside[row * c->at.size[0] + i] != is_inside[row * c->at.size[0] + i + step[a]])
                        fail_msg("%s: free cells part at %u, %u, %u", doing, i, j, k);
            }
}

/* What parity fills of a closed mesh in the grid is not reached from outside; what else is not, pockets, is on no border. */
static void check_both_ways(const fill_case *c, const answer *parity)
{
    uint64_t flood[CASE_WORDS_MAX], scratch[2 * ORACLE_CELLS / 64 + 3];
    assert_int_equal(tribox_fill_outside(fill_case_size(c), c->occupied, scratch, flood, NULL), TRIBOX_OK);
    for (size_t row = 0; row < rows_of(c); row++)
        for (uint32_t i = 0; i < c->at.size[0]; i++) {
            const bool is_flood = bit(c, flood, row, i), is_parity = bit(c, parity->solid, row, i);
            if (is_parity && !is_flood)
                fail_msg("%s: cell %u of row %zu is inside, but reached from outside", doing, i, row);
            const uint32_t j = (uint32_t)(row % c->at.size[1]), k = (uint32_t)(row / c->at.size[1]);
            if (is_flood && !is_parity &&
                (!i || !j || !k || i + 1 == c->at.size[0] || j + 1 == c->at.size[1] || k + 1 == c->at.size[2]))
                fail_msg("%s: cell %u of row %zu is filled on the border", doing, i, row);
        }
}

static void draw_case(random_source *r, size_t round)
{
    fill_case_draw(r, round % fill_case_scenes(), &drawn);
    snprintf(doing, sizeof doing, "round %zu: %s, %d triangles, %s%s", round, drawn.scene, drawn.at.count, drawn.body,
             drawn.is_closed ? "" : ", open");
}

CASE(test_crossings)
{
    static const uint64_t none[CASE_WORDS_MAX];
    static answer first, other;
    random_source r = random_named(args.seed, "fill parity");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS) / (arguments_are_short(&args) ? 10 : 1); round++) {
        draw_case(&r, round);
        crossing_oracle(&drawn.at, is_inside, is_odd);
        ask(&drawn, drawn.occupied, &first);
        check_answer(&drawn, drawn.occupied, &first);
        if (drawn.is_closed) {
            assert_int_equal(first.odd_rows, 0);
            check_regions(&drawn);
            if (drawn.is_within)
                check_both_ways(&drawn, &first);
        }
        fill_case_shuffle(&r, &drawn);
        ask(&drawn, none, &other);
        check_answer(&drawn, none, &other);
    }
}

PROGRAM(RUN(test_crossings))
