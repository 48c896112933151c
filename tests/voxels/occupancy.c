#include "occupancy.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cell_oracle.h"

static const double band_of_cell = 0x1p-7, band_of_distance = 0x1p-40, band_of_planes = 4;

uint64_t *occupancy_make(size_t words)
{
    uint64_t *const occupied = calloc(words ? words : 1, sizeof *occupied);
    assert_non_null(occupied);
    return occupied;
}

size_t occupancy_count(const uint64_t *occupied, size_t words)
{
    size_t count = 0;
    for (size_t w = 0; w < words; w++)
        count += (size_t)__builtin_popcountll(occupied[w]);
    return count;
}

static bool range_of(const grid_planes *l, const float u[3][3], unsigned axes, int first[3], int last[3])
{
    for (int a = 0; a < 3; a++) {
        const int size = (int)l->grid.size[a];
        first[a] = 0;
        last[a] = size - 1;
        if (!(axes & TRIBOX_AXES_BOX))
            continue;
        const float least = fminf(fminf(u[0][a], u[1][a]), u[2][a]), most = fmaxf(fmaxf(u[0][a], u[1][a]), u[2][a]);
        grid_planes_range(l, a, least, most, &first[a], &last[a]);
        if (first[a] > last[a])
            return false;
        first[a] -= first[a] > 0;
        last[a] += last[a] < size - 1;
    }
    return true;
}

size_t occupancy_cost(const grid_planes *l, const float u[3][3], unsigned axes)
{
    int first[3], last[3];
    size_t cost = range_of(l, u, axes, first, last);
    for (int a = 0; cost && a < 3; a++)
        cost *= (size_t)(last[a] - first[a] + 1);
    return cost;
}

size_t occupancy_add(const grid_planes *l, const float u[3][3], unsigned axes, uint64_t *occupied)
{
    int first[3], last[3];
    if (!range_of(l, u, axes, first, last))
        return 0;
    const cell_oracle t = cell_oracle_make(u);
    for (int k = first[2]; k <= last[2]; k++)
        for (int j = first[1]; j <= last[1]; j++)
            for (int i = first[0]; i <= last[0]; i++) {
                const tribox_box cell = grid_planes_cell(l, i, j, k);
                if (cell_oracle_overlaps(&t, &cell, axes))
                    grid_planes_set(l, occupied, i, j, k);
            }
    return occupancy_cost(l, u, axes);
}

static unsigned axes_of(const request *q) { return q->options.axes ? q->options.axes : TRIBOX_AXES_ALL; }

static void check_row_ends(const grid_planes *l, const uint64_t *occupied)
{
    const unsigned used = l->grid.size[0] % 64;
    for (size_t w = l->row_words - 1; used && w < l->words; w += l->row_words)
        if (occupied[w] >> used)
            fail_msg("bits past the end of the row at word %zu are set", w);
}

/* A mesh of the same floats has the same bits at every accuracy, and EXACT one of doubles. */
static void check_meshes(const request *q, size_t first, size_t count, const uint64_t *expected)
{
    static float floats[TRIANGLE_LIST_MAX][3][3];
    static double doubles[TRIANGLE_LIST_MAX][3][3];
    uint64_t *const occupied = occupancy_make(q->at->words);
    for (size_t t = 0; t < count; t++) {
        triangle_list_get(q->triangles, first + t, floats[t]);
        for (int n = 0; n < 9; n++)
            doubles[t][n / 3][n % 3] = floats[t][n / 3][n % 3];
    }
    for (unsigned bytes = 4; bytes <= 8; bytes += 4) {
        const void *const positions = bytes == 8 ? (const void *)doubles : floats;
        const tribox_mesh mesh = {.positions = positions, .vertices = 3 * count, .count = count, .position_bytes = bytes};
        if (bytes == 8 && q->options.accuracy != TRIBOX_EXACT)
            continue;
        memset(occupied, 0, q->at->words * sizeof *occupied);
        assert_int_equal(tribox_mesh_voxelize(&mesh, &q->at->grid, NULL, &q->options, occupied, NULL), TRIBOX_OK);
        if (memcmp(occupied, expected, q->at->words * sizeof *occupied))
            fail_msg("%s: a mesh of %u bytes a number has other bits than its soup; seed %" PRIu64, q->scene, bytes, q->seed);
    }
    free(occupied);
}

void request_ask(const request *q, size_t first, size_t count, uint64_t *occupied)
{
    static const int as_they_are[3] = {0, 1, 2};
    const tribox_soup soup = triangle_list_part(q->triangles, first, count, as_they_are);
    tribox_report report = {SIZE_MAX, SIZE_MAX};
    memset(occupied, 0, q->at->words * sizeof *occupied);
    assert_int_equal(tribox_voxelize(&soup, &q->at->grid, NULL, &q->options, occupied, &report), TRIBOX_OK);
    assert_int_equal(report.overlapping, occupancy_count(occupied, q->at->words));
    check_row_ends(q->at, occupied);
    check_meshes(q, first, count, occupied);
}

/* The triangle that alone makes the oracle and the library differ about the cell, or else the last of them. */
static size_t culprit(const request *q, size_t first, size_t count, int i, int j, int k)
{
    const tribox_box cell = grid_planes_cell(q->at, i, j, k);
    uint64_t *const alone = occupancy_make(q->at->words);
    size_t t = first;
    for (; t + 1 < first + count; t++) {
        float u[3][3];
        triangle_list_get(q->triangles, t, u);
        const cell_oracle triangle = cell_oracle_make((const_vertices)u);
        request_ask(q, t, 1, alone);
        if (grid_planes_bit(q->at, alone, i, j, k) != cell_oracle_overlaps(&triangle, &cell, axes_of(q)))
            break;
    }
    free(alone);
    return t;
}

static void fail_cell(const request *q, size_t first, size_t count, const int cell[3], bool answer, const char *why)
{
    static const char *const accuracy[] = {"EXACT", "CONSERVATIVE", "FAST"};
    const size_t t = culprit(q, first, count, cell[0], cell[1], cell[2]);
    pair_f32 pair = {.box = grid_planes_cell(q->at, cell[0], cell[1], cell[2])};
    triangle_list_get(q->triangles, t, pair.u);
    fprintf(stderr, "tribox_voxelize %s cell %d %d %d: %s\n", answer ? "sets" : "does not set", cell[0], cell[1], cell[2], why);
    fprintf(stderr, "  scene %s, seed %" PRIu64 ", triangle %zu of %zu, %s, axes %u, kernel %s\n", q->scene, q->seed, t, count,
            accuracy[q->options.accuracy], axes_of(q), q->options.kernel ? q->options.kernel : "of the library's choice");
    grid_planes_print(stderr, &q->at->grid);
    oracle_explain(stderr, &pair);
    fail_msg("a cell of scene %s is wrong", q->scene);
}

/* The next bit that differs, from *word on; false if there is none. */
static bool next_difference(const grid_planes *l, const uint64_t *a, const uint64_t *b, size_t *word, uint64_t *seen, int cell[3])
{
    for (; *word < l->words; ++*word, *seen = 0) {
        const uint64_t rest = (a[*word] ^ b[*word]) & ~*seen;
        if (!rest)
            continue;
        const size_t row = *word / l->row_words;
        const int bit = __builtin_ctzll(rest);
        *seen |= UINT64_C(1) << bit;
        cell[0] = (int)(*word % l->row_words) * 64 + bit;
        cell[1] = (int)(row % l->grid.size[1]);
        cell[2] = (int)(row / l->grid.size[1]);
        return true;
    }
    return false;
}

void request_check_exact(const request *q, size_t first, size_t count, const uint64_t *expected, const uint64_t *occupied)
{
    size_t word = 0;
    uint64_t seen = 0;
    int cell[3];
    if (next_difference(q->at, expected, occupied, &word, &seen, cell))
        fail_cell(q, first, count, cell, grid_planes_bit(q->at, occupied, cell[0], cell[1], cell[2]), "the oracle says otherwise");
}

/* At least the spacing of floats at a number. */
static double spacing_at(double number) { return 0x1p-23 * number + 0x1p-149; }

static void set_band(const grid_planes *l, const tribox_box *cell, const float u[3][3], double band[3])
{
    for (int a = 0; a < 3; a++) {
        const double lo = cell->lo[a], hi = cell->hi[a];
        const double farthest = fmax(fabs((double)l->plane[a][0]), fabs((double)l->plane[a][l->grid.size[a]]));
        double distance = 0;
        for (int j = 0; j < 3; j++)
            distance = fmax(distance, fmax(fabs(u[j][a] - lo), fabs(u[j][a] - hi)));
        band[a] = band_of_cell * (hi - lo) + band_of_distance * distance + band_of_planes * spacing_at(farthest);
    }
}

/* Whether some triangle excuses that the cell is set, or all that overlap it that it is not. */
static bool is_excused(const request *q, const int cell[3], bool answer)
{
    const tribox_box box = grid_planes_cell(q->at, cell[0], cell[1], cell[2]);
    for (size_t t = 0; t < q->triangles->count; t++) {
        float u[3][3];
        double band[3];
        triangle_list_get(q->triangles, t, u);
        set_band(q->at, &box, (const_vertices)u, band);
        const cell_oracle triangle = cell_oracle_make((const_vertices)u);
        if (!answer && !cell_oracle_overlaps(&triangle, &box, axes_of(q)))
            continue;
        if (cell_oracle_errs_within(&triangle, &box, axes_of(q), band, answer) == answer)
            return answer;
    }
    return !answer;
}

void request_check_band(const request *q, const uint64_t *exact, const uint64_t *occupied, tally *count)
{
    size_t word = 0;
    uint64_t seen = 0;
    int cell[3];
    count->asked += occupancy_count(exact, q->at->words);
    while (next_difference(q->at, exact, occupied, &word, &seen, cell)) {
        const bool is_missed = grid_planes_bit(q->at, exact, cell[0], cell[1], cell[2]);
        count->missed += is_missed;
        count->extra += !is_missed;
        if (is_missed && q->options.accuracy == TRIBOX_CONSERVATIVE)
            fail_cell(q, 0, q->triangles->count, cell, false, "CONSERVATIVE never misses");
        if (!is_excused(q, cell, !is_missed))
            fail_cell(q, 0, q->triangles->count, cell, !is_missed, "that is farther from contact than the stated band");
    }
}
