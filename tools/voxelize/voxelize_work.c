/* voxelize_work.c - reads a mesh, lays a grid around it, fills it, and writes it. */
#define _POSIX_C_SOURCE 200809L
#include "voxelize_work.h"

#include <stdlib.h>
#include <string.h>

#include "console/clock.h"
#include "layers.h"
#include "console/memory.h"
#include "read/mesh.h"
#include "console/message.h"
#include "write/brick_out.h"
#include "write/part.h"
#include "voxelize_report.h"

/* Refuses what does not fit before any of it is taken. */
static int check_memory(const tribox_grid_f64 *grid, uint64_t bytes, uint64_t preview_bytes)
{
    char needed[16], there[16];
    const uint64_t available = memory_available();
    if (bytes + preview_bytes <= available)
        return EXIT_CODE_OK;
    const uint64_t shards = bytes / (available / 2 + 1) + 2;
    return message_failure(
        "%u x %u x %u cells take %s of memory here and %s are available: choose fewer cells, or voxelize in parts, "
        "--shard 1/%u and so on, and join them with 'tribox merge'",
        grid->size[0], grid->size[1], grid->size[2], memory_text(bytes + preview_bytes, needed), memory_text(available, there),
        (unsigned)(shards < grid->size[2] ? shards : grid->size[2]));
}

static int take_memory(const voxelize_request *r, const tribox_grid_f64 *grid, voxels_slab *slab, uint64_t **bits)
{
    const size_t words = voxels_layer_words(grid) * slab->layers;
    const int code =
        check_memory(grid, (uint64_t)words * sizeof **bits, r->result.preview_path ? preview_memory(grid, &r->result.look) : 0);
    if (code)
        return code;
    *bits = calloc(words ? words : 1, sizeof **bits); /* a shard may have no layers */
    slab->bits = *bits;
    return *bits ? EXIT_CODE_OK : message_failure("out of memory for %zu words of cells", words);
}

static void write_part(const voxelize_request *r, const mesh *m, const voxels *v, FILE *to, progress *bar)
{
    part_header header = {.magic = PART_MAGIC,
                          .byte_order = PART_BYTE_ORDER,
                          .shard = r->shard,
                          .whole = {.shards = r->shards,
                                    .accuracy = r->test.accuracy,
                                    .axes = r->test.axes ? r->test.axes : TRIBOX_AXES_ALL,
                                    .position_bytes = m->is_double ? sizeof(double) : sizeof(float),
                                    .triangles = m->triangles,
                                    .mesh_checksum = part_mesh_checksum(m)}};
    part_set_grid(&header.whole, v);
    part_write(to, &header, v->slab[0].bits, bar);
}

static int write_answer(const voxelize_request *r, const mesh *m, const voxels *v, file_out *out)
{
    progress bar = progress_start("writing", !r->result.is_quiet);
    int code = EXIT_CODE_OK;
    if (r->result.format)
        code = brick_out_voxels(r->result.format, &r->result.options, out, v, &bar);
    else
        write_part(r, m, v, out->stream, &bar);
    progress_end(&bar);
    return code ? code : file_out_keep(out);
}

/* Into a grid of doubles, from doubles or from floats. */
static tribox_status voxelize_doubles(const voxelize_request *r, const mesh *m, const voxels *v, uint64_t *bits, progress *bar,
                                      tribox_report *report)
{
    uint32_t *indices = NULL;
    const tribox_mesh all = m->is_double ? m->doubles : mesh_of_streams(m, &indices);
    const tribox_status status =
        all.positions ? voxelize_mesh_in_threads(&all, &v->grid, v->slab[0].first, v->slab[0].layers, &r->test, r->threads, bits,
                                                 report, bar->is_wanted ? progress_tell : NULL, bar)
                      : TRIBOX_NO_MEMORY;
    free(indices);
    return status;
}

static tribox_status voxelize_floats(const voxelize_request *r, const mesh *m, const voxels *v, uint64_t *bits, progress *bar,
                                     tribox_report *report)
{
    const tribox_grid narrow = voxels_narrow(&v->grid);
    return voxelize_in_threads(&m->soup, &narrow, v->slab[0].first, v->slab[0].layers, &r->test, r->threads, bits, report,
                               bar->is_wanted ? progress_tell : NULL, bar);
}

static int voxelize(const voxelize_request *r, const mesh *m, const voxels *v, uint64_t *bits, voxelize_answer *a)
{
    progress bar = progress_start("voxelizing", !r->result.is_quiet);
    const double start = clock_seconds();
    const tribox_status status = (v->is_float ? voxelize_floats : voxelize_doubles)(r, m, v, bits, &bar, &a->report);
    a->seconds = clock_seconds() - start;
    progress_end(&bar);
    return status ? message_failure("%s", tribox_status_text(status)) : EXIT_CODE_OK;
}

/* From the mesh to the files. */
static int answer_mesh(const voxelize_request *r, const mesh *m, voxelize_answer *a, file_out *out, file_out *picture)
{
    uint64_t *bits = NULL;
    voxels_slab slab;
    voxels v = a->cells;
    v.slab = &slab;
    v.slabs = 1;
    int code = grid_choose(&r->grid, triangle_file_name(r->mesh_path), m, &v.grid, &v.is_float);
    if (!code && r->result.format && r->result.format->check_grid)
        code = r->result.format->check_grid(r->result.out_path, &v.grid);
    if (code)
        return code;
    volume_note_shift(r->result.format, r->result.out_path, &v);
    part_whole whole = {.shards = r->shards};
    part_set_grid(&whole, &v);
    part_layers(&whole, r->shard, &slab.first, &slab.layers);
    a->cells = v;
    a->first = slab.first;
    a->layers = slab.layers;
    code = take_memory(r, &v.grid, &slab, &bits);
    if (!code)
        code = voxelize(r, m, &v, bits, a);
    if (!code)
        code = write_answer(r, m, &v, out);
    if (!code)
        code = preview_draw(picture, &v, &r->result.look, r->threads, !r->result.is_quiet);
    free(bits);
    return code;
}

int voxelize_work(const voxelize_request *r)
{
    mesh m;
    file_out out, picture;
    mesh_shift shift = r->shift;
    voxelize_answer a = {.mesh_path = r->mesh_path,
                         .out_path = r->result.out_path,
                         .preview_path = r->result.preview_path,
                         .test = r->test,
                         .threads = r->threads,
                         .shard = r->is_part ? r->shard : 0,
                         .shards = r->shards};
    int code = mesh_read_shifted(r->mesh_path, r->format, &shift, &m);
    if (code)
        return code;
    mesh_warn(triangle_file_name(r->mesh_path), &m);
    a.triangles = m.triangles;
    a.not_finite = m.not_finite;
    a.is_double = m.is_double;
    a.is_shifted = shift.is_wanted;
    memcpy(a.cells.shift, shift.by, sizeof shift.by);
    code = file_out_open(&out, r->result.out_path);
    if (!code) {
        code = file_out_open(&picture, r->result.preview_path);
        if (!code) {
            code = answer_mesh(r, &m, &a, &out, &picture);
            file_out_drop(&picture);
        }
        file_out_drop(&out);
    }
    mesh_free(&m);
    return code || !r->result.has_summary ? code : voxelize_report(&a, r->result.wants_json);
}
