/*
 * shell.c - the faces between set and clear cells, merged into rectangles plane by plane; the points of the grid where these have
 * corners, and the vertices that lie in them; vertices along the sides of rectangles, and triangles between them.
 */
#include "shell.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "colours/colours.h"
#include "console/system.h"

/* ------------------------------------------------------------------------------------------------------------------- rectangles */

/* On plane `plane` across `axis`. The other two axes, the lower first, are called u and v here. */
typedef struct rectangle {
    int axis;
    uint32_t plane;
    bool is_up;              /* outside is where the axis points */
    uint32_t from[2], to[2]; /* planes across u and v */
    rgb colour;              /* of all its cells, where they have colours */
} rectangle;

static int rectangle_u(int axis) { return axis == 0; }
static int rectangle_v(int axis) { return axis == 2 ? 1 : 2; }

enum { SIDE = 64 };

typedef struct walk {
    const voxels *cells;
    uint64_t *mask;
    bool (*take)(void *data, const rectangle *r);
    void *data;
    shell_share share;
    bool is_over;
} walk;

static size_t words_of(uint32_t bits) { return tribox_mask_words(bits); }

/* How many words `mask` of the walk has. */
static uint64_t rectangles_words(const tribox_grid *grid)
{
    const uint64_t row = words_of(grid->size[0]), y = grid->size[1], z = grid->size[2];
    const uint64_t across_x = SIDE * z * words_of(grid->size[1]), across_z = row * (y > z ? y : z);
    return across_x > across_z ? across_x : across_z;
}

/* The bits from `from` of word w on, to `to` at most; both count from the start of the row. */
static uint64_t bits_of_word(size_t w, uint32_t from, uint32_t to)
{
    const uint64_t start = 64 * (uint64_t)w, above = from > start ? ~UINT64_C(0) << (from - start) : ~UINT64_C(0);
    return to - start >= 64 ? above : above & ~(~UINT64_C(0) << (to - start));
}

/* Where the run of set bits that begins at `from` ends. */
static uint32_t end_of_run(const uint64_t *row, size_t words, uint32_t from)
{
    for (size_t w = from / 64; w < words; w++) {
        const uint64_t clear = ~row[w] & bits_of_word(w, from, UINT32_MAX);
        if (clear)
            return (uint32_t)(64 * w) + lowest_bit(clear);
    }
    return (uint32_t)(64 * words);
}

static bool has_run(const uint64_t *row, uint32_t from, uint32_t to)
{
    for (size_t w = from / 64; w <= (to - 1) / 64; w++)
        if (bits_of_word(w, from, to) & ~row[w])
            return false;
    return true;
}

static void clear_run(uint64_t *row, uint32_t from, uint32_t to)
{
    for (size_t w = from / 64; w <= (to - 1) / 64; w++)
        row[w] &= ~bits_of_word(w, from, to);
}

/* Of the cell behind a face of the rectangle's plane. */
static rgb colour_at(const walk *k, const rectangle *r, uint32_t column, uint32_t row)
{
    uint32_t cell[3];
    cell[r->axis] = r->plane - r->is_up;
    cell[rectangle_u(r->axis)] = column;
    cell[rectangle_v(r->axis)] = row;
    return cell_colours_at(k->cells->colours, cell);
}

/* Where the rectangle's colour ends in a row of it. */
static uint32_t end_of_colour(const walk *k, const rectangle *r, uint32_t row)
{
    uint32_t column = r->from[0];
    while (column < r->to[0] && rgb_number(colour_at(k, r, column, row)) == rgb_number(r->colour))
        column++;
    return column;
}

/* Takes the first run of the row, up to where it changes its colour, and as many rows after it as go on with it. */
static void cut_rectangle(const walk *k, uint64_t *mask, size_t words, uint32_t rows, rectangle *r)
{
    const uint32_t row = r->from[1];
    const bool has_colours = k->cells->colours;
    r->to[0] = end_of_run(mask + row * words, words, r->from[0]);
    if (has_colours) {
        r->colour = colour_at(k, r, r->from[0], row);
        r->to[0] = end_of_colour(k, r, row);
    }
    r->to[1] = row;
    do
        clear_run(mask + r->to[1]++ * words, r->from[0], r->to[0]);
    while (r->to[1] < rows && has_run(mask + r->to[1] * words, r->from[0], r->to[0]) &&
           (!has_colours || end_of_colour(k, r, r->to[1]) == r->to[0]));
}

/* Takes all bits of a mask; r says which plane it is. */
static void cut_mask(walk *k, uint64_t *mask, size_t words, uint32_t rows, rectangle r)
{
    for (uint32_t j = 0; j < rows; j++) {
        uint64_t *const row = mask + j * words;
        for (size_t w = 0; w < words; w++)
            while (row[w]) {
                r.from[0] = (uint32_t)(64 * w) + lowest_bit(row[w]);
                r.from[1] = j;
                cut_rectangle(k, mask, words, rows, &r);
                k->is_over |= !k->take(k->data, &r);
            }
    }
}

/* The faces between two rows of cells, either NULL for one beyond the grid. Returns whether there are any. */
static bool faces_of_rows(const uint64_t *below, const uint64_t *above, bool is_up, size_t words, uint64_t *faces)
{
    const uint64_t *const set = is_up ? below : above, *const clear = is_up ? above : below;
    uint64_t any = 0;
    for (size_t w = 0; w < words; w++)
        any |= faces[w] = (set ? set[w] : 0) & ~(clear ? clear[w] : 0);
    return any != 0;
}

/* Across y or z: rows along x on both sides of the plane. */
static const uint64_t *row_of(const walk *k, int axis, uint32_t plane, uint32_t row)
{
    if (plane >= k->cells->grid.size[axis]) /* also one before the first, which wraps around */
        return NULL;
    return voxels_layer(k->cells, axis == 2 ? plane : row) + (axis == 2 ? row : plane) * voxels_row_words(&k->cells->grid);
}

static void cut_plane(walk *k, int axis, uint32_t plane, bool is_up)
{
    const size_t words = voxels_row_words(&k->cells->grid);
    const uint32_t rows = k->cells->grid.size[rectangle_v(axis)];
    bool any = false;
    for (uint32_t j = 0; j < rows; j++)
        any |= faces_of_rows(row_of(k, axis, plane - 1, j), row_of(k, axis, plane, j), is_up, words, k->mask + j * words);
    if (any)
        cut_mask(k, k->mask, words, rows, (rectangle){.axis = axis, .plane = plane, .is_up = is_up});
}

/* The faces on the planes across x from 64 w on, of a row of cells. */
static uint64_t faces_across_x(const uint64_t *row, size_t words, size_t w, bool is_up)
{
    const uint64_t above = w < words ? row[w] : 0, below = above << 1 | (w ? row[w - 1] >> 63 : 0);
    return is_up ? below & ~above : above & ~below;
}

/* Lays out 64 planes across x, each with rows along y. Returns which of them have faces. */
static uint64_t lay_planes(const walk *k, size_t w, bool is_up)
{
    const uint32_t *const n = k->cells->grid.size;
    const size_t words = voxels_row_words(&k->cells->grid), y_words = words_of(n[1]);
    uint64_t all = 0;
    memset(k->mask, 0, SIDE * y_words * n[2] * sizeof *k->mask);
    for (uint32_t z = 0; z < n[2]; z++)
        for (size_t y = 0; y < y_words; y++) {
            uint64_t block[SIDE] = {0}, any = 0;
            const uint32_t rows = n[1] - 64 * (uint32_t)y < SIDE ? n[1] - 64 * (uint32_t)y : SIDE;
            const uint64_t *const from = voxels_layer(k->cells, z) + SIDE * y * words;
            for (uint32_t j = 0; j < rows; j++)
                any |= block[j] = faces_across_x(from + j * words, words, w, is_up);
            if (any)
                voxels_transpose(block);
            for (size_t i = 0; any && i < SIDE; i++)
                k->mask[(i * n[2] + z) * y_words + y] = block[i];
            all |= any;
        }
    return all;
}

static void cut_planes_across_x(walk *k, size_t w, bool is_up)
{
    const uint32_t *const n = k->cells->grid.size;
    const size_t y_words = words_of(n[1]);
    for (uint64_t planes = lay_planes(k, w, is_up); planes; planes &= planes - 1) {
        const uint32_t i = lowest_bit(planes);
        cut_mask(k, k->mask + i * n[2] * y_words, y_words, n[2],
                 (rectangle){.axis = 0, .plane = (uint32_t)(64 * w) + i, .is_up = is_up});
    }
}

static void tell(const walk *k, double done)
{
    if (k->share.bar)
        progress_tell(k->share.bar, k->share.from + (k->share.to - k->share.from) * done);
}

/*
 * Hands over each rectangle, until one is not taken, but those of its plane; what is outside the grid is clear. Greedy: as long as
 * possible along u, then along v, of cells of one colour where they have colours. Each time in the same order.
 */
static void rectangles_walk(const voxels *v, uint64_t *mask, bool (*take)(void *data, const rectangle *r), void *data,
                            shell_share share)
{
    walk k = {v, mask, take, data, share, false};
    const size_t x_words = words_of(v->grid.size[0] + 1);
    for (size_t w = 0; w < x_words && !k.is_over; w++) {
        cut_planes_across_x(&k, w, false);
        cut_planes_across_x(&k, w, true);
        tell(&k, (double)(w + 1) / (double)x_words / 3);
    }
    for (int axis = 1; axis < 3; axis++)
        for (uint32_t p = 0; p <= v->grid.size[axis] && !k.is_over; p++) {
            cut_plane(&k, axis, p, false);
            cut_plane(&k, axis, p, true);
            tell(&k, (axis + (p + 1.0) / (v->grid.size[axis] + 1.0)) / 3);
        }
}

/* ------------------------------------------------------------------------------------------------------------------------- fans */

enum { FACES = 12, NONE = 255 };

/* The number of the face across an axis of the cell at a side. */
static unsigned face_of(int axis, unsigned side)
{
    const unsigned low = side & ((1U << axis) - 1), high = side >> (axis + 1);
    return 4 * (unsigned)axis + (low | high << axis);
}

static bool has(unsigned around, unsigned side) { return around >> side & 1; }

static void join_faces(uint8_t fan[FACES], unsigned a, unsigned b)
{
    const uint8_t from = fan[b];
    for (int f = 0; f < FACES; f++)
        if (fan[f] == from)
            fan[f] = fan[a];
}

/* The edge from the point along an axis, `end` 0 or 1: its four cells, one after the other around it. */
static void join_at_edge(unsigned around, int axis, unsigned end, uint8_t fan[FACES])
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const unsigned U = 1U << u, V = 1U << v, base = end << axis;
    const unsigned cell[4] = {base, base | U, base | U | V, base | V};
    unsigned face[4], faces = 0;
    for (int n = 0; n < 4; n++) /* face n is between cells n and n + 1 */
        if (has(around, cell[n]) != has(around, cell[(n + 1) % 4]))
            face[faces++] = face_of(n % 2 ? v : u, cell[n]);
    if (faces == 2)
        join_faces(fan, face[0], face[1]);
    if (faces != 4)
        return;
    const int first = has(around, cell[0]) ? 3 : 0; /* faces n and n + 1 are those of cell n + 1 */
    join_faces(fan, face[first], face[(first + 1) % 4]);
    join_faces(fan, face[(first + 2) % 4], face[(first + 3) % 4]);
}

static void find_fans(unsigned around, uint8_t *count, uint8_t of[FACES])
{
    uint8_t fan[FACES], number[FACES];
    for (int f = 0; f < FACES; f++)
        fan[f] = (uint8_t)f;
    for (int axis = 0; axis < 3; axis++)
        for (unsigned end = 0; end < 2; end++)
            join_at_edge(around, axis, end, fan);
    memset(number, NONE, sizeof number);
    *count = 0;
    for (int axis = 0; axis < 3; axis++)
        for (unsigned side = 0; side < 8; side++)
            if (!(side >> axis & 1) && has(around, side) != has(around, side | 1U << axis)) {
                const unsigned face = face_of(axis, side);
                if (number[fan[face]] == NONE)
                    number[fan[face]] = (*count)++;
                of[face] = number[fan[face]];
            }
}

static void make_fans(fans *f)
{
    memset(f, 0, sizeof *f);
    for (unsigned around = 0; around < 256; around++)
        find_fans(around, &f->count[around], f->of[around]);
}

/* The fan, 0 to 3, of the face across `axis` of the cell at `side`, a bit's number in `around`. The face is there. */
static unsigned fans_of(const fans *f, unsigned around, int axis, unsigned side) { return f->of[around][face_of(axis, side)]; }

/* ----------------------------------------------------------------------------------------------------------------------- points */

enum { OF_POINT = 3 }; /* the key of more fans; those of edges are their axes */

static uint64_t points_of(const tribox_grid *grid)
{
    return ((uint64_t)grid->size[0] + 64) / 64 * ((uint64_t)grid->size[1] + 1) * ((uint64_t)grid->size[2] + 1);
}

/* What the lattice of a grid takes, in bytes, besides the extra vertices. */
static uint64_t lattice_bytes(const tribox_grid *grid) { return points_of(grid) * (sizeof(uint64_t) + sizeof(uint32_t)); }

/* Returns false without memory; lattice_free is due in any case. */
static bool lattice_open(lattice *l, const voxels *cells)
{
    *l = (lattice){.cells = cells};
    for (int a = 0; a < 3; a++)
        l->size[a] = cells->grid.size[a] + 1;
    l->row_words = tribox_mask_words(l->size[0]);
    l->cell_words = voxels_row_words(&cells->grid);
    l->marks = calloc(points_of(&cells->grid), sizeof *l->marks);
    l->before = malloc(points_of(&cells->grid) * sizeof *l->before);
    make_fans(&l->fans);
    return l->marks && l->before;
}

static void lattice_free(lattice *l)
{
    free(l->marks);
    free(l->before);
    free(l->extra);
}

static uint64_t number_of(const lattice *l, const uint32_t at[3])
{
    return ((uint64_t)at[2] * l->size[1] + at[1]) * l->size[0] + at[0];
}

static size_t row_of_point(const lattice *l, const uint32_t at[3]) { return ((size_t)at[2] * l->size[1] + at[1]) * l->row_words; }

static bool is_marked(const lattice *l, const uint32_t at[3])
{
    return l->marks[row_of_point(l, at) + at[0] / 64] >> at[0] % 64 & 1;
}

static bool mark(void *data, const rectangle *r)
{
    lattice *const l = data;
    const int u = rectangle_u(r->axis), v = rectangle_v(r->axis);
    uint32_t at[3];
    at[r->axis] = r->plane;
    for (int corner = 0; corner < 4; corner++) {
        at[u] = corner % 2 ? r->to[0] : r->from[0];
        at[v] = corner / 2 ? r->to[1] : r->from[1];
        l->marks[row_of_point(l, at) + at[0] / 64] |= UINT64_C(1) << at[0] % 64;
    }
    return true;
}

/* Two cells of a row side by side along x, the second of which is cell i; beyond the grid they are clear. */
static unsigned pair(const uint64_t *row, uint32_t i, uint32_t cells)
{
    const uint64_t before = i > 0 ? row[(i - 1) / 64] >> (i - 1) % 64 & 1 : 0, at = i < cells ? row[i / 64] >> i % 64 & 1 : 0;
    return (unsigned)(before | at << 1);
}

static unsigned around(const lattice *l, const uint32_t at[3])
{
    const uint32_t *const n = l->cells->grid.size;
    unsigned cells = 0;
    for (unsigned k = 0; k < 2; k++)
        for (unsigned j = 0; j < 2; j++) {
            const uint32_t y = at[1] - 1 + j, z = at[2] - 1 + k; /* one before the first wraps around */
            if (y < n[1] && z < n[2])
                cells |= pair(l->cells->words + (z * (size_t)n[1] + y) * l->cell_words, at[0], n[0]) << 2 * (j + 2 * k);
        }
    return cells;
}

/* The next marked point after `at` along an axis, as its coordinate; there is one. */
static uint32_t lattice_next(const lattice *l, const uint32_t at[3], int axis)
{
    uint32_t next[3] = {at[0], at[1], at[2]};
    do
        next[axis]++;
    while (!is_marked(l, next));
    return next[axis];
}

/* Whether the cell at `side` and the one across the edge are set, and the other two at this end of it are not. */
static bool touches_across(unsigned cells, int axis, unsigned side)
{
    const unsigned u = 1U << (axis + 1) % 3, v = 1U << (axis + 2) % 3;
    return (cells >> side & cells >> (side ^ u ^ v) & 1) && !((cells >> (side ^ u) | cells >> (side ^ v)) & 1);
}

/* Whether two set cells that touch across an edge hold together around this end of it: it is one fan. */
static bool holds_together(const fans *f, unsigned cells, int axis, unsigned side)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return fans_of(f, cells, u, side) == fans_of(f, cells, u, side ^ (1U << u) ^ (1U << v));
}

/* side: of `at`, with the bit of the axis. */
static bool is_double(const lattice *l, unsigned cells, const uint32_t at[3], int axis, uint32_t to, unsigned side)
{
    uint32_t end[3] = {at[0], at[1], at[2]};
    if (!holds_together(&l->fans, cells, axis, side))
        return false;
    end[axis] = to;
    return holds_together(&l->fans, around(l, end), axis, side ^ (1U << axis));
}

static bool add_extra(lattice *l, uint64_t key, unsigned vertices)
{
    lattice_extra *const extra = memory_grow(l->extra, l->extras + 1, &l->room, sizeof *extra);
    if (!extra)
        return false;
    l->extra = extra;
    l->extra[l->extras++] = (lattice_extra){key, (uint32_t)l->vertices};
    l->vertices += vertices;
    return true;
}

static bool add_extras_of(lattice *l, const uint32_t at[3])
{
    const unsigned cells = around(l, at), count = l->fans.count[cells];
    const uint64_t key = 4 * number_of(l, at);
    for (int axis = 0; axis < 3; axis++) {
        const unsigned end = 1U << axis, low = touches_across(cells, axis, end) ? end : end | 1U << (axis + 1) % 3;
        if (touches_across(cells, axis, low) && is_double(l, cells, at, axis, lattice_next(l, at, axis), low) &&
            !add_extra(l, key + (unsigned)axis, 2))
            return false;
    }
    return count < 2 || add_extra(l, key + OF_POINT, count - 1);
}

/* Calls for each marked point, x fastest, until false is returned. */
static bool each_point(const lattice *l, bool (*take)(void *data, const uint32_t at[3]), void *data)
{
    uint32_t at[3];
    const uint64_t *word = l->marks;
    for (at[2] = 0; at[2] < l->size[2]; at[2]++)
        for (at[1] = 0; at[1] < l->size[1]; at[1]++)
            for (size_t w = 0; w < l->row_words; w++, word++)
                for (uint64_t bits = *word; bits; bits &= bits - 1) {
                    at[0] = (uint32_t)(64 * w) + lowest_bit(bits);
                    if (!take(data, at))
                        return false;
                }
    return true;
}

static bool take_extras(void *data, const uint32_t at[3])
{
    lattice *const l = data;
    return l->vertices > LATTICE_VERTICES_MAX || add_extras_of(l, at);
}

/* Numbers the vertices, once all is marked. Returns false without memory. More vertices than the most are counted, not numbered. */
static bool lattice_number(lattice *l)
{
    const uint64_t words = points_of(&l->cells->grid);
    for (uint64_t w = 0; w < words; w++) {
        l->before[w] = (uint32_t)l->points;
        l->points += l->marks[w] ? voxels_count(&l->marks[w], 1) : 0;
    }
    l->vertices = l->points;
    return each_point(l, take_extras, l);
}

static uint32_t extra_of(const lattice *l, uint64_t key)
{
    size_t low = 0, high = l->extras;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (l->extra[middle].key <= key)
            low = middle;
        else
            high = middle;
    }
    return l->extra[low].first;
}

/* The vertex at a marked point, of the face across `axis` of the set cell at `side` of the point. */
static uint32_t lattice_vertex(const lattice *l, const uint32_t at[3], int axis, unsigned side)
{
    const unsigned cells = around(l, at), fan = l->fans.count[cells] > 1 ? fans_of(&l->fans, cells, axis, side) : 0;
    if (fan)
        return extra_of(l, 4 * number_of(l, at) + OF_POINT) + fan - 1;
    const size_t w = row_of_point(l, at) + at[0] / 64;
    const uint64_t lower = l->marks[w] & ((UINT64_C(1) << at[0] % 64) - 1);
    return l->before[w] + (uint32_t)voxels_count(&lower, 1);
}

/*
 * The vertex in the middle of the edge from a marked point to the next at `to` along an axis, for the set cell at `side` of the
 * point: of those four whose bit of the axis is 1. UINT32_MAX for none.
 */
static uint32_t lattice_middle(const lattice *l, const uint32_t at[3], int axis, uint32_t to, unsigned side)
{
    const unsigned cells = around(l, at);
    if (!touches_across(cells, axis, side) || !is_double(l, cells, at, axis, to, side))
        return UINT32_MAX;
    return extra_of(l, 4 * number_of(l, at) + (unsigned)axis) + (side >> (axis + 1) % 3 & 1);
}

typedef struct taking {
    const lattice *l;
    bool (*take)(void *data, const uint32_t halves[3]);
    void *data;
} taking;

static bool take_point(void *data, const uint32_t at[3])
{
    const taking *const t = data;
    return t->take(t->data, (const uint32_t[3]){2 * at[0], 2 * at[1], 2 * at[2]});
}

static bool take_extra(const taking *t, uint64_t key)
{
    const uint32_t *const n = t->l->size;
    const uint64_t number = key / 4;
    const uint32_t at[3] = {(uint32_t)(number % n[0]), (uint32_t)(number / n[0] % n[1]), (uint32_t)(number / n[0] / n[1])};
    uint32_t halves[3] = {2 * at[0], 2 * at[1], 2 * at[2]};
    const int axis = (int)(key % 4);
    if (axis != OF_POINT)
        halves[axis] = at[axis] + lattice_next(t->l, at, axis);
    unsigned count = axis != OF_POINT ? 2 : t->l->fans.count[around(t->l, at)] - 1U;
    while (count && t->take(t->data, halves))
        count--;
    return !count;
}

bool lattice_vertices(const lattice *l, bool (*take)(void *data, const uint32_t halves[3]), void *data)
{
    taking t = {l, take, data};
    if (!each_point(l, take_point, &t))
        return false;
    for (size_t n = 0; n < l->extras; n++)
        if (!take_extra(&t, l->extra[n].key))
            return false;
    return true;
}

/* -------------------------------------------------------------------------------------------------------------------- triangles */

struct shell_side {
    uint32_t halves; /* where it is along the side */
    uint32_t vertex;
};

typedef struct side {
    shell_side *at;
    uint32_t count;
} side;

/* Four sides of a rectangle: v = from, v = to, u = from, u = to. */
enum { LOW, HIGH, LEFT, RIGHT, SIDES };

typedef struct cutting {
    const shell *s;
    shell_taker *take;
    void *data;
    bool is_turned; /* u, v and the outside are left-handed */
    bool is_over;
    rgb colour;
} cutting;

/* Room for a side: each point and each middle between two. */
static uint64_t side_room(const tribox_grid *grid)
{
    uint64_t longest = 0;
    for (int a = 0; a < 3; a++)
        longest = grid->size[a] > longest ? grid->size[a] : longest;
    return 2 * longest + 1;
}

uint64_t shell_bytes(const tribox_grid *grid)
{
    return lattice_bytes(grid) + rectangles_words(grid) * sizeof(uint64_t) + SIDES * side_room(grid) * sizeof(shell_side);
}

/* The vertices of one side. along: u or v of the rectangle, 0 or 1. */
static side find_side(const shell *s, const rectangle *r, int along, bool is_far, shell_side *room)
{
    const int axes[2] = {rectangle_u(r->axis), rectangle_v(r->axis)}, axis = axes[along], other = axes[!along];
    side found = {room, 0};
    uint32_t at[3];
    at[r->axis] = r->plane;
    at[other] = is_far ? r->to[!along] : r->from[!along];
    at[axis] = r->from[along];
    /* The cell behind the rectangle's face, as the point sees it: first the one after it along the side, then the one before. */
    const unsigned before = (is_far ? 0U : 1U << other) | (r->is_up ? 0U : 1U << r->axis), after = before | 1U << axis;
    found.at[found.count++] = (shell_side){2 * at[axis], lattice_vertex(&s->points, at, r->axis, after)};
    while (at[axis] < r->to[along]) {
        const uint32_t next = lattice_next(&s->points, at, axis), middle = lattice_middle(&s->points, at, axis, next, after);
        if (middle != UINT32_MAX)
            found.at[found.count++] = (shell_side){at[axis] + next, middle};
        at[axis] = next;
        found.at[found.count++] = (shell_side){2 * next, lattice_vertex(&s->points, at, r->axis, before)};
    }
    return found;
}

static void take_triangle(cutting *c, uint32_t a, uint32_t b, uint32_t d)
{
    c->is_over |= !c->take(c->data, (const uint32_t[3]){a, c->is_turned ? d : b, c->is_turned ? b : d}, c->colour);
}

/* A triangle whose edge from b to d is a side of the rectangle, there and back: cut where the side has vertices. */
static void take_fan(cutting *c, uint32_t tip, const side *edge, bool is_back)
{
    for (uint32_t n = 0; n + 1 < edge->count; n++)
        take_triangle(c, tip, edge->at[n + is_back].vertex, edge->at[n + !is_back].vertex);
}

/* Triangles between the low and the high side from left to right; the first and the last of them have the other two sides. */
static void take_between(cutting *c, const side sides[SIDES])
{
    const side *const low = &sides[LOW], *const high = &sides[HIGH];
    uint32_t i = 0, j = 0;
    while (i + 1 < low->count || j + 1 < high->count) {
        const bool is_low = j + 1 == high->count || (i + 1 < low->count && low->at[i + 1].halves <= high->at[j + 1].halves);
        const bool is_first = i + j == 0, is_last = i + j + 3 == low->count + high->count;
        const uint32_t tip = is_low ? low->at[i + 1].vertex : high->at[j + 1].vertex;
        if (is_first)
            take_fan(c, tip, &sides[LEFT], true);
        else if (is_last)
            take_fan(c, is_low ? low->at[i].vertex : high->at[j].vertex, &sides[RIGHT], false);
        else
            take_triangle(c, low->at[i].vertex, tip, high->at[j].vertex);
        i += is_low;
        j += !is_low;
    }
}

static bool cut_sides(void *data, const rectangle *r)
{
    cutting *const c = data;
    const size_t room = (size_t)side_room(&c->s->points.cells->grid);
    side sides[SIDES];
    for (int n = 0; n < SIDES; n++)
        sides[n] = find_side(c->s, r, n / 2, n % 2, c->s->side + (size_t)n * room);
    c->is_turned = (r->axis == 1) == r->is_up;
    c->colour = r->colour;
    take_between(c, sides);
    return !c->is_over;
}

void shell_triangles(const shell *s, shell_taker *take, void *data, shell_share share)
{
    cutting c = {.s = s, .take = take, .data = data};
    rectangles_walk(s->points.cells, s->mask, cut_sides, &c, share);
}

static bool count(void *data, const uint32_t triangle[3], rgb colour)
{
    shell *const s = data;
    (void)triangle, (void)colour;
    s->triangles++;
    return true;
}

bool shell_make(shell *s, const voxels *cells, progress *bar, double share)
{
    *s = (shell){.mask = malloc((size_t)rectangles_words(&cells->grid) * sizeof *s->mask),
                 .side = malloc(SIDES * (size_t)side_room(&cells->grid) * sizeof *s->side)};
    if (!lattice_open(&s->points, cells) || !s->mask || !s->side)
        return false;
    rectangles_walk(cells, s->mask, mark, &s->points, (shell_share){bar, 0, share / 2});
    if (!lattice_number(&s->points))
        return false;
    if (s->points.vertices <= LATTICE_VERTICES_MAX)
        shell_triangles(s, count, s, (shell_share){bar, share / 2, share});
    return true;
}

void shell_free(shell *s)
{
    lattice_free(&s->points);
    free(s->mask);
    free(s->side);
}
