/* listed.c - the triangles that a list names: whether they are there, and copied to where kernels read them. */
#include "listed.h"

#include <string.h>

#include "base/floats.h"
#include "mesh/mesh_input.h"

static bool are_all_below(const uint32_t *list, size_t count, size_t end)
{
    uint32_t greatest = 0;
    for (size_t i = 0; i < count; i++)
        greatest = list[i] > greatest ? list[i] : greatest;
    return !count || greatest < end;
}

/* Of the triangles of a list alone: a call about few tiles of a large mesh looks at few of its indices. */
static bool have_vertices(const tribox_mesh *mesh, const uint32_t *list, size_t count)
{
    const unsigned bytes = tribox_vertex_bytes(mesh);
    size_t greatest = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t v = 0; v < 3; v++) {
            const size_t number = tribox_vertex_number(mesh, bytes, 3 * (size_t)list[i] + v);
            greatest = number > greatest ? number : greatest;
        }
    return !count || greatest < mesh->vertices;
}

bool tribox_listed_are_there(const tribox_triangles *triangles, const uint32_t *list, size_t count)
{
    return are_all_below(list, count, triangles->count) && (triangles->is_soup || have_vertices(&triangles->mesh, list, count));
}

/* Triangles are copied a group at a time, as many follow each other. */
enum { GROUP = 4 };

/* How many of the next GROUP triangles of a list follow each other in the soup. */
static size_t successors(const uint32_t list[GROUP])
{
    size_t following = 1;
    bool follows = true;
    for (uint32_t n = 1; n < GROUP; n++) {
        follows &= list[n] == list[0] + n;
        following += follows;
    }
    return following;
}

/*
 * What is copied and not of the list is overwritten by the next. The streams do not begin at one place of a page each: caches would
 * have them all in few of their sets, and loads wait for stores.
 */
static void gather_soup(const tribox_soup *soup, const uint32_t *list, size_t count, tribox_listed *block)
{
    enum { AHEAD = 32 };
    const float *stream[9];
    size_t i = 0;
    for (int n = 0; n < 9; n++)
        stream[n] = tribox_soup_axis(soup, n / 3)[n % 3];
    for (size_t following; count - i >= GROUP && soup->count - list[i] >= GROUP; i += following) {
        const uint32_t later = list[count - i > AHEAD ? i + AHEAD : count - 1];
        for (size_t n = 0; n < 9; n++) {
            tribox_will_read(stream[n] + later);
            memcpy(&block->u[n][i], stream[n] + list[i], GROUP * sizeof(float));
        }
        following = successors(list + i);
    }
    for (; i < count; i++)
        for (size_t n = 0; n < 9; n++)
            block->u[n][i] = tribox_float_at(stream[n] + list[i]);
}

static void gather_mesh(const tribox_mesh *mesh, const double origin[3], const uint32_t *list, size_t count, tribox_listed *block)
{
    for (size_t i = 0; i < count; i++) {
        double corner[3][3];
        tribox_mesh_read_corners(mesh, 3 * (size_t)list[i], 3, corner);
        for (size_t n = 0; n < 9; n++)
            block->u[n][i] = (float)(corner[n % 3][n / 3] - origin[n / 3]);
    }
}

tribox_soup tribox_listed_gather(const tribox_triangles *triangles, const double origin[3], const uint32_t *list, size_t count,
                                 tribox_listed *block)
{
    static const double zero[3] = {0, 0, 0};
    if (triangles->is_soup)
        gather_soup(&triangles->soup, list, count, block);
    else
        gather_mesh(&triangles->mesh, triangles->are_doubles ? origin : zero, list, count, block);
    return tribox_soup_of(&block->u[0][0], TRIBOX_LISTED_STREAM, count);
}
