#include "grid_kinds.h"

#include <float.h>
#include <math.h>

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

static void draw_units(random_source *r, tribox_grid *grid)
{
    (void)r;
    for (int a = 0; a < 3; a++) {
        grid->origin[a] = 0;
        grid->cell[a] = 1;
    }
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
        const double cell = random_double(r, 0.4, 2.5), from = random_double(r, -50, 20);
        grid->cell[a] = is_float ? nearest_float(cell) : cell;
        grid->origin[a] = is_float ? nearest_float(from) : from;
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

/* Of doubles. */

static void draw_far_from_origin(random_source *r, tribox_grid *grid)
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

static void draw_huge_doubles(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->origin[a] = -random_double(r, 0, 1) * DBL_MAX;
        grid->cell[a] = random_double(r, 0.001, 0.1) * DBL_MAX;
    }
}

static void draw_subnormal_doubles(random_source *r, tribox_grid *grid)
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

static const grid_kind kinds[] = {
    {"units", draw_units, true, false},
    {"dyadic", draw_dyadic, true, false},
    {"nearly dyadic", draw_nearly_dyadic, true, false},
    {"tenths", draw_tenths, true, false},
    {"any", draw_any, true, false},
    {"about zero", draw_about_zero, true, false},
    {"far", draw_far, true, false},
    {"offset", draw_offset, true, false},
    {"own lengths", draw_own_lengths, true, false},
    {"tiny", draw_tiny, false, false},
    {"huge", draw_huge, false, false},
    {"scaled", draw_scaled, true, false},
    {"brink", draw_brink, true, false},
    {"subnormal", draw_subnormal, false, false},
    {"mixed", draw_mixed, false, false},
    {"range", draw_ends_of_range, false, false},
    {"beyond floats", draw_beyond_floats, false, false},
    {"one cell", draw_one_cell, true, false},
    {"plain doubles", draw_tenths, false, true},
    {"dyadic doubles", draw_dyadic, false, true},
    {"offset doubles", draw_far_from_origin, false, true},
    {"geocentric", draw_geocentric, false, true},
    {"mercator", draw_mercator, false, true},
    {"lengths", draw_lengths, false, true},
    {"exponents", draw_exponents, false, true},
    {"huge doubles", draw_huge_doubles, false, true},
    {"subnormal doubles", draw_subnormal_doubles, false, true},
    {"spacings", draw_spacings, false, true},
};
enum { KINDS = sizeof kinds / sizeof kinds[0], OF_DOUBLES = 10 };

size_t grid_kind_count(void) { return KINDS; }
size_t grid_kind_floats(void) { return KINDS - OF_DOUBLES; }
const grid_kind *grid_kind_at(size_t i) { return &kinds[i]; }

/* By definition: sizes here are small. */
static bool has_rising_planes(const tribox_grid *grid)
{
    for (int a = 0; a < 3; a++)
        for (uint32_t p = 0; p <= grid->size[a]; p++)
            if (!isfinite(cells_plane(grid, a, p)) || (p && !(cells_plane(grid, a, p) > cells_plane(grid, a, p - 1.0))))
                return false;
    return true;
}

static bool draw_grid(random_source *r, const grid_kind *kind, cells_case *c)
{
    c->scene = kind->name;
    c->is_double = kind->is_double;
    c->form = kind->is_double ? DOUBLES : SOUP;
    c->count = 0;
    kind->draw(r, &c->grid);
    cells_open(c);
    return has_rising_planes(&c->grid);
}

void draw_grid_of_size(random_source *r, const grid_kind *kind, const uint32_t size[3], cells_case *c)
{
    do
        memcpy(c->grid.size, size, sizeof c->grid.size);
    while (!draw_grid(r, kind, c));
}

void draw_grid_of_kind(random_source *r, const grid_kind *kind, size_t most, cells_case *c)
{
    uint32_t *const size = c->grid.size;
    /* Places far along x count most for what float rounds. */
    for (int trial = kind->is_double && most > 1000 && !random_int(r, 6) ? 5 : 0; trial > 0; trial--) {
        size[0] = size_between(r, 20000, 60000);
        size[1] = size_between(r, 1, 2);
        size[2] = size_between(r, 1, 2);
        if (draw_grid(r, kind, c))
            return;
    }
    do
        draw_size(r, size);
    while ((size_t)size[0] * size[1] * size[2] > most || !draw_grid(r, kind, c) || (size_t)size[0] * size[1] * size[2] > most);
}
