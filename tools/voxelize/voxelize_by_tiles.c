/* voxelize_by_tiles.c - a mesh or a partition tile by tile: sparse formats, shards, and mere counts. */
#define _POSIX_C_SOURCE 200809L

#include <stdlib.h>

#include "console/clock.h"
#include "console/message.h"
#include "tile_set.h"
#include "voxelize_work.h"
#include "write/volume.h"
#include "write/part.h"
#include "write/voxels.h"

/* Where the bricks go; at least one of them, or none to count. */
typedef struct brick_goals {
    const voxels *cells;
    brick_out *file;
    uint64_t *words; /* for the picture */
    int code;        /* of what failed */
} brick_goals;

static int take_brick(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    brick_goals *const g = data;
    if (g->file) {
        g->file->ids = ids;
        g->code = brick_out_put(g->file, at, bits);
    }
    if (g->words)
        bricks_lay(g->cells->grid.size, g->words, at, bits);
    return g->code;
}

/* The tiles of a shard, or all. */
typedef struct tile_job {
    const voxelize_request *r;
    const voxelize_input *in;
    const tile_set *set;
    size_t from, to; /* records */
    size_t from_tile, to_tile;
} tile_job;

static part_header header_of(const tile_job *j)
{
    const voxelize_request *const r = j->r;
    const mesh *const m = j->in->mesh;
    const partition_header *const p = m ? NULL : &j->in->partition->header;
    return (part_header){.shard = r->shard,
                         .shards = r->shards,
                         .whole = {.cells = j->in->cells,
                                   .accuracy = r->test.accuracy,
                                   .axes = r->test.axes ? r->test.axes : TRIBOX_AXES_ALL,
                                   .position_bytes = m ? (m->is_double ? sizeof(double) : sizeof(float)) : p->position_bytes,
                                   .tile = j->set->tile,
                                   .has_ids = r->result.options.has_ids,
                                   .triangles = m ? m->triangles : p->triangles,
                                   .sums = m ? mesh_sums_of(m) : p->sums},
                         .from = j->from_tile,
                         .to = j->to_tile};
}

/* The surface alone. */
static tribox_status run_surface(const tile_job *j, const tile_sink *sink, voxelize_answer *a)
{
    progress bar = progress_start_of("voxelizing", "tiles", (double)(j->to - j->from));
    tile_found found;
    const tribox_status status = tile_crew_run(j->set, j->from, j->to, j->r->threads, sink, &bar, &found);
    progress_end(&bar);
    a->report = found.report;
    a->has_bricks = true;
    a->bricks = found.bricks;
    return status;
}

/* A brick of a filled grid. */
static int take_filled(void *data, const uint32_t at[3], const uint64_t bits[8], const uint64_t inside[8])
{
    brick_goals *const g = data;
    if (g->file)
        g->file->inside = inside;
    return take_brick(data, at, bits, NULL);
}

/* With its inside. Parity asks for the mesh, of which a partition has what is in the grid. */
static tribox_status run_filled(const tile_job *j, const filled_sink *sink, voxelize_answer *a)
{
    progress bar = progress_start("filling");
    tribox_box bounds = {{0, 0, 0}, {0, 0, 0}};
    const bool is_parity = j->r->fill != FILL_OUTSIDE && mesh_bounds(j->in->mesh, &bounds);
    const double along[2] = {bounds.lo[0], bounds.hi[0]};
    beam_found found;
    const tribox_status status = fill_tiles(j->set, is_parity ? along : NULL, j->r->cells, j->r->threads, sink, &bar, &found);
    progress_end(&bar);
    a->report = found.report;
    a->has_bricks = true;
    a->bricks = found.bricks;
    a->inside = found.inside;
    if (!status)
        voxelize_note_rows(found.odd_rows, a);
    return status;
}

static int run_crew(const tile_job *j, brick_goals *goals, voxelize_answer *a)
{
    const bool has_goal = goals->file || goals->words;
    const tile_sink sink = {take_brick, goals};
    const filled_sink filled = {take_filled, goals};
    const tribox_status status =
        j->r->fill == FILL_NONE ? run_surface(j, has_goal ? &sink : NULL, a) : run_filled(j, has_goal ? &filled : NULL, a);
    if (goals->code)
        return goals->code;
    if (status == TRIBOX_BAD_VERTEX && j->in->partition)
        return partition_refuse_triangles(j->in->partition->pieces, j->in->partition->count);
    return message_status(status);
}

static int run_to_file(const tile_job *j, voxelize_files *files, brick_goals *goals, voxelize_answer *a)
{
    brick_out out;
    part_header header;
    int code = brick_out_open(&out, j->r->result.format, &j->r->result.options, &files->out, &j->in->cells);
    if (code)
        return code;
    if (j->r->has_shard) {
        header = header_of(j);
        out.part = &header;
    }
    out.threads = j->r->threads;
    goals->file = &out;
    code = run_crew(j, goals, a);
    if (!code) {
        progress bar = progress_start("writing");
        code = brick_out_end(&out, &bar);
        progress_end(&bar);
    }
    brick_out_drop(&out);
    return code ? code : file_out_keep(&files->out);
}

static int run_job(const tile_job *j, voxelize_files *files, voxelize_answer *a)
{
    static const char fewer[] = "choose fewer cells, or write bricks, -o FILE.npz or .vdb";
    const result_request *const result = &j->r->result;
    const voxels *const cells = &j->in->cells;
    uint64_t *words;
    int code = result_take_words(result, &cells->grid, fewer, "choose fewer cells, or leave out the picture", &words);
    if (code)
        return code;
    brick_goals goals = {.cells = cells, .words = words};
    code = j->r->is_count ? run_crew(j, &goals, a) : run_to_file(j, files, &goals, a);
    if (!code)
        code = result_draw(result, cells, words, j->r->threads, &files->picture);
    free(words);
    return code;
}

/* Of a partition the triangles come with the tiles. FILL_MIDDLES asks for no cells of the surface. */
static int make_set(const voxelize_request *r, const voxelize_input *in, tile_set *set)
{
    const tribox_soup nothing = {.count = 0};
    voxel_task task = voxelize_task(r, in);
    task.has_ids = r->result.options.has_ids;
    if (in->partition) {
        *set = tile_set_of_partition(in->partition, &task);
        return EXIT_CODE_OK;
    }
    const voxel_task no_surface = voxel_task_of_soup(&nothing, &task.grid, task.options);
    const int code = tile_set_of_task(r->fill == FILL_MIDDLES ? &no_surface : &task, r->shards > 1, r->threads, set);
    set->task = task;
    return code;
}

int voxelize_by_tiles(const voxelize_request *r, const voxelize_input *in, voxelize_files *files, voxelize_answer *a)
{
    const double start = clock_seconds();
    tile_set set;
    int code = make_set(r, in, &set);
    if (code)
        return code;
    tile_job j = {.r = r, .in = in, .set = &set};
    tile_set_shard(&set, r->shard, r->shards, &j.from, &j.to);
    j.from_tile = tile_set_border(&set, j.from);
    j.to_tile = r->shard == r->shards ? set.tiles : tile_set_border(&set, j.to);
    a->tile = set.tile;
    a->from_tile = j.from_tile;
    a->tiles = j.to_tile - j.from_tile;
    code = run_job(&j, files, a);
    tile_set_free(&set);
    a->seconds = clock_seconds() - start;
    return code;
}
