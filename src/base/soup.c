/* soup.c - checks of soups, their last word, and the count of triangles that are not finite. */
#include "soup.h"

#include <string.h>

#include "finite.h"
#include "floats.h"

tribox_soup tribox_soup_tail(const tribox_soup *soup, float scratch[9][64])
{
    const size_t tail = soup->count % 64, first = soup->count - tail;
    for (int a = 0; a < 3; a++)
        for (int v = 0; v < 3; v++)
            memcpy(scratch[3 * a + v], tribox_soup_axis(soup, a)[v] + first, tail * sizeof(float));
    return tribox_soup_of(&scratch[0][0], 64, 64);
}

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
