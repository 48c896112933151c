/* octree.c - divides a mesh into an octree, and asks of its last division what overlaps. */
#include "sweep_work.h"

#include <math.h>
#include <stdlib.h>

enum { CHILDREN = 8 };

typedef struct node {
    tribox_box box;
    size_t first, count; /* its triangles, in the level's list */
} node;

/* The nodes of one level that have triangles. */
typedef struct level {
    node *nodes;
    uint32_t *list;
    size_t node_count, list_count;
} level;

unsigned octree_depth_for(size_t triangles)
{
    unsigned depth = 1;
    for (size_t leaves = 4; depth < OCTREE_DEPTH_MOST && 16 * leaves < triangles; leaves *= 4)
        depth++;
    return depth;
}

static bool make_room(level *l, size_t nodes, size_t triangles)
{
    *l = (level){.nodes = malloc((nodes + 1) * sizeof *l->nodes), .list = malloc((triangles + 1) * sizeof *l->list)};
    return l->nodes && l->list;
}

static void level_free(level *l)
{
    free(l->nodes);
    free(l->list);
}

static bool is_finite(const tribox_soup *soup, size_t i)
{
    for (int j = 0; j < 3; j++)
        if (!isfinite(soup->x[j][i]) || !isfinite(soup->y[j][i]) || !isfinite(soup->z[j][i]))
            return false;
    return true;
}

/* All finite triangles, and the cube about them. */
static void fill_root(const tribox_soup *soup, level *root)
{
    const float *const *const streams[3] = {soup->x, soup->y, soup->z};
    tribox_box all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    double size = 0;
    for (size_t i = 0; i < soup->count; i++) {
        for (int k = 0; is_finite(soup, i) && k < 9; k++) {
            all.lo[k % 3] = fmin(all.lo[k % 3], (double)streams[k % 3][k / 3][i]);
            all.hi[k % 3] = fmax(all.hi[k % 3], (double)streams[k % 3][k / 3][i]);
        }
        if (is_finite(soup, i))
            root->list[root->list_count++] = (uint32_t)i;
    }
    for (int a = 0; a < 3; a++)
        size = fmax(size, all.hi[a] - all.lo[a]);
    for (int a = 0; a < 3; a++)
        all.hi[a] = (float)(all.lo[a] + size);
    root->nodes[0] = (node){all, 0, root->list_count};
    root->node_count = root->list_count > 0;
}

/* A float, and the same for all nodes between the same planes: neighbours share their faces to the bit. */
static void middle_of(const tribox_box *box, double middle[3])
{
    for (int a = 0; a < 3; a++)
        middle[a] = (float)((box->lo[a] + box->hi[a]) / 2);
}

static tribox_box child_box(const tribox_box *box, size_t child)
{
    tribox_box own = *box;
    double middle[3];
    middle_of(box, middle);
    for (int a = 0; a < 3; a++)
        *(child >> a & 1 ? &own.lo[a] : &own.hi[a]) = middle[a];
    return own;
}

/* Which children each triangle of each node overlaps, and how many they are. */
static bool split_all(const tribox_soup *soup, const level *l, uint8_t *children, size_t *found)
{
    for (size_t n = 0; n < l->node_count; n++) {
        const node *const at = &l->nodes[n];
        tribox_report report;
        double middle[3];
        middle_of(&at->box, middle);
        if (tribox_split(soup, l->list + at->first, at->count, &at->box, middle, NULL, children + at->first, &report))
            return false;
        *found += report.overlapping;
    }
    return true;
}

/* The next level, of the children that have triangles, in its place. */
static bool divide(const tribox_soup *soup, level *l)
{
    uint8_t *const children = malloc(l->list_count + 1);
    size_t found = 0;
    level next = {.nodes = NULL};
    const bool is_done = children && split_all(soup, l, children, &found) &&
                         make_room(&next, found < CHILDREN * l->node_count ? found : CHILDREN * l->node_count, found);
    for (size_t k = 0; is_done && k < CHILDREN * l->node_count; k++) {
        const node *const parent = &l->nodes[k / CHILDREN];
        node *const own = &next.nodes[next.node_count];
        *own = (node){child_box(&parent->box, k % CHILDREN), next.list_count, 0};
        for (size_t i = parent->first; i < parent->first + parent->count; i++)
            if (children[i] >> k % CHILDREN & 1)
                next.list[next.list_count++] = l->list[i];
        own->count = next.list_count - own->first;
        next.node_count += own->count > 0;
    }
    free(children);
    level_free(l);
    *l = next;
    return is_done;
}

/* The last division, as work: every step-th node against its eight children. */
static bool make_work(const tribox_soup *soup, const level *last, size_t pairs_most, timing_work *work)
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
            const tribox_box box = child_box(&parent->box, child);
            timing_work_add(work, &job, &box);
        }
    }
    return true;
}

const char *octree_work(const tribox_soup *soup, unsigned depth, size_t pairs_most, timing_work *work)
{
    level at;
    bool is_done = make_room(&at, 1, soup->count);
    if (is_done)
        fill_root(soup, &at);
    const bool is_empty = is_done && !at.node_count;
    for (unsigned divided = 1; is_done && divided < depth; divided++)
        is_done = divide(soup, &at);
    is_done = is_done && make_work(soup, &at, pairs_most, work);
    level_free(&at);
    return is_empty ? "no triangle with finite coordinates" : is_done ? NULL : "out of memory for the octree";
}
