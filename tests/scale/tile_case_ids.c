#include "tile_case.h"

tribox_status tile_case_bricks_ids(const tile_case *c, size_t from, size_t to, const size_t *starts, const uint32_t *numbers,
                                   void *scratch, const tribox_ids_sink *sink, tribox_report *report)
{
    const tribox_soup soup = triangle_list_soup(&c->triangles);
    const tribox_mesh mesh = tile_case_mesh(c);
    const tribox_grid *const grid = tile_case_grid(c);
    const tribox_tiles tiles = {c->tile, from, to - from};
    return c->is_mesh ? tribox_mesh_bricks_ids(&mesh, grid, &tiles, starts, numbers, &c->options, scratch, sink, report)
                      : tribox_bricks_ids(&soup, grid, &tiles, starts, numbers, &c->options, scratch, sink, report);
}

tribox_status tile_case_bricks_lists(const tile_case *c, size_t from, size_t to, const size_t *starts, const uint32_t *numbers,
                                     void *scratch, const tribox_lists_sink *sink, tribox_report *report)
{
    const tribox_soup soup = triangle_list_soup(&c->triangles);
    const tribox_mesh mesh = tile_case_mesh(c);
    const tribox_tiles tiles = {c->tile, from, to - from};
    return c->is_mesh
               ? tribox_mesh_bricks_lists(&mesh, tile_case_grid(c), &tiles, starts, numbers, &c->options, scratch, sink, report)
               : tribox_bricks_lists(&soup, tile_case_grid(c), &tiles, starts, numbers, &c->options, scratch, sink, report);
}

void tile_case_dense_ids(const tile_case *c, const tribox_options *options, uint64_t *occupied, uint32_t *ids)
{
    const tribox_soup soup = triangle_list_soup(&c->triangles);
    const tribox_mesh mesh = tile_case_mesh(c);
    const tribox_grid *const grid = tile_case_grid(c);
    assert_int_equal(c->is_double ? tribox_mesh_voxelize_ids(&mesh, 0, grid, NULL, options, occupied, ids, NULL)
                                  : tribox_voxelize_ids(&soup, 0, grid, NULL, options, occupied, ids, NULL),
                     TRIBOX_OK);
}
