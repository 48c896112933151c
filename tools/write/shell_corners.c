/* shell_corners.c - a list for each vertex, of the few colours around it. */
#include "shell_corners.h"

#include <stdlib.h>
#include <string.h>

uint32_t shell_corners_find(const shell_corners *c, uint32_t vertex, rgb colour)
{
    uint32_t n = c->first[vertex];
    while (n != UINT32_MAX && rgb_number(c->of[n].colour) != rgb_number(colour))
        n = c->of[n].next;
    return n;
}

static void add(shell_corners *c, uint32_t vertex, rgb colour)
{
    if (c->count == c->room) {
        const size_t room = c->room ? 2 * c->room : 4096;
        shell_corner *const more = room <= (size_t)LATTICE_VERTICES_MAX + 1 ? realloc(c->of, room * sizeof *more) : NULL;
        c->lacks_memory = !more;
        if (!more)
            return;
        c->of = more;
        c->room = room;
    }
    c->of[c->count] = (shell_corner){vertex, c->first[vertex], colour};
    c->first[vertex] = (uint32_t)c->count++;
}

typedef struct making {
    shell_corners *corners;
    bool (*tell)(void *data, double done);
    void *data;
} making;

static void take_corners(void *data, const uint32_t triangle[3], rgb colour)
{
    shell_corners *const c = ((const making *)data)->corners;
    for (int n = 0; n < 3 && !c->lacks_memory; n++)
        if (shell_corners_find(c, triangle[n], colour) == UINT32_MAX)
            add(c, triangle[n], colour);
}

typedef struct placing {
    uint32_t (*to)[3];
} placing;

static bool take_place(void *data, const uint32_t halves[3])
{
    placing *const p = data;
    memcpy(*p->to++, halves, sizeof *p->to);
    return true;
}

static bool tell_making(void *data, double done)
{
    const making *const m = data;
    return m->tell(m->data, done) || m->corners->lacks_memory;
}

bool shell_corners_make(shell_corners *c, const shell *s, bool (*tell)(void *data, double done), void *data)
{
    const size_t vertices = (size_t)s->points.vertices + 1;
    making m = {c, tell, data};
    *c = (shell_corners){.places = malloc(vertices * sizeof *c->places), .first = malloc(vertices * sizeof *c->first)};
    if (!c->places || !c->first)
        return false;
    memset(c->first, 0xff, vertices * sizeof *c->first);
    lattice_vertices(&s->points, take_place, &(placing){c->places});
    shell_triangles(s, take_corners, tell_making, &m);
    return !c->lacks_memory;
}

void shell_corners_free(shell_corners *c)
{
    free(c->places);
    free(c->first);
    free(c->of);
}
