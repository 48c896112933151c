/*
 * octree.c - builds an octree over a surface, in which a triangle belongs to every leaf that it overlaps: by handing lists of
 * triangles down, and by an index; and compares the two.
 *
 *     cc -std=c11 -O2 octree.c $(pkg-config --cflags --libs tribox) -o octree && ./octree
 *
 * Lists cost each triangle a test of eight children at each level, one call a node. The index is told a box and answers with what
 * is in it, so that only the border of a node is tested; but it has to be made first.
 *
 * If you want the cells of a uniform grid, do not build top-down, take bricks: tribox_bricks gives those of the lowest level, and
 * the levels above are their numbers shifted.
 */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <tribox.h>

enum { SIDE = 256, TRIANGLES = 2 * SIDE * SIDE, LEVELS = 6, LEAF = 32 /* triangles, at most, of a node without children */ };

typedef float triangle[3][3];

static triangle surface[TRIANGLES];
static const tribox_mesh mesh = {
    .positions = surface, .stride = sizeof(float[3]), .vertices = 3 * (size_t)TRIANGLES, .count = TRIANGLES};
static const tribox_box root = {{-1, -1, -1}, {1, 1, 1}};

typedef struct octree {
    size_t nodes[LEVELS], leaves[LEVELS], references[LEVELS]; /* references: triangles in the level's leaves */
    uint32_t *list;                                           /* of each leaf how many triangles, and which */
    size_t used, room;
} octree;

static void check(tribox_status status)
{
    if (status == TRIBOX_OK)
        return;
    fprintf(stderr, "tribox: %s\n", tribox_status_text(status));
    exit(1);
}

static void *allocated(void *memory)
{
    if (memory)
        return memory;
    fputs("octree: out of memory\n", stderr);
    exit(1);
}

static void *allocate(size_t count, size_t size) { return allocated(calloc(count + 1, size)); }

/* Room at the end of the list for a leaf of so many triangles; returns where they go. */
static uint32_t *leaf_room(octree *tree, size_t count)
{
    if (tree->room - tree->used <= count) {
        tree->room = 2 * tree->room + count + 1;
        tree->list = allocated(realloc(tree->list, tree->room * sizeof *tree->list));
    }
    return tree->list + tree->used + 1;
}

static void add_leaf(octree *tree, int depth, size_t count)
{
    tree->list[tree->used] = (uint32_t)count;
    tree->used += count + 1;
    tree->leaves[depth]++;
    tree->references[depth] += count;
}

/* Children share the planes in the middle, so nothing slips between them: those of tribox_split. */
static tribox_box child_of(const tribox_box *box, int child)
{
    tribox_box own = *box;
    for (int a = 0; a < 3; a++)
        *(child >> a & 1 ? &own.lo[a] : &own.hi[a]) = (box->lo[a] + box->hi[a]) / 2;
    return own;
}

/* ------ by lists ------ */

static void divide_list(octree *tree, const tribox_box *box, const uint32_t *list, size_t count, int depth)
{
    tree->nodes[depth]++;
    if (count <= LEAF || depth + 1 == LEVELS) {
        memcpy(leaf_room(tree, count), list, count * sizeof *list);
        add_leaf(tree, depth, count);
        return;
    }
    unsigned char *overlapped = allocate(count, 1); /* bit c of each: child c */
    uint32_t *own = allocate(count, sizeof *own);
    check(tribox_mesh_split(&mesh, list, count, box, NULL, NULL, overlapped, NULL));
    for (int c = 0; c < 8; c++) {
        const tribox_box child = child_of(box, c);
        size_t own_count = 0;
        for (size_t i = 0; i < count; i++)
            if (overlapped[i] >> c & 1)
                own[own_count++] = list[i];
        divide_list(tree, &child, own, own_count, depth + 1);
    }
    free(own);
    free(overlapped);
}

static void build_by_lists(octree *tree)
{
    uint32_t *all = allocate(TRIANGLES, sizeof *all);
    for (uint32_t i = 0; i < TRIANGLES; i++)
        all[i] = i;
    divide_list(tree, &root, all, TRIANGLES, 0);
    free(all);
}

/* ------ by the index ------ */

typedef struct ordered {
    tribox_index index;
    tribox_soup soup;
    uint32_t *order; /* the number that each triangle of the soup had before */
    float *coordinates;
    void *nodes;
} ordered;

static void order_triangles(ordered *o)
{
    void *scratch = allocate(TRIANGLES, 16);
    float *streams[9];
    o->order = allocate(TRIANGLES, sizeof *o->order);
    o->coordinates = allocate(TRIANGLES, sizeof(triangle));
    o->soup.count = TRIANGLES;
    for (size_t k = 0; k < 9; k++)
        streams[k] = o->coordinates + k * TRIANGLES;
    for (size_t v = 0; v < 3; v++) {
        o->soup.x[v] = streams[v];
        o->soup.y[v] = streams[3 + v];
        o->soup.z[v] = streams[6 + v];
    }
    check(tribox_mesh_sort(&mesh, o->order, scratch));
    check(tribox_mesh_gather(&mesh, NULL, o->order, 0, TRIANGLES, streams, streams + 3, streams + 6));
    free(scratch);
    o->nodes = allocate(tribox_index_bytes(TRIANGLES), 1);
    o->index = (tribox_index){.nodes = o->nodes, .soup = &o->soup, .ids = o->order};
    check(tribox_index_build(&o->index, NULL, o->nodes));
}

/* Asks for as many triangles as a leaf may have: where there are more, the answer is how many, and the node is divided. */
static void divide_box(octree *tree, const ordered *o, const tribox_box *box, int depth)
{
    const bool is_last = depth + 1 == LEVELS;
    uint32_t *list = leaf_room(tree, LEAF);
    size_t room = is_last ? tree->room - tree->used - 1 : LEAF;
    size_t found;
    check(tribox_index_list(&o->index, &(tribox_region){.box = box}, NULL, room, list, &found));
    if (is_last && found > room) {
        list = leaf_room(tree, found);
        check(tribox_index_list(&o->index, &(tribox_region){.box = box}, NULL, found, list, &found));
    }

    tree->nodes[depth]++;
    if (is_last || found <= LEAF) {
        add_leaf(tree, depth, found);
        return;
    }
    for (int c = 0; c < 8; c++) {
        const tribox_box child = child_of(box, c);
        divide_box(tree, o, &child, depth + 1);
    }
}

/* ------ both ------ */

/* The saddle z = x * y over the square from -1 to 1. */
static void make_surface(void)
{
    for (int t = 0; t < TRIANGLES; t++)
        for (int v = 0; v < 3; v++) { /* two triangles a square, the second turned by half */
            float *p = surface[t][v];
            p[0] = (float)(t / 2 % SIDE + ((v == 1) != t % 2)) * 2 / SIDE - 1;
            p[1] = (float)(t / 2 / SIDE + ((v == 2) != t % 2)) * 2 / SIDE - 1;
            p[2] = p[0] * p[1];
        }
}

static int compare(const void *a, const void *b)
{
    const uint32_t left = *(const uint32_t *)a, right = *(const uint32_t *)b;
    return (left > right) - (left < right);
}

/* The index lists a leaf's triangles in its own order. */
static bool is_same(const octree *a, const octree *b)
{
    if (a->used != b->used)
        return false;
    for (size_t at = 0; at < a->used; at += a->list[at] + 1) {
        if (a->list[at] != b->list[at])
            return false;
        qsort(a->list + at + 1, a->list[at], sizeof *a->list, compare);
        qsort(b->list + at + 1, a->list[at], sizeof *b->list, compare);
        if (memcmp(a->list + at + 1, b->list + at + 1, a->list[at] * sizeof *a->list))
            return false;
    }
    return true;
}

static double milliseconds(void) { return 1e3 * (double)clock() / CLOCKS_PER_SEC; }

static bool report(octree *by_lists, octree *by_index, double lists_ms, double order_ms, double index_ms)
{
    const bool is_right = is_same(by_lists, by_index);
    printf("%d triangles\nlevel   nodes  leaves  triangles in leaves\n", TRIANGLES);
    for (int d = 0; d < LEVELS; d++)
        printf("%5d %7zu %7zu %20zu\n", d, by_index->nodes[d], by_index->leaves[d], by_index->references[d]);
    printf("by lists %.1f ms, by the index %.1f ms: %.1f times as fast\n", lists_ms, index_ms, lists_ms / index_ms);
    printf("with order, streams and index, made before in %.1f ms: %.1f times\n", order_ms, lists_ms / (order_ms + index_ms));
    puts(is_right ? "the same triangles in every leaf" : "THE LEAVES DIFFER");
    return is_right;
}

int main(void)
{
    octree by_lists = {.list = NULL}, by_index = by_lists;
    ordered o;
    make_surface();

    const double start = milliseconds();
    build_by_lists(&by_lists);
    const double lists_done = milliseconds();
    order_triangles(&o);
    const double order_done = milliseconds();
    divide_box(&by_index, &o, &root, 0);
    const double index_done = milliseconds();
    const bool is_right = report(&by_lists, &by_index, lists_done - start, order_done - lists_done, index_done - order_done);

    free(by_lists.list);
    free(by_index.list);
    free(o.order);
    free(o.coordinates);
    free(o.nodes);
    return is_right ? 0 : 1;
}
