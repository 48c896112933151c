/* octree.c - divides a mesh into an octree, and asks of its last division what overlaps. */
#include "octree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHILDREN = 8 };

typedef struct node {
    size_t cell[3];      /* of the 2^level cells along each axis */
    size_t first, count; /* its triangles, in the level's list */
} node;

/* The nodes of one level that have triangles. */
typedef struct level {
    unsigned depth;
    node *nodes;
    size_t node_count, node_room;
    size_t *list; /* indices of triangles */
    size_t list_count, list_room;
} level;

/* The bounding cube of the mesh. */
typedef struct cube {
    double corner[3], size;
} cube;

unsigned octree_depth_for(size_t triangles)
{
    unsigned depth = 1;
    for (size_t leaves = 4; depth < OCTREE_DEPTH_MOST && 16 * leaves < triangles; leaves *= 4)
        depth++;
    return depth;
}

static void level_free(level *l)
{
    free(l->nodes);
    free(l->list);
    *l = (level){.nodes = NULL};
}

/* Room for one element more; false if memory fails. */
static bool make_room(void **elements, size_t *room, size_t count, size_t size)
{
    if (count < *room)
        return true;
    const size_t larger = *room ? 2 * *room : 1024;
    void *const moved = larger <= SIZE_MAX / size ? realloc(*elements, larger * size) : NULL;
    if (!moved)
        return false;
    *elements = moved;
    *room = larger;
    return true;
}

static bool append_index(level *l, size_t index)
{
    void *list = l->list;
    const bool is_room = make_room(&list, &l->list_room, l->list_count, sizeof *l->list);
    l->list = list;
    if (is_room)
        l->list[l->list_count++] = index;
    return is_room;
}

static bool append_node(level *l, const node *n)
{
    void *nodes = l->nodes;
    const bool is_room = make_room(&nodes, &l->node_room, l->node_count, sizeof *l->nodes);
    l->nodes = nodes;
    if (is_room)
        l->nodes[l->node_count++] = *n;
    return is_room;
}

static bool is_finite(const tribox_soup *soup, size_t i)
{
    for (int j = 0; j < 3; j++)
        if (!isfinite(soup->x[j][i]) || !isfinite(soup->y[j][i]) || !isfinite(soup->z[j][i]))
            return false;
    return true;
}

/* The root: all finite triangles, and the cube about them. */
static bool make_root(const tribox_soup *soup, level *root, cube *c)
{
    const float *const *const streams[3] = {soup->x, soup->y, soup->z};
    double hi[3];
    for (size_t i = 0; i < soup->count; i++) {
        if (!is_finite(soup, i))
            continue;
        for (int a = 0; a < 3; a++)
            for (int j = 0; j < 3; j++) {
                const double at = (double)streams[a][j][i];
                const bool is_first = !root->list_count && !j;
                c->corner[a] = is_first ? at : fmin(c->corner[a], at);
                hi[a] = is_first ? at : fmax(hi[a], at);
            }
        if (!append_index(root, i))
            return false;
    }
    c->size = 0;
    for (int a = 0; root->list_count && a < 3; a++)
        c->size = fmax(c->size, hi[a] - c->corner[a]);
    const node all = {.count = root->list_count};
    return !root->list_count || append_node(root, &all);
}

/* The planes of a level are the same for all its nodes: neighbours share their faces to the bit. */
static tribox_box child_box(const cube *c, unsigned depth, const node *parent, size_t child, size_t cell[3])
{
    const double size = ldexp(c->size, -(int)depth);
    tribox_box box;
    for (size_t a = 0; a < 3; a++) {
        cell[a] = 2 * parent->cell[a] + (child >> a & 1);
        box.lo[a] = (float)(c->corner[a] + size * (double)cell[a]);
        box.hi[a] = (float)(c->corner[a] + size * (double)(cell[a] + 1));
    }
    return box;
}

/* Appends the child of a node to the next level, if a triangle overlaps it. scratch: the node's triangles as a job. */
static bool divide_into(const level *from, const node *parent, size_t child, const timing_job *scratch, const cube *c,
                        uint64_t *mask, level *to)
{
    node n = {.first = to->list_count};
    const tribox_box box = child_box(c, to->depth, parent, child, n.cell);
    if (tribox_overlap(&scratch->soup, &box, NULL, mask, NULL))
        return false;
    for (size_t i = 0; i < parent->count; i++)
        if (mask[i / 64] >> i % 64 & 1 && !append_index(to, from->list[parent->first + i]))
            return false;
    n.count = to->list_count - n.first;
    return !n.count || append_node(to, &n);
}

static bool divide(const tribox_soup *soup, const cube *c, const level *from, level *to)
{
    uint64_t *const mask = malloc((tribox_mask_words(soup->count) + 1) * sizeof *mask);
    timing_work scratch;
    bool is_done = timing_work_make(&scratch, 1, timing_work_room(soup->count)) && mask;
    to->depth = from->depth + 1;
    for (size_t n = 0; is_done && n < from->node_count; n++) {
        const node *const parent = &from->nodes[n];
        scratch.used = 0;
        const timing_job job = timing_work_copy(&scratch, soup, from->list + parent->first, parent->count);
        for (size_t child = 0; is_done && child < CHILDREN; child++)
            is_done = divide_into(from, parent, child, &job, c, mask, to);
    }
    timing_work_free(&scratch);
    free(mask);
    return is_done;
}

/* The last division, as work: every step-th node against its eight children. */
static bool make_work(const tribox_soup *soup, const cube *c, const level *last, size_t pairs_most, timing_work *work)
{
    const size_t pairs = CHILDREN * last->list_count, step = pairs / pairs_most + 1;
    size_t room = 0, nodes = 0;
    for (size_t n = 0; n < last->node_count; n += step, nodes++)
        room += timing_work_room(last->nodes[n].count);
    if (!timing_work_make(work, CHILDREN * nodes, room))
        return false;
    for (size_t n = 0; n < last->node_count; n += step) {
        const node *const parent = &last->nodes[n];
        const timing_job job = timing_work_copy(work, soup, last->list + parent->first, parent->count);
        for (size_t child = 0; child < CHILDREN; child++) {
            size_t cell[3];
            const tribox_box box = child_box(c, last->depth + 1, parent, child, cell);
            timing_work_add(work, &job, &box);
        }
    }
    return true;
}

const char *octree_work(const tribox_soup *soup, unsigned depth, size_t pairs_most, timing_work *work)
{
    level at = {.depth = 0}, next = {.depth = 0};
    cube c;
    bool is_done = make_root(soup, &at, &c);
    const bool is_empty = is_done && !at.node_count;
    while (is_done && at.depth + 1 < depth) {
        is_done = divide(soup, &c, &at, &next);
        level_free(&at);
        at = next;
        next = (level){.depth = 0};
    }
    is_done = is_done && make_work(soup, &c, &at, pairs_most, work);
    level_free(&at);
    return is_empty ? "no triangle with finite coordinates" : is_done ? NULL : "out of memory for the octree";
}
