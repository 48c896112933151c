#include "grid_kinds.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "common/contact.h"

/* Rows that end before, at and after the end of a word. */
static uint32_t row_length(random_source *r)
{
    static const uint32_t length[] = {1, 2, 63, 64, 65, 127, 128, 129, 191, 200};
    return length[random_int(r, sizeof length / sizeof length[0])];
}

static uint32_t size_between(random_source *r, int least, int most) { return (uint32_t)random_int_between(r, least, most); }

/* Cubes, rows, columns and towers, and anything. */
static void draw_size(random_source *r, uint32_t size[3])
{
    const int long_axis = random_int(r, 3);
    switch (random_int(r, 5)) {
    case 0:
        size[0] = size[1] = size[2] = size_between(r, 1, 9);
        break;
    case 1:
        size[0] = row_length(r);
        size[1] = size_between(r, 1, 4);
        size[2] = size_between(r, 1, 4);
        break;
    case 2:
        for (int a = 0; a < 3; a++)
            size[a] = a == long_axis ? size_between(r, 40, 150) : size_between(r, 1, 3);
        break;
    case 3:
        size[0] = size[1] = size[2] = size_between(r, 16, 30);
        break;
    default:
        size[0] = row_length(r);
        size[1] = size_between(r, 1, 20);
        size[2] = size_between(r, 1, 20);
    }
}

static void set_grid(tribox_grid *grid, double origin, double cell)
{
    for (int a = 0; a < 3; a++) {
        grid->origin[a] = origin;
        grid->cell[a] = cell;
    }
}

static void draw_units(random_source *r, tribox_grid *grid)
{
    (void)r;
    set_grid(grid, 0, 1);
}

/* Every plane is exact; so are lattice vertices, and there are many ties. */
static void draw_dyadic(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = ldexp(1, random_int_between(r, -6, 3));
        grid->origin[a] = grid->cell[a] * random_int_between(r, -40, 40) / 4;
    }
}

/* Planes that are nearly floats: from a float of many bits, from next to zero, or in steps that float rounds. */
static void draw_nearly_dyadic(random_source *r, tribox_grid *grid)
{
    draw_dyadic(r, grid);
    for (int a = 0; a < 3; a++)
        if (random_int(r, 2))
            grid->origin[a] = nearest_float(random_double(r, -50, 20));
        else if (random_int(r, 3) == 0)
            grid->origin[a] = ldexp(random_int(r, 2) ? 1 : -1, random_int(r, 2) ? -1074 : -random_int_between(r, 140, 1074));
        else
            grid->cell[a] *= 1 + ldexp(random_int(r, 2) ? 1 : -1, -random_int_between(r, 26, 50));
}

static void draw_tenths(random_source *r, tribox_grid *grid)
{
    static const double length[] = {0.1, 0.3, 1.0 / 3, 0.7, 1.1, 0.05};
    const bool is_cubic = random_int(r, 2);
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = is_cubic && a ? grid->cell[0] : length[random_int(r, sizeof length / sizeof length[0])];
        grid->origin[a] = random_int_between(r, -30, 30) * 0.1;
    }
}

/* Of floats or of doubles; planes are doubles. */
static void draw_any(random_source *r, tribox_grid *grid)
{
    const bool is_float = random_int(r, 2);
    for (int a = 0; a < 3; a++) {
        const double cell = random_double(r, 0.4, 2.5), origin = random_double(r, -50, 20);
        grid->cell[a] = is_float ? nearest_float(cell) : cell;
        grid->origin[a] = is_float ? nearest_float(origin) : origin;
    }
}

/* A plane that is nearly zero, or exactly, of either sign. */
static void draw_about_zero(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = random_int(r, 2) ? 0.1 : random_double(r, 0.1, 1);
        grid->origin[a] = -grid->cell[a] * random_int(r, (int)grid->size[a] + 1);
        if (random_int(r, 2))
            grid->origin[a] = random_sign_of_zero(r, nearest_float(grid->origin[a]));
    }
}

/* Far from the origin, where floats are hardly finer than cells, or coarser. */
static void draw_far(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        const double far = pow(10, random_double(r, 5, 7)) * (random_int(r, 2) ? 1 : -1);
        const double spacing = ldexp(1, ilogb(far) - 23);
        grid->origin[a] = random_int(r, 2) ? nearest_float(far) : far;
        grid->cell[a] = spacing * (random_int(r, 3) ? random_double(r, 0.1, 9) : random_int_between(r, 1, 64));
    }
}

static void draw_offset(random_source *r, tribox_grid *grid)
{
    draw_any(r, grid);
    for (int a = 0; a < 3; a++)
        grid->origin[a] += random_int_between(r, -1, 1) * pow(10, random_double(r, 3, 5));
}

static void draw_own_lengths(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = ldexp(random_int(r, 2) ? 1 : 1.3, random_int_between(r, -20, 20));
        grid->origin[a] = grid->cell[a] * random_int_between(r, -100, 100);
    }
}

static void scale(tribox_grid *grid, int exponent)
{
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = ldexp(grid->cell[a], exponent);
        grid->origin[a] = ldexp(grid->origin[a], exponent);
    }
}

static void draw_tiny(random_source *r, tribox_grid *grid)
{
    draw_any(r, grid);
    scale(grid, random_int_between(r, -122, -100));
}

static void draw_huge(random_source *r, tribox_grid *grid)
{
    draw_any(r, grid);
    scale(grid, random_int_between(r, 80, 115));
}

/* Small and large, but far from the ends of the float range. */
static void draw_scaled(random_source *r, tribox_grid *grid)
{
    draw_any(r, grid);
    scale(grid, random_int(r, 2) ? -90 : 90);
}

/* The float nearest to the first plane is many cells away from it, up to more than float can count with. */
static void draw_brink(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        const int exponent = random_int_between(r, 0, 22), finer = random_int_between(r, 0, 24);
        grid->cell[a] = ldexp(random_int(r, 2) ? 1 : random_double(r, 1, 2), exponent - 23 - finer);
        grid->origin[a] = (random_int(r, 2) ? 1 : -1) * random_double(r, 1, 2) * ldexp(1, exponent);
        if (random_int(r, 2))
            grid->origin[a] = nearest_float(grid->origin[a]) - grid->cell[a] * random_int(r, (int)grid->size[a] + 1);
    }
}

/* Cells of a few times the least float, or of parts of it. */
static void draw_subnormal(random_source *r, tribox_grid *grid)
{
    const int finer = random_int(r, 2) ? 0 : random_int_between(r, 1, 60);
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = ldexp(random_int_between(r, 1, 5), -149 - finer);
        grid->origin[a] = random_sign_of_zero(r, ldexpf((float)random_int_between(r, -300, 100), -149));
    }
}

/* No number of the grid is a float, nor near one. */
static void draw_beyond_floats(random_source *r, tribox_grid *grid)
{
    draw_any(r, grid);
    scale(grid, random_int(r, 2) ? random_int_between(r, -1060, -150) : random_int_between(r, 126, 1000));
}

/* Subnormal on one axis, ordinary on another, huge on the third. */
static void draw_mixed(random_source *r, tribox_grid *grid)
{
    const int turn = random_int(r, 3);
    draw_any(r, grid);
    const int low = turn, high = (turn + 1) % 3;
    grid->cell[low] = ldexp(random_int_between(r, 1, 9), random_int_between(r, -149, -130));
    grid->origin[low] = grid->cell[low] * random_int_between(r, -50, 50);
    grid->cell[high] = ldexp(grid->cell[high], 100);
    grid->origin[high] = ldexp(grid->origin[high], 100);
}

/* From one end of the float range to the other: the length of the whole is not a float. */
static void draw_ends_of_range(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->size[a] = grid->size[a] < 3 ? 3 : grid->size[a];
        grid->cell[a] = 2 * (double)FLT_MAX / grid->size[a] * (random_int(r, 2) ? 0.9999999 : 0.7);
        grid->origin[a] = -FLT_MAX;
    }
}

static void draw_one_cell(random_source *r, tribox_grid *grid)
{
    draw_any(r, grid);
    grid->size[0] = grid->size[1] = grid->size[2] = 1;
}

static const grid_kind kinds[] = {
    {"units", draw_units, true},
    {"dyadic", draw_dyadic, true},
    {"nearly dyadic", draw_nearly_dyadic, true},
    {"tenths", draw_tenths, true},
    {"any", draw_any, true},
    {"about zero", draw_about_zero, true},
    {"far", draw_far, true},
    {"offset", draw_offset, true},
    {"own lengths", draw_own_lengths, true},
    {"tiny", draw_tiny, false},
    {"huge", draw_huge, false},
    {"scaled", draw_scaled, true},
    {"brink", draw_brink, true},
    {"subnormal", draw_subnormal, false},
    {"mixed", draw_mixed, false},
    {"range", draw_ends_of_range, false},
    {"beyond floats", draw_beyond_floats, false},
    {"one cell", draw_one_cell, true},
};

size_t grid_kind_count(void) { return sizeof kinds / sizeof kinds[0]; }

const grid_kind *grid_kind_at(size_t i) { return &kinds[i]; }

void draw_grid_of_size(random_source *r, const grid_kind *kind, const uint32_t size[3], grid_planes *l)
{
    tribox_grid grid;
    do {
        memcpy(grid.size, size, sizeof grid.size);
        kind->draw(r, &grid);
    } while (!grid_planes_make(l, &grid));
}

void draw_grid_of_kind(random_source *r, const grid_kind *kind, size_t cells, grid_planes *l)
{
    do {
        tribox_grid grid;
        draw_size(r, grid.size);
        kind->draw(r, &grid);
        if ((size_t)grid.size[0] * grid.size[1] * grid.size[2] <= cells && grid_planes_make(l, &grid))
            return;
    } while (true);
}
