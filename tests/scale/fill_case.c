/* fill_case.c - meshes and grids whose insides are asked for. */
#include "fill_case.h"

#include <math.h>

#include "common/closed_meshes.h"
#include "common/harness.h"
#include "common/window_bits.h"

/* ------------------------------------------------------------------------------------------------------------------------ grids */

/* The number at a place, counted in cells, as a mesh of the case can have it. */
static double number_at(const fill_case *c, int a, double place)
{
    const double number = fma(place, c->grid.cell[a], c->grid.origin[a]);
    return c->is_double ? number : (double)(float)number;
}

static double plane_at(const fill_case *c, int a, uint32_t plane) { return fma(plane, c->grid.cell[a], c->grid.origin[a]); }

static void set_middles(fill_case *c)
{
    for (int a = 0; a < 3; a++)
        for (uint32_t n = 0; n < c->at.size[a]; n++) {
            const double lo = plane_at(c, a, n), hi = plane_at(c, a, n + 1);
            const double mean = isfinite(lo + hi) ? (lo + hi) / 2 : lo / 2 + hi / 2;
            c->at.middle[a][n] = mean < hi ? mean : lo;
        }
}

typedef struct scene {
    const char *name;
    bool is_double;
    double origin, cell; /* cells are up to twice as long; origins between both signs of it */
    int bits;            /* as crossing_case has them */
    bool is_whole;       /* origin and cells as they are, so that middles are few units */
    int powers;          /* by which grids may be scaled further, both ways, each axis by its own or all about one place */
} scene;

static const scene scenes[] = {
    {"unit cells", false, 0, 1, 160, true, 0},
    {"cells of any length", false, 3, 0.7, 160, false, 0},
    {"far away", false, 1 << 17, 1, 160, true, 0},
    {"floats hardly finer than cells", false, 0x1p23, 1, 160, false, 0},
    {"huge", false, 0x1p100, 0x1p98, 160, false, 0},
    {"small", false, 0, 0x1p-140, 160, false, 0},
    {"doubles", true, 3, 0.7, 200, false, 0},
    {"unit cells of doubles", true, 0, 1, 200, true, 0},
    {"doubles far away", true, 0x1p46, 0x1p-3, 200, false, 0},
    {"doubles hardly finer than cells", true, 0x1p51, 0.6, 200, false, 0},
    {"doubles as fine as cells", true, 0x1p52, 1, 200, true, 0},
    {"doubles of any length", true, 3, 0.7, 1100, false, 1000},
    {"tiny doubles", true, 0, 0x1p-1040, 1100, false, 0},
    {"huge doubles", true, 0x1.8p1023, 0x1p1017, 1100, false, 0},
};

size_t fill_case_scenes(void) { return sizeof scenes / sizeof scenes[0]; }

static void draw_grid(random_source *r, const scene *s, fill_case *c)
{
    c->scene = s->name;
    c->is_double = s->is_double;
    c->at.bits = s->bits;
    const int place = random_int_between(r, -s->powers, s->powers);
    const bool are_near = s->powers && random_int(r, 2);
    for (int a = 0; a < 3; a++) {
        const int power = are_near ? place + random_int_between(r, -30, 30) : random_int_between(r, -s->powers, s->powers);
        const double origin = s->is_whole ? s->origin : ldexp(random_double(r, -1, 1) * s->origin, power);
        const double cell = s->is_whole ? s->cell : ldexp(random_double(r, 1, 2) * s->cell, power);
        const uint32_t size = (uint32_t)(a                  ? random_int_between(r, 1, 9)
                                         : random_int(r, 6) ? random_int_between(r, 2, 20)
                                                            : random_int_between(r, 60, 130));
        c->grid.origin[a] = origin;
        c->grid.cell[a] = cell;
        c->grid.size[a] = c->at.size[a] = size;
    }
    set_middles(c);
}

/* ----------------------------------------------------------------------------------------------------------------------- bodies */

/* How a body within [-1, 1]^3 lies in the grid. */
typedef struct placement {
    fill_case *c;
    double centre[3], radius[3];
    double lattice; /* places are multiples of it, 0 for any */
    int axis;       /* of the body that lies along x */
} placement;

static void put(void *to, const double a[3], const double b[3], const double d[3])
{
    const placement *const p = to;
    const double *const from[3] = {a, b, d};
    crossing_case *const at = &p->c->at;
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++) {
            double place = p->centre[k] + p->radius[k] * from[v][(k + p->axis) % 3];
            place = p->lattice > 0 ? round(place / p->lattice) * p->lattice : place;
            at->u[at->count][v][k] = number_at(p->c, k, place);
        }
    at->count += at->count < ORACLE_TRIANGLES - 1;
}

static void place_body(random_source *r, fill_case *c, placement *p)
{
    static const double lattices[] = {0, 0, 0.5, 0.5, 1, 0.25};
    p->c = c;
    p->lattice = lattices[random_int(r, 6)];
    p->axis = random_int(r, 3);
    for (int a = 0; a < 3; a++) {
        p->centre[a] = random_double(r, 0, 1) * c->at.size[a];
        p->radius[a] = (random_int(r, 4) ? random_double(r, 0.1, 0.6) : random_double(r, 0, 3)) * c->at.size[a];
        if (!random_int(r, 4)) { /* from middle to middle */
            p->centre[a] = floor(p->centre[a]) + 0.5;
            p->radius[a] = ceil(p->radius[a]);
        }
    }
}

static void draw_body(random_source *r, fill_case *c)
{
    placement p;
    place_body(r, c, &p);
    c->body = closed_any(&(closed_mesh_sink){put, &p}, r);
}

/*
 * The middle of a cell is in the plane of the triangle, or where its ray is, on an edge, but for the rounding of vertices: which
 * decides on which side it is.
 */
static void put_about_middle(random_source *r, fill_case *c)
{
    double d[2][3], u[3][3];
    const bool is_edge = random_int(r, 2);
    const double s = random_double(r, 0.1, 2), t = is_edge ? 0 : random_double(r, 0.1, 2);
    for (int a = 0; a < 3; a++) {
        const double middle = c->at.middle[a][random_below(r, c->at.size[a])] + (a || !is_edge ? 0 : 0.3 * c->grid.cell[0]);
        const double reach = random_double(r, 0.1, 5) * c->grid.cell[a] * (a || random_int(r, 2) ? 1 : 1000);
        for (int v = 0; v < 2; v++)
            d[v][a] = random_double(r, -1, 1) * reach;
        u[0][a] = middle + d[0][a];
        u[1][a] = middle + d[1][a];
        u[2][a] = middle - s * d[0][a] - t * d[1][a];
        for (int v = 0; v < 3; v++)
            c->at.u[c->at.count][v][a] = c->is_double ? u[v][a] : (double)(float)u[v][a];
    }
    c->at.count += c->at.count < ORACLE_TRIANGLES - 1;
}

/* Triangles that belong to nothing: small, large, flat, on middles and planes. */
static void draw_triangles(random_source *r, fill_case *c)
{
    const bool are_about_middles = random_int(r, 2);
    for (int t = random_int_between(r, 1, 60); t > 0; t--) {
        placement p;
        double u[3][3];
        if (are_about_middles) {
            for (int n = 0; n < (c->at.bits <= 200 ? 20 : 2); n++)
                put_about_middle(r, c);
            continue;
        }
        place_body(r, c, &p);
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 3; a++)
                u[v][a] = v && !random_int(r, 5) ? u[0][a] : random_double(r, -1, 1);
        put(&p, u[0], u[1], u[2]);
    }
    c->body = "triangles";
}

/* Numbers that are not finite, among triangles that are. */
static void spoil(random_source *r, fill_case *c)
{
    for (int n = random_int(r, 4); n > 0 && c->at.count < ORACLE_TRIANGLES - 1; n--) {
        const double wrong[] = {NAN, INFINITY, -INFINITY};
        memcpy(c->at.u[c->at.count], c->at.u[0], sizeof c->at.u[0]);
        c->at.u[c->at.count++][random_int(r, 3)][random_int(r, 3)] = wrong[random_int(r, 3)];
    }
}

static void remove_triangle(fill_case *c, int t) { memmove(c->at.u[t], c->at.u[--c->at.count], sizeof c->at.u[t]); }

static bool is_finite(const fill_case *c)
{
    bool is = true;
    for (int t = 0; t < c->at.count; t++)
        for (int n = 0; n < 9; n++)
            is = is && isfinite(c->at.u[t][n / 3][n % 3]);
    return is;
}

static bool is_within(const fill_case *c)
{
    bool is = true;
    for (int t = 0; t < c->at.count; t++)
        for (int n = 0; n < 9; n++) {
            const double number = c->at.u[t][n / 3][n % 3];
            is = is && number >= plane_at(c, n % 3, 0) && number <= plane_at(c, n % 3, c->at.size[n % 3]);
        }
    return is;
}

static void draw_mesh(random_source *r, fill_case *c)
{
    c->at.count = 0;
    c->is_closed = random_int(r, 4);
    c->is_within = false;
    const int bodies = random_int(r, 3) ? 1 : 2;
    if (!c->is_closed && random_int(r, 2)) {
        draw_triangles(r, c);
        return;
    }
    for (int n = 0; n < bodies; n++)
        draw_body(r, c);
    if (!c->is_closed)
        remove_triangle(c, random_int(r, c->at.count));
    c->is_within = is_within(c);
    c->is_closed = c->is_closed && is_finite(c);
}

/* ------------------------------------------------------------------------------------------------------------------------ calls */

fill_mesh fill_mesh_make(const fill_case *c)
{
    const size_t count = (size_t)c->at.count, bytes = count * (c->is_double ? sizeof c->at.u[0] : 9 * sizeof(float));
    fill_mesh m = {guarded_make(bytes ? bytes : 1), {.is_mesh = c->is_double}};
    void *const at = guarded_tail(m.pages, bytes);
    m.of.mesh = mesh_of_corners(at, count, 8);
    m.of.soup = soup_of_rows(at, count, count);
    if (c->is_double)
        memcpy(at, c->at.u, bytes);
    for (size_t n = 0; n < 9 * count && !c->is_double; n++)
        ((float *)at)[n] = (float)c->at.u[n % count][n / count % 3][n / count / 3];
    return m;
}

static tribox_status voxelize(fill_case *c)
{
    const fill_mesh m = fill_mesh_make(c);
    memset(c->occupied, 0, sizeof c->occupied);
    const tribox_status status = CALL(voxelize, &m.of, &c->grid, NULL, NULL, c->occupied, NULL);
    fill_mesh_free(m);
    return status;
}

static bool is_grid_served(fill_case *c)
{
    c->at.count = 0;
    return (size_t)c->at.size[0] * c->at.size[1] * c->at.size[2] <= ORACLE_CELLS && voxelize(c) == TRIBOX_OK;
}

void fill_case_draw(random_source *r, size_t number, fill_case *c)
{
    do {
        draw_grid(r, &scenes[number], c);
    } while (!is_grid_served(c));
    draw_mesh(r, c);
    spoil(r, c);
    (void)voxelize(c);
}

void fill_case_shuffle(random_source *r, fill_case *c)
{
    for (int t = c->at.count - 1; t > 0; t--) {
        const int other = random_int(r, t + 1), turn = random_int(r, 3), is_turned = random_int(r, 2);
        double u[3][3];
        memcpy(u, c->at.u[t], sizeof u);
        memmove(c->at.u[t], c->at.u[other], sizeof u);
        for (int v = 0; v < 3; v++)
            memcpy(c->at.u[other][(is_turned ? 3 - v : v) % 3], u[(v + turn) % 3], sizeof u[0]);
    }
}

void fill_case_check_leaks(const fill_case *c, const uint64_t *walls, const bool *is_inside)
{
    const uint32_t *const size = c->at.size;
    uint64_t solid[CASE_WORDS_MAX], scratch[2 * ORACLE_CELLS / 64 + 3];
    assert_int_equal(tribox_fill_outside(size, walls, scratch, solid, NULL), TRIBOX_OK);
    for (size_t n = 0; n < (size_t)size[0] * size[1] * size[2]; n++) {
        const size_t at[3] = {n % size[0], n / size[0] % size[1], n / size[0] / size[1]};
        const size_t step[3] = {1, size[0], (size_t)size[0] * size[1]};
        const bool is_free = !window_bit(size, walls, at[0], at[1], at[2]);
        for (int a = 0; a < 3; a++)
            if (at[a] + 1 < size[a] && is_free && !window_bit(size, walls, at[0] + (a == 0), at[1] + (a == 1), at[2] + (a == 2)) &&
                is_inside[n] != is_inside[n + step[a]])
                fail_msg("%s: cell %zu and the next along axis %d are free, and one of them is inside", doing, n, a);
        if (c->is_within && is_inside[n] && !window_bit(size, solid, at[0], at[1], at[2]))
            fail_msg("%s: cell %zu is inside, but reached from outside", doing, n);
    }
}
