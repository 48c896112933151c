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
        grid->origin[a] = nearest_float(origin);
        grid->cell[a] = nearest_float(cell);
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
        grid->cell[a] = ldexpf(1, random_int_between(r, -6, 3));
        grid->origin[a] = grid->cell[a] * (float)random_int_between(r, -40, 40) / 4;
    }
}

static void draw_tenths(random_source *r, tribox_grid *grid)
{
    static const float length[] = {0.1f, 0.3f, 1.0f / 3, 0.7f, 1.1f, 0.05f};
    const bool is_cubic = random_int(r, 2);
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = is_cubic && a ? grid->cell[0] : length[random_int(r, sizeof length / sizeof length[0])];
        grid->origin[a] = (float)random_int_between(r, -30, 30) * 0.1f;
    }
}

static void draw_any(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = nearest_float(random_double(r, 0.4, 2.5));
        grid->origin[a] = nearest_float(random_double(r, -50, 20));
    }
}

/* A plane that is nearly zero, or exactly, of either sign. */
static void draw_about_zero(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = random_int(r, 2) ? 0.1f : nearest_float(random_double(r, 0.1, 1));
        grid->origin[a] = random_sign_of_zero(r, nearest_float(-(double)grid->cell[a] * random_int(r, (int)grid->size[a] + 1)));
    }
}

/* Far from the origin the planes round: cells of 1 to 9 spacings of floats, the next longer or shorter than the last. */
static void draw_far(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        const double far = pow(10, random_double(r, 5, 7)) * (random_int(r, 2) ? 1 : -1);
        const double spacing = ldexp(1, ilogb(far) - 23);
        grid->origin[a] = nearest_float(far);
        grid->cell[a] = nearest_float(spacing * (random_int(r, 3) ? random_double(r, 1.01, 9) : random_int_between(r, 1, 64)));
    }
}

static void draw_offset(random_source *r, tribox_grid *grid)
{
    draw_any(r, grid);
    for (int a = 0; a < 3; a++)
        grid->origin[a] += nearest_float(random_int_between(r, -1, 1) * pow(10, random_double(r, 3, 5)));
}

static void draw_own_lengths(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = ldexpf(random_int(r, 2) ? 1 : 1.3f, random_int_between(r, -20, 20));
        grid->origin[a] = grid->cell[a] * (float)random_int_between(r, -100, 100);
    }
}

static void scale(tribox_grid *grid, int exponent)
{
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = ldexpf(grid->cell[a], exponent);
        grid->origin[a] = ldexpf(grid->origin[a], exponent);
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

/* Planes that are off by nearly half a cell, by just that, and by more: from there on float tells no cell from its neighbour. */
static void draw_brink(random_source *r, tribox_grid *grid)
{
    const int spacings = random_int_between(r, 1, 2);
    for (int a = 0; a < 3; a++) {
        const int exponent = random_int_between(r, 20, 22), from = random_int_between(r, -40, 40);
        grid->cell[a] = ldexpf((float)spacings, exponent - 23);
        grid->origin[a] = (float)(random_int(r, 2) ? 1 : -1) * ldexpf(1, exponent + spacings - 1) + grid->cell[a] * (float)from;
    }
}

/* Cells of a few times the least float. */
static void draw_subnormal(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->cell[a] = ldexpf((float)random_int_between(r, 1, 5), -149);
        grid->origin[a] = random_sign_of_zero(r, ldexpf((float)random_int_between(r, -300, 100), -149));
    }
}

/* Subnormal on one axis, ordinary on another, huge on the third. */
static void draw_mixed(random_source *r, tribox_grid *grid)
{
    const int turn = random_int(r, 3);
    draw_any(r, grid);
    const int low = turn, high = (turn + 1) % 3;
    grid->cell[low] = ldexpf((float)random_int_between(r, 1, 9), random_int_between(r, -149, -130));
    grid->origin[low] = grid->cell[low] * (float)random_int_between(r, -50, 50);
    grid->cell[high] = ldexpf(grid->cell[high], 100);
    grid->origin[high] = ldexpf(grid->origin[high], 100);
}

/* From one end of the float range to the other: the length of the whole is not a float. */
static void draw_ends_of_range(random_source *r, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        grid->size[a] = grid->size[a] < 3 ? 3 : grid->size[a];
        grid->cell[a] = nearest_float(2 * (double)FLT_MAX / grid->size[a] * (random_int(r, 2) ? 0.9999999 : 0.7));
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
