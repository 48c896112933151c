/* voxelize_work.c - opens a mesh or a partition, lays the grid, chooses the way, and reports. */
#define _POSIX_C_SOURCE 200809L
#include "voxelize_work.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "console/interrupt.h"
#include "console/message.h"
#include "console/system.h"
#include "sort_first.h"

/*
 * Whether all cells at once take less time than tile by tile, and are the same: up to 2 MB of bits, which a core has at hand, and
 * with many triangles up to what the last cache holds (bench/findings.md).
 */
static bool is_grid_small(const voxelize_request *r, const tribox_grid *grid, size_t triangles)
{
    static const double at_hand = 0x1p21, cached = 0x1p25, per_triangle = 16;
    if (r->has_shard || r->result.options.has_ids || r->test.accuracy != TRIBOX_EXACT)
        return false;
    const double bytes = ceil(grid->size[0] / 64.0) * grid->size[1] * grid->size[2] * sizeof(uint64_t);
    const bool is_faster = bytes <= at_hand || bytes <= per_triangle * (double)triangles;
    return is_faster && bytes <= cached && bytes < (double)memory_available() / 2;
}

/* Formats of all cells take the whole grid, and so do small ones; all else goes tile by tile. */
static bool takes_whole(const voxelize_request *r, const voxelize_input *in)
{
    const bool is_dense = !r->is_count && !r->result.format->writer->bricks && !r->result.options.has_ids;
    const bool is_small = in->mesh && (is_dense || is_grid_small(r, &in->cells.grid, in->mesh->triangles));
    return r->has_colours || r->is_thin || is_small;
}

voxel_task voxelize_task(const voxelize_request *r, const voxelize_input *in)
{
    static const tribox_soup nothing = {.count = 0};
    const tribox_grid *const grid = &in->cells.grid;
    if (in->mesh && in->mesh->is_double)
        return voxel_task_of_mesh(&in->mesh->doubles, grid, &r->test);
    return voxel_task_of_soup(in->mesh ? &in->mesh->soup : &nothing, grid, &r->test);
}

void voxelize_note_rows(size_t odd_rows, voxelize_answer *a)
{
    a->odd_rows = odd_rows;
    if (odd_rows)
        message_say("warning: %s is not closed: %zu rows of cells cross it an odd number of times, and may be filled wrongly; "
                    "--fill outside does not depend on this",
                    triangle_file_name(a->r->from.mesh_path), odd_rows);
}

static int answer(const voxelize_request *r, const voxelize_input *in, voxelize_files *files, voxelize_answer *a)
{
    a->cells = in->cells;
    if (r->result.format && r->result.format->writer->check_grid) {
        const int code = r->result.format->writer->check_grid(r->result.out_path, &in->cells.grid);
        if (code)
            return code;
    }
    volume_note_shift(r->result.format, r->result.out_path, &in->cells);
    return takes_whole(r, in) ? voxelize_whole(r, in, files, a) : voxelize_by_tiles(r, in, files, a);
}

/* What a run that is interrupted says. */
static void advise(const voxelize_request *r)
{
    char advice[128];
    if (!r->has_shard)
        return;
    snprintf(advice, sizeof advice, "nothing was written; run shard %u of %u again, parts that are there stay good", r->shard,
             r->shards);
    interrupt_advise(advice);
}

static int open_files(const voxelize_request *r, const voxelize_input *in, voxelize_answer *a)
{
    voxelize_files files;
    advise(r);
    int code = file_out_open(&files.out, r->result.out_path);
    if (code)
        return code;
    code = file_out_open(&files.picture, r->result.preview_path);
    if (!code) {
        code = answer(r, in, &files, a);
        file_out_drop(&files.picture);
    }
    file_out_drop(&files.out);
    return code;
}

static int work_on_colours(const voxelize_request *r, voxelize_input *in, voxelize_answer *a)
{
    mesh_colours colours;
    const file_out_names names = result_names(&r->result);
    int code = mesh_colours_read(r->from.mesh_path, r->from.format, in->mesh->triangles, &names, &colours);
    if (code)
        return code;
    in->colours = &colours;
    a->colours = colours.from;
    code = open_files(r, in, a);
    mesh_colours_free(&colours);
    return code;
}

/* The mesh itself, whose name is known, was checked before it was read. */
static int check_opened(const result_request *result, const char *opened)
{
    const file_out_names names = result_names(result);
    int code = EXIT_CODE_OK;
    for (const char *name = opened; !code && name && *name; name += strlen(name) + 1)
        code = file_out_check(&names, "file of its data", &name, 1);
    return code;
}

static int work_with_mesh(const voxelize_request *r, const mesh *m, voxelize_input *in, voxelize_answer *a)
{
    const char *const name = triangle_file_name(r->from.mesh_path);
    in->mesh = m;
    int code = check_opened(&r->result, m->opened);
    if (code)
        return code;
    mesh_warn(name, m);
    a->triangles = m->triangles;
    a->not_finite = m->not_finite;
    a->is_double = m->is_double;
    code = r->result.options.has_ids ? partition_check_numbers(name, m->triangles) : EXIT_CODE_OK;
    if (!code)
        code = grid_choose(&r->from.choice, name, m, &in->cells.grid);
    return code ? code : r->has_colours ? work_on_colours(r, in, a) : open_files(r, in, a);
}

static int work_on_partition(const voxelize_request *r, const char *const *paths, size_t count, voxelize_answer *a)
{
    partition p;
    int code = partition_open_all(&p, paths, count, r->memory ? r->memory : memory_available());
    if (code)
        return code;
    const voxelize_input in = {.partition = &p, .cells = partition_voxels(&p.header)};
    a->triangles = (size_t)p.header.triangles;
    a->not_finite = (size_t)p.header.not_finite;
    a->is_double = p.header.position_bytes == sizeof(double);
    a->is_shifted = r->from.shift.is_wanted || voxels_are_shifted(&in.cells);
    if (r->result.options.has_ids && !p.header.number_bytes)
        code = message_failure("%s: has no numbers of its triangles; make it with 'tribox partition --ids', or leave out --ids",
                               p.path);
    if (!code)
        code = open_files(r, &in, a);
    partition_close(&p);
    return code;
}

static int work_sorted(const voxelize_request *r, sorted_place *place, voxelize_answer *a)
{
    const int code = sort_first(place);
    return code ? code : work_on_partition(r, (const char *const[]){place->made.out.beside}, 1, a);
}

static int work_in_memory(const voxelize_request *r, mesh *m, const mesh_shift *shift, voxelize_answer *a)
{
    voxelize_input in = {.mesh = NULL};
    a->is_shifted = shift->is_wanted;
    if (shift->is_wanted)
        memcpy(in.cells.shift, shift->by, sizeof shift->by);
    const int code = work_with_mesh(r, m, &in, a);
    mesh_free(m);
    return code;
}

static int work_on_mesh(const voxelize_request *r, voxelize_answer *a)
{
    mesh m;
    mesh_shift shift = r->from.shift;
    sorted_place place;
    mesh_overflow over = sort_first_overflow(r, &place);
    int code = sort_first_is_due(r, &over.is_used);
    if (!code && !over.is_used)
        code = mesh_read_shifted(r->from.mesh_path, r->from.format, &shift, r->threads, sort_first_can(r) ? &over : NULL, &m);
    if (!code)
        code = over.is_used ? work_sorted(r, &place, a) : work_in_memory(r, &m, &shift, a);
    sort_first_drop(&place);
    return code;
}

int voxelize_work(const voxelize_request *r)
{
    voxelize_answer a = {.r = r};
    if (r->result.format && r->result.format->writer->begin)
        r->result.format->writer->begin();
    const int code = partition_is_folder(r->from.mesh_path) ? work_on_partition(r, r->paths, r->count, &a) : work_on_mesh(r, &a);
    return code || !r->result.has_summary ? code : voxelize_report(&a);
}
