/*
 * test_meshes.c - real meshes against nodes of an octree over them: EXACT is the same from every kernel, and the oracle's answer.
 * Skipped (exit code 77) without a folder of meshes.
 */
#include "common/ask.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/real_meshes.h"
#include "common/random_draws.h"

enum {
    DEEPEST_LEVEL = 8,
    NODES_OF_A_LEVEL = 6,
    ORACLE_MAX = 4000 /* triangles of a node that the oracle is asked about, if their bounding boxes reach the node */
};

static tribox_soup soup_of(const mesh *m, const int vertex[3])
{
    tribox_soup soup = {.count = m->count};
    for (int j = 0; j < 3; j++) {
        soup.x[j] = m->coordinate[vertex[j]][0];
        soup.y[j] = m->coordinate[vertex[j]][1];
        soup.z[j] = m->coordinate[vertex[j]][2];
    }
    return soup;
}

static pair_f64 pair_of(const mesh *m, size_t i, const tribox_box *box)
{
    float u[3][3];
    mesh_triangle(m, i, u);
    return pair_of_floats(u[0], box);
}

/* The node of the octree, 2^-level of the bounds wide, in which a vertex of a drawn triangle lies. */
static tribox_box draw_node(random_source *r, const mesh *m, const tribox_box *bounds, int level)
{
    const size_t i = (size_t)(random_bits(r) % m->count);
    tribox_box node;
    for (int a = 0; a < 3; a++) {
        const double lo = bounds->lo[a], size = ldexp((double)bounds->hi[a] - lo, -level);
        const double place = size > 0 ? floor((m->coordinate[0][a][i] - lo) / size) : 0;
        node.lo[a] = (float)(lo + place * size);
        node.hi[a] = (float)(lo + (place + 1) * size);
    }
    return node;
}

static bool reaches(const pair_f64 *pair)
{
    for (int a = 0; a < 3; a++) {
        const double least = fmin(fmin(pair->u[0][a], pair->u[1][a]), pair->u[2][a]);
        const double most = fmax(fmax(pair->u[0][a], pair->u[1][a]), pair->u[2][a]);
        if (least > pair->box.hi[a] || most < pair->box.lo[a])
            return false;
    }
    return true;
}

/* Every triangle whose bounding box does not reach the node is apart from it; of the others the oracle judges about ORACLE_MAX. */
static size_t check_mask(const origin *where, const mesh *m, const tribox_box *node, const uint64_t *mask)
{
    size_t reaching = 0, asked = 0;
    for (size_t i = 0; i < m->count; i++) {
        const pair_f64 pair = pair_of(m, i, node);
        reaching += reaches(&pair);
    }
    const size_t step = reaching / ORACLE_MAX + 1;
    for (size_t i = 0, k = 0; i < m->count; i++) {
        const pair_f64 pair = pair_of(m, i, node);
        const bool answer = bit_of(mask, i);
        if (!reaches(&pair)) {
            if (answer)
                fail_pair(where, &pair, answer);
            continue;
        }
        if (k++ % step)
            continue;
        asked++;
        if (answer != oracle_overlaps(oracle_separating(&pair), TRIBOX_AXES_ALL))
            fail_pair(where, &pair, answer);
    }
    return asked;
}

static void check_that_masks_agree(const origin *where, const mesh *m, const tribox_box *node, const uint64_t *mask,
                                   const uint64_t *first)
{
    for (size_t i = 0; i < m->count; i++)
        if (bit_of(mask, i) != bit_of(first, i)) {
            const pair_f64 pair = pair_of(m, i, node);
            fprintf(stderr, "two kernels disagree about triangle %zu\n", i);
            fail_pair(where, &pair, bit_of(mask, i));
        }
}

/* Returns how many pairs the oracle was asked about. */
static size_t try_node(random_source *r, origin *where, const mesh *m, const tribox_box *node, uint64_t *mask, uint64_t *first)
{
    const char *kernels[KERNELS_MAX];
    const int kernel_count = kernels_here(kernels);
    size_t asked = 0;
    for (int kernel = 0; kernel < kernel_count; kernel++) {
        const tribox_soup soup = soup_of(m, permutations[random_int(r, ORDERS)]);
        where->options =
            (tribox_options){.axes = TRIBOX_AXES_ALL, .axis_order = order_digits(random_int(r, ORDERS)), .kernel = kernels[kernel]};
        ask_soup(&soup, node, &where->options, mask);
        if (kernel == 0) {
            asked = check_mask(where, m, node, mask);
            memcpy(first, mask, tribox_mask_words(m->count) * sizeof *mask);
        }
        check_that_masks_agree(where, m, node, mask, first);
    }
    return asked;
}

static void try_mesh(const arguments *args, const char *name, const mesh *m)
{
    uint64_t *const mask = calloc(2 * tribox_mask_words(m->count), sizeof *mask);
    assert_non_null(mask);
    random_source r = random_named(args->seed, name);
    origin where = {.scene = name, .seed = args->seed, .function = "tribox_overlap"};
    const tribox_box bounds = mesh_bounds(m);
    size_t asked = 0;
    for (int level = 0; level <= DEEPEST_LEVEL; level++)
        for (int k = 0; k < (level ? NODES_OF_A_LEVEL : 1); k++) {
            const tribox_box node = draw_node(&r, m, &bounds, level);
            asked += try_node(&r, &where, m, &node, mask, mask + tribox_mask_words(m->count));
        }
    printf("%-20s %7zu triangles, oracle asked about %zu pairs\n", name, m->count, asked);
    free(mask);
}

int main(int argc, char **argv) { return real_meshes_main(argc, argv, try_mesh); }
