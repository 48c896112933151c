/* soups.c - draws the soups. */
#include "soups.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "draw.h"

/* Sorted: by cuts, as a spatial tree would leave them. */
enum keep { ALL, SORTED, OVERLAPPING, EDGE_MISSES, PLANE_MISSES };

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
    float lo, hi; /* of the box, on each axis */
    size_t count;
    draw_triangle *draw; /* NULL: a surface, and a mesh of it */
    enum keep keep;
} recipes[] = {
    {"paper", "vertices uniform in [-2, 2]^3", -0.5f, 0.5f, 100000, draw_paper, ALL},
    {"cache", "the same, few enough for the first-level cache", -0.5f, 0.5f, 800, draw_paper, ALL},
    {"twelve", "the same, 12 triangles", -0.5f, 0.5f, 12, draw_paper, ALL},
    {"sixty-four", "the same, 64 triangles: one word of the mask", -0.5f, 0.5f, 64, draw_paper, ALL},
    {"memory", "the same, too many for any cache", -0.5f, 0.5f, 4000000, draw_paper, ALL},
    {"sparse", "small triangles all over [-8, 8]^3, in random order", -0.5f, 0.5f, 1000000, draw_sparse, ALL},
    {"sorted", "the triangles of sparse, in order by cuts", -0.5f, 0.5f, 1000000, draw_sparse, SORTED},
    {"coherent", "the same, 4096 triangles: few enough for the second-level cache", -0.5f, 0.5f, 4096, draw_sparse, SORTED},
    {"surface", "rows of a rough saddle, 1000 by 500 squares over [-2, 2]^2; as an indexed mesh, too", -0.5f, 0.5f, 1000000, NULL,
     ALL},
    {"hit", "those of paper that overlap the box", -0.5f, 0.5f, 100000, draw_paper, OVERLAPPING},
    {"inside", "vertices uniform in the box", -0.5f, 0.5f, 100000, draw_inside, ALL},
    {"edge-miss", "those of paper that only an edge axis separates", -0.5f, 0.5f, 100000, draw_paper, EDGE_MISSES},
    {"lattice", "vertices on multiples of 1/4 in [-2, 2]^3: contact is common", -0.5f, 0.5f, 100000, draw_lattice, ALL},
    {"tenths", "vertices on multiples of 1/10 in [0, 2.5]^3: contact, of rounded numbers", 0.8f, 1.7f, 100000, draw_tenths, ALL},
    {"cad", "faces of blocks and prisms on a grid of 1/4, against a cell of it", 0.75f, 1.25f, 100000, draw_cad, ALL},
    {"cad-tenths", "the same on a grid of 1/10, of rounded numbers", 0.3f, 0.5f, 100000, draw_cad_tenths, ALL},
    {"touching", "triangles that touch the box, on multiples of 1/8", -0.5f, 0.5f, 100000, draw_touching, ALL},
    {"touching-ulp", "the same, three coordinates moved by a float or not", -0.5f, 0.5f, 100000, draw_touching_ulp, ALL},
    {"offset", "the scene paper a million units away", 999999.5f, 1000000.5f, 100000, draw_offset, ALL},
    {"needles", "one edge of up to 4 floats, another as near to contact as floats come", -0.5f, 0.5f, 100000, draw_needle, ALL},
    {"caps", "a vertex on the opposite edge, that edge as near to contact as floats come", -0.5f, 0.5f, 100000, draw_cap, ALL},
    {"thin", "segments, and slivers 2^10 to 2^30 times as long as high", -0.5f, 0.5f, 100000, draw_thin, ALL},
    {"box-0.01", "the triangles of paper, box 0.01", -0.005f, 0.005f, 100000, draw_paper, ALL},
    {"box-0.1", "the same, box 0.1", -0.05f, 0.05f, 100000, draw_paper, ALL},
    {"box-0.3", "the same, box 0.3", -0.15f, 0.15f, 100000, draw_paper, ALL},
    {"box-2", "the same, box 2", -1, 1, 100000, draw_paper, ALL},
    {"box-4", "the same, box 4: all overlap", -2, 2, 100000, draw_paper, ALL},
    {"plane", "those of paper that only the plane separates", -0.5f, 0.5f, 100000, draw_paper, PLANE_MISSES},
    {"miss-x", "triangles beside the box on the x axis", -0.5f, 0.5f, 100000, draw_above_x, ALL},
    {"miss-z", "triangles beside the box on the z axis", -0.5f, 0.5f, 100000, draw_above_z, ALL},
};
enum { SCENES = sizeof recipes / sizeof recipes[0], FOR_ORDERS = 8 /* the last ones */ };

const char *scene_usual(size_t index) { return index < SCENES - FOR_ORDERS ? recipes[index].name : NULL; }

enum { BATCH = 4096 };

static tribox_box box_of(const struct recipe *r) { return (tribox_box){{r->lo, r->lo, r->lo}, {r->hi, r->hi, r->hi}}; }

/* Of the first batch of a work, the triangles to keep, as a mask. */
static bool choose(const timing_job *batch, const struct recipe *recipe, uint64_t chosen[BATCH / 64])
{
    uint64_t without[BATCH / 64], with_all[BATCH / 64];
    const unsigned other = recipe->keep == PLANE_MISSES ? TRIBOX_AXES_EDGES : TRIBOX_AXES_PLANE;
    const tribox_box box = box_of(recipe);
    if (tribox_overlap(&batch->soup, &box, &(tribox_options){.axes = TRIBOX_AXES_BOX | other}, without, NULL) ||
        tribox_overlap(&batch->soup, &box, NULL, with_all, NULL))
        return false;
    for (size_t w = 0; w < BATCH / 64; w++)
        chosen[w] = recipe->keep == OVERLAPPING ? with_all[w] : without[w] & ~with_all[w];
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

bool draw_field(size_t along, size_t rows, draw_vertex *draw, generator *g, triangle *triangles)
{
    float(*const row)[3] = malloc(2 * (along + 1) * sizeof *row);
    for (size_t j = 0; row && j <= rows; j++) {
        float(*const here)[3] = row + j % 2 * (along + 1), (*const before)[3] = row + (j + 1) % 2 * (along + 1);
        for (size_t i = 0; i <= along; i++)
            draw(g, i, j, along, here[i]);
        for (size_t i = 0; j && i < along; i++)
            for (size_t half = 0; half < 2; half++, triangles++) {
                memcpy((*triangles)[0], before[i], sizeof before[i]);
                memcpy((*triangles)[1], half ? here[i + 1] : before[i + 1], sizeof before[i]);
                memcpy((*triangles)[2], half ? here[i] : here[i + 1], sizeof before[i]);
            }
    }
    free(row);
    return row;
}

/* A rough saddle, twice as many squares along as across. */
static void surface_vertex(generator *g, size_t i, size_t j, size_t along, float u[3])
{
    u[0] = 4 * (float)i / (float)along - 2;
    u[1] = 8 * (float)j / (float)along - 2;
    u[2] = (u[0] * u[0] - u[1] * u[1]) / 2 + random_between(g, -0.004f, 0.004f);
}

static bool sort(triangle *triangles, size_t count)
{
    const tribox_mesh mesh = {.positions = triangles, .vertices = 3 * count, .count = count};
    uint32_t *const order = malloc(count * sizeof *order);
    void *const scratch = malloc(16 * count);
    triangle *const sorted = malloc(count * sizeof *sorted);
    const bool is_sorted = order && scratch && sorted && !tribox_mesh_sort(&mesh, order, scratch);
    for (size_t i = 0; is_sorted && i < count; i++)
        memcpy(sorted[i], triangles[order[i]], sizeof *sorted);
    if (is_sorted)
        memcpy(triangles, sorted, count * sizeof *sorted);
    free(order);
    free(scratch);
    free(sorted);
    return is_sorted;
}

static bool draw_all(const struct recipe *recipe, generator *g, triangle *triangles)
{
    timing_work batch;
    if (!recipe->draw)
        return draw_field(1000, recipe->count / 2000, surface_vertex, g, triangles);
    if (recipe->keep <= SORTED) {
        for (size_t i = 0; i < recipe->count; i++)
            recipe->draw(g, triangles[i]);
        return recipe->keep == ALL || sort(triangles, recipe->count);
    }
    const bool is_drawn = timing_work_make(&batch, 1, BATCH) && draw_kept(recipe, g, &batch, triangles);
    timing_work_free(&batch);
    return is_drawn;
}

static const struct recipe *find(const char *name)
{
    for (size_t s = 0; s < SCENES; s++)
        if (!strcmp(name, recipes[s].name))
            return &recipes[s];
    fprintf(stderr, "bench: unknown scene '%s'; the scenes are:\n", name);
    for (size_t s = 0; s < SCENES; s++)
        fprintf(stderr, "  %-12s %s\n", recipes[s].name, recipes[s].what);
    return NULL;
}

bool scene_is_known(const char *name) { return find(name); }

/* Vertices on tenths, which floats round: boxes lie on them, too. */
static bool is_of_tenths(const struct recipe *r) { return r->draw == draw_tenths || r->draw == draw_cad_tenths; }

/* A box of one to three tenths. */
static tribox_box draw_box(generator *g)
{
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        const size_t from = random_below(g, 10);
        box.lo[a] = (double)((float)from / 10);
        box.hi[a] = (double)((float)(from + 1 + random_below(g, 3)) / 10);
    }
    return box;
}

bool scene_make(const char *name, uint64_t seed, bool has_boxes, scene *made)
{
    const struct recipe *const recipe = find(name);
    *made = (scene){.name = name};
    if (!recipe)
        return false;
    const bool is_many = has_boxes && is_of_tenths(recipe);
    const size_t boxes = is_many ? SCENE_BOXES : 1, each = recipe->count / boxes;
    generator g = {seed};
    made->what = recipe->what;
    bool is_made =
        timing_work_make(&made->work, boxes, boxes * timing_work_room(each)) && draw_all(recipe, &g, made->work.triangles);
    for (size_t b = 0; is_made && b < boxes; b++) {
        const timing_job job = timing_work_soup(&made->work, each);
        const tribox_box box = is_many ? draw_box(&g) : box_of(recipe);
        timing_work_add(&made->work, &job, &box);
    }
    is_made = is_made && (recipe->draw || timing_work_mesh(&made->work));
    return is_made || message_failure("cannot make scene %s of %zu triangles: out of memory, or tribox_overlap failed", name,
                                      recipe->count) == EXIT_CODE_OK;
}

bool scene_room(scene *made, size_t triangles)
{
    return timing_work_make(&made->work, 1, timing_work_room(triangles)) ||
           message_failure("out of memory for %zu triangles", triangles) == EXIT_CODE_OK;
}

void scene_add(scene *made, size_t count, double share)
{
    const timing_job job = timing_work_soup(&made->work, count);
    tribox_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t k = 0; k < 9 * count; k++) {
        const double x = (double)job.triangles[k / 9][k / 3 % 3][k % 3];
        box.lo[k % 3] = fmin(box.lo[k % 3], x);
        box.hi[k % 3] = fmax(box.hi[k % 3], x);
    }
    for (int a = 0; a < 3; a++) {
        const double off = (1 - share) / 2 * (box.hi[a] - box.lo[a]);
        box.lo[a] += off;
        box.hi[a] -= off;
    }
    timing_work_add(&made->work, &job, &box);
}

void scene_free(scene *made) { timing_work_free(&made->work); }
