/* fill_search.c - which free cells are reached from outside, by a plain search. */
#include "fill_search.h"

#include <stdbool.h>
#include <string.h>

size_t fill_search(const walls *w, unsigned char is_reached[WALLS_CELLS])
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
