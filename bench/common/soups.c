#include "soups.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw.h"

enum { CACHE_LINE = 64, LINE_FLOATS = CACHE_LINE / sizeof(float) };

static const tribox_box unit_box = {{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}};
static const tribox_box offset_box = {{999999.5f, 999999.5f, 999999.5f}, {1000000.5f, 1000000.5f, 1000000.5f}};
static const tribox_box tenths_box = {{0.8f, 0.8f, 0.8f}, {1.7f, 1.7f, 1.7f}};
static const tribox_box quarter_cell = {{0.75f, 0.75f, 0.75f}, {1.25f, 1.25f, 1.25f}};
static const tribox_box tenth_cell = {{0.3f, 0.3f, 0.3f}, {0.5f, 0.5f, 0.5f}};

enum keep { KEEP_ALL, KEEP_OVERLAPPING, KEEP_EDGE_MISSES };

static const struct recipe {
    const char *name, *what;
    const tribox_box *box;
    size_t count;
    draw_triangle *draw;
    enum keep keep;
    bool is_sorted; /* in Morton order of the centroids, as a spatial tree would leave them */
} recipes[] = {
    {"paper", "vertices uniform in [-2, 2]^3", &unit_box, 100000, draw_paper, KEEP_ALL, false},
    {"cache", "the same, few enough for the first-level cache", &unit_box, 800, draw_paper, KEEP_ALL, false},
    {"memory", "the same, too many for any cache", &unit_box, 4000000, draw_paper, KEEP_ALL, false},
    {"sparse", "small triangles all over [-8, 8]^3, in random order", &unit_box, 1000000, draw_sparse, KEEP_ALL, false},
    {"sorted", "the triangles of sparse, in Morton order", &unit_box, 1000000, draw_sparse, KEEP_ALL, true},
    {"hit", "those of paper that overlap the box", &unit_box, 100000, draw_paper, KEEP_OVERLAPPING, false},
    {"inside", "vertices uniform in the box", &unit_box, 100000, draw_inside, KEEP_ALL, false},
    {"edge-miss", "those of paper that only an edge axis separates", &unit_box, 100000, draw_paper, KEEP_EDGE_MISSES, false},
    {"lattice", "vertices on multiples of 1/4 in [-2, 2]^3: contact is common", &unit_box, 100000, draw_lattice, KEEP_ALL, false},
    {"tenths", "vertices on multiples of 1/10 in [0, 2.5]^3: contact, of rounded numbers", &tenths_box, 100000, draw_tenths,
     KEEP_ALL, false},
    {"cad", "faces of blocks and prisms on a grid of 1/4, against a cell of it", &quarter_cell, 100000, draw_cad, KEEP_ALL, false},
    {"cad-tenths", "the same on a grid of 1/10, of rounded numbers", &tenth_cell, 100000, draw_cad_tenths, KEEP_ALL, false},
    {"touching", "triangles that touch the box, on multiples of 1/8", &unit_box, 100000, draw_touching, KEEP_ALL, false},
    {"touching-ulp", "the same, three coordinates moved by a float or not", &unit_box, 100000, draw_touching_ulp, KEEP_ALL, false},
    {"offset", "the scene paper a million units away", &offset_box, 100000, draw_offset, KEEP_ALL, false},
    {"needles", "one edge of up to 4 floats, another as near to contact as floats come", &unit_box, 100000, draw_needle, KEEP_ALL,
     false},
    {"caps", "a vertex on the opposite edge, that edge as near to contact as floats come", &unit_box, 100000, draw_cap, KEEP_ALL,
     false},
};

size_t scene_count(void) { return sizeof recipes / sizeof recipes[0]; }

const char *scene_name(size_t index) { return recipes[index].name; }

const char *scene_what(size_t index) { return recipes[index].what; }

static tribox_soup streams_at(float *storage, size_t stride, size_t count)
{
    tribox_soup soup = {.count = count};
    for (size_t j = 0; j < 3; j++) {
        soup.x[j] = storage + j * stride;
        soup.y[j] = storage + (3 + j) * stride;
        soup.z[j] = storage + (6 + j) * stride;
    }
    return soup;
}

static void write_streams(const triangle *triangles, size_t count, float *storage, size_t stride)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < 3; j++)
            for (size_t a = 0; a < 3; a++)
                storage[(3 * a + j) * stride + i] = triangles[i][j][a];
}

enum { BATCH = 4096 };

/* Of a batch, the triangles to keep, as a mask. */
static bool choose(const triangle *batch, const struct recipe *recipe, uint64_t chosen[BATCH / 64])
{
    static float streams[9 * BATCH];
    uint64_t without_edges[BATCH / 64], with_all[BATCH / 64];
    write_streams(batch, BATCH, streams, BATCH);
    const tribox_soup soup = streams_at(streams, BATCH, BATCH);
    const tribox_options coarse = {.axes = TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE};
    if (tribox_overlap(&soup, recipe->box, &coarse, without_edges, NULL) ||
        tribox_overlap(&soup, recipe->box, NULL, with_all, NULL))
        return false;
    for (size_t w = 0; w < BATCH / 64; w++)
        chosen[w] = recipe->keep == KEEP_OVERLAPPING ? with_all[w] : without_edges[w] & ~with_all[w];
    return true;
}

/* Draws until `count` triangles are kept. Every recipe keeps some percent, so a batch that keeps none is an error. */
static bool draw_kept(const struct recipe *recipe, generator *g, triangle *triangles)
{
    static triangle batch[BATCH];
    for (size_t kept = 0; kept < recipe->count;) {
        uint64_t chosen[BATCH / 64];
        const size_t before = kept;
        for (size_t i = 0; i < BATCH; i++)
            recipe->draw(g, batch[i]);
        if (!choose((const triangle *)batch, recipe, chosen))
            return false;
        for (size_t i = 0; i < BATCH && kept < recipe->count; i++)
            if (chosen[i / 64] >> i % 64 & 1)
                memcpy(triangles[kept++], batch[i], sizeof(triangle));
        if (kept == before)
            return false;
    }
    return true;
}

typedef struct keyed {
    uint64_t key;
    triangle t;
} keyed;

static int by_key(const void *a, const void *b)
{
    const uint64_t p = ((const keyed *)a)->key, q = ((const keyed *)b)->key;
    return (p > q) - (p < q);
}

/* The bits of the centroid's cell among 1024 x 1024 x 1024 in [-8.5, 8.5]^3, interleaved: x lowest. */
static uint64_t morton_code(const triangle t)
{
    uint64_t code = 0;
    for (int a = 0; a < 3; a++) {
        const float middle = (t[0][a] + t[1][a] + t[2][a]) / 3;
        const unsigned cell = (unsigned)((middle + 8.5f) * (1024 / 17.0f));
        for (int bit = 0; bit < 10; bit++)
            code |= (uint64_t)(cell >> bit & 1) << (3 * bit + a);
    }
    return code;
}

static bool sort_by_place(triangle *triangles, size_t count)
{
    keyed *const order = malloc(count * sizeof *order);
    if (!order)
        return false;
    for (size_t i = 0; i < count; i++) {
        memcpy(order[i].t, triangles[i], sizeof(triangle));
        order[i].key = morton_code((const float(*)[3])triangles[i]);
    }
    qsort(order, count, sizeof *order, by_key);
    for (size_t i = 0; i < count; i++)
        memcpy(triangles[i], order[i].t, sizeof(triangle));
    free(order);
    return true;
}

static bool draw_all(const struct recipe *recipe, generator *g, triangle *triangles)
{
    if (recipe->keep != KEEP_ALL)
        return draw_kept(recipe, g, triangles);
    for (size_t i = 0; i < recipe->count; i++)
        recipe->draw(g, triangles[i]);
    return !recipe->is_sorted || sort_by_place(triangles, recipe->count);
}

bool scene_make(size_t index, uint64_t seed, scene *made)
{
    const struct recipe *const recipe = &recipes[index];
    const size_t count = recipe->count, stride = (count + LINE_FLOATS - 1) / LINE_FLOATS * LINE_FLOATS;
    float *const streams = aligned_alloc(CACHE_LINE, 9 * stride * sizeof(float));
    triangle *const triangles = aligned_alloc(CACHE_LINE, stride * sizeof(triangle));
    *made = (scene){.name = recipe->name,
                    .what = recipe->what,
                    .box = *recipe->box,
                    .soup = streams_at(streams, stride, count),
                    .triangles = (const triangle *)triangles,
                    .storage = {streams, triangles}};
    for (int a = 0; a < 3; a++) {
        made->center[a] = (made->box.lo[a] + made->box.hi[a]) / 2;
        made->half[a] = (made->box.hi[a] - made->box.lo[a]) / 2;
    }
    if (!streams || !triangles || !draw_all(recipe, &(generator){seed}, triangles)) {
        fprintf(stderr, "bench: cannot make scene %s of %zu triangles: out of memory, or tribox_overlap failed\n", recipe->name,
                count);
        scene_free(made);
        return false;
    }
    write_streams((const triangle *)triangles, count, streams, stride);
    return true;
}

void scene_free(scene *made)
{
    free(made->storage[0]);
    free(made->storage[1]);
    *made = (scene){.name = NULL};
}
