/* kept_bricks.c - a growing row of bricks. */
#include "kept_bricks.h"

#include <stdlib.h>
#include <string.h>

int kept_bricks_take(void *kept, const uint32_t at[3], const uint64_t bits[8])
{
    kept_bricks *const k = kept;
    if (k->count == k->room) {
        const size_t room = k->room ? 2 * k->room : 1024;
        kept_brick *const grown = realloc(k->bricks, room * sizeof *grown);
        if (!grown)
            return 1;
        k->bricks = grown;
        k->room = room;
    }
    kept_brick *const to = &k->bricks[k->count++];
    memcpy(to->at, at, sizeof to->at);
    memcpy(to->bits, bits, sizeof to->bits);
    return 0;
}

tribox_status kept_bricks_hand_on(const kept_bricks *kept, const tribox_sink *sink)
{
    size_t i = 0;
    while (i < kept->count && !sink->take(sink->data, kept->bricks[i].at, kept->bricks[i].bits))
        i++;
    return i == kept->count ? TRIBOX_OK : TRIBOX_STOPPED;
}
