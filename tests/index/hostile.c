#include "hostile.h"

#include <float.h>
#include <math.h>

#include "common/contact.h"
#include "common/harness.h"

/* A lattice: number k is unit * (offset + k). Its cells have CELL units. */
typedef struct lattice {
    double unit, offset;
} lattice;

enum { CELL = 3 };

/* The last two reach the ends of the range: subnormal numbers, and cells up to FLT_MAX. */
static lattice any_lattice(random_source *r)
{
    static const lattice known[] = {
        {1, 0}, {1, -20}, {0.125, 4096}, {0.1, 0}, {1, 0x1p20}, {0x1p-149, 0}, {0x1p-127, -3}, {0x1p122, 0}, {0x1p122, -63},
    };
    return known[random_int(r, sizeof known / sizeof known[0])];
}

static void put(random_source *r, size_t i, int v, int a, const lattice *l, int k)
{
    stored.stream[3 * a + v][i] = random_sign_of_zero(r, nearest_float(l->unit * (l->offset + k)));
}

/* Every third bit of a number: cells in this order fill cubes of 64, of 4096, and so on. */
static int every_third_bit(size_t number, int first)
{
    int k = 0;
    for (int bit = 0; number >> (3 * bit + first); bit++)
        k |= (int)(number >> (3 * bit + first) & 1) << bit;
    return k;
}

void draw_cells(random_source *r)
{
    const lattice l = any_lattice(r);
    for (size_t i = 0; i < stored.soup.count; i++) {
        const int reach = random_int(r, 200) ? CELL : 2 * CELL;
        for (int a = 0; a < 3; a++) {
            const int from = CELL * every_third_bit(i / 64, a);
            for (int v = 0; v < 3; v++)
                put(r, i, v, a, &l, from + random_int_between(r, 0, reach));
        }
    }
}

/* The same triangles, but near in number is not near in space. */
static void draw_shuffled(random_source *r)
{
    draw_cells(r);
    for (size_t i = stored.soup.count; i > 1; i--) {
        const size_t k = random_below(r, i);
        for (int stream = 0; stream < STORED_STREAMS; stream++) {
            const float kept = stored.stream[stream][i - 1];
            stored.stream[stream][i - 1] = stored.stream[stream][k];
            stored.stream[stream][k] = kept;
        }
    }
}

static void draw_cell_points(random_source *r)
{
    draw_cells(r);
    for (size_t i = 0; i < stored.soup.count; i++)
        for (int a = 0; a < 3; a++)
            stored.stream[3 * a + 1][i] = stored.stream[3 * a + 2][i] = stored.stream[3 * a][i];
}

static void copy_triangle(size_t to, size_t from)
{
    for (int stream = 0; stream < STORED_STREAMS; stream++)
        stored.stream[stream][to] = stored.stream[stream][from];
}

static void draw_all_equal(random_source *r)
{
    draw_cells(r);
    for (size_t i = 1; i < stored.soup.count; i++)
        copy_triangle(i, 0);
}

/* Runs of the same triangle, which end anywhere in a word. */
static void draw_duplicates(random_source *r)
{
    draw_cells(r);
    for (size_t i = 1; i < stored.soup.count; i++)
        if (random_int(r, 100))
            copy_triangle(i, i - 1);
}

/* Long and thin: two vertices of one cell, an ulp or a bit apart, and one of anywhere. */
static void draw_slivers(random_source *r)
{
    draw_cells(r);
    for (size_t i = 0; i < stored.soup.count; i++) {
        const size_t far = random_below(r, stored.soup.count), near = random_int(r, 4) ? i : far;
        for (int a = 0; a < 3; a++) {
            stored.stream[3 * a + 1][i] = nudged(r, stored.stream[3 * a][i], 1);
            stored.stream[3 * a + 2][i] = stored.stream[3 * a][near];
        }
    }
}

/* Triangles of every size about the origin: nothing is small beside what stands next to it. */
static void draw_every_size(random_source *r)
{
    for (size_t i = 0; i < stored.soup.count; i++) {
        const double size = ldexp(1, random_int_between(r, -30, 30));
        for (int k = 0; k < STORED_STREAMS; k++)
            stored.stream[k][i] = nearest_float(size * random_double(r, -1, 1));
    }
}

/* Any finite floats. */
static void draw_any_floats(random_source *r)
{
    for (int k = 0; k < STORED_STREAMS; k++)
        for (size_t i = 0; i < stored.soup.count; i++)
            do {
                const uint32_t bits = (uint32_t)random_bits(r);
                memcpy(&stored.stream[k][i], &bits, sizeof bits);
            } while (!isfinite(stored.stream[k][i]));
}

void put_batch(size_t first, const scene_batch *batch)
{
    for (size_t t = 0; t < SCENE_TRIANGLES && first + t < stored.soup.count; t++)
        for (int k = 0; k < STORED_STREAMS; k++)
            stored.stream[k][first + t] = batch->u[t][k % 3][k / 3];
}

/* Batches of one scene, each about a box of its own. */
static void draw_scene(random_source *r)
{
    const scene *const drawn = scene_at(random_below(r, scene_count()));
    for (size_t first = 0; first < stored.soup.count; first += SCENE_TRIANGLES) {
        scene_batch batch;
        scene_draw_batch(drawn, r, &batch);
        put_batch(first, &batch);
    }
}

static const soup_kind kinds[] = {
    {"cells", draw_cells},           {"shuffled", draw_shuffled},     {"points", draw_cell_points},
    {"all-equal", draw_all_equal},   {"duplicates", draw_duplicates}, {"slivers", draw_slivers},
    {"every-size", draw_every_size}, {"any-floats", draw_any_floats}, {"scene", draw_scene},
};

size_t soup_kind_count(void) { return sizeof kinds / sizeof kinds[0]; }

const soup_kind *soup_kind_at(size_t i) { return &kinds[i]; }

void spoil_triangle(random_source *r, size_t i)
{
    static const uint32_t bits[] = {0x7fc00000, 0xffc00000, 0x7f800001, 0x7f800000, 0xff800000};
    for (int times = random_int(r, 4) ? 1 : random_int_between(r, 1, 9); times > 0; times--)
        memcpy(&stored.stream[random_int(r, STORED_STREAMS)][i], &bits[random_int(r, sizeof bits / sizeof bits[0])],
               sizeof bits[0]);
}

/* Every `step`-th triangle of a range that begins in the soup. */
static void spoil_range(random_source *r, size_t first, size_t count, size_t step)
{
    for (size_t i = first; i < stored.soup.count && i - first < count; i += step)
        spoil_triangle(r, i);
}

void spoil_soup(random_source *r, dirt kind)
{
    const size_t count = stored.soup.count;
    if (!count || kind == DIRT_NONE)
        return;
    const size_t any = random_below(r, count);
    const size_t word = any / 64 * 64, node = any / TRIBOX_INDEX_BLOCK * TRIBOX_INDEX_BLOCK, last = (count - 1) / 64 * 64;
    if (kind == DIRT_ONE)
        spoil_range(r, any, 1, 1);
    for (size_t first = 0; kind == DIRT_ONE_IN_A_WORD && first < count; first += 64)
        spoil_range(r, first + random_below(r, count - first < 64 ? count - first : 64), 1, 1);
    if (kind == DIRT_A_WORD)
        spoil_range(r, word, 64, 1);
    if (kind == DIRT_A_NODE)
        spoil_range(r, node, TRIBOX_INDEX_BLOCK, 1);
    if (kind == DIRT_A_THIRD)
        spoil_range(r, 1 % count, count, 3);
    if (kind == DIRT_TAIL)
        spoil_range(r, last, 64, 1 + random_below(r, 9));
    if (kind == DIRT_ALL_BUT_ONE || kind == DIRT_ALL)
        spoil_range(r, 0, kind == DIRT_ALL ? count : any, 1);
    if (kind == DIRT_ALL_BUT_ONE)
        spoil_range(r, any + 1, count, 1);
}

static bool is_finite_at(size_t i)
{
    for (int k = 0; k < STORED_STREAMS; k++)
        if (!isfinite(stored.stream[k][i]))
            return false;
    return true;
}

tribox_box bounds_of(size_t first, size_t count)
{
    tribox_box box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    for (size_t i = first; i < stored.soup.count && i - first < count; i++)
        for (int k = 0; k < STORED_STREAMS && is_finite_at(i); k++) {
            box.lo[k / 3] = fminf((float)box.lo[k / 3], stored.stream[k][i]);
            box.hi[k / 3] = fmaxf((float)box.hi[k / 3], stored.stream[k][i]);
        }
    return box;
}

/* The bounds of a triangle, of some, of a word or of as much as a node has. */
static tribox_box draw_bounds_of_run(random_source *r)
{
    static const size_t sizes[] = {1, 1, 64, 64, 64, 200, TRIBOX_INDEX_BLOCK};
    const size_t size = sizes[random_int(r, sizeof sizes / sizeof sizes[0])], any = random_below(r, stored.soup.count);
    return bounds_of(size % 64 ? any : any / size * size, size);
}

static void join(tribox_box *box, const tribox_box *other)
{
    for (int a = 0; a < 3; a++) {
        box->lo[a] = fminf((float)box->lo[a], (float)other->lo[a]);
        box->hi[a] = fmaxf((float)box->hi[a], (float)other->hi[a]);
    }
}

/* Now and then a bound beside its place by an ulp, or a zero of the other sign. */
static void nudge_bounds(random_source *r, tribox_box *box)
{
    for (int a = 0; a < 3; a++) {
        box->lo[a] = random_sign_of_zero(r, random_int(r, 5) ? (float)box->lo[a] : nudged(r, (float)box->lo[a], 1));
        box->hi[a] = random_sign_of_zero(r, random_int(r, 5) ? (float)box->hi[a] : nudged(r, (float)box->hi[a], 1));
    }
}

/* Beyond a face of another box, which it touches. */
static tribox_box beside(random_source *r, tribox_box box)
{
    const int a = random_int(r, 3);
    if (random_int(r, 2)) {
        box.lo[a] = box.hi[a];
        box.hi[a] = random_int(r, 2) ? FLT_MAX : box.lo[a];
    } else {
        box.hi[a] = box.lo[a];
        box.lo[a] = random_int(r, 2) ? -FLT_MAX : box.hi[a];
    }
    return box;
}

/* Bounds that are any finite numbers of the soup. */
static tribox_box draw_of_numbers(random_source *r)
{
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        float u[2];
        for (int k = 0; k < 2; k++) {
            u[k] = stored.stream[3 * a + random_int(r, 3)][random_below(r, stored.soup.count)];
            u[k] = isfinite(u[k]) ? u[k] : 0;
        }
        box.lo[a] = fminf(u[0], u[1]);
        box.hi[a] = fmaxf(u[0], u[1]);
    }
    return box;
}

tribox_box draw_box(random_source *r)
{
    tribox_box box = {{-FLT_MAX, -FLT_MAX, -FLT_MAX}, {FLT_MAX, FLT_MAX, FLT_MAX}};
    const int kind = random_int(r, 20), a = random_int(r, 3);
    if (kind == 0 || !stored.soup.count)
        return box;
    box = kind < 8 ? draw_of_numbers(r) : kind == 8 ? bounds_of(0, stored.soup.count) : draw_bounds_of_run(r);
    if (kind >= 14) {
        const tribox_box other = draw_bounds_of_run(r);
        join(&box, &other);
    }
    if (kind >= 18)
        box = beside(r, box);
    if (kind == 1)
        memcpy(box.hi, box.lo, sizeof box.hi);
    if (kind == 2)
        box.hi[a] = box.lo[a];
    nudge_bounds(r, &box);
    return box;
}

void draw_stored(random_source *r, const soup_kind *kind, size_t count)
{
    stored_soup_lay(count, random_int(r, 2) ? STORED_AT_END : random_int(r, STORED_SHIFTS));
    kind->draw(r);
    spoil_soup(r, random_int(r, 2) ? DIRT_NONE : (dirt)random_int(r, DIRTS));
    stored_build(names[random_int(r, kernels)]);
}

void draw_stored_form(random_source *r, const soup_kind *kind, size_t count)
{
    draw_stored(r, kind, count);
    if (random_int(r, 2))
        return;
    const mesh_layout layout = draw_layout(r, count);
    stored_mesh_lay(r, &layout);
    stored_build(names[random_int(r, kernels)]);
}

/* Axes of a turn about one axis of the world, quarter turns among them; then scaled, sheared, or one of them lost. */
void draw_axes(random_source *r, tribox_oriented_box *box)
{
    const int about = random_int(r, 3);
    const double angle = random_int(r, 3) ? random_double(r, -4, 4) : 0, quarter = random_int(r, 4);
    const double c = quarter > 1 && angle == 0 ? (quarter > 2 ? -1 : 0) : cos(angle), s = c == 0 ? 1 : sin(angle);
    memset(box->axis, 0, sizeof box->axis);
    box->axis[about][about] = 1;
    box->axis[(about + 1) % 3][(about + 1) % 3] = box->axis[(about + 2) % 3][(about + 2) % 3] = (float)c;
    box->axis[(about + 1) % 3][(about + 2) % 3] = (float)s;
    box->axis[(about + 2) % 3][(about + 1) % 3] = (float)-s;
    const int k = random_int(r, 3), a = random_int(r, 3), kind = random_int(r, 8);
    if (kind == 0)
        box->axis[k][a] += (float)random_double(r, -1, 1);
    for (int b = 0; kind == 1 && b < 3; b++)
        box->axis[k][b] *= 0.125f;
    for (int b = 0; kind == 2 && b < 3; b++)
        box->axis[k][b] = 0;
}

tribox_oriented_box draw_oriented(random_source *r, const tribox_box *about)
{
    tribox_oriented_box box;
    draw_axes(r, &box);
    for (int a = 0; a < 3; a++) {
        box.center[a] = about->lo[a] / 2 + about->hi[a] / 2;
        box.half[a] = (about->hi[a] / 2 - about->lo[a] / 2) * (random_int(r, 3) ? 1 : random_double(r, 0, 2));
        if (random_int(r, 12) == 0)
            box.half[a] = random_int(r, 2) ? 0 : -box.half[a];
    }
    return box;
}
