/* places.c - the middles of the bounding boxes of triangles and boxes. */
#include "places.h"

#include "finite.h"

enum { BLOCK = 256 };

/* Bounds of a block of triangles or boxes. */
typedef struct bounds {
    float lo[3][BLOCK], hi[3][BLOCK];
    bool is_finite[BLOCK];
} bounds;

static float lesser(float a, float b) { return a < b ? a : b; }
static float greater(float a, float b) { return a > b ? a : b; }

/* Half way between two floats, rounded once; it overflows nowhere, and zero has one sign. */
static float middle(float lo, float hi) { return (float)(0.5 * ((double)lo + (double)hi)) + 0.0f; }

static void write_places(const tribox_places *places, const bounds *b, size_t first, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const uint32_t number = (uint32_t)(first + i);
        memcpy(tribox_places_at(places, 3, first + i), &number, sizeof number);
        for (int a = 0; a < 3; a++) {
            const float m = b->is_finite[i] ? middle(b->lo[a][i], b->hi[a][i]) : NAN;
            memcpy(tribox_places_at(places, a, first + i), &m, sizeof m);
        }
    }
}

static void bound_triangles(const tribox_soup *soup, size_t first, size_t count, bounds *b)
{
    for (size_t i = 0; i < count; i++)
        b->is_finite[i] = true;
    for (int a = 0; a < 3; a++)
        for (size_t i = 0; i < count; i++) {
            const float *const *const stream = tribox_soup_axis(soup, a);
            const float u = stream[0][first + i], v = stream[1][first + i], w = stream[2][first + i];
            b->lo[a][i] = lesser(lesser(u, v), w);
            b->hi[a][i] = greater(greater(u, v), w);
            b->is_finite[i] &= tribox_is_finite(u);
            b->is_finite[i] &= tribox_is_finite(v);
            b->is_finite[i] &= tribox_is_finite(w);
        }
}

void tribox_places_of_soup(const tribox_places *places, const tribox_soup *soup, size_t first, size_t count)
{
    bounds b;
    for (size_t done = 0; done < count; done += BLOCK) {
        const size_t block = count - done < BLOCK ? count - done : BLOCK;
        bound_triangles(soup, first + done, block, &b);
        write_places(places, &b, first + done, block);
    }
}

void tribox_places_of_mesh(const tribox_places *places, const tribox_mesh *mesh, const tribox_kernel *kernel, size_t first,
                           size_t count)
{
    bounds b;
    float streams[9][BLOCK], *to[9];
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    for (size_t done = 0; done < count; done += BLOCK) {
        const size_t block = count - done < BLOCK ? count - done : BLOCK;
        const tribox_soup soup = tribox_soup_of(&streams[0][0], BLOCK, block);
        kernel->gather(mesh, first + done, block, to);
        bound_triangles(&soup, 0, block, &b);
        write_places(places, &b, first + done, block);
    }
}

void tribox_places_of_boxes(const tribox_places *places, const tribox_boxes *boxes, size_t first, size_t count)
{
    bounds b;
    for (size_t done = 0; done < count; done += BLOCK) {
        const size_t block = count - done < BLOCK ? count - done : BLOCK;
        for (size_t i = 0; i < block; i++)
            b.is_finite[i] = true;
        for (int a = 0; a < 3; a++)
            for (size_t i = 0; i < block; i++) {
                b.lo[a][i] = boxes->lo[a][first + done + i];
                b.hi[a][i] = boxes->hi[a][first + done + i];
                b.is_finite[i] &= tribox_is_finite(b.lo[a][i]);
                b.is_finite[i] &= tribox_is_finite(b.hi[a][i]);
            }
        write_places(places, &b, first + done, block);
    }
}
