/*
 * test_embree.c - pairs and voxels of every kernel and accuracy against rays, on integers: there the rays need no tolerance, and no
 * accuracy may err, as what separates does so by more than any bound.
 */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "common/ask.h"

#include "common/arguments.h"
#include "witness.h"

enum {
    SKIPPED = 77,
    LIBRARIES_MAX = 3 * KERNELS_MAX,
    CELLS_ASKED = 48 /* with tribox_overlap */
};

/* What a data set is checked with. */
typedef struct check {
    const char *name;
    const model *model;
    planes planes;
    witness witness;
    tribox_soup soup;
    origin libraries[LIBRARIES_MAX]; /* each kernel at each accuracy, EXACT first */
    int count;
    uint64_t *occupied, *voxels; /* the union of EXACT's pairs, and what voxelization says */
    size_t words, candidates, pairs;
    random_source r;
} check;

/* A pair of which the rays say otherwise. */
static void breach(const check *c, const origin *l, size_t t, const int cell[3], bool answer)
{
    const tribox_box box = planes_cell(&c->planes, cell);
    const pair_f64 pair = pair_of_floats(&c->model->triangles[t].u[0][0], &box);
    const bool is_right = answer == oracle_overlaps(oracle_separating(&pair), TRIBOX_AXES_ALL);
    fprintf(stderr, "a ray says otherwise, and the oracle sides with the %s\n", is_right ? "library" : "ray");
    fail_pair(l, &pair, answer);
}

static void compare_pair(const check *c, const origin *l, size_t t, const int cell[3], bool answer)
{
    const block *const candidates = &c->witness.candidates[t];
    const size_t number = block_number(candidates, cell);
    const bool is_met = number < block_cells(candidates) && bit_of(c->witness.met, 64 * c->witness.first_word[t] + number);
    if (answer != is_met)
        breach(c, l, t, cell, answer);
}

/* One triangle and the cells that it may meet. */
static void ask_triangle(check *c, size_t t)
{
    const block *const candidates = &c->witness.candidates[t];
    const triangle *const u = &c->model->triangles[t];
    const size_t count = block_cells(candidates);
    float *const bounds = memory_of(6 * count, sizeof *bounds);
    uint64_t *const mask = memory_of(tribox_mask_words(count), sizeof *mask);
    tribox_boxes boxes = {.count = count};
    int cell[3];
    for (int k = 0; k < 6; k++)
        (k < 3 ? boxes.lo : boxes.hi)[k % 3] = bounds + (size_t)k * count;
    for (size_t n = 0; n < count; n++) {
        block_cell(candidates, n, cell);
        for (int k = 0; k < 6; k++)
            bounds[(size_t)k * count + n] = (float)c->planes.at[k % 3][cell[k % 3] + k / 3];
    }
    for (int k = 0; k < c->count; k++) {
        origin *const l = &c->libraries[k];
        l->function = "tribox_overlap_boxes";
        ask_boxes(u->u[0], &boxes, &l->options, mask);
        for (size_t n = 0; n < count; n++) {
            block_cell(candidates, n, cell);
            compare_pair(c, l, t, cell, bit_of(mask, n));
            if (!k && bit_of(mask, n)) {
                const size_t bit = planes_bit(&c->planes, cell);
                c->occupied[bit / 64] |= UINT64_C(1) << bit % 64;
                c->pairs++;
            }
        }
    }
    c->candidates += count;
    free(bounds);
    free(mask);
}

/* The same pairs with the loops exchanged: all triangles against one cell. */
static void ask_cell(check *c, uint64_t *mask)
{
    int cell[3];
    for (int a = 0; a < 3; a++)
        cell[a] = random_int(&c->r, (int)c->planes.grid.size[a]);
    const tribox_box box = planes_cell(&c->planes, cell);
    for (int k = 0; k < c->count; k++) {
        c->libraries[k].function = "tribox_overlap";
        ask_soup(&c->soup, &box, &c->libraries[k].options, mask);
        for (size_t t = 0; t < c->model->count; t++)
            compare_pair(c, &c->libraries[k], t, cell, bit_of(mask, t));
    }
}

/* EXACT voxels are the union of the pairs, bit for bit; CONSERVATIVE ones hold it. */
static void check_voxels(check *c, const origin *l)
{
    const tribox_options *const o = &l->options;
    uint64_t *const voxels = c->voxels;
    memset(voxels, 0, c->words * sizeof *voxels);
    assert_int_equal(tribox_voxelize(&c->soup, &c->planes.grid, NULL, o, voxels, NULL), TRIBOX_OK);
    for (size_t k = 0; k < c->words && o->accuracy != TRIBOX_FAST; k++) {
        const uint64_t missing = c->occupied[k] & ~voxels[k], extra = voxels[k] & ~c->occupied[k];
        if (missing || (extra && o->accuracy == TRIBOX_EXACT))
            fail_msg("%s: voxels of kernel %s, accuracy %d: word %zu is not the union of the pairs: missing %" PRIx64
                     ", too many %" PRIx64,
                     c->name, o->kernel, (int)o->accuracy, k, missing, extra);
    }
}

static void check_counts(const check *c)
{
    const witness *const w = &c->witness;
    printf("%-28s %zu triangles, %zu of %zu candidates overlap; rays: %zu hits, %zu edges\n", c->name, c->model->count, c->pairs,
           c->candidates, w->hits, w->edges);
    fflush(stdout);
    assert_int_equal(w->strays, 0);
    assert_true(c->pairs > 0);
}

static void check_data_set(const char *name, const model *m, const tribox_grid *grid, uint64_t seed)
{
    check c = {.name = name, .model = m, .r = random_named(seed, name), .words = tribox_window_words(grid->size)};
    const char *kernels[KERNELS_MAX];
    const int kernel_count = kernels_here(kernels);
    for (; c.count < 3 * kernel_count; c.count++)
        c.libraries[c.count] =
            (origin){.scene = name,
                     .seed = seed,
                     .options = {.accuracy = (tribox_accuracy)(c.count / kernel_count), .kernel = kernels[c.count % kernel_count]}};
    planes_make(&c.planes, grid);
    c.witness = witness_make(&c.planes, m);
    float *const rows = model_soup(m, &c.soup);
    c.occupied = memory_of(c.words, sizeof *c.occupied);
    c.voxels = memory_of(c.words, sizeof *c.voxels);
    uint64_t *const mask = memory_of(tribox_mask_words(m->count), sizeof *mask);
    for (size_t t = 0; t < m->count; t++)
        ask_triangle(&c, t);
    for (int k = 0; k < CELLS_ASKED; k++)
        ask_cell(&c, mask);
    for (int k = 0; k < c.count; k++)
        check_voxels(&c, &c.libraries[k]);
    check_counts(&c);
    free(mask);
    free(c.occupied);
    free(c.voxels);
    free(rows);
    witness_free(&c.witness);
}

/* Vertices are integers from 0 to 63, planes lie at multiples of 1, 2 and 4. */
enum { EXTENT = 64, COARSEST = 4 };
static const struct integers {
    const char *name;
    shape shape;
    size_t count;
    double size, scale, shift;
} integers[] = {
    {"soup", SOUP, 600, 2, 31.5, 31.5},
    {"soup within 8", SOUP, 8000, 2.0 * 8 / 63, 31.5, 31.5},
    {"soup within 2", SOUP, 8000, 2.0 * 2 / 63, 31.5, 31.5},
    {"icosphere", ICOSPHERE, 0, 0, 28, 32},
    {"torus", TORUS, 0, 8.0 / 28, 28, 32},
    {"cube", CUBE, 0, 0, 16, 32},
};

static void check_integers(const struct integers *from, double shift, const int h[3], uint64_t seed)
{
    char name[64];
    tribox_grid grid;
    (void)snprintf(name, sizeof name, "%s + %g, %d %d %d", from->name, shift, h[0], h[1], h[2]);
    random_source r = random_named(seed, from->name);
    model m = model_make(from->shape, from->count, from->size, &r);
    model_place(&m, from->scale, from->shift);
    model_snap(&m);
    model_place(&m, 1, shift);
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = shift;
        grid.cell[a] = h[a];
        grid.size[a] = (uint32_t)(EXTENT / h[a]);
    }
    check_data_set(name, &m, &grid, seed);
    free(m.triangles);
}

static void check_all(const arguments *args, double shift)
{
    for (size_t k = 0; k < sizeof integers / sizeof integers[0]; k++) {
        for (int h = arguments_are_short(args) ? 2 : 1; h <= COARSEST; h *= 2)
            check_integers(&integers[k], shift, (const int[3]){h, h, h}, args->seed);
        check_integers(&integers[k], shift, (const int[3]){1, 4, 2}, args->seed);
    }
}

static void test_integers(void **state) { check_all(*state, 0); }
static void test_shifted_integers(void **state) { check_all(*state, 0x1p20); }

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    if (!witness_is_usable())
        return SKIPPED;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_integers, &args),
                                       cmocka_unit_test_prestate(test_shifted_integers, &args)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
