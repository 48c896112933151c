/* soups.c - draws the soups. */
#include "soups.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw.h"

static const tribox_box unit_box = {{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}};
static const tribox_box offset_box = {{999999.5f, 999999.5f, 999999.5f}, {1000000.5f, 1000000.5f, 1000000.5f}};
static const tribox_box tenths_box = {{0.8f, 0.8f, 0.8f}, {1.7f, 1.7f, 1.7f}};
static const tribox_box quarter_cell = {{0.75f, 0.75f, 0.75f}, {1.25f, 1.25f, 1.25f}};
static const tribox_box tenth_cell = {{0.3f, 0.3f, 0.3f}, {0.5f, 0.5f, 0.5f}};
static const tribox_box box_001 = {{-0.005f, -0.005f, -0.005f}, {0.005f, 0.005f, 0.005f}};
static const tribox_box box_01 = {{-0.05f, -0.05f, -0.05f}, {0.05f, 0.05f, 0.05f}};
static const tribox_box box_03 = {{-0.15f, -0.15f, -0.15f}, {0.15f, 0.15f, 0.15f}};
static const tribox_box box_2 = {{-1, -1, -1}, {1, 1, 1}};
static const tribox_box box_4 = {{-2, -2, -2}, {2, 2, 2}};

enum keep { KEEP_ALL, KEEP_OVERLAPPING, KEEP_EDGE_MISSES, KEEP_PLANE_MISSES };

/* Small triangles within the shadow of the unit box, above it: one box normal separates them, whatever the other axes do. */
static void draw_above(generator *g, triangle t, int axis)
{
    draw_inside(g, t);
    for (int j = 0; j < 3; j++)
        t[j][axis] += 2;
}

static void draw_above_x(generator *g, triangle t) { draw_above(g, t, 0); }

static void draw_above_z(generator *g, triangle t) { draw_above(g, t, 2); }

static const struct recipe {
    const char *name, *what;
    const tribox_box *box;
    size_t count;
    draw_triangle *draw; /* NULL: a surface, and a mesh of it */
    enum keep keep;
    bool is_sorted; /* in Morton order of the centroids, as a spatial tree would leave them */
} recipes[] = {
    {"paper", "vertices uniform in [-2, 2]^3", &unit_box, 100000, draw_paper, KEEP_ALL, false},
    {"cache", "the same, few enough for the first-level cache", &unit_box, 800, draw_paper, KEEP_ALL, false},
    {"twelve", "the same, 12 triangles", &unit_box, 12, draw_paper, KEEP_ALL, false},
    {"sixty-four", "the same, 64 triangles: one word of the mask", &unit_box, 64, draw_paper, KEEP_ALL, false},
    {"memory", "the same, too many for any cache", &unit_box, 4000000, draw_paper, KEEP_ALL, false},
    {"sparse", "small triangles all over [-8, 8]^3, in random order", &unit_box, 1000000, draw_sparse, KEEP_ALL, false},
    {"sorted", "the triangles of sparse, in Morton order", &unit_box, 1000000, draw_sparse, KEEP_ALL, true},
    {"coherent", "the same, 4096 triangles: few enough for the second-level cache", &unit_box, 4096, draw_sparse, KEEP_ALL, true},
    {"surface", "rows of a rough saddle, 1000 by 500 squares over [-2, 2]^2; as an indexed mesh, too", &unit_box, 1000000, NULL,
     KEEP_ALL, false},
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
    {"thin", "segments, and slivers 2^10 to 2^30 times as long as high", &unit_box, 100000, draw_thin, KEEP_ALL, false},
    {"box-0.01", "the triangles of paper, box 0.01", &box_001, 100000, draw_paper, KEEP_ALL, false},
    {"box-0.1", "the same, box 0.1", &box_01, 100000, draw_paper, KEEP_ALL, false},
    {"box-0.3", "the same, box 0.3", &box_03, 100000, draw_paper, KEEP_ALL, false},
    {"box-2", "the same, box 2", &box_2, 100000, draw_paper, KEEP_ALL, false},
    {"box-4", "the same, box 4: all overlap", &box_4, 100000, draw_paper, KEEP_ALL, false},
    {"plane", "those of paper that only the plane separates", &unit_box, 100000, draw_paper, KEEP_PLANE_MISSES, false},
    {"miss-x", "triangles beside the box on the x axis", &unit_box, 100000, draw_above_x, KEEP_ALL, false},
    {"miss-z", "triangles beside the box on the z axis", &unit_box, 100000, draw_above_z, KEEP_ALL, false},
};
enum { SCENES = sizeof recipes / sizeof recipes[0], FOR_ORDERS = 8 /* the last ones */ };

size_t scene_count(void) { return SCENES; }

bool scene_is_usual(size_t index) { return index < SCENES - FOR_ORDERS; }

const char *scene_name(size_t index) { return recipes[index].name; }

const char *scene_what(size_t index) { return recipes[index].what; }

enum { BATCH = 4096 };

/* Of the first batch of a work, the triangles to keep, as a mask. */
static bool choose(const timing_job *batch, const struct recipe *recipe, uint64_t chosen[BATCH / 64])
{
    uint64_t without[BATCH / 64], with_all[BATCH / 64];
    const unsigned other = recipe->keep == KEEP_PLANE_MISSES ? TRIBOX_AXES_EDGES : TRIBOX_AXES_PLANE;
    if (tribox_overlap(&batch->soup, recipe->box, &(tribox_options){.axes = TRIBOX_AXES_BOX | other}, without, NULL) ||
        tribox_overlap(&batch->soup, recipe->box, NULL, with_all, NULL))
        return false;
    for (size_t w = 0; w < BATCH / 64; w++)
        chosen[w] = recipe->keep == KEEP_OVERLAPPING ? with_all[w] : without[w] & ~with_all[w];
    return true;
}

/* Draws until `count` triangles are kept. Every recipe keeps some percent, so a batch that keeps none is an error. */
static bool draw_kept(const struct recipe *recipe, generator *g, timing_work *batch, triangle *triangles)
{
    for (size_t kept = 0; kept < recipe->count;) {
        uint64_t chosen[BATCH / 64];
        const size_t before = kept;
        for (size_t i = 0; i < BATCH; i++)
            recipe->draw(g, batch->triangles[i]);
        batch->used = 0;
        const timing_job drawn = timing_work_soup(batch, BATCH);
        if (!choose(&drawn, recipe, chosen))
            return false;
        for (size_t i = 0; i < BATCH && kept < recipe->count; i++)
            if (chosen[i / 64] >> i % 64 & 1)
                memcpy(triangles[kept++], batch->triangles[i], sizeof(triangle));
        if (kept == before)
            return false;
    }
    return true;
}

/* Two triangles to a square, row after row. */
static bool draw_surface(size_t count, generator *g, triangle *triangles)
{
    enum { ALONG = 1000 };
    const size_t rows = count / 2 / ALONG;
    float(*const vertex)[ALONG + 1][3] = malloc((rows + 1) * sizeof *vertex);
    for (size_t j = 0; vertex && j <= rows; j++)
        for (size_t i = 0; i <= ALONG; i++) {
            const float x = 4 * (float)i / ALONG - 2, y = 4 * (float)j / (float)rows - 2;
            memcpy(vertex[j][i], (const float[3]){x, y, (x * x - y * y) / 2 + random_between(g, -0.004f, 0.004f)},
                   sizeof vertex[j][i]);
        }
    for (size_t t = 0; vertex && t < count; t++) {
        const size_t i = t / 2 % ALONG, j = t / 2 / ALONG;
        memcpy(triangles[t][0], vertex[j][i], sizeof triangles[t][0]);
        memcpy(triangles[t][1], vertex[j + t % 2][i + 1], sizeof triangles[t][1]);
        memcpy(triangles[t][2], vertex[j + 1][i + 1 - t % 2], sizeof triangles[t][2]);
    }
    free(vertex);
    return vertex;
}

static bool draw_all(const struct recipe *recipe, generator *g, triangle *triangles)
{
    timing_work batch;
    if (!recipe->draw)
        return draw_surface(recipe->count, g, triangles);
    if (recipe->keep == KEEP_ALL) {
        for (size_t i = 0; i < recipe->count; i++)
            recipe->draw(g, triangles[i]);
        return !recipe->is_sorted || place_sort(triangles, recipe->count, 8.5f);
    }
    const bool is_drawn = timing_work_make(&batch, 1, BATCH) && draw_kept(recipe, g, &batch, triangles);
    timing_work_free(&batch);
    return is_drawn;
}

bool scene_find(const char *name, size_t *index)
{
    for (*index = 0; *index < scene_count(); ++*index)
        if (!strcmp(name, scene_name(*index)))
            return true;
    fprintf(stderr, "bench: unknown scene '%s'; the scenes are:\n", name);
    for (size_t s = 0; s < scene_count(); s++)
        fprintf(stderr, "  %-12s %s\n", scene_name(s), scene_what(s));
    return false;
}

bool scene_make(size_t index, uint64_t seed, scene *made)
{
    const struct recipe *const recipe = &recipes[index];
    *made = (scene){.name = recipe->name, .what = recipe->what};
    if (!timing_work_make(&made->work, 1, timing_work_room(recipe->count)) ||
        !draw_all(recipe, &(generator){seed}, made->work.triangles)) {
        fprintf(stderr, "bench: cannot make scene %s of %zu triangles: out of memory, or tribox_overlap failed\n", recipe->name,
                recipe->count);
        scene_free(made);
        return false;
    }
    const timing_job job = timing_work_soup(&made->work, recipe->count);
    timing_work_add(&made->work, &job, recipe->box);
    if (recipe->draw || timing_work_mesh(&made->work))
        return true;
    fprintf(stderr, "bench: out of memory for the mesh of %s\n", recipe->name);
    scene_free(made);
    return false;
}

void scene_free(scene *made) { timing_work_free(&made->work); }
