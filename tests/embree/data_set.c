#include "data_set.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "common/ask.h"

#include "compare.h"
#include "contact_margin.h"
#include "zeroed.h"

enum {
    ACCURACIES = 3,
    LIBRARIES_MAX = ACCURACIES * KERNELS_MAX,
    CELLS_ASKED = 48, /* with tribox_overlap */
    DISPUTES_MAX = 2  /* pairs of a data set that this test's own rounding gets wrong; none was ever seen */
};

/* The library as an answerer. */
typedef struct library {
    answerer base;
    origin where;
    bool is_exact_data;
    uint64_t *agreed; /* what the first of them answered about the triangle at hand */
    bool is_first;
    size_t disputes; /* breaches in which the exact oracle sides with the library */
} library;

/* What a data set is checked with. */
typedef struct check {
    const data_set *d;
    grid_planes planes;
    witness witness;
    streams streams;
    library libraries[LIBRARIES_MAX]; /* EXACT first */
    int count, kernels;
    uint64_t *agreed;
    uint64_t *occupied, *voxels; /* the union of EXACT's pairs, and what voxelization says */
    size_t words;
    random_source r;
} check;

static library *library_of(answerer *self) { return (library *)(void *)self; }

static void library_answer(answerer *self, size_t t, const triangle *u, const tribox_boxes *boxes, uint64_t *mask)
{
    library *const l = library_of(self);
    const size_t size = tribox_mask_words(boxes->count) * sizeof *mask;
    ask_boxes(u->u, boxes, &l->where.options, mask);
    if (l->is_first)
        memcpy(l->agreed, mask, size);
    else if (l->where.options.accuracy == TRIBOX_EXACT && memcmp(l->agreed, mask, size) != 0)
        fail_msg("%s: kernel %s answers EXACT otherwise than the first for triangle %zu", l->where.scene, l->where.options.kernel,
                 t);
}

/* What FAST may get wrong where coordinates round, as a part of the largest of them. */
static const double fast_gap = 0x1p-22;

static bool is_forgiven(const library *l, const pair_f32 *pair, bool answer)
{
    switch (l->where.options.accuracy) {
    case TRIBOX_CONSERVATIVE:
        return answer && margin_is_conservative(pair);
    case TRIBOX_FAST:
        return !l->is_exact_data && fabs(margin_gap(pair)) <= fast_gap * margin_largest(pair);
    default:
        return false;
    }
}

static void library_breach(answerer *self, const pair_f32 *pair, bool answer)
{
    library *const l = library_of(self);
    const bool is_right = answer == oracle_overlaps(oracle_separating(pair), TRIBOX_AXES_ALL);
    if (is_right ? l->is_exact_data : !is_forgiven(l, pair, answer)) {
        fprintf(stderr, "a ray says otherwise, and the oracle sides with the %s; gap %g\n", is_right ? "library" : "ray",
                margin_gap(pair));
        fail_pair(&l->where, pair, answer);
    }
    l->disputes += is_right;
}

static size_t most_words(const witness *w)
{
    size_t most = 0;
    for (size_t t = 0; t < w->model->count; t++)
        most = w->first_word[t + 1] - w->first_word[t] > most ? w->first_word[t + 1] - w->first_word[t] : most;
    return most;
}

static void make_libraries(check *c, uint64_t seed)
{
    const char *kernels[KERNELS_MAX];
    c->kernels = kernels_here(kernels);
    c->agreed = memory_of(most_words(&c->witness), sizeof *c->agreed);
    for (int accuracy = 0; accuracy < ACCURACIES; accuracy++)
        for (int kernel = 0; kernel < c->kernels; kernel++) {
            const tribox_options options = {.accuracy = (tribox_accuracy)accuracy, .kernel = kernels[kernel]};
            c->libraries[c->count] = (library){.base = {.answer = library_answer, .breach = library_breach},
                                               .where = {.scene = c->d->name, .seed = seed, .options = options},
                                               .is_exact_data = c->d->is_exact,
                                               .agreed = c->agreed,
                                               .is_first = c->count == 0};
            c->count++;
        }
}

static size_t ask_pairs(check *c)
{
    answerer *answerers[LIBRARIES_MAX];
    for (int k = 0; k < c->count; k++) {
        c->libraries[k].where.function = "tribox_overlap_boxes";
        answerers[k] = &c->libraries[k].base;
    }
    return compare(&c->witness, answerers, c->count, c->occupied);
}

/* The same pairs with the loops exchanged: all triangles against one cell. */
static void ask_cell(check *c, library *l, const int cell[3], uint64_t *mask)
{
    const tribox_box box = grid_planes_cell(&c->planes, cell[0], cell[1], cell[2]);
    l->where.function = "tribox_overlap";
    ask_soup(&c->streams.soup, &box, &l->where.options, mask);
    for (size_t t = 0; t < c->d->model.count; t++)
        compare_pair(&c->witness, &l->base, t, cell, bit_of(mask, t));
}

static void ask_cells(check *c)
{
    uint64_t *const mask = memory_of(tribox_mask_words(c->d->model.count), sizeof *mask);
    for (int k = 0; k < CELLS_ASKED; k++) {
        int cell[3];
        for (int a = 0; a < 3; a++)
            cell[a] = random_int(&c->r, (int)c->planes.grid.size[a]);
        for (int i = 0; i < c->count; i++)
            ask_cell(c, &c->libraries[i], cell, mask);
    }
    free(mask);
}

/* In two pieces, of which one may be empty. */
static void voxelize(check *c, const tribox_options *options)
{
    const uint32_t layers = c->d->grid.size[2], below = (uint32_t)random_int(&c->r, (int)layers + 1);
    uint64_t *const upper = c->voxels + c->words / layers * below;
    memset(c->voxels, 0, c->words * sizeof *c->voxels);
    assert_int_equal(tribox_voxelize(&c->streams.soup, &c->d->grid,
                                     &(tribox_window){{0, 0, 0}, {c->d->grid.size[0], c->d->grid.size[1], below}}, options,
                                     c->voxels, NULL),
                     TRIBOX_OK);
    assert_int_equal(tribox_voxelize(&c->streams.soup, &c->d->grid,
                                     &(tribox_window){{0, 0, below}, {c->d->grid.size[0], c->d->grid.size[1], layers - below}},
                                     options, upper, NULL),
                     TRIBOX_OK);
    tribox_report report;
    assert_int_equal(tribox_voxelize(&c->streams.soup, &c->d->grid, NULL, options, c->voxels, &report), TRIBOX_OK);
    assert_int_equal(report.overlapping, 0);
}

/* EXACT voxels are the union of the pairs, bit for bit; CONSERVATIVE ones hold it. */
static void check_voxels(check *c, const library *l)
{
    const tribox_accuracy accuracy = l->where.options.accuracy;
    voxelize(c, &l->where.options);
    for (size_t k = 0; k < c->words && accuracy != TRIBOX_FAST; k++) {
        const uint64_t missing = c->occupied[k] & ~c->voxels[k], extra = c->voxels[k] & ~c->occupied[k];
        if (missing || (extra && accuracy == TRIBOX_EXACT))
            fail_msg("%s: tribox_voxelize with kernel %s, accuracy %d: word %zu is not the union of the pairs: missing %" PRIx64
                     ", too many %" PRIx64,
                     l->where.scene, l->where.options.kernel, (int)accuracy, k, missing, extra);
    }
}

void data_set_print_heading(void)
{
    printf("%-28s %9s %10s %8s %8s %8s %7s %7s %6s %6s %7s %8s %8s %9s %8s %8s %8s %8s\n", "data set", "triangles", "candidates",
           "pairs", "certain", "possible", "lattice", "grazing", "soft", "ghosts", "edges", "vertices", "left out", "disputes",
           "cons. +", "fast -", "fast +", "seconds");
}

static size_t bits_in(const uint64_t *words, size_t count)
{
    size_t bits = 0;
    for (size_t k = 0; k < 64 * count; k++)
        bits += bit_of(words, k);
    return bits;
}

static void print_line(const check *c, size_t candidates, size_t pairs, double seconds)
{
    const witness_counts *const n = &c->witness.counts;
    const size_t words = c->witness.first_word[c->d->model.count];
    const size_t certain = bits_in(c->witness.certain, words), possible = bits_in(c->witness.possible, words);
    size_t disputes = 0, conservative = 0, fast_missed = 0, fast_unfounded = 0;
    for (int k = 0; k < c->count; k++) {
        const library *const l = &c->libraries[k];
        disputes += l->disputes;
        conservative += l->where.options.accuracy == TRIBOX_CONSERVATIVE ? l->base.unfounded : 0;
        fast_missed += l->where.options.accuracy == TRIBOX_FAST ? l->base.missed : 0;
        fast_unfounded += l->where.options.accuracy == TRIBOX_FAST ? l->base.unfounded : 0;
    }
    printf("%-28s %9zu %10zu %8zu %8zu %8zu %7zu %7zu %6zu %6zu %7zu %8zu %8zu %9zu %8zu %8zu %8zu %8.2f\n", c->d->name,
           c->d->model.count, candidates, pairs, certain, possible - certain, n->solid, n->grazing, n->soft, n->ghost, n->edges,
           n->vertices, n->left_out, disputes, conservative, fast_missed, fast_unfounded, seconds);
    fflush(stdout);
}

static void check_counts(const check *c, size_t pairs)
{
    const witness_counts *const n = &c->witness.counts;
    assert_int_equal(n->strays, 0);
    assert_true(pairs > 0);
    if (c->d->is_exact)
        assert_int_equal(n->soft + n->ghost + n->left_out, 0);
    for (int k = 0; k < c->count; k++)
        assert_in_range(c->libraries[k].disputes, 0, DISPUTES_MAX);
}

void data_set_check(data_set *d, uint64_t seed)
{
    const clock_t start = clock();
    check c = {.d = d, .r = random_named(seed, d->name), .words = tribox_window_words(d->grid.size)};
    assert_true(planes_make(&c.planes, &d->grid));
    c.witness = witness_make(&c.planes, &d->model, d->is_exact);
    c.streams = streams_make(&d->model);
    c.occupied = memory_of(c.words, sizeof *c.occupied);
    c.voxels = memory_of(c.words, sizeof *c.voxels);
    make_libraries(&c, seed);
    const size_t candidates = ask_pairs(&c), pairs = c.libraries[0].base.overlapping;
    ask_cells(&c);
    for (int k = 0; k < c.count; k++)
        check_voxels(&c, &c.libraries[k]);
    print_line(&c, candidates, pairs, (double)(clock() - start) / CLOCKS_PER_SEC);
    check_counts(&c, pairs);
    free(c.agreed);
    free(c.occupied);
    free(c.voxels);
    streams_free(&c.streams);
    witness_free(&c.witness);
}
