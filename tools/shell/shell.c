/* shell.c - vertices along the sides of rectangles, and triangles between them. */
#define _POSIX_C_SOURCE 200809L
#include "shell.h"

#include <stdlib.h>

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
    bool (*tell)(void *data, double done);
    void *data;
    bool is_turned; /* u, v and the outside are left-handed */
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

static void take_triangle(const cutting *c, uint32_t a, uint32_t b, uint32_t d)
{
    c->take(c->data, (const uint32_t[3]){a, c->is_turned ? d : b, c->is_turned ? b : d}, c->colour);
}

/* A triangle whose edge from b to d is a side of the rectangle, there and back: cut where the side has vertices. */
static void take_fan(const cutting *c, uint32_t tip, const side *edge, bool is_back)
{
    for (uint32_t n = 0; n + 1 < edge->count; n++)
        take_triangle(c, tip, edge->at[n + is_back].vertex, edge->at[n + !is_back].vertex);
}

/* Triangles between the low and the high side from left to right; the first and the last of them have the other two sides. */
static void take_between(const cutting *c, const side sides[SIDES])
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

static void cut_rectangle(void *data, const rectangle *r)
{
    cutting *const c = data;
    const size_t room = (size_t)side_room(&c->s->points.cells->grid);
    side sides[SIDES];
    for (int n = 0; n < SIDES; n++)
        sides[n] = find_side(c->s, r, n / 2, n % 2, c->s->side + (size_t)n * room);
    c->is_turned = (r->axis == 1) == r->is_up;
    c->colour = r->colour;
    take_between(c, sides);
}

static bool tell_cutting(void *data, double done)
{
    const cutting *const c = data;
    return c->tell(c->data, done);
}

void shell_triangles(const shell *s, shell_taker *take, bool (*tell)(void *data, double done), void *data)
{
    cutting c = {.s = s, .take = take, .tell = tell, .data = data};
    rectangles_walk(s->points.cells, s->mask, cut_rectangle, tell_cutting, &c);
}

/* The walks that find vertices and count triangles. */
typedef struct making {
    shell *s;
    bool (*tell)(void *data, double done);
    void *data;
    double from;
} making;

static void mark(void *data, const rectangle *r)
{
    making *const m = data;
    lattice_mark(&m->s->points, r);
}

static void count(void *data, const uint32_t triangle[3], rgb colour)
{
    making *const m = data;
    (void)triangle, (void)colour;
    m->s->triangles++;
}

static bool tell_making(void *data, double done)
{
    const making *const m = data;
    return m->tell(m->data, m->from + done / 2);
}

bool shell_make(shell *s, const voxels *cells, bool (*tell)(void *data, double done), void *data)
{
    making m = {s, tell, data, 0};
    *s = (shell){.mask = malloc((size_t)rectangles_words(&cells->grid) * sizeof *s->mask),
                 .side = malloc(SIDES * (size_t)side_room(&cells->grid) * sizeof *s->side)};
    if (!lattice_open(&s->points, cells) || !s->mask || !s->side)
        return false;
    rectangles_walk(cells, s->mask, mark, tell_making, &m);
    if (!lattice_number(&s->points))
        return false;
    m.from = 0.5;
    if (s->points.vertices <= LATTICE_VERTICES_MAX)
        shell_triangles(s, count, tell_making, &m);
    return true;
}

void shell_free(shell *s)
{
    lattice_free(&s->points);
    free(s->mask);
    free(s->side);
}
