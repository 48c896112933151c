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

static inline size_t greatest_vertex(const tribox_mesh *mesh, unsigned index_bytes, const uint32_t *list, size_t count)
{
    size_t greatest = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t v = 0; v < 3; v++) {
            const size_t number = tribox_vertex_number(mesh, index_bytes, 3 * (size_t)list[i] + v);
            greatest = number > greatest ? number : greatest;
        }
    return greatest;
}

/*
 * Of the triangles of a list alone: a call about few tiles of a large mesh looks at few of its indices. A long list takes longer
 * than all of them in order, which may name a vertex too many elsewhere.
 */
static bool have_vertices(const tribox_mesh *mesh, const tribox_kernel *kernel, const uint32_t *list, size_t count)
{
    enum { FASTER = 8 };
    if (count > mesh->count / FASTER && tribox_mesh_is_in_range(mesh, kernel, 0, mesh->count))
        return true;
    const unsigned bytes = tribox_vertex_bytes(mesh);
    const size_t greatest = bytes == 4 ? greatest_vertex(mesh, 4, list, count) : greatest_vertex(mesh, bytes, list, count);
    return !count || greatest < mesh->vertices;
}

bool tribox_listed_are_there(const tribox_triangles *triangles, const tribox_kernel *kernel, const uint32_t *list, size_t count)
{
    return are_all_below(list, count, triangles->count) &&
           (triangles->is_soup || have_vertices(&triangles->mesh, kernel, list, count));
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

tribox_soup tribox_listed_gather(const tribox_triangles *triangles, const tribox_kernel *kernel, const double origin[3],
                                 const uint32_t *list, size_t first, size_t count, tribox_listed *block)
{
    float *to[9];
    for (int k = 0; k < 9; k++)
        to[k] = block->u[k];
    if (!triangles->is_soup)
        tribox_mesh_write_soup(&triangles->mesh, kernel, triangles->are_doubles ? origin : NULL, list, first, count, to);
    else if (list)
        gather_soup(triangles->soup, list + first, count, block);
    else
        for (int k = 0; k < 9; k++)
            memcpy(to[k], tribox_soup_axis(triangles->soup, k / 3)[k % 3] + first, count * sizeof(float));
    return tribox_soup_of(&block->u[0][0], TRIBOX_LISTED_STREAM, count);
}
