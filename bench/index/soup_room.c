/* soup_room.c - memory for the nine streams of a soup. */
#include "soup_room.h"

#include <stdlib.h>
#include <string.h>

#include "console/message.h"

enum { CACHE_LINE = 64, LINE_FLOATS = CACHE_LINE / sizeof(float) };

bool soup_room_make(size_t count, soup_room *made)
{
    const size_t stride = (count / LINE_FLOATS + 3) * LINE_FLOATS;
    float *to = aligned_alloc(CACHE_LINE, 9 * stride * sizeof *to);
    *made = (soup_room){.soup = {.count = count}, .storage = to};
    if (!to)
        return message_failure("out of memory for %zu triangles", count) == EXIT_CODE_OK;
    memset(to, 0, 9 * stride * sizeof *to); /* pages that are first touched here, and not while the clock runs */
    for (int v = 0; v < 3; v++) {
        made->soup.x[v] = made->x[v] = to + (size_t)v * stride;
        made->soup.y[v] = made->y[v] = to + (size_t)(3 + v) * stride;
        made->soup.z[v] = made->z[v] = to + (size_t)(6 + v) * stride;
    }
    return true;
}

void soup_room_free(soup_room *made)
{
    free(made->storage);
    *made = (soup_room){.storage = NULL};
}

void soup_room_put(soup_room *to, size_t i, const float u[3][3])
{
    for (int v = 0; v < 3; v++) {
        to->x[v][i] = u[v][0];
        to->y[v][i] = u[v][1];
        to->z[v][i] = u[v][2];
    }
}

void soup_triangle(const tribox_soup *soup, size_t i, float u[3][3])
{
    for (int v = 0; v < 3; v++) {
        u[v][0] = soup->x[v][i];
        u[v][1] = soup->y[v][i];
        u[v][2] = soup->z[v][i];
    }
}
