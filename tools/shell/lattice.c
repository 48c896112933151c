/* lattice.c - marks points, numbers vertices, and finds them again. */
#define _POSIX_C_SOURCE 200809L
#include "lattice.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "write/lowest_bit.h"

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

uint64_t lattice_bytes(const tribox_grid *grid) { return points_of(grid) * (sizeof(uint64_t) + sizeof(uint32_t)); }

bool lattice_open(lattice *l, const voxels *cells)
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

void lattice_free(lattice *l)
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

void lattice_mark(lattice *l, const rectangle *r)
{
    const int u = rectangle_u(r->axis), v = rectangle_v(r->axis);
    uint32_t at[3];
    at[r->axis] = r->plane;
    for (int corner = 0; corner < 4; corner++) {
        at[u] = corner % 2 ? r->to[0] : r->from[0];
        at[v] = corner / 2 ? r->to[1] : r->from[1];
        l->marks[row_of_point(l, at) + at[0] / 64] |= UINT64_C(1) << at[0] % 64;
    }
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
                cells |= pair(l->cells->slab->bits + (z * (size_t)n[1] + y) * l->cell_words, at[0], n[0]) << 2 * (j + 2 * k);
        }
    return cells;
}

uint32_t lattice_next(const lattice *l, const uint32_t at[3], int axis)
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
    if (l->extras == l->room) {
        const size_t room = l->room ? 2 * l->room : 1024;
        lattice_extra *const more = realloc(l->extra, room * sizeof *more);
        if (!more)
            return false;
        l->extra = more;
        l->room = room;
    }
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

bool lattice_number(lattice *l)
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

uint32_t lattice_vertex(const lattice *l, const uint32_t at[3], int axis, unsigned side)
{
    const unsigned cells = around(l, at), fan = l->fans.count[cells] > 1 ? fans_of(&l->fans, cells, axis, side) : 0;
    if (fan)
        return extra_of(l, 4 * number_of(l, at) + OF_POINT) + fan - 1;
    const size_t w = row_of_point(l, at) + at[0] / 64;
    const uint64_t lower = l->marks[w] & ((UINT64_C(1) << at[0] % 64) - 1);
    return l->before[w] + (uint32_t)voxels_count(&lower, 1);
}

uint32_t lattice_middle(const lattice *l, const uint32_t at[3], int axis, uint32_t to, unsigned side)
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
