/*
 * octree.c - builds an octree over a surface, in which a triangle belongs to every leaf that it overlaps: by handing lists of
 * triangles down, and by an index; and compares the two.
 *
 *     cc -std=c11 -O2 octree.c $(pkg-config --cflags --libs tribox) -o octree && ./octree
 *
 * ./octree NAME.f32 LEVELS takes triangles of your own, nine floats each. Lists cost each triangle a test of eight children at each
 * level, one call a node. The index is told a box and answers with what is in it, so that only the border of a node is tested; but
 * it has to be made first.
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

enum { SIDE = 256, LEVELS = 6, LEVELS_MOST = 20, LEAF = 32 /* triangles, at most, of a node without children */ };

typedef float triangle[3][3];

typedef struct octree {
    const triangle *triangles;
    size_t count;
    tribox_box root;
    int levels;
    size_t nodes[LEVELS_MOST], leaves[LEVELS_MOST], references[LEVELS_MOST]; /* references: triangles in the level's leaves */
    uint32_t *list;                                                          /* of each leaf how many triangles, and which */
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

static tribox_mesh mesh_of(const octree *tree)
{
    return (tribox_mesh){
        .positions = tree->triangles, .stride = sizeof(float[3]), .vertices = 3 * tree->count, .count = tree->count};
}

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
    if (count <= LEAF || depth + 1 == tree->levels) {
        memcpy(leaf_room(tree, count), list, count * sizeof *list);
        add_leaf(tree, depth, count);
        return;
    }
    const tribox_mesh mesh = mesh_of(tree);
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
    uint32_t *all = allocate(tree->count, sizeof *all);
    for (size_t i = 0; i < tree->count; i++)
        all[i] = (uint32_t)i;
    divide_list(tree, &tree->root, all, tree->count, 0);
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

static void order_triangles(const octree *tree, ordered *o)
{
    const tribox_mesh mesh = mesh_of(tree);
    void *scratch = allocate(tree->count, 16);
    float *streams[9];
    o->order = allocate(tree->count, sizeof *o->order);
    o->coordinates = allocate(tree->count, sizeof(triangle));
    o->soup.count = tree->count;
    for (size_t k = 0; k < 9; k++)
        streams[k] = o->coordinates + k * tree->count;
    for (size_t v = 0; v < 3; v++) {
        o->soup.x[v] = streams[v];
        o->soup.y[v] = streams[3 + v];
        o->soup.z[v] = streams[6 + v];
    }
    check(tribox_mesh_sort(&mesh, o->order, scratch));
    check(tribox_mesh_gather(&mesh, NULL, o->order, 0, tree->count, streams, streams + 3, streams + 6));
    free(scratch);
    o->nodes = allocate(tribox_index_bytes(tree->count), 1);
    o->index = (tribox_index){.nodes = o->nodes, .soup = &o->soup, .ids = o->order};
    check(tribox_index_build(&o->index, NULL, o->nodes));
}

/* Asks for as many triangles as a leaf may have: where there are more, the answer is how many, and the node is divided. */
static void divide_box(octree *tree, const ordered *o, const tribox_box *box, int depth)
{
    const bool is_last = depth + 1 == tree->levels;
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
static triangle *make_surface(size_t *count)
{
    *count = 2 * SIDE * SIDE;
    triangle *surface = allocate(*count, sizeof *surface);
    for (int t = 0; t < 2 * SIDE * SIDE; t++)
        for (int v = 0; v < 3; v++) { /* two triangles a square, the second turned by half */
            float *p = surface[t][v];
            p[0] = (float)(t / 2 % SIDE + ((v == 1) != t % 2)) * 2 / SIDE - 1;
            p[1] = (float)(t / 2 / SIDE + ((v == 2) != t % 2)) * 2 / SIDE - 1;
            p[2] = p[0] * p[1];
        }
    return surface;
}

static triangle *read_surface(const char *name, size_t *count)
{
    FILE *file = fopen(name, "rb");
    const long bytes = file && !fseek(file, 0, SEEK_END) ? ftell(file) : 0;
    *count = bytes > 0 ? (size_t)bytes / sizeof(triangle) : 0;
    triangle *surface = allocate(*count, sizeof *surface);
    if (!*count || fseek(file, 0, SEEK_SET) || fread(surface, sizeof *surface, *count, file) != *count) {
        fprintf(stderr, "%s: no triangles of nine floats can be read\n", name);
        exit(1);
    }
    fclose(file);
    return surface;
}

static tribox_box bounds(const triangle *surface, size_t count)
{
    tribox_box box;
    for (int a = 0; a < 3; a++)
        box.lo[a] = box.hi[a] = surface[0][0][a];
    for (size_t i = 0; i < 9 * count; i++) {
        const float at = surface[i / 9][i / 3 % 3][i % 3];
        box.lo[i % 3] = at < box.lo[i % 3] ? at : box.lo[i % 3];
        box.hi[i % 3] = at > box.hi[i % 3] ? at : box.hi[i % 3];
    }
    return box;
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
    printf("%zu triangles\nlevel   nodes  leaves  triangles in leaves\n", by_index->count);
    for (int d = 0; d < by_index->levels; d++)
        printf("%5d %7zu %7zu %20zu\n", d, by_index->nodes[d], by_index->leaves[d], by_index->references[d]);
    printf("by lists %.1f ms, by the index %.1f ms: %.1f times as fast\n", lists_ms, index_ms, lists_ms / index_ms);
    printf("with order, streams and index, made before in %.1f ms: %.1f times\n", order_ms, lists_ms / (order_ms + index_ms));
    puts(is_right ? "the same triangles in every leaf" : "THE LEAVES DIFFER");
    return is_right;
}

int main(int argc, char **argv)
{
    octree by_lists = {.levels = argc > 2 ? atoi(argv[2]) : LEVELS};
    if (by_lists.levels < 1 || by_lists.levels > LEVELS_MOST) {
        fprintf(stderr, "levels: 1 to %d\n", LEVELS_MOST);
        return 1;
    }
    triangle *surface = argc > 1 ? read_surface(argv[1], &by_lists.count) : make_surface(&by_lists.count);
    by_lists.triangles = (const triangle *)surface;
    by_lists.root = bounds(by_lists.triangles, by_lists.count);
    octree by_index = by_lists;
    ordered o;

    const double start = milliseconds();
    build_by_lists(&by_lists);
    const double lists_done = milliseconds();
    order_triangles(&by_index, &o);
    const double order_done = milliseconds();
    divide_box(&by_index, &o, &by_index.root, 0);
    const double index_done = milliseconds();
    const bool is_right = report(&by_lists, &by_index, lists_done - start, order_done - lists_done, index_done - order_done);

    free(by_lists.list);
    free(by_index.list);
    free(o.order);
    free(o.coordinates);
    free(o.nodes);
    free(surface);
    return is_right ? 0 : 1;
}
