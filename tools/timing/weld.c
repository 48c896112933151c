/* weld.c - finds vertices by what they are, in a table with open places. */
#include "weld.h"

#include <stdlib.h>
#include <string.h>

typedef struct weld {
    uint32_t *place; /* vertex + 1; 0 where none is */
    size_t mask;
    float (*positions)[3];
    size_t vertices;
} weld;

static uint32_t vertex_of(weld *w, const float p[3])
{
    uint32_t bits[3];
    memcpy(bits, p, sizeof bits);
    uint64_t hash = (bits[0] * UINT64_C(0x9e3779b97f4a7c15)) ^ (bits[1] * UINT64_C(0xbf58476d1ce4e5b9)) ^
                    (bits[2] * UINT64_C(0x94d049bb133111eb));
    for (size_t at = (size_t)(hash ^ hash >> 29) & w->mask;; at = (at + 1) & w->mask) {
        if (!w->place[at]) {
            memcpy(w->positions[w->vertices++], p, sizeof w->positions[0]);
            w->place[at] = (uint32_t)w->vertices;
        }
        if (!memcmp(w->positions[w->place[at] - 1], p, sizeof w->positions[0]))
            return w->place[at] - 1;
    }
}

size_t weld_soup(const tribox_soup *soup, float (*positions)[3], uint32_t (*corners)[3])
{
    size_t places = 64;
    while (places < 6 * soup->count)
        places *= 2;
    weld w = {.place = calloc(places, sizeof *w.place), .mask = places - 1, .positions = positions};
    for (size_t i = 0; w.place && i < soup->count; i++)
        for (size_t v = 0; v < 3; v++)
            corners[i][v] = vertex_of(&w, (const float[3]){soup->x[v][i], soup->y[v][i], soup->z[v][i]});
    free(w.place);
    return w.vertices;
}
