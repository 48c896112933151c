#include "double_scenes.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "common/draw.h"
#include "common/place.h"
#include "console/message.h"

enum { SEED = 1, NEARNESS = 32, STAGED = 20000 };

typedef struct recipe {
    const char *name, *what;
    size_t count;
    draw_triangle *draw; /* as floats; the numbers between them are filled up */
    double offset;
    bool is_filled_up, is_sorted, is_large;
} recipe;

static const recipe recipes[DOUBLE_SCENES] = {
    {"cache", "the scene of the paper, in the first caches", 800, draw_paper, 0, true, false, false},
    {"paper", "the scene of the paper", 100000, draw_paper, 0, true, false, false},
    {"offset", "the same ten million units away", 100000, draw_paper, 1e7, true, false, false},
    {"lattice", "coordinates in quarters", 100000, draw_lattice, 0, false, false, false},
    {"tenths", "coordinates in tenths, as doubles have them", 100000, NULL, 0, false, false, false},
    {"sorted", "small triangles in Morton order, mostly far off", 1000000, draw_sparse, 0, true, true, false},
    {"memory", "the scene of the paper, beyond the caches", 4000000, draw_paper, 0, true, false, true},
};

const char *const stage_names[STAGE_SCENES] = {"none", "in double", "an ulp off contact", "in integers of 60 bits",
                                               "in long integers"};

bool double_scene_is_large(size_t index) { return recipes[index].is_large; }

static void *allocate(size_t count, size_t size)
{
    void *const memory = aligned_alloc(64, (count * size + 63) / 64 * 64);
    if (!memory)
        exit(message_failure("out of memory for %zu bytes", count * size));
    return memory;
}

static double uniform(generator *g, double least, double most)
{
    return least + (most - least) * ((double)(random_bits(g) >> 11) * 0x1p-53);
}

static void draw_in_tenths(generator *g, double u[3][3])
{
    for (int k = 0; k < 9; k++)
        u[k / 3][k % 3] = (double)random_below(g, 26) / 10;
}

/* A triangle at the origin. The last 29 bits of a double, which floats have not, are drawn too. */
static void draw_one(generator *g, const recipe *from, double u[3][3])
{
    triangle t;
    if (!from->draw) {
        draw_in_tenths(g, u);
        return;
    }
    from->draw(g, t);
    for (int k = 0; k < 9; k++) {
        const double x = (double)t[k / 3][k % 3];
        u[k / 3][k % 3] = from->is_filled_up ? x * (1 + uniform(g, -0x1p-25, 0x1p-25)) : x;
    }
}

/* Vertices, half as many as triangles, at numbers near to the corner's; of sorted triangles one for each corner. */
static void draw_vertices(generator *g, const recipe *from, double (*vertex)[3], size_t vertices)
{
    for (size_t v = 0; v < vertices; v += 3) {
        double u[3][3];
        draw_one(g, from, u);
        memcpy(vertex[v], u, (vertices - v < 3 ? vertices - v : 3) * sizeof u[0]);
    }
}

static void sort_triangles(double (*vertex)[3], size_t count)
{
    triangle *const rounded = allocate(count, sizeof *rounded);
    for (size_t k = 0; k < 9 * count; k++)
        rounded[k / 9][k / 3 % 3][k % 3] = (float)vertex[k / 3][k % 3];
    if (!place_sort(rounded, count, 8))
        exit(message_failure("out of memory"));
    for (size_t k = 0; k < 9 * count; k++)
        vertex[k / 3][k % 3] = (double)rounded[k / 9][k / 3 % 3][k % 3];
    free(rounded);
}

/* Near in number, and another for each corner of a triangle. */
static size_t near_number(generator *g, size_t corner, size_t corners, size_t vertices)
{
    const size_t about = (size_t)((double)corner / (double)corners * (double)(vertices - 3 * NEARNESS));
    return about + corner % 3 * NEARNESS + random_below(g, NEARNESS);
}

/* Both sizes of numbers, by index and as nine, from vertices at the origin. */
static void make_meshes(double_scene *made, double (*vertex)[3], size_t vertices, double offset, const uint32_t *index)
{
    const size_t corners = 3 * made->count;
    float(*const single)[3] = allocate(vertices, sizeof *single), (*const single_nine)[3] = allocate(corners, sizeof *single_nine);
    double(*const nine)[3] = allocate(corners, sizeof *nine);
    for (size_t v = 0; v < vertices; v++)
        for (int a = 0; a < 3; a++) {
            single[v][a] = (float)vertex[v][a];
            vertex[v][a] += offset;
        }
    for (size_t c = 0; c < corners; c++) {
        memcpy(nine[c], vertex[index[c]], sizeof nine[c]);
        memcpy(single_nine[c], single[index[c]], sizeof single_nine[c]);
    }
    made->nine = (tribox_mesh){.positions = nine, .vertices = corners, .count = made->count, .position_bytes = 8};
    made->indexed = (tribox_mesh){
        .positions = vertex, .vertices = vertices, .indices = index, .index_bytes = 4, .count = made->count, .position_bytes = 8};
    made->single_nine = (tribox_mesh){.positions = single_nine, .vertices = corners, .count = made->count};
    made->single_indexed =
        (tribox_mesh){.positions = single, .vertices = vertices, .indices = index, .index_bytes = 4, .count = made->count};
    made->memory[0] = single;
    made->memory[1] = single_nine;
    made->memory[2] = nine;
}

static void make_boxes(double_scene *made, bool is_tenths, double offset)
{
    for (int a = 0; a < 3; a++) {
        made->box.lo[a] = offset + (is_tenths ? 0.8 : -0.5);
        made->box.hi[a] = offset + (is_tenths ? 1.7 : 0.5);
        made->single_box.lo[a] = (float)(is_tenths ? 0.8 : -0.5);
        made->single_box.hi[a] = (float)(is_tenths ? 1.7 : 0.5);
    }
}

void double_scene_make(size_t number, double_scene *made)
{
    const recipe *const from = &recipes[number];
    generator g = {SEED};
    const size_t corners = 3 * from->count, vertices = from->is_sorted ? corners : from->count / 2;
    double(*const vertex)[3] = allocate(vertices, sizeof *vertex);
    uint32_t *const index = allocate(corners, sizeof *index);
    *made = (double_scene){.name = from->name, .what = from->what, .count = from->count};
    draw_vertices(&g, from, vertex, vertices);
    if (from->is_sorted)
        sort_triangles(vertex, from->count);
    for (size_t c = 0; c < corners; c++)
        index[c] = (uint32_t)(from->is_sorted ? c : near_number(&g, c, corners, vertices));
    make_meshes(made, vertex, vertices, from->offset, index);
    make_boxes(made, !from->draw, from->offset);
    made->memory[3] = vertex;
    made->memory[4] = index;
}

void double_scene_free(double_scene *made)
{
    for (size_t k = 0; k < sizeof made->memory / sizeof made->memory[0]; k++)
        free(made->memory[k]);
}

static double draw_number(generator *g, stage_scene which)
{
    const double x = uniform(g, -2, 2);
    return which == STAGE_SHORT ? ldexp(x, -600) : which == STAGE_LONG ? ldexp(x, (int)random_below(g, 2000) - 1000) : x;
}

/* Touching a box of thirds: contact that no double has. */
static void draw_off_contact(generator *g, double u[3][3])
{
    triangle t;
    draw_touching(g, t);
    for (int k = 0; k < 9; k++)
        u[k / 3][k % 3] = (double)t[k / 3][k % 3] / 3;
}

void stage_scene_make(stage_scene which, double_scene *made)
{
    generator g = {SEED};
    double(*const nine)[3][3] = allocate(STAGED, sizeof *nine);
    *made = (double_scene){.name = stage_names[which], .count = STAGED, .memory = {nine}};
    for (size_t i = 0; i < STAGED; i++) {
        if (which == STAGE_ULP)
            draw_off_contact(&g, nine[i]);
        for (int k = 0; which != STAGE_ULP && k < 9; k++)
            nine[i][k / 3][k % 3] = draw_number(&g, which);
    }
    for (int a = 0; a < 3; a++) {
        const double half = which == STAGE_SHORT ? 0x1p-601 : which == STAGE_ULP ? 0.5 / 3 : 0.5;
        made->box.lo[a] = -half;
        made->box.hi[a] = which == STAGE_DOUBLE && a == 2 ? -half : half;
    }
    made->nine = (tribox_mesh){.positions = nine, .vertices = 3 * STAGED, .count = STAGED, .position_bytes = 8};
}
