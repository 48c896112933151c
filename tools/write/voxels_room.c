/* voxels_room.c - what all cells of a grid take. */
#include "voxels_room.h"

#include <math.h>

#include "console/memory.h"
#include "console/message.h"

int voxels_check_words(const tribox_grid *grid, const char *instead)
{
    static const double words_max = 0x1p31;
    char bytes[16];
    const double words = ceil(grid->size[0] / 64.0) * grid->size[1] * grid->size[2];
    if (words <= words_max)
        return EXIT_CODE_OK;
    return message_failure("a grid of %u x %u x %u cells takes %s, a bit per cell; the most is 16.0 GiB: %s", grid->size[0],
                           grid->size[1], grid->size[2], memory_text(words < 0x1p60 ? (uint64_t)(8 * words) : UINT64_MAX, bytes),
                           instead);
}

int voxels_check_memory(const tribox_grid *grid, uint64_t bytes, const char *instead)
{
    char needed[16], there[16];
    const uint64_t available = memory_available();
    if (bytes <= available)
        return EXIT_CODE_OK;
    return message_failure("%u x %u x %u cells take %s of memory here and %s are available: %s", grid->size[0], grid->size[1],
                           grid->size[2], memory_text(bytes, needed), memory_text(available, there), instead);
}
