/* index_canvas.c - projects triangles, and keeps the nearest at each sample. */
#include "index_canvas.h"

#include <math.h>
#include <stdlib.h>

#include "soup_room.h"

static void set_axes(canvas *c, double right, double above)
{
    const double degree = 3.14159265358979323846 / 180;
    const double cr = cos(right * degree), sr = sin(right * degree), ca = cos(above * degree), sa = sin(above * degree);
    const double axis[3][3] = {{cr, sr, 0}, {sr * sa, -cr * sa, -ca}, {sr * ca, -cr * ca, sa}};
    for (int k = 0; k < 9; k++)
        c->axis[k / 3][k % 3] = axis[k / 3][k % 3];
}

static void widen(const canvas *c, const float point[3], float least[3], float most[3])
{
    float at[3];
    canvas_place(c, point, at);
    for (int k = 0; k < 3; k++) {
        least[k] = fminf(least[k], at[k]);
        most[k] = fmaxf(most[k], at[k]);
    }
}

/* The largest scale at which the soup and the box are seen, in the middle and with a margin. */
static void fit(canvas *c, const tribox_soup *soup, const tribox_box *box)
{
    float least[3] = {INFINITY, INFINITY, INFINITY}, most[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < soup->count; i++) {
        const float corner[3] = {soup->x[0][i], soup->y[0][i], soup->z[0][i]};
        widen(c, corner, least, most);
    }
    for (int k = 0; k < 8; k++) {
        const float corner[3] = {(float)(k & 1 ? box->hi : box->lo)[0], (float)(k & 2 ? box->hi : box->lo)[1],
                                 (float)(k & 4 ? box->hi : box->lo)[2]};
        widen(c, corner, least, most);
    }
    const double width = (double)(most[0] - least[0]), height = (double)(most[1] - least[1]);
    const double scale = 0.97 * fmin(c->width / width, c->height / height);
    for (int k = 0; k < 9; k++)
        c->axis[k / 3][k % 3] *= scale;
    c->corner[0] = (c->width - scale * (double)(least[0] + most[0])) / 2;
    c->corner[1] = (c->height - scale * (double)(least[1] + most[1])) / 2;
}

bool canvas_make(unsigned width, unsigned height, const tribox_soup *soup, const tribox_box *box, const double from[2],
                 canvas *made)
{
    *made = (canvas){.width = CANVAS_FINE * width, .height = CANVAS_FINE * height};
    const size_t samples = (size_t)made->width * made->height;
    made->triangle = malloc(samples * sizeof *made->triangle);
    made->depth = malloc(samples * sizeof *made->depth);
    if (!made->triangle || !made->depth)
        return false;
    for (size_t i = 0; i < samples; i++) {
        made->triangle[i] = CANVAS_NOTHING;
        made->depth[i] = -INFINITY;
    }
    set_axes(made, from[0], from[1]);
    fit(made, soup, box);
    return true;
}

void canvas_free(canvas *made)
{
    free(made->triangle);
    free(made->depth);
}

void canvas_place(const canvas *c, const float point[3], float at[3])
{
    for (int k = 0; k < 3; k++) {
        double sum = c->corner[k];
        for (int a = 0; a < 3; a++)
            sum += c->axis[k][a] * (double)point[a];
        at[k] = (float)sum;
    }
}

static void keep_nearer(canvas *c, unsigned x, unsigned y, float depth, uint32_t triangle)
{
    const size_t at = (size_t)y * c->width + x;
    if (depth <= c->depth[at])
        return;
    c->depth[at] = depth;
    c->triangle[at] = triangle;
}

static float side(const float p[3], const float q[3], float x, float y)
{
    return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
}

static unsigned sample_from(float at, unsigned count)
{
    const float up = ceilf(at - 0.5f);
    return up < 0 ? 0 : up > (float)count ? count : (unsigned)up;
}

static void draw_triangle(canvas *c, uint32_t triangle, const float p[3][3])
{
    const float area = side(p[0], p[1], p[2][0], p[2][1]);
    if (area == 0)
        return;
    const unsigned x_end = sample_from(fmaxf(fmaxf(p[0][0], p[1][0]), p[2][0]), c->width);
    const unsigned y_end = sample_from(fmaxf(fmaxf(p[0][1], p[1][1]), p[2][1]), c->height);
    for (unsigned y = sample_from(fminf(fminf(p[0][1], p[1][1]), p[2][1]), c->height); y < y_end; y++)
        for (unsigned x = sample_from(fminf(fminf(p[0][0], p[1][0]), p[2][0]), c->width); x < x_end; x++) {
            const float sx = (float)x + 0.5f, sy = (float)y + 0.5f;
            const float u = side(p[1], p[2], sx, sy) / area, v = side(p[2], p[0], sx, sy) / area;
            if (u >= 0 && v >= 0 && u + v <= 1)
                keep_nearer(c, x, y, u * p[0][2] + v * p[1][2] + (1 - u - v) * p[2][2], triangle);
        }
}

void canvas_draw(canvas *c, const tribox_soup *soup)
{
    for (size_t i = 0; i < soup->count; i++) {
        float corners[3][3], seen[3][3];
        soup_triangle(soup, i, corners);
        for (int v = 0; v < 3; v++)
            canvas_place(c, corners[v], seen[v]);
        draw_triangle(c, (uint32_t)i, (const float(*)[3])seen);
    }
}
