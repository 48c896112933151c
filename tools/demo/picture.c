/* picture.c - draws a soup into cells of a terminal, twice as high as wide. */
#include "picture.h"

#include <math.h>
#include <stdio.h>

enum { COLUMNS = 60, ROWS = 24 };

typedef struct view {
    double middle[2];
    double cell_height;
} view;

typedef struct cell {
    double depth; /* z of the nearest centre so far */
    char shown;   /* ' ' while there is none */
} cell;

static double coordinate(const tribox_soup *soup, int a, int v, size_t i)
{
    return (double)(a == 0 ? soup->x : a == 1 ? soup->y : soup->z)[v][i];
}

static view view_of(const tribox_soup *soup)
{
    view seen;
    double size[2];
    for (int a = 0; a < 2; a++) {
        double lo = INFINITY, hi = -INFINITY;
        for (size_t i = 0; i < soup->count; i++)
            for (int v = 0; v < 3; v++) {
                lo = fmin(lo, coordinate(soup, a, v, i));
                hi = fmax(hi, coordinate(soup, a, v, i));
            }
        seen.middle[a] = (lo + hi) / 2;
        size[a] = hi - lo;
    }
    seen.cell_height = fmax(size[1] / ROWS, size[0] / (0.5 * COLUMNS));
    return seen;
}

static char shade(const tribox_soup *soup, size_t i)
{
    static const double light[3] = {-0.5, 0.6, 0.62};
    static const char shades[] = ".:-=+*";
    double normal[3], e[3], f[3], dot = 0, square = 0;
    for (int a = 0; a < 3; a++) {
        e[a] = coordinate(soup, a, 1, i) - coordinate(soup, a, 0, i);
        f[a] = coordinate(soup, a, 2, i) - coordinate(soup, a, 0, i);
    }
    for (int a = 0; a < 3; a++)
        normal[a] = e[(a + 1) % 3] * f[(a + 2) % 3] - e[(a + 2) % 3] * f[(a + 1) % 3];
    for (int a = 0; a < 3; a++) {
        dot += normal[a] * light[a];
        square += normal[a] * normal[a];
    }
    /* Both sides of a triangle look alike: the side that faces the viewer is lit. */
    const double brightness = square > 0 ? copysign(1, normal[2]) * dot / sqrt(square) : 0;
    return shades[brightness > 0 ? (int)fmin(brightness * 6, 5) : 0];
}

static void draw(const tribox_soup *soup, const uint64_t *mask, const view *seen, size_t i, cell cells[ROWS][COLUMNS])
{
    double center[3];
    for (int a = 0; a < 3; a++)
        center[a] = (coordinate(soup, a, 0, i) + coordinate(soup, a, 1, i) + coordinate(soup, a, 2, i)) / 3;
    const double column = floor((center[0] - seen->middle[0]) / (0.5 * seen->cell_height) + 0.5 * COLUMNS);
    const double row = floor((seen->middle[1] - center[1]) / seen->cell_height + 0.5 * ROWS);
    if (!(column >= 0 && column < COLUMNS && row >= 0 && row < ROWS))
        return;
    cell *c = &cells[(int)row][(int)column];
    if (c->shown != ' ' && c->depth > center[2])
        return;
    c->depth = center[2];
    c->shown = mask[i / 64] >> i % 64 & 1 ? '#' : shade(soup, i);
}

void picture_print(const tribox_soup *soup, const uint64_t *mask)
{
    cell cells[ROWS][COLUMNS];
    for (int i = 0; i < ROWS * COLUMNS; i++)
        cells[i / COLUMNS][i % COLUMNS] = (cell){0, ' '};
    const view seen = view_of(soup);
    for (size_t i = 0; i < soup->count; i++)
        draw(soup, mask, &seen, i, cells);
    for (int row = 0; row < ROWS; row++) {
        int width = COLUMNS;
        while (width && cells[row][width - 1].shown == ' ')
            width--;
        for (int column = 0; column < width; column++)
            putchar(cells[row][column].shown);
        putchar('\n');
    }
}
