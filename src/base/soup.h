/* soup.h - the streams of a soup by axis, and what every call checks before it reads them. */
#ifndef TRIBOX_SOUP_H
#define TRIBOX_SOUP_H

#include <stdbool.h>

#include "tribox.h"

/* Whether `count` floats fit the address space. */
static inline bool tribox_is_addressable(size_t count) { return count <= PTRDIFF_MAX / sizeof(float); }

/* Whether 32-bit numbers can count `count` things. A size_t may have no more bits itself. */
static inline bool tribox_has_numbers(uint64_t count) { return count <= UINT64_C(1) << 32; }

static inline bool tribox_soup_has_streams(const tribox_soup *soup)
{
    bool are_all = true;
    for (int v = 0; v < 3; v++)
        are_all &= soup->x[v] && soup->y[v] && soup->z[v];
    return are_all;
}

/* Whether the soup can be read: no NULL where triangles are, and a count that fits. */
static inline bool tribox_soup_is_readable(const tribox_soup *soup)
{
    return soup && tribox_is_addressable(soup->count) && (!soup->count || tribox_soup_has_streams(soup));
}

/* The three streams of axis a: one for each vertex. */
static inline const float *const *tribox_soup_axis(const tribox_soup *soup, int a)
{
    return a == 0 ? soup->x : a == 1 ? soup->y : soup->z;
}

/* `count` triangles whose nine streams x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2 lie in memory `length` floats apart. */
static inline tribox_soup tribox_soup_of(const float *streams, size_t length, size_t count)
{
    tribox_soup soup = {.count = count};
    for (size_t v = 0; v < 3; v++) {
        soup.x[v] = streams + v * length;
        soup.y[v] = streams + (3 + v) * length;
        soup.z[v] = streams + (6 + v) * length;
    }
    return soup;
}

#endif
