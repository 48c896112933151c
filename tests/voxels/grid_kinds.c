#include "kinds.h"

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

/* Numbers between others, times a power of two that all axes share, or that each has its own of. */
struct grid_range {
    double at[3], spread, cell[2];
    int exponent[2];
    bool are_own;
};

static const grid_range any = {{-15, -15, -15}, 35, {0.4, 2.5}, {0, 0}, false};

/* Of floats at times, where they are in range; often of one length, or with planes that are multiples of it. */
static void draw_range(random_source *r, const grid_range *of, tribox_grid *grid)
{
    const bool are_floats = random_int(r, 2) && of->exponent[0] >= -122 && of->exponent[1] <= 115;
    const bool is_cubic = random_int(r, 4) == 0, are_multiples = random_int(r, 4) == 0;
    for (int a = 0, exponent = 0; a < 3; a++) {
        exponent = a && !of->are_own ? exponent : random_int_between(r, of->exponent[0], of->exponent[1]);
        const double cell = ldexp(random_double(r, of->cell[0], of->cell[1]), exponent);
        const double from = ldexp(of->at[a] + of->spread * random_double(r, -1, 1), exponent);
        grid->cell[a] = is_cubic && a ? grid->cell[0] : are_floats ? nearest_float(cell) : cell;
        grid->origin[a] = are_multiples ? floor(from / grid->cell[a]) * grid->cell[a] : are_floats ? nearest_float(from) : from;
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
    draw_range(r, &any, grid);
    for (int a = 0; a < 3; a++)
        grid->origin[a] += random_int_between(r, -1, 1) * pow(10, random_double(r, 3, 5));
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

/* Subnormal on one axis, ordinary on another, huge on the third. */
static void draw_mixed(random_source *r, tribox_grid *grid)
{
    const int turn = random_int(r, 3);
    draw_range(r, &any, grid);
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
    draw_range(r, &any, grid);
    grid->size[0] = grid->size[1] = grid->size[2] = 1;
}

/* Planes next to each other, or nearly. */
static void draw_spacings(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        const double from = ldexp(random_double(r, random_int(r, 2) ? 1 : -2, 2), random_int_between(r, -20, 20)),
                     spacing = nextafter(from, INFINITY) - from;
        grid->origin[a] = from;
        grid->cell[a] = spacing * (random_int(r, 2) ? random_int_between(r, 1, 6) : random_double(r, 1, 10));
    }
}

static const grid_kind kinds[] = {
    {"units", draw_units, NULL, true, false},
    {"dyadic", draw_dyadic, NULL, true, false},
    {"nearly dyadic", draw_nearly_dyadic, NULL, true, false},
    {"tenths", draw_tenths, NULL, true, false},
    {"any", NULL, &any, true, false},
    {"about zero", draw_about_zero, NULL, true, false},
    {"far", draw_far, NULL, true, false},
    {"offset", draw_offset, NULL, true, false},
    {"own lengths", NULL, &(const grid_range){{0}, 100, {1, 1.3}, {-20, 20}, true}, true, false},
    {"tiny", NULL, &(const grid_range){{-15, -15, -15}, 35, {0.4, 2.5}, {-122, -100}, false}, false, false},
    {"huge", NULL, &(const grid_range){{-15, -15, -15}, 35, {0.4, 2.5}, {80, 115}, false}, false, false},
    {"scaled", NULL, &(const grid_range){{-15, -15, -15}, 35, {0.4, 2.5}, {-90, 90}, false}, true, false},
    {"brink", draw_brink, NULL, true, false},
    {"subnormal", draw_subnormal, NULL, false, false},
    {"mixed", draw_mixed, NULL, false, false},
    {"range", draw_ends_of_range, NULL, false, false},
    {"below floats", NULL, &(const grid_range){{-15, -15, -15}, 35, {0.4, 2.5}, {-1060, -150}, false}, false, false},
    {"beyond floats", NULL, &(const grid_range){{-15, -15, -15}, 35, {0.4, 2.5}, {126, 1000}, false}, false, false},
    {"one cell", draw_one_cell, NULL, true, false},
    {"plain doubles", draw_tenths, NULL, false, true},
    {"dyadic doubles", draw_dyadic, NULL, false, true},
    {"offset doubles", NULL, &(const grid_range){{0}, 1e7, {1e-5, 0.5}, {0, 0}, false}, false, true},
    {"geocentric", NULL, &(const grid_range){{4.1e6, -1.13e6, 4.74e6}, 1000, {1e-9, 9e-9}, {0, 0}, false}, false,
     true}, /* of few spacings */
    {"mercator", NULL, &(const grid_range){{1.49e6, 6.89e6, 120}, 500, {0.01, 0.05}, {0, 0}, false}, false, true},
    {"lengths", NULL, &(const grid_range){{0}, 1e6, {1, 2}, {-60, 60}, true}, false, true},
    {"exponents", NULL, &(const grid_range){{0}, 100, {1, 2}, {-1070, 1010}, true}, false, true},
    {"huge doubles", NULL, &(const grid_range){{-0.5, -0.5, -0.5}, 0.5, {0.001, 0.1}, {1024, 1024}, false}, false, true},
    {"subnormal doubles", NULL, &(const grid_range){{0}, 100, {1, 50}, {-1074, -1074}, false}, false, true},
    {"spacings", draw_spacings, NULL, false, true},
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
            if (!isfinite(plane_of(grid, a, p)) || (p && !(plane_of(grid, a, p) > plane_of(grid, a, p - 1.0))))
                return false;
    return true;
}

static bool draw_grid(random_source *r, const grid_kind *kind, cells_case *c)
{
    c->scene = kind->name;
    c->is_double = kind->is_double;
    c->form = kind->is_double ? DOUBLES : SOUP;
    c->count = 0;
    if (kind->draw)
        kind->draw(r, &c->grid);
    else
        draw_range(r, kind->range, &c->grid);
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
