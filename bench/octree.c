/*
 * octree.c - what does an octree over a mesh cost, whose nodes hand lists of triangles down: by the paper's test in float at every
 * child, by eight calls about triangles gathered by hand, and by tribox_split? And the same leaves as bricks of a grid.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/box_scenes.h"
#include "paper/paper.h"

enum { SIDE = 128, DEPTH_MAX = 9 };

/* A mesh in each form, the cube about it, and room for the lists of all nodes from the root to a leaf. */
typedef struct octree {
    tribox_soup soup;
    tribox_mesh mesh;
    float (*triangles)[3][3], (*own)[3][3]; /* of the mesh; of a node */
    tribox_box cube;
    int depth;
    uint32_t *lists;
    uint8_t *bytes;
    uint64_t *mask;
    tribox_options options;
    size_t leaves;
    uint64_t sum; /* of what they are, in any order */
} octree;

/* Which children each triangle of a list overlaps, as tribox_split says it. */
typedef void divide(octree *o, const tribox_box *box, const uint32_t *list, size_t count, uint8_t *children);

static tribox_box child_of(const tribox_box *box, int child)
{
    tribox_box own = *box;
    for (int a = 0; a < 3; a++)
        *(child >> a & 1 ? &own.lo[a] : &own.hi[a]) = (box->lo[a] + box->hi[a]) / 2;
    return own;
}

static void add_child(const octree *o, size_t count, int child, uint8_t *children)
{
    for (size_t word = 0; 64 * word < count; word++)
        for (uint64_t left = o->mask[word]; left; left &= left - 1)
            children[64 * word + (size_t)__builtin_ctzll(left)] |= (uint8_t)(1 << child);
}

static void divide_by_paper(octree *o, const tribox_box *box, const uint32_t *list, size_t count, uint8_t *children)
{
    paper_walk *const walk = paper_in_order(PAPER_ORDER);
    memset(children, 0, count);
    for (size_t i = 0; i < count; i++)
        memcpy(o->own[i], o->triangles[list[i]], sizeof o->own[i]);
    for (int c = 0; c < 8; c++) {
        const tribox_box child = child_of(box, c);
        float center[3], half[3];
        for (int a = 0; a < 3; a++) {
            center[a] = (float)((child.lo[a] + child.hi[a]) / 2);
            half[a] = (float)((child.hi[a] - child.lo[a]) / 2);
        }
        walk(center, half, (const float(*)[3][3])o->own, count, o->mask);
        add_child(o, count, c, children);
    }
}

static void divide_by_eight(octree *o, const tribox_box *box, const uint32_t *list, size_t count, uint8_t *children)
{
    float *const to = o->own[0][0];
    const tribox_soup own = {{to, to + count, to + 2 * count},
                             {to + 3 * count, to + 4 * count, to + 5 * count},
                             {to + 6 * count, to + 7 * count, to + 8 * count},
                             count};
    memset(children, 0, count);
    for (size_t i = 0; i < count; i++)
        for (size_t n = 0; n < 9; n++)
            to[n * count + i] = o->triangles[list[i]][n % 3][n / 3];
    for (int c = 0; c < 8; c++) {
        const tribox_box child = child_of(box, c);
        tribox_overlap(&own, &child, &o->options, o->mask, NULL);
        add_child(o, count, c, children);
    }
}

static void divide_soup(octree *o, const tribox_box *box, const uint32_t *list, size_t count, uint8_t *children)
{
    tribox_split(&o->soup, list, count, box, NULL, &o->options, children, NULL);
}

static void divide_mesh(octree *o, const tribox_box *box, const uint32_t *list, size_t count, uint8_t *children)
{
    tribox_mesh_split(&o->mesh, list, count, box, NULL, &o->options, children, NULL);
}

static void add_leaf(octree *o, const uint32_t at[3])
{
    o->leaves++;
    o->sum += at[0] * UINT64_C(0x9e3779b97f4a7c15) ^ at[1] * UINT64_C(0xbf58476d1ce4e5b9) ^ at[2] * UINT64_C(0x94d049bb133111eb);
}

/* A node whose list, and the room after it, are there. */
static void descend(octree *o, divide *by, const tribox_box *box, const uint32_t at[3], uint32_t *list, size_t count,
                    uint8_t *children, int depth)
{
    unsigned any = 0;
    by(o, box, list, count, children);
    for (size_t i = 0; i < count; i++)
        any |= children[i];
    for (unsigned c = 0; c < 8; c++) {
        const uint32_t side[3] = {c & 1, c >> 1 & 1, c >> 2},
                       own[3] = {2 * at[0] + side[0], 2 * at[1] + side[1], 2 * at[2] + side[2]};
        const tribox_box child = child_of(box, (int)c);
        size_t found = 0;
        if (any >> c & 1 && depth == 1)
            add_leaf(o, own);
        for (size_t i = 0; depth > 1 && i < count; i++) {
            list[count + found] = list[i];
            found += children[i] >> c & 1;
        }
        if (found)
            descend(o, by, &child, own, list + count, found, children + count, depth - 1);
    }
}

static int take(void *o, const uint32_t at[3], const uint64_t bits[8])
{
    for (uint32_t k = 0; k < 8; k++)
        for (uint64_t left = bits[k]; left; left &= left - 1) {
            const uint32_t bit = (uint32_t)__builtin_ctzll(left);
            add_leaf(o, (const uint32_t[3]){8 * at[0] + bit % 8, 8 * at[1] + bit / 8, 8 * at[2] + k});
        }
    return 0;
}

static bool make_bricks(octree *o)
{
    const uint32_t size = UINT32_C(1) << o->depth;
    tribox_grid grid = {.size = {size, size, size}};
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = o->cube.lo[a];
        grid.cell[a] = (o->cube.hi[a] - o->cube.lo[a]) / size;
    }
    const tribox_tiles all = {SIDE, 0, tribox_tile_count(grid.size, SIDE)};
    const tribox_sink sink = {take, o};
    size_t *const starts = malloc((all.count + 1) * sizeof *starts);
    void *const scratch = malloc(tribox_bricks_bytes(SIDE));
    bool is_made = starts && scratch && !tribox_mesh_tile_lists(&o->mesh, &grid, &all, &o->options, starts, NULL);
    uint32_t *const list = is_made ? malloc((starts[all.count] + 1) * sizeof *list) : NULL;
    is_made = list && !tribox_mesh_tile_lists(&o->mesh, &grid, &all, &o->options, starts, list) &&
              !tribox_mesh_bricks(&o->mesh, &grid, &all, starts, list, &o->options, scratch, &sink, NULL);
    free(list);
    free(scratch);
    free(starts);
    return is_made;
}

typedef struct way {
    const char *name;
    divide *by; /* NULL for bricks */
} way;

enum { PAPER, EIGHT, SOUP, MESH, BRICKS, WAYS };
static const way ways[WAYS] = {{"the paper's test", divide_by_paper},
                               {"eight calls", divide_by_eight},
                               {"tribox_split", divide_soup},
                               {"tribox_mesh_split", divide_mesh},
                               {"tribox_mesh_bricks", NULL}};

/* The octree is what changes. */
CONTESTANT_RUN(run_way)
{
    octree *const o = (octree *)(uintptr_t)self->question;
    divide *const by = ways[self->which].by;
    o->leaves = o->sum = 0;
    if (!by)
        return make_bricks(o);
    for (size_t i = 0; i < o->mesh.count; i++)
        o->lists[i] = (uint32_t)i;
    descend(o, by, &o->cube, (const uint32_t[3]){0, 0, 0}, o->lists, o->mesh.count, o->bytes, o->depth);
    return true;
}

static bool run_depth(asked *q, const char *name, octree *o)
{
    contestant list[WAYS];
    size_t leaves[WAYS];
    uint64_t sums[WAYS];
    for (int w = 0; w < WAYS; w++) {
        list[w] = (contestant){.run = run_way, .question = o, .which = w, .pairs = 1};
        if (!run_way(&list[w], NULL, NULL))
            return message_failure("not enough memory") == EXIT_CODE_OK;
        leaves[w] = o->leaves;
        sums[w] = o->sum;
        if (w > EIGHT && o->options.accuracy == TRIBOX_EXACT && (leaves[w] != leaves[EIGHT] || sums[w] != sums[EIGHT]))
            return message_failure("%s makes other leaves; nothing is timed", ways[w].name) == EXIT_CODE_OK;
    }
    asked_measure(q, name, list, WAYS, NULL, asked_effort(q, 5, 1e9, 0), 1);
    printout_table(&q->out, "%s, %zu triangles, depth %d: %zu leaves", name, o->mesh.count, o->depth, leaves[EIGHT]);
    for (size_t w = 0; w < WAYS; w++) {
        const double least = measure_least(&q->taken, w);
        ROW(&q->out, TEXT("way", ways[w].name), NUMBER("ms", 1, 1e-6 * least),
            NUMBER("times_the_paper's_speed", 2, measure_least(&q->taken, PAPER) / least),
            NUMBER("times_eight_calls", 2, measure_least(&q->taken, EIGHT) / least), NUMBER("leaves", 0, leaves[w]));
    }
    printout_disturbed(&q->out, &q->taken);
    return true;
}

/* Planes of few bits, so that floats hold those of all nodes, and a grid has the same. */
static void make_cube(const scene *at, octree *o)
{
    int exponent;
    frexp(scene_extent(at), &exponent);
    const double step = ldexp(1, exponent - 9), edge = (floor(scene_extent(at) / step) + 2) * step;
    for (int a = 0; a < 3; a++) {
        o->cube.lo[a] = floor(at->work.jobs[0].box.lo[a] / step) * step;
        o->cube.hi[a] = o->cube.lo[a] + edge;
    }
}

static bool ask_scene(asked *q, scene *at)
{
    const size_t count = at->work.pairs;
    bool is_run = timing_work_mesh(&at->work) || message_failure("not enough memory") == EXIT_CODE_OK;
    octree o = {.soup = at->work.jobs[0].soup,
                .mesh = at->work.mesh,
                .triangles = at->work.triangles,
                .own = asked_allocate(count, sizeof *o.own),
                .lists = asked_allocate((DEPTH_MAX + 1) * (count + 1), sizeof *o.lists),
                .bytes = asked_allocate((DEPTH_MAX + 1) * (count + 1), 1),
                .mask = asked_allocate(at->work.words, sizeof *o.mask),
                .options = {.accuracy = asked_has(q, OPTION_FAST) ? TRIBOX_FAST : TRIBOX_EXACT, .kernel = q->kernel}};
    make_cube(at, &o);
    for (o.depth = DEPTH_MAX - 2; is_run && o.depth <= DEPTH_MAX; o.depth += 2)
        is_run = run_depth(q, at->name, &o);
    return is_run;
}

static bool answer(asked *q) { return scenes_ask(q, 0, 0, ask_scene); }

const bench_question question_octree = {
    .name = "octree",
    .asks = "What does an octree cost whose nodes hand lists of triangles down, by each way to test children, and by bricks?",
    .options = 1u << OPTION_FAST | 1u << OPTION_KERNEL | 1u << OPTION_QUICK,
    .takes_meshes = true,
    .needs_meshes = true,
    .answer = answer};
