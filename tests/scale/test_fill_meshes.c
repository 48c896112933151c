/* test_fill_meshes.c - real meshes filled both ways: what holds of all, and of those that are known to be closed or open. */
#include <math.h>

#include "common/harness.h"
#include "common/real_meshes.h"

static const double cells = 200;

static tribox_grid grid_around(const mesh *m)
{
    const tribox_box box = mesh_bounds(m);
    double longest = 0;
    tribox_grid grid;
    for (int a = 0; a < 3; a++)
        longest = fmax(longest, (double)box.hi[a] - box.lo[a]);
    for (int a = 0; a < 3; a++) {
        grid.cell[a] = nextafter(longest / cells, INFINITY);
        grid.origin[a] = box.lo[a];
        grid.size[a] = (uint32_t)fmax(1, ceil(((double)box.hi[a] - box.lo[a]) / grid.cell[a]));
    }
    return grid;
}

static tribox_soup soup_of(const mesh *m, const int vertex[3])
{
    tribox_soup soup = {.count = m->count};
    for (int v = 0; v < 3; v++) {
        soup.x[v] = m->coordinate[vertex[v]][0];
        soup.y[v] = m->coordinate[vertex[v]][1];
        soup.z[v] = m->coordinate[vertex[v]][2];
    }
    return soup;
}

static void fill(const arguments *given, const char *name, const mesh *m)
{
    (void)given;
    const tribox_grid grid = grid_around(m);
    const tribox_soup soup = soup_of(m, (const int[]){0, 1, 2}), turned = soup_of(m, (const int[]){2, 1, 0});
    const size_t words = tribox_window_words(grid.size);
    uint64_t *const occupied = calloc(4 * words, sizeof *occupied), *const outside = occupied + words,
                    *const parity = outside + words, *const other = parity + words;
    void *const scratch = malloc(tribox_fill_bytes(grid.size));
    assert_true(occupied && scratch);
    size_t sealed, inside, odd_rows, only = 0;
    assert_int_equal(tribox_voxelize(&soup, &grid, NULL, NULL, occupied, NULL), TRIBOX_OK);
    assert_int_equal(tribox_fill_outside(grid.size, occupied, scratch, outside, &sealed), TRIBOX_OK);
    assert_int_equal(tribox_fill_parity(&soup, &grid, occupied, scratch, parity, &inside, &odd_rows), TRIBOX_OK);
    assert_int_equal(tribox_fill_parity(&turned, &grid, occupied, scratch, other, NULL, NULL), TRIBOX_OK);
    assert_memory_equal(parity, other, words * sizeof *parity);
    for (size_t w = 0; w < words; w++)
        only += (parity[w] & ~outside[w]) != 0;
    printf("%s: %zu cells not reached, %zu inside by parity, %zu odd rows\n", name, sealed, inside, odd_rows);
    if (!strcmp(name, "buildings.ply"))
        assert_true(!odd_rows && !only && inside > 0 && inside <= sealed);
    if (!strcmp(name, "stanford-bunny.ply"))
        assert_true(odd_rows > 0);
    free(occupied);
    free(scratch);
}

int main(int argc, char **argv) { return real_meshes_main(argc, argv, fill); }
