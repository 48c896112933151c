/* fill_walls.c - grids of free and occupied cells that are hard to flood. */
#include "fill_walls.h"

#include <stdbool.h>
#include <string.h>

static void draw_size(random_source *r, walls *w)
{
    static const uint32_t words[] = {1, 2, 3, 62, 63, 64, 65, 66, 127, 128, 129, 130, 192, 193};
    w->size[0] = random_int(r, 2) ? words[random_int(r, sizeof words / sizeof words[0])] : (uint32_t)random_int_between(r, 1, 130);
    for (int a = 1; a < 3; a++)
        w->size[a] = random_int(r, 5) ? (uint32_t)random_int_between(r, 2, 14) : 1;
}

static size_t cells_of(const walls *w) { return (size_t)w->size[0] * w->size[1] * w->size[2]; }

/* Walls with a chance, each of eight by itself. */
static void draw_noise(random_source *r, walls *w)
{
    const int of_eight = random_int_between(r, 0, 8);
    for (size_t n = 0; n < cells_of(w); n++)
        w->is_wall[n] = random_int(r, 8) < of_eight;
}

static uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }

/* Shells in each other, every other one a wall. */
static void draw_shells(random_source *r, walls *w)
{
    const uint32_t first = (uint32_t)random_int(r, 2);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++) {
                const uint32_t x = least(i, w->size[0] - 1 - i), y = least(j, w->size[1] - 1 - j), z = least(k, w->size[2] - 1 - k);
                const uint32_t depth = w->size[2] > 2 ? least(x, least(y, z)) : least(x, y);
                w->is_wall[walls_at(w, i, j, k)] = depth % 2 == first;
            }
}

/* A hole through each shell, at either end in turn: spirals. */
static void draw_spiral(random_source *r, walls *w)
{
    draw_shells(r, w);
    const uint32_t j = w->size[1] / 2, k = w->size[2] / 2;
    for (uint32_t i = 0; i < w->size[0]; i++)
        if (i / 2 % 2)
            w->is_wall[walls_at(w, least(i, w->size[0] - 1 - i), j, k)] = 0;
        else
            w->is_wall[walls_at(w, w->size[0] - 1 - least(i, w->size[0] - 1 - i), j, k)] = 0;
}

/* Walls across axis a, open at the ends of axis b in turn. */
static void draw_comb(random_source *r, walls *w)
{
    const int a = random_int(r, 3), b = (a + random_int_between(r, 1, 2)) % 3;
    const bool is_open = random_int(r, 2);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++) {
                const uint32_t at[3] = {i, j, k};
                const uint32_t end = at[a] / 2 % 2 ? 0 : w->size[b] - 1, other = 3 - (uint32_t)a - (uint32_t)b;
                const bool is_rim = at[b] == 0 || at[b] + 1 == w->size[b] || at[other] == 0 || at[other] + 1 == w->size[other];
                w->is_wall[walls_at(w, i, j, k)] = (at[a] % 2 && at[b] != end) || (!is_open && is_rim && at[b] != end);
            }
}

/* Corridors of one cell through a block, each on from where one was, and one that leads out of it. */
static void draw_labyrinth(random_source *r, walls *w)
{
    memset(w->is_wall, 1, sizeof w->is_wall);
    uint32_t at[3];
    for (int a = 0; a < 3; a++)
        at[a] = (uint32_t)random_int(r, (int)w->size[a]);
    for (size_t step = 0; step < cells_of(w); step++) {
        const int a = random_int(r, 3), length = random_int_between(r, 1, a ? 4 : 70);
        const bool is_up = random_int(r, 2);
        for (int n = 0; n < length; n++) {
            w->is_wall[walls_at(w, at[0], at[1], at[2])] = 0;
            if (is_up ? at[a] + 1 == w->size[a] : at[a] == 0)
                break;
            at[a] += is_up ? 1 : UINT32_MAX;
        }
        step += (size_t)length * 3;
    }
}

/* A block whose border is a wall, with corridors or noise in it. */
static void close_border(walls *w)
{
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++)
                if (i == 0 || j == 0 || k == 0 || i + 1 == w->size[0] || j + 1 == w->size[1] || k + 1 == w->size[2])
                    w->is_wall[walls_at(w, i, j, k)] = 1;
}

static const struct {
    const char *name;
    void (*draw)(random_source *r, walls *w);
} kinds[] = {
    {"noise", draw_noise}, {"shells", draw_shells}, {"spiral", draw_spiral}, {"comb", draw_comb}, {"labyrinth", draw_labyrinth}};

size_t walls_kinds(void) { return sizeof kinds / sizeof kinds[0]; }

void walls_draw(random_source *r, size_t number, walls *w)
{
    draw_size(r, w);
    w->kind = kinds[number].name;
    kinds[number].draw(r, w);
    if (!random_int(r, 3))
        close_border(w);
    for (int holes = random_int(r, 3); holes > 0; holes--)
        w->is_wall[random_below(r, cells_of(w))] = 0;
}

size_t walls_search(const walls *w, unsigned char is_reached[WALLS_CELLS])
{
    static uint32_t queue[WALLS_CELLS][3];
    size_t head = 0, tail = 0;
    memset(is_reached, 0, WALLS_CELLS);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++) {
                const bool is_border = !i || !j || !k || i + 1 == w->size[0] || j + 1 == w->size[1] || k + 1 == w->size[2];
                if (is_border && !w->is_wall[walls_at(w, i, j, k)]) {
                    is_reached[walls_at(w, i, j, k)] = 1;
                    memcpy(queue[tail++], (uint32_t[3]){i, j, k}, sizeof queue[0]);
                }
            }
    for (; head < tail; head++)
        for (int side = 0; side < 6; side++) {
            uint32_t to[3];
            memcpy(to, queue[head], sizeof to);
            to[side / 2] += side % 2 ? 1 : UINT32_MAX;
            if (to[side / 2] >= w->size[side / 2])
                continue;
            const size_t at = walls_at(w, to[0], to[1], to[2]);
            if (!w->is_wall[at] && !is_reached[at]) {
                is_reached[at] = 1;
                memcpy(queue[tail++], to, sizeof to);
            }
        }
    return tail;
}
