/* cell_lists.c - which triangles overlap which cell of a window: lists by tiles of one cell. */
#include "tile_lists.h"

static tribox_status list_cells(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                                const tribox_options *options, size_t *starts, uint32_t *list)
{
    if (!grid)
        return TRIBOX_BAD_ARGUMENT;
    const tribox_tiles cells = {.side = 1, .count = tribox_tile_count(window ? window->size : grid->size, 1)};
    return tribox_tiles_list(triangles, grid, window, &cells, options, starts, list);
}

tribox_status tribox_cell_lists(const tribox_soup *soup, const tribox_grid *grid, const tribox_window *window,
                                const tribox_options *options, size_t *starts, uint32_t *list)
{
    tribox_triangles triangles;
    return tribox_triangles_of_soup(soup, &triangles) ? list_cells(&triangles, grid, window, options, starts, list)
                                                      : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_cell_lists(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_window *window,
                                     const tribox_options *options, size_t *starts, uint32_t *list)
{
    tribox_triangles triangles;
    return tribox_triangles_of_mesh(mesh, &triangles) ? list_cells(&triangles, grid, window, options, starts, list)
                                                      : TRIBOX_BAD_ARGUMENT;
}
