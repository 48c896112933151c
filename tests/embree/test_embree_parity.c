/*
 * test_embree_parity.c - inside and outside of a closed mesh, cell by cell, from rays that know nothing of triangle and box: cells
 * that no triangle overlaps have a side, neighbours among them have the same side, even those by a corner; and a single cell that
 * is missing is seen to leak. Cheap, and far weaker than the witnesses: false positives are invisible to it.
 */
#include <math.h>
#include <stdlib.h>

#include "common/ask.h"

#include "common/arguments.h"
#include "embree.h"

/* A cell that the surface only grazes has one side around it: its absence is not a leak. */
enum { CROSSINGS_MAX = 1024, RECASTS_MAX = 100, SKIPPED = 77, REMOVED = 64, LEAKS_LEAST = 56 };

/* A line too close to a triangle's border, or too nearly within its plane, is drawn again. */
static const double least_barycentric = 1e-7, least_cosine = 1e-4;

typedef struct line {
    double place[CROSSINGS_MAX]; /* on the axis, in no order */
    size_t count;
} line;

static size_t parity_cells(const grid_planes *p)
{
    return (size_t)p->grid.size[0] * (size_t)p->grid.size[1] * (size_t)p->grid.size[2];
}

static size_t number_of(const grid_planes *p, const int cell[3])
{
    return ((size_t)cell[2] * (size_t)p->grid.size[1] + (size_t)cell[1]) * (size_t)p->grid.size[0] + (size_t)cell[0];
}

static float drawn_between(random_source *r, double lo, double hi)
{
    return (float)random_double(r, 0.8 * lo + 0.2 * hi, 0.2 * lo + 0.8 * hi);
}

/* False if the line has to be drawn again. */
static bool cast_line(const grid_planes *p, const model *s, embree_scene *scene, int axis, const float from[3], line *l)
{
    float along[3] = {0};
    along[axis] = 1;
    const embree_hit *hits;
    l->count =
        embree_cast(scene, from, along, (float)(p->plane[axis][(int)p->grid.size[axis]] - from[axis] + p->grid.cell[axis]), &hits);
    if (l->count % 2 || l->count > CROSSINGS_MAX)
        return false;
    int turns = 0;
    for (size_t k = 0; k < l->count; k++) {
        crossing c;
        if (!crossing_make(&s->triangles[hits[k].triangle], axis, from, &c) || c.barycentric < least_barycentric ||
            fabs(c.cosine) < least_cosine)
            return false;
        l->place[k] = c.place;
        turns += c.cosine > 0 ? 1 : -1;
    }
    return turns == 0;
}

static bool is_inside(const line *l, double place)
{
    bool is_in = false;
    for (size_t k = 0; k < l->count; k++)
        is_in ^= l->place[k] < place;
    return is_in;
}

/* The column of cells along the axis of which `cell` is one. */
static bool cast_column(const grid_planes *p, const model *s, embree_scene *scene, random_source *r, int axis, int cell[3],
                        uint8_t *sides, size_t *recasts)
{
    static line l;
    int tries = 0;
    float from[3];
    do {
        if (tries++ > RECASTS_MAX)
            return false;
        for (int a = 0; a < 3; a++)
            from[a] = a == axis ? (float)(p->plane[a][0] - p->grid.cell[a])
                                : drawn_between(r, p->plane[a][cell[a]], p->plane[a][cell[a] + 1]);
    } while (!cast_line(p, s, scene, axis, from, &l));
    *recasts += (size_t)(tries - 1);
    for (cell[axis] = 0; cell[axis] < (int)p->grid.size[axis]; cell[axis]++) {
        const double *const plane = &p->plane[axis][cell[axis]];
        sides[number_of(p, cell)] |= (uint8_t)(is_inside(&l, (plane[0] + plane[1]) / 2) << axis);
    }
    cell[axis] = 0;
    return true;
}

/*
 * One line for every column of cells on each axis, through a drawn point of the column, not near its border. Bit a of sides[cell]
 * (x fastest) is set if the cell lies inside by the line along axis a. `recasts`: how many lines had to be drawn again; may be
 * NULL. False if the mesh is not closed: no line gives both an even count of hits and as many ways in as out. Needs Embree, and a
 * grid that holds the mesh.
 */
static bool parity_cast(const grid_planes *p, const model *s, random_source *r, uint8_t *sides, size_t *recasts)
{
    embree_scene *const scene = embree_scene_make(s->triangles, s->count);
    size_t count = 0;
    bool is_closed = true;
    for (int axis = 0; axis < 3; axis++) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        int cell[3] = {0};
        for (cell[a] = 0; cell[a] < (int)p->grid.size[a]; cell[a]++)
            for (cell[b] = 0; is_closed && cell[b] < (int)p->grid.size[b]; cell[b]++)
                is_closed = cast_column(p, s, scene, r, axis, cell, sides, &count);
    }
    embree_scene_free(scene);
    if (recasts)
        *recasts = count;
    return is_closed;
}

typedef struct parity_verdict {
    size_t disagreements; /* free cells of which the three lines say different things */
    size_t components;    /* of the free cells, neighbours by face, edge or corner */
    size_t mixed;         /* components with both sides in them: a leak */
    size_t border_inside; /* components that reach the grid's border but are inside */
} parity_verdict;

/* Free cells not yet visited, and those that wait for their neighbours. */
typedef struct flood {
    const grid_planes *p;
    const uint8_t *sides;
    uint8_t *is_closed; /* overlapped or visited */
    int (*waiting)[3];
    size_t count;
    bool has_side[2], is_at_border;
} flood;

static bool is_free(const flood *f, const int cell[3]) { return !f->is_closed[number_of(f->p, cell)]; }

static void visit(flood *f, const int cell[3])
{
    const size_t number = number_of(f->p, cell);
    f->is_closed[number] = 1;
    f->has_side[f->sides[number] & 1] = true;
    for (int a = 0; a < 3; a++) {
        f->is_at_border = f->is_at_border || cell[a] == 0 || cell[a] == (int)f->p->grid.size[a] - 1;
        f->waiting[f->count][a] = cell[a];
    }
    f->count++;
}

static bool is_in_grid(const grid_planes *p, const int cell[3])
{
    return cell[0] >= 0 && cell[0] < (int)p->grid.size[0] && cell[1] >= 0 && cell[1] < (int)p->grid.size[1] && cell[2] >= 0 &&
           cell[2] < (int)p->grid.size[2];
}

static void flood_from(flood *f, const int start[3])
{
    f->has_side[0] = f->has_side[1] = f->is_at_border = false;
    f->count = 0;
    visit(f, start);
    while (f->count) {
        const int *const at = f->waiting[--f->count];
        const int here[3] = {at[0], at[1], at[2]};
        for (int k = 0; k < 27; k++) {
            const int next[3] = {here[0] + k % 3 - 1, here[1] + k / 3 % 3 - 1, here[2] + k / 9 - 1};
            if (is_in_grid(f->p, next) && is_free(f, next))
                visit(f, next);
        }
    }
}

static bool is_overlapped(const grid_planes *p, const uint64_t *occupied, const int cell[3])
{
    const size_t bit = planes_bit(p, cell);
    return occupied[bit / 64] >> bit % 64 & 1;
}

/* Calls on every free cell in turn. */
static void judge_cell(flood *f, const int cell[3], parity_verdict *v)
{
    flood_from(f, cell);
    v->components++;
    v->mixed += f->has_side[0] && f->has_side[1];
    v->border_inside += f->is_at_border && f->has_side[1];
}

/* `occupied` as tribox_voxelize sets it. */
static parity_verdict parity_judge(const grid_planes *p, const uint8_t *sides, const uint64_t *occupied)
{
    const size_t cells = parity_cells(p);
    flood f = {.p = p, .sides = sides, .is_closed = memory_of(cells, 1), .waiting = memory_of(cells, sizeof *f.waiting)};
    parity_verdict v = {0};
    for (size_t number = 0; number < cells; number++) {
        int cell[3];
        block_cell(&(block){{0, 0, 0}, {(int)p->grid.size[0], (int)p->grid.size[1], (int)p->grid.size[2]}}, number, cell);
        f.is_closed[number] = is_overlapped(p, occupied, cell);
        v.disagreements += !f.is_closed[number] && sides[number] != 0 && sides[number] != 7;
    }
    for (size_t number = 0; number < cells; number++) {
        int cell[3];
        block_cell(&(block){{0, 0, 0}, {(int)p->grid.size[0], (int)p->grid.size[1], (int)p->grid.size[2]}}, number, cell);
        if (is_free(&f, cell))
            judge_cell(&f, cell, &v);
    }
    free(f.is_closed);
    free(f.waiting);
    return v;
}

typedef struct mesh {
    const char *name;
    model model;
    grid_planes planes;
    uint64_t *occupied;
    size_t words;
    uint8_t *sides;
    size_t recasts;
} mesh;

/* About the origin in a grid from -1.5 to 1.5; a snapped one on integers, in a grid of unit cells. */
static mesh make_mesh(const char *name, model s, int cells, bool is_snapped, uint64_t seed)
{
    mesh m = {.name = name, .model = s};
    const float edge = is_snapped ? 1 : 3.0f / (float)cells;
    tribox_grid grid;
    if (is_snapped) {
        const double radius = cells * 0.4375;
        model_place(&m.model, (const double[3]){radius, radius, radius}, (const double[3]){0, 0, 0});
        model_snap(&m.model);
    }
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = -edge * (float)cells / 2;
        grid.cell[a] = edge;
        grid.size[a] = (uint32_t)cells;
    }
    assert_true(planes_make(&m.planes, &grid));
    m.words = tribox_window_words(grid.size);
    m.occupied = memory_of(m.words, sizeof *m.occupied);
    m.sides = memory_of(parity_cells(&m.planes), sizeof *m.sides);
    random_source r = random_named(seed, name);
    assert_true(parity_cast(&m.planes, &m.model, &r, m.sides, &m.recasts));
    return m;
}

static void free_mesh(mesh *m)
{
    model_free(&m->model);
    free(m->occupied);
    free(m->sides);
}

static void voxelize(mesh *m, const char *kernel)
{
    const tribox_options options = {.kernel = kernel};
    streams s = streams_make(&m->model);
    for (size_t k = 0; k < m->words; k++)
        m->occupied[k] = 0;
    assert_int_equal(tribox_voxelize(&s.soup, &m->planes.grid, NULL, &options, m->occupied, NULL), TRIBOX_OK);
    streams_free(&s);
}

static void check_mesh(mesh m)
{
    const char *kernels[KERNELS_MAX];
    const int kernel_count = kernels_here(kernels);
    for (int kernel = 0; kernel < kernel_count; kernel++) {
        voxelize(&m, kernels[kernel]);
        const parity_verdict v = parity_judge(&m.planes, m.sides, m.occupied);
        printf("%-22s %4d cells, %-8s %zu disagree, %zu components, %zu mixed, %zu inside at the border, %zu lines cast again\n",
               m.name, (int)m.planes.grid.size[0], kernels[kernel], v.disagreements, v.components, v.mixed, v.border_inside,
               m.recasts);
        assert_int_equal(v.disagreements + v.mixed + v.border_inside, 0);
        assert_int_equal(v.components, 2);
    }
    free_mesh(&m);
}

static void test_closed_meshes(void **state)
{
    const uint64_t seed = *(const uint64_t *)*state;
    for (int cells = 16; cells <= 128; cells *= cells == 16 ? 4 : 2) {
        check_mesh(make_mesh("icosphere", model_icosphere(4), cells, false, seed));
        check_mesh(make_mesh("torus", model_torus(64, 32, 2.0 / 7), cells, false, seed));
        check_mesh(make_mesh("cube", model_cube(8), cells, false, seed));
        check_mesh(make_mesh("snapped icosphere", model_icosphere(4), cells, true, seed));
    }
    check_mesh(make_mesh("snapped torus", model_torus(64, 32, 2.0 / 7), 64, true, seed));
}

/* The voxels of a mesh, one of them drawn and taken away: is it missed? */
static size_t count_leaks(mesh m, uint64_t seed)
{
    random_source r = random_named(seed, "removed");
    size_t leaks = 0;
    voxelize(&m, NULL);
    for (int k = 0; k < REMOVED; k++) {
        size_t bit;
        do
            bit = (size_t)(random_bits(&r) % (64 * m.words));
        while (!bit_of(m.occupied, bit));
        m.occupied[bit / 64] ^= UINT64_C(1) << bit % 64;
        leaks += parity_judge(&m.planes, m.sides, m.occupied).mixed > 0;
        m.occupied[bit / 64] ^= UINT64_C(1) << bit % 64;
    }
    printf("%-22s %zu of %d cells taken away are seen\n", m.name, leaks, REMOVED);
    free_mesh(&m);
    return leaks;
}

static void test_missing_cell(void **state)
{
    const uint64_t seed = *(const uint64_t *)*state;
    assert_in_range(count_leaks(make_mesh("icosphere", model_icosphere(4), 24, false, seed), seed), LEAKS_LEAST, REMOVED);
    assert_in_range(count_leaks(make_mesh("torus", model_torus(64, 32, 2.0 / 7), 24, false, seed), seed), LEAKS_LEAST, REMOVED);
}

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    if (!embree_is_usable())
        return SKIPPED;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_closed_meshes, &args.seed),
                                       cmocka_unit_test_prestate(test_missing_cell, &args.seed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
