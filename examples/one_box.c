/*
 * one_box.c - which triangles overlap a box? For a mesh of vertices and faces, and for its nine streams.
 *
 *     cc -std=c11 -O2 one_box.c $(pkg-config --cflags --libs tribox) -o one_box && ./one_box
 */
#include <stdio.h>
#include <stdlib.h>
#include <tribox.h>

enum { TRIANGLES = 12 };

/* The cube from -1 to 1: vertex 4 * x + 2 * y + z has a bit for each axis. */
static const float vertices[8][3] = {{-1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {-1, 1, 1},
                                     {1, -1, -1},  {1, -1, 1},  {1, 1, -1},  {1, 1, 1}};
static const uint16_t faces[TRIANGLES][3] = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5},  /* x = -1, x = 1 */
                                             {0, 4, 5}, {0, 5, 1}, {2, 3, 7}, {2, 7, 6},  /* y = -1, y = 1 */
                                             {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}}; /* z = -1, z = 1 */

static void check(tribox_status status)
{
    if (status != TRIBOX_OK) {
        fprintf(stderr, "tribox: %s\n", tribox_status_text(status));
        exit(1);
    }
}

static void print_mask(const char *title, const uint64_t *mask)
{
    uint32_t indices[TRIANGLES];
    const size_t count = tribox_mask_indices(mask, TRIANGLES, indices);
    printf("%s:", title);
    for (size_t i = 0; i < count; i++)
        printf(" %u", (unsigned)indices[i]);
    printf("\n");
}

int main(void)
{
    const tribox_mesh mesh = {.positions = vertices,
                              .stride = sizeof vertices[0],
                              .vertices = 8,
                              .indices = faces,
                              .index_bytes = sizeof faces[0][0],
                              .count = TRIANGLES};
    const tribox_box corner = {{0.5f, 0.5f, 0.5f}, {1.5f, 1.5f, 1.5f}}, edge = {{0.5f, 1, -2}, {2, 2, -1}};
    uint64_t mask[1]; /* tribox_mask_words(TRIANGLES) words */
    tribox_report report;

    /* The mesh as it is: only the answer needs memory. */
    check(tribox_mesh_overlap(&mesh, &corner, NULL, mask, &report));
    printf("%zu of %d triangles overlap the box at a corner\n", report.overlapping, TRIANGLES);
    print_mask("indexed", mask);

    /* Its nine streams, for a mesh that is tested often: x[v][i] is the x of vertex v of triangle i. */
    static float x[3][TRIANGLES], y[3][TRIANGLES], z[3][TRIANGLES];
    check(tribox_mesh_to_soup(&mesh, NULL, 0, TRIANGLES, NULL, (float *[]){x[0], x[1], x[2]}, (float *[]){y[0], y[1], y[2]},
                              (float *[]){z[0], z[1], z[2]}));
    const tribox_soup soup = {{x[0], x[1], x[2]}, {y[0], y[1], y[2]}, {z[0], z[1], z[2]}, TRIANGLES};
    check(tribox_overlap(&soup, &corner, NULL, mask, NULL));
    print_mask("streams", mask);

    /* Touching is overlap: this box and the cube share a part of an edge, and no more. */
    check(tribox_overlap(&soup, &edge, NULL, mask, NULL));
    print_mask("touching an edge", mask);
    return 0;
}
