/*
 * test_fill.c - drawn meshes in drawn grids by integers: what is filled are the cells whose middles have an odd number of crossings
 * below them, of whole grids, and of windows, which need no triangle beside them; thin surfaces are those of each triangle by
 * itself, and leak nowhere; and every kernel turns the bits that exact signs alone turn.
 */
#include <float.h>
#include <math.h>

#include "common/closed_meshes.h"
#include "common/fences.h"
#include "common/harness.h"
#include "common/window_bits.h"
#include "crossing_oracle.h"
#include "dispatch.h"
#include "fill/fill_crossings.h"
#include "voxels/cells.h"

enum { PAIRS = 100000, ROUNDS = 1500, WINDOWS = 6 };

typedef struct fill_case {
    const char *scene, *body;
    bool is_double, is_closed;
    bool is_within; /* the mesh is in the grid */
    tribox_grid grid;
    crossing_case at; /* the triangles, and the middles by the definition */
    uint64_t occupied[ORACLE_CELLS];
} fill_case;

/* ------------------------------------------------------------------------------------------------------------------------ grids */

/* The number at a place, counted in cells, as a mesh of the case can have it. */
static double number_at(const fill_case *c, int a, double place)
{
    const double number = plane_of(&c->grid, a, place);
    return c->is_double ? number : (double)(float)number;
}

static void set_middles(fill_case *c)
{
    for (int a = 0; a < 3; a++)
        for (uint32_t n = 0; n < c->at.size[a]; n++) {
            const double lo = plane_of(&c->grid, a, n), hi = plane_of(&c->grid, a, n + 1);
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

static void draw_grid(random_source *r, const scene *s, fill_case *c)
{
    c->scene = s->name;
    c->is_double = s->is_double;
    c->at.bits = s->bits;
    const int place = random_int_between(r, -s->powers, s->powers);
    const bool are_near = s->powers && random_int(r, 2);
    for (int a = 0; a < 3; a++) {
        const int power = are_near ? place + random_int_between(r, -30, 30) : random_int_between(r, -s->powers, s->powers);
        const double from = s->is_whole ? s->origin : ldexp(random_double(r, -1, 1) * s->origin, power);
        const double cell = s->is_whole ? s->cell : ldexp(random_double(r, 1, 2) * s->cell, power);
        const uint32_t size = (uint32_t)(a                  ? random_int_between(r, 1, 9)
                                         : random_int(r, 6) ? random_int_between(r, 2, 20)
                                                            : random_int_between(r, 60, 130));
        c->grid.origin[a] = from;
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

/* Whether all numbers are finite, or in the grid. */
static bool are_all(const fill_case *c, bool in_grid)
{
    bool are = true;
    for (int n = 0; n < 9 * c->at.count; n++) {
        const double number = c->at.u[n / 9][n / 3 % 3][n % 3];
        const double lo = in_grid ? plane_of(&c->grid, n % 3, 0) : -DBL_MAX,
                     hi = in_grid ? plane_of(&c->grid, n % 3, c->at.size[n % 3]) : DBL_MAX;
        are = are && number >= lo && number <= hi;
    }
    return are;
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
    if (!c->is_closed) {
        double(*const u)[3] = c->at.u[random_int(r, c->at.count)];
        memmove(u, c->at.u[--c->at.count], sizeof c->at.u[0]);
    }
    c->is_within = are_all(c, true);
    c->is_closed = c->is_closed && are_all(c, false);
}

/* ------------------------------------------------------------------------------------------------------------------------ calls */

/* The triangles as a mesh of doubles or as nine streams of floats, which end at a page that cannot be touched, until the next. */
static soup_or_mesh triangles_of(const fill_case *c)
{
    static guarded streams[9], pages;
    const size_t count = (size_t)c->at.count, bytes = count * sizeof c->at.u[0];
    soup_or_mesh of = {.is_mesh = c->is_double};
    if (!streams[0].first)
        stream_fences_make(ORACLE_TRIANGLES, streams);
    if (c->is_double)
        of.mesh = mesh_of_corners(memcpy(guarded_room(&pages, bytes), c->at.u, bytes), count, 8);
    else
        of.soup = streams_of_triangles(streams, AT_END, (const double(*)[3][3])c->at.u, count);
    return of;
}

static tribox_status voxelize(fill_case *c)
{
    const soup_or_mesh of = triangles_of(c);
    memset(c->occupied, 0, sizeof c->occupied);
    return CALL(voxelize, &of, &c->grid, NULL, NULL, c->occupied, NULL);
}

static bool is_grid_served(fill_case *c)
{
    c->at.count = 0;
    return (size_t)c->at.size[0] * c->at.size[1] * c->at.size[2] <= ORACLE_CELLS && voxelize(c) == TRIBOX_OK;
}

/* A mesh in a grid of the scene `number`, and the cells of its surface. */
static void fill_case_draw(random_source *r, size_t number, fill_case *c)
{
    do {
        draw_grid(r, &scenes[number], c);
    } while (!is_grid_served(c));
    draw_mesh(r, c);
    spoil(r, c);
    (void)voxelize(c);
}

/* Triangles in another order, each with its vertices in another order. */
static void fill_case_shuffle(random_source *r, fill_case *c)
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

/*
 * Fails where free cells that share a face are not both inside or both outside; and, of a mesh in the grid, where the outside
 * reaches what is inside.
 */
static void fill_case_check_leaks(const fill_case *c, const uint64_t *walls, const bool *is_inside)
{
    const uint32_t *const size = c->at.size;
    uint64_t solid[ORACLE_CELLS], scratch[2 * ORACLE_CELLS / 64 + 3];
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

/* ----------------------------------------------------------------------------------------------------------------------- checks */

static fill_case drawn, cut;
static bool is_inside[ORACLE_CELLS], is_odd[ORACLE_CELLS], wanted[ORACLE_CELLS];

typedef struct turned {
    uint64_t solid[ORACLE_CELLS], beyond[ORACLE_CELLS / 64 + 1];
} turned;

static void start(const fill_case *c, tribox_crossings *to, turned *t)
{
    memset(t, 0, sizeof *t);
    to->rows = tribox_rows_of(c->at.size);
    to->middles = tribox_middles_of(&c->grid, &(tribox_window){.size = {c->at.size[0], c->at.size[1], c->at.size[2]}});
    to->handlers = &tribox_exact_crossings;
    to->solid = t->solid;
    to->beyond = t->beyond;
    to->turns.count = 0;
}

static size_t see(const fill_case *c, size_t first, tribox_seen_along *seen)
{
    const size_t left = (size_t)c->at.count - first, count = left < TRIBOX_SEEN_ALONG ? left : TRIBOX_SEEN_ALONG;
    for (size_t i = 0; i < count; i++)
        for (int n = 0; n < 9; n++)
            seen->number[n][i] = c->at.u[first + i][n % 3][n / 3];
    return count;
}

static void cross(const fill_case *c, const tribox_kernel *kernel, turned *t)
{
    static tribox_seen_along seen;
    static tribox_crossings to;
    start(c, &to, t);
    for (size_t first = 0; first < (size_t)c->at.count; first += TRIBOX_SEEN_ALONG)
        kernel->rows->cross(&to, &seen, see(c, first, &seen));
    tribox_crossings_finish(&to);
}

static void cross_exactly(const fill_case *c, turned *t)
{
    static tribox_crossings to;
    start(c, &to, t);
    for (int i = 0; i < c->at.count; i++) {
        double u[3][3];
        memcpy(u, c->at.u[i], sizeof u);
        if (tribox_are_finite_doubles(&u[0][0], 9))
            tribox_crossings_exactly(&to, u);
    }
    tribox_crossings_finish(&to);
}

static void check_kernels(random_source *r)
{
    static turned exact, found;
    const tribox_window all = tribox_whole_window(&drawn.grid);
    (void)r;
    if (!tribox_middles_of(&drawn.grid, &all).has_places)
        return;
    cross_exactly(&drawn, &exact);
    for (size_t k = 0; k < tribox_kernel_count(); k++) {
        if (!tribox_kernel_runs_here(k))
            continue;
        cross(&drawn, tribox_kernel_at(k), &found);
        if (memcmp(&found, &exact, sizeof exact))
            fail_msg("%s: %s crosses elsewhere", doing, tribox_kernel_at(k)->name);
    }
}

/* Each cell of a window as it is wanted, and none past the end of a row. Returns how many are set. */
static size_t check_cells(const tribox_window *w, const uint64_t *words)
{
    const uint32_t *const size = drawn.at.size;
    size_t count = 0;
    for (size_t k = 0; k < w->size[2]; k++)
        for (size_t j = 0; j < w->size[1]; j++)
            for (size_t i = 0; i < 64 * window_row(w->size); i++) {
                const size_t cell = ((w->first[2] + k) * size[1] + w->first[1] + j) * size[0] + w->first[0] + i;
                const bool is_set = window_bit(w->size, words, i, j, k);
                count += is_set;
                if (is_set != (i < w->size[0] && wanted[cell]))
                    fail_msg("%s: cell %zu, %zu, %zu of the window is %s", doing, i, j, k, is_set ? "set" : "clear");
            }
    return count;
}

/* At times of whole rows, or without cells. */
static tribox_window draw_window(random_source *r, bool is_of_rows, bool may_be_empty)
{
    const tribox_window whole = tribox_whole_window(&drawn.grid);
    tribox_window w;
    cells_draw_window(r, &whole, whole.size, &w);
    if (is_of_rows) {
        w.first[0] = 0;
        w.size[0] = whole.size[0];
    }
    if (may_be_empty && !random_int(r, 4))
        w.size[random_int(r, 3)] = 0;
    return w;
}

/* Leaves out what cannot cross the rows of the window. */
static void cut_mesh(const fill_case *from, const tribox_window *w, fill_case *to)
{
    *to = *from;
    to->at.count = 0;
    for (int t = 0; t < from->at.count; t++) {
        bool is_beside = false;
        for (int a = 1; a < 3; a++) {
            const double u[3] = {from->at.u[t][0][a], from->at.u[t][1][a], from->at.u[t][2][a]};
            is_beside = is_beside || fmax(fmax(u[0], u[1]), u[2]) < plane_of(&from->grid, a, w->first[a]) ||
                        fmin(fmin(u[0], u[1]), u[2]) > plane_of(&from->grid, a, w->first[a] + w->size[a]);
        }
        if (!is_beside)
            memcpy(to->at.u[to->at.count++], from->at.u[t], sizeof from->at.u[t]);
    }
}

/* The cells of the surface in the window, or none, with bits of any kind past them. Returns how many are set. */
static size_t take_surface(random_source *r, const tribox_window *w, bool has_walls, uint64_t *to)
{
    const uint32_t *const at = w->first, *const size = drawn.at.size;
    size_t walls = 0;
    memset(to, random_int(r, 2) ? 0xff : 0, tribox_window_words(w->size) * sizeof *to);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++) {
                const bool is = has_walls && window_bit(size, drawn.occupied, at[0] + i, at[1] + j, at[2] + k);
                window_put(w->size, to, i, j, k, is);
                walls += is;
            }
    for (size_t n = 0; n < (size_t)size[0] * size[1] * size[2]; n++) {
        const size_t row = n / size[0];
        wanted[n] = is_inside[n] || (has_walls && window_bit(size, drawn.occupied, n % size[0], row % size[1], row / size[1]));
    }
    return walls;
}

/* Between pages that cannot be touched: a window, or the whole as one or without one. */
static void check_filled(random_source *r, const tribox_window *w, bool is_whole, bool has_walls)
{
    const size_t bytes = tribox_window_words(w->size) * sizeof(uint64_t), scratch_bytes = tribox_fill_bytes(w->size);
    static guarded walls, solid, scratch;
    uint64_t *const occupied = guarded_room(&walls, bytes), *const filled = guarded_room(&solid, bytes);
    void *const room = guarded_room(&scratch, scratch_bytes);
    size_t inside = SIZE_MAX, odd_rows = SIZE_MAX;
    const size_t taken = take_surface(r, w, has_walls, occupied);
    guarded_read_only(walls, true);
    memset(solid.first, 0xa5, solid.size);
    memset(scratch.first, 0x5a, scratch.size);
    cut_mesh(&drawn, w, &cut);
    const soup_or_mesh of = triangles_of(random_int(r, 2) ? &cut : &drawn);
    assert_int_equal(is_whole ? CALL(fill_parity, &of, &drawn.grid, occupied, room, filled, &inside, &odd_rows)
                              : CALL(fill_parity_window, &of, &drawn.grid, w, occupied, room, filled, &inside, &odd_rows),
                     TRIBOX_OK);
    const size_t set = check_cells(w, filled);
    for (size_t n = 0; n < (size_t)w->size[1] * w->size[2]; n++)
        odd_rows -= is_odd[(w->first[2] + n / w->size[1]) * drawn.at.size[1] + w->first[1] + n % w->size[1]];
    if (inside != set - taken || odd_rows)
        fail_msg("%s: %zu inside, not %zu, and %zd odd rows too many", doing, inside, set - taken, (ptrdiff_t)odd_rows);
}

static void check_parity(random_source *r)
{
    crossing_oracle(&drawn.at, is_inside, is_odd);
    for (size_t row = 0; drawn.is_closed && row < (size_t)drawn.at.size[1] * drawn.at.size[2]; row++)
        assert_false(is_odd[row]);
    if (drawn.is_closed)
        fill_case_check_leaks(&drawn, drawn.occupied, is_inside);
    for (int n = -2; n < WINDOWS; n++) {
        const tribox_window w = n < 0 ? tribox_whole_window(&drawn.grid) : draw_window(r, n % 2, false);
        if (n == -1)
            fill_case_shuffle(r, &drawn);
        check_filled(r, &w, n < 0, n != -1);
    }
}

/*
 * The lines along an axis, one triangle at a time, which crosses each once at the most: between which planes, the lowest moved
 * down?
 */
static void expect_along(const fill_case *c, int along)
{
    static crossing_case one, mirrored;
    static bool is_past[2 * ORACLE_CELLS], is_odd_row[2 * ORACLE_CELLS], is_below[2 * ORACLE_CELLS];
    one.bits = c->at.bits;
    one.count = 1;
    for (int a = 0; a < 3; a++) {
        const int from = (along + a) % 3;
        one.size[a] = c->at.size[from] + !a;
        memcpy(one.middle[a], c->at.middle[from], sizeof one.middle[a]);
    }
    for (uint32_t p = 0; p < one.size[0]; p++)
        one.middle[0][p] = plane_of(&c->grid, along, p);
    memcpy(&mirrored, &one, sizeof mirrored);
    mirrored.size[0] = 1;
    mirrored.middle[0][0] = -one.middle[0][0];
    for (int t = 0; t < c->at.count; t++) {
        for (int n = 0; n < 9; n++) {
            one.u[0][n / 3][n % 3] = c->at.u[t][n / 3][(along + n % 3) % 3];
            mirrored.u[0][n / 3][n % 3] = n % 3 ? one.u[0][n / 3][n % 3] : -one.u[0][n / 3][0];
        }
        crossing_oracle(&one, is_past, is_odd_row);
        crossing_oracle(&mirrored, is_below, is_odd_row);
        for (size_t row = 0; row < (size_t)one.size[1] * one.size[2]; row++)
            for (uint32_t i = 0; i + 1 < one.size[0]; i++) {
                size_t at[3];
                at[along] = i;
                at[(along + 1) % 3] = row % one.size[1];
                at[(along + 2) % 3] = row / one.size[1];
                const bool is_up_to = is_past[row * one.size[0] + i + 1]; /* in a mirror it is past the lowest plane, moved down */
                wanted[(at[2] * c->at.size[1] + at[1]) * c->at.size[0] + at[0]] |=
                    is_up_to && (i ? !is_past[row * one.size[0] + i] : is_below[row]);
            }
    }
}

/* Cells of a window between pages that cannot be touched, which begin with `before`, a word for all. */
static size_t ask_thin(const fill_case *c, const tribox_window *window, const tribox_options *options, int before, uint64_t *words)
{
    const size_t bytes = tribox_window_words(window ? window->size : c->grid.size) * sizeof *words;
    static guarded pages;
    uint64_t *const occupied = guarded_room(&pages, bytes);
    tribox_report report = {9, 9};
    memset(occupied, before, bytes);
    const soup_or_mesh of = triangles_of(c);
    assert_int_equal(CALL(voxelize_thin, &of, &c->grid, window, options, occupied, &report), TRIBOX_OK);
    assert_int_equal(report.undecided, 0);
    memcpy(words, occupied, bytes);
    return report.overlapping;
}

static void check_window_thin(const tribox_window *window, const tribox_options *options, uint64_t *words)
{
    const tribox_window whole = tribox_whole_window(&drawn.grid);
    const size_t set = ask_thin(&drawn, window, options, 0, words);
    assert_int_equal(check_cells(window ? window : &whole, words), set);
}

static void check_thin(random_source *r)
{
    static uint64_t words[ORACLE_CELLS];
    const tribox_window whole = tribox_whole_window(&drawn.grid), part = draw_window(r, false, true);
    const uint32_t *const size = drawn.at.size;
    memset(wanted, 0, sizeof wanted);
    for (int along = 0; along < 3; along++)
        expect_along(&drawn, along);
    for (size_t n = 0; n < ORACLE_CELLS; n++)
        if (wanted[n] && !window_bit(size, drawn.occupied, n % size[0], n / size[0] % size[1], n / size[0] / size[1]))
            fail_msg("%s: no triangle overlaps cell %zu", doing, n);
    for (size_t k = 0; tribox_kernel_list(k); k++)
        check_window_thin(NULL, &(tribox_options){.kernel = tribox_kernel_list(k)}, words);
    if (drawn.is_closed) {
        crossing_oracle(&drawn.at, is_inside, is_odd);
        fill_case_check_leaks(&drawn, words, is_inside);
    }
    check_window_thin(&part, NULL, words);
    fill_case_shuffle(r, &drawn);
    check_window_thin(&whole, NULL, words);
    assert_int_equal(ask_thin(&drawn, &whole, NULL, 0xff, words), 0);
}

/* Each of so many cases, in numbers that every scene comes up with. */
CASE(test_cases)
{
    static const struct {
        void (*check)(random_source *r);
        size_t every, every_in_short;
    } checks[] = {{check_kernels, 1, 1}, {check_parity, 9, 9}, {check_thin, 37, 9}};
    const bool are_short = arguments_are_short(&args);
    random_source r = random_named(args.seed, "fill");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS) / (are_short ? 10 : 1); round++) {
        fill_case_draw(&r, round % (sizeof scenes / sizeof scenes[0]), &drawn);
        snprintf(doing, sizeof doing, "round %zu: %s, %d triangles, %s%s", round, drawn.scene, drawn.at.count, drawn.body,
                 drawn.is_closed ? "" : ", open");
        for (size_t n = 0; n < sizeof checks / sizeof checks[0]; n++)
            if (round % (are_short ? checks[n].every_in_short : checks[n].every) == 0)
                checks[n].check(&r);
    }
}

/* Of a grid beyond one call, far behind a triangle whose rows it has. */
CASE(test_limits)
{
    const float corner[9] = {2, 2, 2, 0, 4, 0, 0, 0, 4};
    const tribox_soup soup = soup_of_rows(corner, 1, 1);
    const tribox_grid vast = {{0, 0, 0}, {1, 1, 1}, {1 << 20, 1 << 20, 1 << 20}};
    const tribox_window some = {{1 << 19, 1, 1}, {64, 1, 2}};
    uint64_t occupied[2] = {0}, solid[2];
    unsigned char scratch[64];
    size_t inside;
    assert_int_equal(tribox_fill_parity_window(&soup, &vast, &some, occupied, scratch, solid, &inside, NULL), TRIBOX_OK);
    assert_true(inside + 64 * (size_t) !(solid[1] & 1) == 128 && solid[0] == ~UINT64_C(0));
}

/* Tetrahedra with corners on planes that are neighbouring doubles, so that middles are planes. */
CASE(test_neighbouring_planes)
{
    static const uint32_t corners[] = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
    const tribox_grid grid = {{1, 1, 1}, {0x1p-52, 0x1p-52, 0x1p-52}, {3, 3, 3}};
    random_source r = random_named(args.seed, "fill thin neighbours");
    memcpy(drawn.at.size, grid.size, sizeof grid.size);
    drawn.is_within = true;
    for (int round = 0; round < 3000; round++) {
        uint64_t thin[9] = {0}, inside[9], scratch[3];
        double at[4][3];
        for (int n = 0; n < 12; n++)
            at[n / 3][n % 3] = 1 + random_int(&r, 4) * 0x1p-52;
        const tribox_mesh mesh = {
            .positions = at, .vertices = 4, .indices = corners, .index_bytes = 4, .count = 4, .position_bytes = 8};
        assert_int_equal(tribox_mesh_fill_parity(&mesh, &grid, thin, scratch, inside, NULL, NULL), TRIBOX_OK);
        assert_int_equal(tribox_mesh_voxelize_thin(&mesh, &grid, NULL, NULL, thin, NULL), TRIBOX_OK);
        for (size_t n = 0; n < 27; n++)
            is_inside[n] = inside[n / 3] >> n % 3 & 1;
        snprintf(doing, sizeof doing, "tetrahedron %d", round);
        fill_case_check_leaks(&drawn, thin, is_inside);
    }
}

/* The faces of a box on planes: one layer of cells each, the lower ones without and the upper ones within. */
CASE(test_box)
{
    static const float low = 2, high = 7;
    float number[9][12];
    static const int corners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (int t = 0; t < 12; t++)
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 3; a++)
                number[3 * a + v][t] = corners[t / 2][!v ? 0 : v + t % 2] >> a & 1 ? high : low;
    const tribox_soup soup = soup_of_rows(number[0], 12, 12);
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {9, 9, 9}}, around = {{2, 2, 2}, {1, 1, 1}, {5, 5, 5}};
    uint64_t thin[81] = {0}, full[81] = {0};
    tribox_report report, of_full;
    assert_int_equal(tribox_voxelize_thin(&soup, &grid, NULL, NULL, thin, &report), TRIBOX_OK);
    assert_int_equal(tribox_voxelize(&soup, &grid, NULL, NULL, full, &of_full), TRIBOX_OK);
    assert_int_equal(report.overlapping, 3 * 5 * 5 + (5 * 5 * 5 - 4 * 4 * 4));
    assert_int_equal(of_full.overlapping, 7 * 7 * 7 - 3 * 3 * 3);
    memset(thin, 0, sizeof thin); /* what lies in planes of the grid's border is in the cells within */
    assert_int_equal(tribox_voxelize_thin(&soup, &around, NULL, NULL, thin, &report), TRIBOX_OK);
    assert_int_equal(report.overlapping, 5 * 5 * 5 - 3 * 3 * 3);
}

PROGRAM(RUN(test_cases), RUN(test_limits), RUN(test_neighbouring_planes), RUN(test_box))
