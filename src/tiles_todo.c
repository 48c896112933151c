/* tiles_todo.c - for the time being: calls that are declared and not written yet. */
#include "tribox.h"

tribox_status tribox_voxelize_window(const tribox_soup *soup, const tribox_grid *grid, const uint32_t first[3],
                                     const uint32_t size[3], const tribox_options *options, uint64_t *occupied,
                                     tribox_report *report)
{
    (void)soup, (void)grid, (void)first, (void)size, (void)options, (void)occupied, (void)report;
    return TRIBOX_BAD_ARGUMENT;
}
