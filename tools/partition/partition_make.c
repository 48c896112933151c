/* partition_make.c - lays a grid around meshes, sorts them into its tiles and writes these; or joins partitions. */
#define _POSIX_C_SOURCE 200809L
#include "partition_make.h"

#include <string.h>

#include "console/message.h"
#include "console/system.h"
#include "tile_sort.h"
#include "voxelize/tile_set.h"

/* How many meshes there are does not matter to a message about all of them. */
static const char *name_of(const partition_request *r)
{
    return r->name ? r->name : r->count == 1 ? triangle_file_name(r->paths[0]) : "the meshes";
}

static uint64_t memory_of(const partition_request *r) { return r->memory ? r->memory : memory_available() / 2; }

static void fill_header(partition_answer *a, uint32_t tile, unsigned position_bytes, const tally *found)
{
    partition_header *const h = &a->header;
    *h = (partition_header){.magic = PARTITION_MAGIC,
                            .byte_order = PARTITION_BYTE_ORDER,
                            .tile = tile,
                            .position_bytes = position_bytes,
                            .number_bytes = a->r->has_ids ? sizeof(uint32_t) : 0,
                            .record_bytes = sizeof(partition_tile),
                            .triangles = found->triangles,
                            .sums = found->sums,
                            .not_finite = found->seen.not_finite};
    memcpy(h->origin, a->cells.grid.origin, sizeof h->origin);
    memcpy(h->cell, a->cells.grid.cell, sizeof h->cell);
    memcpy(h->shift, a->cells.shift, sizeof h->shift);
    memcpy(h->size, a->cells.grid.size, sizeof h->size);
}

static int refuse_none(const partition_request *r)
{
    return message_failure("%s: none of %s triangles has finite coordinates", name_of(r), r->count == 1 ? "its" : "their");
}

static int sort_pieces(partition_answer *a, const pieces *all)
{
    const partition_request *const r = a->r;
    const uint32_t side = tile_set_side(a->cells.grid.size, r->has_ids);
    tally found;
    if (!side)
        return EXIT_CODE_FAILURE;
    tile_runs *const runs = tile_runs_make(&a->cells.grid, side, r->has_ids, all->blocks, memory_of(r));
    int code = runs ? tile_sort(runs, all, r->threads, &a->out, &found) : EXIT_CODE_FAILURE;
    if (!code) {
        mesh_warn_not_finite(name_of(r), found.seen.not_finite, found.triangles, found.seen.first_not_finite);
        fill_header(a, side, all->write_bytes, &found);
        code = found.seen.not_finite == found.triangles ? refuse_none(r)
                                                        : tile_write(&a->out, runs, r->threads, &a->header, &a->spilled);
    }
    tile_runs_free(runs);
    return code;
}

/* Reads all once, where that is needed to know the shift, whether floats hold what it leaves, or the grid. */
static int survey(partition_answer *a, pieces *all)
{
    const grid_choice *const choice = &a->r->from.choice;
    tally found = {.triangles = 0};
    int code = EXIT_CODE_OK;
    if (all->shift.is_auto) {
        const double nothing[3] = {0, 0, 0};
        memcpy(all->shift.by, nothing, sizeof nothing);
        code = tile_sort_look(all, a->r->threads, &found);
        if (!code)
            mesh_shift_choose(&found.seen.bounds, all->shift.by);
    }
    if (!code && (all->shift.is_wanted || !grid_is_fixed(choice)))
        code = tile_sort_look(all, a->r->threads, &found);
    if (code)
        return code;
    if (all->shift.is_wanted && found.fits_float)
        all->write_bytes = sizeof(float);
    memcpy(a->cells.shift, all->shift.by, sizeof a->cells.shift);
    if (!grid_is_fixed(choice) && found.seen.bounds.lo[0] > found.seen.bounds.hi[0]) {
        mesh_warn_not_finite(name_of(a->r), found.seen.not_finite, found.triangles, found.seen.first_not_finite);
        return refuse_none(a->r);
    }
    return grid_choose_around(choice, name_of(a->r), &found.seen.bounds, &a->cells.grid);
}

static int open_out(partition_answer *a, bool has_ids)
{
    const char *const names[] = PARTITION_NAMES;
    return folder_out_open(&a->out, a->r->out_path, a->r->told, (const char *[]){names[0], names[1], has_ids ? names[2] : NULL});
}

static int work_on_pieces(partition_answer *a, pieces *all)
{
    pieces_divide(all, tile_sort_block(all, memory_of(a->r), a->r->threads));
    int code = a->r->has_ids ? partition_check_numbers(name_of(a->r), all->triangles) : EXIT_CODE_OK;
    if (!code)
        code = survey(a, all);
    if (!code)
        code = open_out(a, a->r->has_ids);
    return code ? code : sort_pieces(a, all);
}

static int work_on_meshes(partition_answer *a)
{
    pieces all;
    int code = pieces_open(&all, a->r->paths, a->r->count, a->r->from.format, &a->r->from.shift, a->r->threads);
    a->is_shifted = a->r->from.shift.is_wanted;
    if (!code)
        code = work_on_pieces(a, &all);
    pieces_close(&all);
    return code;
}

static int work_on_partitions(partition_answer *a)
{
    partition all;
    int code = partition_open(&all, a->r->paths, a->r->count);
    if (code)
        return code;
    a->header = all.header;
    a->cells = partition_voxels(&a->header);
    a->is_shifted = voxels_are_shifted(&a->cells);
    code = open_out(a, a->header.number_bytes);
    tile_runs *const runs = code ? NULL : tile_runs_of_partition(&all, memory_of(a->r));
    code = runs ? tile_write(&a->out, runs, a->r->threads, &a->header, &a->spilled) : EXIT_CODE_FAILURE;
    tile_runs_free(runs);
    partition_close(&all);
    return code;
}

int partition_make(partition_answer *a)
{
    const bool is_kept = !a->r->told;
    a->out = (folder_out){.path = NULL};
    int code = partition_is_folder(a->r->paths[0]) ? work_on_partitions(a) : work_on_meshes(a);
    if (!code)
        code = is_kept ? folder_out_keep(&a->out) : folder_out_finish(&a->out);
    if (code || is_kept)
        folder_out_drop(&a->out);
    return code;
}
