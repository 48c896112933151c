/* window_cells.c - the set cells of a window, one by one: the call. */
#include "dispatch.h"
#include "tribox.h"

size_t tribox_window_cells(const uint64_t *occupied, const uint32_t size[3], uint32_t (*cells)[3])
{
    return tribox_kernel_any()->cells->number_cells(occupied, size, cells);
}
