#include "id_case.h"

#include <stdlib.h>
#include <string.h>

#include "common/guard.h"

static size_t row_words(const id_case *c) { return (c->at.size[0] + 63) / 64; }
size_t id_case_words(const id_case *c) { return row_words(c) * c->at.size[1] * c->at.size[2]; }
static size_t cells_of(const id_case *c) { return (size_t)c->at.size[0] * c->at.size[1] * c->at.size[2]; }

static bool is_set(const id_case *c, const uint64_t *occupied, size_t cell)
{
    const size_t row = cell / c->at.size[0], i = cell % c->at.size[0];
    return occupied[row * row_words(c) + i / 64] >> i % 64 & 1;
}

void id_case_open(id_case *c, const tribox_window *at)
{
    c->at = *at;
    assert_true(cells_of(c) <= ID_CELLS);
    for (size_t n = 0; n < cells_of(c); n++)
        c->expected[n] = ID_NONE;
}

void id_case_expect(id_case *c, const uint64_t *occupied, int64_t t)
{
    for (size_t n = 0; n < cells_of(c); n++)
        if (c->expected[n] == ID_NONE && is_set(c, occupied, n))
            c->expected[n] = t;
}

/* One to three parts, cut anywhere; the second may come before the first. */
static void ask_in_parts(random_source *r, size_t count, uint32_t first, id_call *ask, void *data, uint64_t *occupied,
                         uint32_t *ids, size_t *set)
{
    size_t cut[4] = {0, (size_t)random_int(r, (int)count + 1), count, count};
    const int parts = random_int_between(r, 1, 2), from = random_int(r, 2);
    cut[1] = parts == 1 ? count : cut[1];
    *set = 0;
    for (int n = 0; n < parts; n++) {
        const int part = (n + from) % parts;
        tribox_report report;
        assert_int_equal(ask(data, cut[part], cut[part + 1], first + (uint32_t)cut[part], occupied, ids, &report), TRIBOX_OK);
        *set += report.overlapping;
    }
}

static void check_cells(const id_case *c, uint32_t first, const uint64_t *occupied, const uint32_t *ids, const uint32_t *before,
                        size_t set)
{
    size_t expected = 0;
    for (size_t n = 0; n < cells_of(c); n++) {
        const bool is_expected = c->expected[n] != ID_NONE;
        const uint32_t id = is_expected ? first + (uint32_t)c->expected[n] : before[n];
        expected += is_expected;
        if (is_set(c, occupied, n) != is_expected || ids[n] != id)
            fail_msg("%s: cell %zu of window %u x %u x %u is %s with %u where %lld and %u are expected, first %u", doing, n,
                     (unsigned)c->at.size[0], (unsigned)c->at.size[1], (unsigned)c->at.size[2],
                     is_set(c, occupied, n) ? "set" : "clear", (unsigned)ids[n], (long long)c->expected[n], (unsigned)id,
                     (unsigned)first);
    }
    assert_int_equal(set, expected);
}

void id_case_check(const id_case *c, random_source *r, size_t count, id_call *ask, void *data)
{
    const size_t bytes = cells_of(c) * sizeof(uint32_t);
    const guarded g = guarded_make(bytes + 1);
    uint32_t *const ids = guarded_tail(g, bytes), *const before = malloc(bytes + 1), poison = (uint32_t)random_bits(r);
    uint64_t *const occupied = calloc(id_case_words(c) + 1, sizeof *occupied);
    const int kind = random_int(r, 4);
    const uint32_t last = UINT32_MAX - (uint32_t)count, first = random_int(r, 2) ? 0 : random_int(r, 2) ? last : poison % last;
    size_t set;
    assert_non_null(before);
    assert_non_null(occupied);
    for (size_t n = 0; n < cells_of(c); n++)
        ids[n] = before[n] = kind == 0 ? 0 : kind == 1 ? UINT32_MAX : kind == 2 ? first : (uint32_t)random_bits(r);
    ask_in_parts(r, count, first, ask, data, occupied, ids, &set);
    check_cells(c, first, occupied, ids, before, set);
    free(occupied);
    free(before);
    guarded_free(g);
}
