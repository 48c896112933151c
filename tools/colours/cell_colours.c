/*
 * cell_colours.c - finds the colour of a cell: its brick, and how many of that brick's cells come before it; counts colours, and
 * where there are too many divides them: Heckbert's median cut, 1982; and the curve of sRGB, IEC 61966-2-1.
 */
#include "colours.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/system.h"
#include "write/voxels.h"

/* Cubes along a side, and the colours along a side of one. */
enum { CUBES = 64, CUBE = 4, COLOURS = 1 << 24 };

/* A cube in which there are cells. */
typedef struct cube {
    rgb_sum sum;
    unsigned char at[3];
} cube;

/* Cubes from .. to - 1 of the list. */
typedef struct box {
    size_t from, to;
    uint64_t cells;
} box;

static size_t number_of(const unsigned char at[3]) { return ((size_t)at[0] * CUBES + at[1]) * CUBES + at[2]; }

static void cube_of(rgb colour, unsigned char at[3])
{
    for (int c = 0; c < 3; c++)
        at[c] = colour.at[c] / CUBE;
}

/* False where there are more than a palette has. */
static bool take_few(const unsigned char *seen, palette *p)
{
    for (uint32_t n = 0; n < COLOURS; n++) {
        if (!(seen[n / 8] >> n % 8 & 1))
            continue;
        if (p->count == PALETTE_MAX)
            return false;
        p->of[p->count++] = rgb_of_number(n);
    }
    return true;
}

static size_t fill_cubes(const rgb *colours, uint64_t cells, cube *cubes)
{
    size_t filled = 0;
    for (uint64_t n = 0; n < cells; n++) {
        unsigned char at[3];
        cube_of(colours[n], at);
        rgb_add(&cubes[number_of(at)].sum, colours[n]);
    }
    for (size_t n = 0; n < (size_t)CUBES * CUBES * CUBES; n++)
        if (cubes[n].sum.count) {
            cubes[filled++] =
                (cube){.sum = cubes[n].sum,
                       .at = {(unsigned char)(n / CUBES / CUBES), (unsigned char)(n / CUBES % CUBES), (unsigned char)(n % CUBES)}};
        }
    return filled;
}

static int longest_axis(const cube *cubes, const box *b)
{
    int longest = 0, most = -1;
    for (int c = 0; c < 3; c++) {
        int lo = CUBES, hi = 0;
        for (size_t n = b->from; n < b->to; n++) {
            lo = cubes[n].at[c] < lo ? cubes[n].at[c] : lo;
            hi = cubes[n].at[c] > hi ? cubes[n].at[c] : hi;
        }
        longest = hi - lo > most ? c : longest;
        most = hi - lo > most ? hi - lo : most;
    }
    return longest;
}

/* In the order of an axis; equal ones stay as they are. */
static void sort(cube *cubes, cube *room, const box *b, int axis)
{
    size_t start[CUBES + 1] = {0};
    for (size_t n = b->from; n < b->to; n++)
        start[cubes[n].at[axis] + 1]++;
    for (int at = 0; at < CUBES; at++)
        start[at + 1] += start[at];
    for (size_t n = b->from; n < b->to; n++)
        room[start[cubes[n].at[axis]]++] = cubes[n];
    memcpy(cubes + b->from, room, (b->to - b->from) * sizeof *cubes);
}

/* Where half of its cells are, with a cube on either side at least. */
static void cut(cube *cubes, cube *room, box *b, box *other)
{
    uint64_t before = 0;
    size_t at = b->from;
    sort(cubes, room, b, longest_axis(cubes, b));
    do
        before += cubes[at++].sum.count;
    while (at + 1 < b->to && 2 * before + cubes[at].sum.count <= b->cells);
    *other = (box){at, b->to, b->cells - before};
    *b = (box){b->from, at, before};
}

/* The box of most cells that has more than one cube; NULL for none. */
static box *largest(box *boxes, int count)
{
    box *found = NULL;
    for (int n = 0; n < count; n++)
        if (boxes[n].to - boxes[n].from > 1 && (!found || boxes[n].cells > found->cells))
            found = &boxes[n];
    return found;
}

static void take_means(const cube *cubes, const box *boxes, palette *p)
{
    for (int n = 0; n < p->count; n++) {
        rgb_sum sum = {.count = 0};
        for (size_t i = boxes[n].from; i < boxes[n].to; i++) {
            for (int c = 0; c < 3; c++)
                sum.at[c] += cubes[i].sum.at[c];
            sum.count += cubes[i].sum.count;
            p->place[number_of(cubes[i].at)] = (unsigned char)n;
        }
        p->of[n] = rgb_mean(&sum);
    }
}

static bool take_many(const rgb *colours, uint64_t cells, palette *p)
{
    enum { ALL = CUBES * CUBES * CUBES };
    box boxes[PALETTE_MAX];
    cube *const cubes = calloc(2 * (size_t)ALL, sizeof *cubes);
    p->place = calloc(ALL, 1);
    if (cubes && p->place) {
        p->count = 1;
        boxes[0] = (box){0, fill_cubes(colours, cells, cubes), cells};
        for (box *b; p->count < PALETTE_MAX && (b = largest(boxes, p->count));)
            cut(cubes, cubes + ALL, b, &boxes[p->count++]);
        take_means(cubes, boxes, p);
    }
    const bool is_made = cubes && p->place;
    free(cubes);
    return is_made;
}

/*
 * Up to PALETTE_MAX colours stay as they are. More are divided by median cuts of their cubes: the box of cubes with the most cells
 * is cut in two of about as many across its longest side, until there are PALETTE_MAX; a box has the mean colour of its cells.
 * False where there is no memory.
 */
static bool palette_make(const rgb *colours, uint64_t cells, palette *p)
{
    unsigned char *const seen = calloc(COLOURS / 8, 1);
    if (!seen)
        return false;
    for (uint64_t n = 0; n < cells; n++)
        seen[rgb_number(colours[n]) / 8] |= (unsigned char)(1U << rgb_number(colours[n]) % 8);
    const bool is_few = take_few(seen, p);
    free(seen);
    return is_few || take_many(colours, cells, p);
}

int palette_find(const palette *p, rgb colour)
{
    if (p->place) {
        unsigned char at[3];
        cube_of(colour, at);
        return p->place[number_of(at)];
    }
    int low = 0, high = p->count;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (rgb_number(p->of[middle]) <= rgb_number(colour))
            low = middle;
        else
            high = middle;
    }
    return low;
}

rgb_curve rgb_curve_make(void)
{
    rgb_curve curve;
    for (int byte = 0; byte < 256; byte++) {
        const double s = byte / 255.0;
        curve.light[byte] = (float)(s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4));
    }
    return curve;
}

rgb rgb_of_light(const double light[3])
{
    double number[3];
    for (int c = 0; c < 3; c++)
        number[c] = light[c] <= 0.0031308 ? 12.92 * light[c] : 1.055 * pow(light[c], 1 / 2.4) - 0.055;
    return rgb_of(number, 1);
}

enum { SIDE = 8 };

static size_t place_of(const cell_colours *c, const uint32_t at[3])
{
    return ((size_t)at[2] * c->size[1] + at[1]) * c->size[0] + at[0];
}

rgb *cell_colours_add(cell_colours *c, const uint32_t at[3], const uint64_t bits[8], uint64_t cells)
{
    coloured_brick *const bricks = memory_grow(c->bricks, c->count + 1, &c->room, sizeof *bricks);
    c->bricks = bricks ? bricks : c->bricks;
    rgb *const of = bricks ? memory_grow(c->of, (size_t)(c->cells + cells), &c->cells_room, sizeof *of) : NULL;
    c->of = of ? of : c->of;
    if (!of)
        return NULL;
    coloured_brick *const b = &bricks[c->count++];
    *b = (coloured_brick){.at = {at[0], at[1], at[2]}, .first = c->cells};
    memcpy(b->bits, bits, sizeof b->bits);
    c->cells += cells;
    return of + b->first;
}

int cell_colours_make_palette(cell_colours *c, const char *path)
{
    if (!palette_make(c->of, c->cells, &c->palette))
        return message_failure("%s: out of memory for its palette", path);
    if (c->palette.place)
        message_say(
            "note: %s: the cells have more than the %d colours of its palette; colours close to one another became their mean",
            path, c->palette.count);
    return EXIT_CODE_OK;
}

bool cell_colours_place(cell_colours *c, const uint32_t cells[3])
{
    for (int a = 0; a < 3; a++)
        c->size[a] = (cells[a] + SIDE - 1) / SIDE;
    const size_t places = (size_t)c->size[0] * c->size[1] * c->size[2];
    c->number = c->count < UINT32_MAX ? malloc(places * sizeof *c->number) : NULL;
    if (!c->number)
        return false;
    memset(c->number, 0xff, places * sizeof *c->number);
    for (size_t b = 0; b < c->count; b++)
        c->number[place_of(c, c->bricks[b].at)] = (uint32_t)b;
    return true;
}

const rgb *cell_colours_of_brick(const cell_colours *c, const uint32_t at[3])
{
    return c->of + c->bricks[c->number[place_of(c, at)]].first;
}

rgb cell_colours_at(const cell_colours *c, const uint32_t cell[3])
{
    const uint32_t at[3] = {cell[0] / SIDE, cell[1] / SIDE, cell[2] / SIDE};
    const coloured_brick *const b = &c->bricks[c->number[place_of(c, at)]];
    const uint32_t k = cell[2] % SIDE, bit = SIDE * (cell[1] % SIDE) + cell[0] % SIDE;
    const uint64_t lower = b->bits[k] & ((UINT64_C(1) << bit) - 1);
    return c->of[b->first + voxels_count(b->bits, k) + voxels_count(&lower, 1)];
}

void cell_colours_free(cell_colours *c)
{
    free(c->bricks);
    free(c->of);
    free(c->number);
    free(c->palette.place);
    *c = (cell_colours){.count = 0};
}
