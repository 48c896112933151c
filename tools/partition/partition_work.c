/* partition_work.c - reads a mesh, lays a grid around it, sorts it into tiles, and writes them. */
#define _POSIX_C_SOURCE 200809L
#include "partition_work.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/output.h"
#include "partition_write.h"
#include "voxelize/voxelize_report.h"
#include "write/part.h"

typedef struct partition_answer {
    const partition_request *r;
    const mesh *m;
    voxels cells;
    bool is_shifted;
    partition_header header;
} partition_answer;

static void print_summary(const partition_answer *a)
{
    const partition_header *const h = &a->header;
    printf("mesh         %s\ntriangles    %zu\npositions    %s\n", a->r->from.mesh_path, a->m->triangles,
           a->m->is_double ? "float64" : "float32");
    voxelize_print_grid(&a->cells, a->is_shifted);
    printf("tiles        %" PRIu64 " of %u cells along a side, of %zu in the grid\n", h->records, h->tile,
           tribox_tile_count(h->size, h->tile));
    printf("sorted       %" PRIu64 " triangles, %.3f for each of the mesh\nwritten      %s\n", h->places,
           (double)h->places / (double)h->triangles, a->r->out_path);
}

static void print_json(const partition_answer *a)
{
    json j = json_to(stdout);
    json_open_object(&j, NULL);
    json_string(&j, "mesh", a->r->from.mesh_path);
    json_whole(&j, "triangles", a->m->triangles);
    json_string(&j, "positions", a->m->is_double ? "float64" : "float32");
    json_whole(&j, "not_finite", a->m->not_finite);
    voxelize_json_grid(&j, &a->cells, a->is_shifted);
    json_whole(&j, "tile", a->header.tile);
    json_whole(&j, "tiles", tribox_tile_count(a->header.size, a->header.tile));
    json_whole(&j, "filled_tiles", a->header.records);
    json_whole(&j, "sorted", a->header.places);
    json_string(&j, "output", a->r->out_path);
    json_close(&j);
}

static void fill_header(partition_answer *a, uint32_t tile)
{
    partition_header *const h = &a->header;
    *h = (partition_header){.magic = PARTITION_MAGIC,
                            .byte_order = PARTITION_BYTE_ORDER,
                            .tile = tile,
                            .position_bytes = a->m->is_double ? sizeof(double) : sizeof(float),
                            .record_bytes = sizeof(partition_tile),
                            .triangles = a->m->triangles,
                            .mesh_checksum = part_mesh_checksum(a->m),
                            .not_finite = a->m->not_finite};
    memcpy(h->origin, a->cells.grid.origin, sizeof h->origin);
    memcpy(h->cell, a->cells.grid.cell, sizeof h->cell);
    memcpy(h->shift, a->cells.shift, sizeof h->shift);
    memcpy(h->size, a->cells.grid.size, sizeof h->size);
}

static int write_set(partition_answer *a, tile_set *set, folder_out *out)
{
    progress bar = progress_start_of("writing", "triangles", (double)set->places, !a->r->is_quiet);
    fill_header(a, set->tile);
    const bool has_memory = partition_write(out, a->m, set, &a->header, &bar);
    progress_end(&bar);
    return has_memory ? folder_out_keep(out) : message_failure("out of memory to sort the triangles");
}

static int sort_mesh(partition_answer *a, folder_out *out)
{
    const tribox_options test = {.accuracy = TRIBOX_EXACT};
    const voxel_task task = a->m->is_double ? voxel_task_of_mesh(&a->m->doubles, &a->cells.grid, &test)
                                            : voxel_task_of_soup(&a->m->soup, &a->cells.grid, &test);
    tile_set set;
    int code = tile_set_of_task(&task, true, &set);
    if (code)
        return code;
    code = write_set(a, &set, out);
    tile_set_free(&set);
    return code;
}

static int report(const partition_answer *a)
{
    if (a->r->is_quiet)
        return EXIT_CODE_OK;
    (a->r->wants_json ? print_json : print_summary)(a);
    return output_flush();
}

static int answer(partition_answer *a)
{
    folder_out out;
    int code = grid_choose(&a->r->from.choice, triangle_file_name(a->r->from.mesh_path), a->m, &a->cells.grid);
    if (!code)
        code = folder_out_open(&out, a->r->out_path, PARTITION_NAMES);
    if (code)
        return code;
    code = sort_mesh(a, &out);
    folder_out_drop(&out);
    return code ? code : report(a);
}

int partition_work(const partition_request *r)
{
    mesh m;
    mesh_shift shift = r->from.shift;
    int code = mesh_read_shifted(r->from.mesh_path, r->from.format, &shift, &m);
    if (code)
        return code;
    mesh_warn(triangle_file_name(r->from.mesh_path), &m);
    partition_answer a = {.r = r, .m = &m, .is_shifted = shift.is_wanted};
    memcpy(a.cells.shift, shift.by, sizeof shift.by);
    code = answer(&a);
    mesh_free(&m);
    return code;
}
