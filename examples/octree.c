/*
 * octree.c - builds an octree over a surface: a triangle belongs to every child that it overlaps.
 *
 *     cc -std=c11 -O2 octree.c $(pkg-config --cflags --libs tribox) -o octree && ./octree
 */
#include <stdio.h>
#include <stdlib.h>
#include <tribox.h>

enum { SIDE = 64, TRIANGLES = 2 * SIDE * SIDE, LEVELS = 6, LEAF = 32 /* triangles, at most, of a node without children */ };
static float triangles[TRIANGLES][3][3];
static size_t all[TRIANGLES]; /* the list of the root: 0, 1, 2, ... */

typedef struct level {
    size_t nodes, leaves, references; /* references: triangles, counted in each of the level's leaves */
} level;

static void stop(tribox_status status)
{
    fprintf(stderr, "tribox: %s\n", tribox_status_text(status));
    exit(1);
}

static void *allocate(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    if (!memory)
        stop(TRIBOX_NO_MEMORY);
    return memory;
}

/* The saddle z = x * y over the square from -1 to 1. */
static void make_surface(void)
{
    for (int t = 0; t < TRIANGLES; t++) {
        all[t] = (size_t)t;
        for (int v = 0; v < 3; v++) { /* two triangles a square, the second turned by half */
            float *p = triangles[t][v];
            p[0] = (float)(t / 2 % SIDE + ((v == 1) != t % 2)) * 2 / SIDE - 1;
            p[1] = (float)(t / 2 / SIDE + ((v == 2) != t % 2)) * 2 / SIDE - 1;
            p[2] = p[0] * p[1];
        }
    }
}

static void build(const tribox_box *box, const size_t *list, size_t count, int depth, level levels[])
{
    levels[depth].nodes++;
    if (count <= LEAF || depth + 1 == LEVELS) {
        levels[depth].leaves++;
        levels[depth].references += count;
        return;
    }

    /* The eight children as boxes in streams. They share the planes in the middle, so nothing slips between them. */
    float bound[2][3][8];
    tribox_boxes children = {.count = 8};
    for (int a = 0; a < 3; a++) {
        const float middle = (box->lo[a] + box->hi[a]) / 2;
        for (int c = 0; c < 8; c++) {
            bound[0][a][c] = c >> a & 1 ? middle : box->lo[a];
            bound[1][a][c] = c >> a & 1 ? box->hi[a] : middle;
        }
        children.lo[a] = bound[0][a];
        children.hi[a] = bound[1][a];
    }

    /* One call tests a triangle against all eight: bit c of the mask is child c. */
    unsigned char *overlapped = allocate(count, 1);
    for (size_t i = 0; i < count; i++) {
        uint64_t mask;
        const tribox_status status = tribox_overlap_boxes((const float(*)[3])triangles[list[i]], &children, NULL, &mask, NULL);
        if (status != TRIBOX_OK)
            stop(status);
        overlapped[i] = (unsigned char)mask;
    }

    size_t *own = allocate(count, sizeof *own);
    for (int c = 0; c < 8; c++) {
        size_t own_count = 0;
        for (size_t i = 0; i < count; i++)
            if (overlapped[i] >> c & 1)
                own[own_count++] = list[i];
        const tribox_box child = {{bound[0][0][c], bound[0][1][c], bound[0][2][c]},
                                  {bound[1][0][c], bound[1][1][c], bound[1][2][c]}};
        build(&child, own, own_count, depth + 1, levels);
    }
    free(own);
    free(overlapped);
}

int main(void)
{
    const tribox_box root = {{-1, -1, -1}, {1, 1, 1}};
    level levels[LEVELS] = {{0}};
    make_surface();
    build(&root, all, TRIANGLES, 0, levels);

    printf("%d triangles\nlevel   nodes  leaves  triangles in leaves\n", TRIANGLES);
    for (int d = 0; d < LEVELS; d++)
        printf("%5d %7zu %7zu %20zu\n", d, levels[d].nodes, levels[d].leaves, levels[d].references);
    return 0;
}
