#include "grid_scenes_f64.h"

#include <float.h>
#include <math.h>

#include "common/harness.h"

static void draw_plain(random_source *r, tribox_grid *grid)
{
    static const double cells[] = {1, 0.1, 0.25, 1.0 / 3, 3};
    for (int a = 0; a < 3; a++) {
        grid->origin[a] = random_int(r, 2) ? 0 : random_double(r, -10, 10);
        grid->cell[a] = cells[random_int(r, 5)];
    }
}

static void draw_dyadic(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->origin[a] = random_int_between(r, -64, 64) / 4.0;
        grid->cell[a] = ldexp(1, random_int_between(r, -3, 2));
    }
}

static void draw_offset(random_source *r, tribox_grid *grid)
{
    static const double cells[] = {0.5, 0.1, 0.0625, 1e-3, 1e-5};
    const double cell = cells[random_int(r, 5)];
    for (int a = 0; a < 3; a++) {
        grid->origin[a] = random_double(r, -1e7, 1e7);
        grid->cell[a] = cell;
    }
}

/* Cells of few spacings of doubles, down to one. */
static void draw_geocentric(random_source *r, tribox_grid *grid)
{
    static const double at[3] = {4.1e6, -1.13e6, 4.74e6};
    for (int a = 0; a < 3; a++) {
        grid->origin[a] = at[a] + random_double(r, -1000, 1000);
        grid->cell[a] = 1e-9 * random_int_between(r, 1, 9);
    }
}

static void draw_mercator(random_source *r, tribox_grid *grid)
{
    static const double at[3] = {1.49e6, 6.89e6, 120};
    for (int a = 0; a < 3; a++) {
        grid->origin[a] = at[a] + random_double(r, -500, 500);
        grid->cell[a] = a == 2 ? 0.05 : 0.01;
    }
}

static double draw_number(random_source *r) { return (random_int(r, 2) ? 1 : -1) * random_double(r, 1, 2); }

static void draw_lengths(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = fabs(ldexp(draw_number(r), random_int_between(r, -60, 60)));
        grid->origin[a] = grid->cell[a] * random_double(r, -1e6, 1e6);
    }
}

static void draw_exponents(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        const int exponent = random_int_between(r, -1070, 1010);
        grid->cell[a] = fabs(ldexp(draw_number(r), exponent));
        grid->origin[a] = random_int(r, 2) ? ldexp(draw_number(r), random_int_between(r, -1074, exponent + 10))
                                           : grid->cell[a] * random_double(r, -100, 100);
    }
}

static void draw_huge(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->origin[a] = -random_double(r, 0, 1) * DBL_MAX;
        grid->cell[a] = random_double(r, 0.001, 0.1) * DBL_MAX;
    }
}

static void draw_subnormal(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->origin[a] = random_int_between(r, -100, 100) * 0x1p-1074;
        grid->cell[a] = random_int_between(r, 1, 50) * 0x1p-1074;
    }
}

/* Planes next to each other, or nearly. */
static void draw_spacings(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        const double from = ldexp(draw_number(r), random_int_between(r, -20, 20)), spacing = nextafter(from, INFINITY) - from;
        grid->origin[a] = from;
        grid->cell[a] = spacing * (random_int(r, 2) ? random_int_between(r, 1, 6) : random_double(r, 1, 10));
    }
}

static const scene_f64 scenes[] = {
    {"plain", draw_plain},         {"dyadic", draw_dyadic},     {"offset", draw_offset},       {"geocentric", draw_geocentric},
    {"mercator", draw_mercator},   {"lengths", draw_lengths},   {"exponents", draw_exponents}, {"huge", draw_huge},
    {"subnormal", draw_subnormal}, {"spacings", draw_spacings},
};

size_t scene_f64_count(void) { return sizeof scenes / sizeof scenes[0]; }
const scene_f64 *scene_f64_at(size_t i) { return &scenes[i]; }

/* By definition: sizes here are small. */
static bool has_rising_planes(const tribox_grid *grid)
{
    for (int a = 0; a < 3; a++)
        for (uint32_t p = 0; p <= grid->size[a]; p++)
            if (!isfinite(window_f64_plane(grid, a, p)) ||
                (p && !(window_f64_plane(grid, a, p) > window_f64_plane(grid, a, p - 1.0))))
                return false;
    return true;
}

/* Places far along x count most for what float rounds. */
static bool draw_long_grid(random_source *r, const scene_f64 *scene, tribox_grid *grid)
{
    for (int trial = 0; trial < 5; trial++) {
        scene->draw(r, grid);
        grid->size[0] = (uint32_t)random_int_between(r, 20000, 60000);
        grid->size[1] = (uint32_t)random_int_between(r, 1, 2);
        grid->size[2] = (uint32_t)random_int_between(r, 1, 2);
        if (has_rising_planes(grid))
            return true;
    }
    return false;
}

void draw_grid_f64(random_source *r, const scene_f64 *scene, int cells, tribox_grid *grid)
{
    if (cells > 1000 && !random_int(r, 6) && draw_long_grid(r, scene, grid))
        return;
    do {
        scene->draw(r, grid);
        int left = cells;
        for (int n = 0, a = random_int(r, 3); n < 3; n++, a = (a + 1) % 3) {
            grid->size[a] = (uint32_t)random_int_between(r, 1, left < 33 ? left : random_int(r, 8) ? 33 : left < 100 ? left : 100);
            left /= (int)grid->size[a];
        }
    } while (!has_rising_planes(grid));
}

/* Some doubles further up or down. */
static double moved(double x, int spacings)
{
    for (; spacings > 0; spacings--)
        x = nextafter(x, INFINITY);
    for (; spacings < 0; spacings++)
        x = nextafter(x, -INFINITY);
    return x;
}

static double draw_coordinate(random_source *r, const tribox_grid *grid, int a, double least, double most)
{
    const double p = random_double(r, least, most);
    double x;
    switch (random_int(r, 8)) {
    case 0:
    case 1:
    case 2:
        x = window_f64_plane(grid, a, floor(p));
        break;
    case 3:
        x = moved(window_f64_plane(grid, a, floor(p)), random_int_between(r, -2, 2));
        break;
    case 4: /* within what float can tell of a plane */
        x = window_f64_plane(grid, a, floor(p)) + grid->cell[a] * ldexp(draw_number(r), random_int_between(r, -60, -15));
        break;
    default:
        x = window_f64_plane(grid, a, p);
    }
    return isfinite(x) ? x : window_f64_plane(grid, a, 0);
}

/* The last vertex next to the edge of the others, by what float can tell or not. */
static void draw_sliver(random_source *r, const tribox_grid *grid, triangle_f64 u)
{
    const double at = random_int(r, 2) ? random_double(r, 0, 1) : random_int(r, 9) / 8.0;
    const int exponent = random_int_between(r, -45, -4);
    for (int a = 0; a < 3; a++) {
        const double x = u[0][a] + at * (u[1][a] - u[0][a]) + grid->cell[a] * ldexp(draw_number(r), exponent);
        u[2][a] = isfinite(x) ? x : u[0][a];
    }
}

/* Numbers near the ends of the range, or a whole axis of tiny ones. */
static void draw_extreme(random_source *r, triangle_f64 u)
{
    static const double far[] = {1e30, -1e30, 1e300, -1e300, DBL_MAX, -DBL_MAX, 0x1p-1074, -0x1p-1040, 1e-300};
    static const double tiny[] = {0, 0x1p-1074, -0x1p-1040, 1e-300, -1e-200, 1e-100};
    const int a = random_int(r, 3);
    if (random_int(r, 2)) {
        for (int j = 0; j < 3; j++)
            u[j][a] = tiny[random_int(r, 6)];
        return;
    }
    for (int n = random_int_between(r, 1, 3); n > 0; n--)
        u[random_int(r, 3)][random_int(r, 3)] = far[random_int(r, 9)];
}

void draw_triangle_f64(random_source *r, const tribox_grid *grid, triangle_f64 u)
{
    static const double lengths[] = {0.3, 1.5, 3, 8, 40, 100};
    const double length = lengths[random_int(r, 6)];
    for (int a = 0; a < 3; a++) {
        const double from = random_double(r, -2, grid->size[a] + 1.0), to = from + (random_int(r, 4) ? length : 0.2);
        for (int j = 0; j < 3; j++)
            u[j][a] = j && !random_int(r, 4) ? u[j - 1][a] : draw_coordinate(r, grid, a, from, to);
    }
    if (!random_int(r, 20))
        memcpy(u[2], u[random_int(r, 2)], sizeof u[2]);
    if (!random_int(r, 6))
        draw_sliver(r, grid, u);
    if (!random_int(r, 10))
        draw_extreme(r, u);
    if (!random_int(r, 100))
        u[random_int(r, 3)][random_int(r, 3)] = random_int(r, 2) ? NAN : INFINITY;
}

void window_f64_draw_scene(window_f64 *w, random_source *r, const scene_f64 *scene, int cells)
{
    enum { LONG = 1000 };
    w->scene = scene->name;
    w->seed = args.seed;
    draw_grid_f64(r, scene, cells, &w->grid);
    const bool is_few = w->grid.size[0] > LONG || random_int(r, 2);
    const int count = is_few ? random_int_between(r, 1, 6) : random_int_between(r, 20, 60);
    for (w->count = 0; w->count < (size_t)count; w->count++)
        draw_triangle_f64(r, &w->grid, w->triangle[w->count]);
}
