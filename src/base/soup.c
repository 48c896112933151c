/* soup.c - checks of soups, and the count of triangles that are not finite. */
#include "soup.h"

#include "finite.h"
#include "floats.h"

static bool is_triangle_finite(const tribox_soup *soup, size_t i)
{
    for (int v = 0; v < 3; v++)
        for (int a = 0; a < 3; a++)
            if (!tribox_is_finite(tribox_float_at(tribox_soup_axis(soup, a)[v] + i)))
                return false;
    return true;
}

size_t tribox_soup_not_finite(const tribox_soup *soup, size_t *first)
{
    const size_t count = soup && tribox_soup_has_streams(soup) ? soup->count : 0;
    size_t found = 0, lowest = count;
    for (size_t i = count; i-- > 0;)
        if (!is_triangle_finite(soup, i)) {
            found++;
            lowest = i;
        }
    if (first)
        *first = lowest;
    return found;
}
