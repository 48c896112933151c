/* voxelize_report.c - prints the summary of a voxelization. */
#include "result_options.h"

#include <inttypes.h>
#include <stdio.h>

#include "console/written_number.h"
#include "console/output.h"
#include "voxelize_work.h"

static const char *const fill_words[] = {[FILL_OUTSIDE] = "outside", [FILL_PARITY] = "parity", [FILL_MIDDLES] = "middles"};

static double cells_of(const voxelize_answer *a)
{
    return (double)a->cells.grid.size[0] * a->cells.grid.size[1] * a->cells.grid.size[2];
}

static double share_percent(const voxelize_answer *a) { return 100 * (double)a->report.overlapping / cells_of(a); }

static double ns_per_triangle(const voxelize_answer *a) { return 1e9 * a->seconds / (double)a->triangles; }

/* The rate is left out for so few that starting the threads takes most of the time. */
static void print_time(const voxelize_answer *a)
{
    const voxelize_request *const r = a->r;
    enum { FEW = 1000 };
    char text[DURATION_MAX];
    printf("time         %s", duration_text(a->seconds, text));
    if (a->report.overlapping >= FEW)
        printf(", %s cells a second", duration_count((double)a->report.overlapping / a->seconds, text));
    printf(!a->tile ? " (the voxelization alone)\n" : r->result.out_path ? " (with writing)\n" : "\n");
}

void voxelize_print_grid(const voxels *v, bool is_shifted)
{
    const tribox_grid *const grid = &v->grid;
    printf("grid         %u x %u x %u cells of ", grid->size[0], grid->size[1], grid->size[2]);
    if (grid->cell[0] == grid->cell[1] && grid->cell[1] == grid->cell[2])
        printf("%.6g", grid->cell[0]);
    else
        printf("%.6g x %.6g x %.6g", grid->cell[0], grid->cell[1], grid->cell[2]);
    printf(", from %.6g,%.6g,%.6g\n", grid->origin[0], grid->origin[1], grid->origin[2]);
    if (is_shifted)
        output_shift(v->shift);
}

void voxelize_json_grid(json *j, const voxels *v, bool is_shifted)
{
    const tribox_grid *const grid = &v->grid;
    json_open_object(j, "grid");
    json_doubles(j, "origin", grid->origin, 3, false);
    json_doubles(j, "cell", grid->cell, 3, false);
    json_wholes(j, "size", (const size_t[3]){grid->size[0], grid->size[1], grid->size[2]}, 3);
    json_close(j);
    if (is_shifted)
        json_doubles(j, "shift", v->shift, 3, false);
}

static const char *up_text(const result_request *r)
{
    switch (r->up_source) {
    case RESULT_UP_GIVEN:
        return preview_up_word(r->look.up);
    case RESULT_UP_OF_GLTF:
        return "y, as glTF has it; --up tells otherwise";
    default:
        return "z; where the mesh has another, --up tells, as in --up y";
    }
}

void result_print(const result_request *r)
{
    if (r->out_path)
        printf("written      %s\n", r->out_path);
    if (r->out_path && !volume_holds(r->format, "place"))
        printf("place        not in the file: keep origin and cell, which --json prints with all digits\n");
    if (r->preview_path)
        printf("preview      %s\nup           %s\n", r->preview_path, up_text(r));
}

void result_json(json *j, const result_request *r)
{
    if (r->out_path)
        json_string(j, "output", r->out_path);
    if (r->preview_path)
        json_string(j, "preview", r->preview_path);
}

/* Which cells of a fill the file has. */
static const char *cells_word(const voxelize_answer *a)
{
    const voxelize_request *const r = a->r;
    static const char *const words[] = {[FILL_CELLS_ALL] = "all", [FILL_CELLS_LABELLED] = "labels", [FILL_CELLS_INSIDE] = "inside"};
    return words[r->fill == FILL_MIDDLES ? FILL_CELLS_INSIDE : r->cells];
}

/* Nothing inside is mostly no closed surface, of which parity says as much by its odd rows. */
static const char *cells_note(const voxelize_answer *a)
{
    const voxelize_request *const r = a->r;
    if (!a->inside && !(r->fill == FILL_PARITY || r->fill == FILL_MIDDLES))
        return "; the surface is open by a cell or more, or encloses none";
    static const char *const notes[] = {
        [FILL_CELLS_ALL] = "", [FILL_CELLS_LABELLED] = "; label 2, the surface 1", [FILL_CELLS_INSIDE] = "; alone in the file"};
    return notes[r->cells];
}

static void print_summary(const voxelize_answer *a)
{
    const voxelize_request *const r = a->r;
    printf("mesh         %s\n", r->from.mesh_path);
    printf("triangles    %zu\n", a->triangles);
    printf("positions    %s\n", a->is_double ? "float64" : "float32");
    voxelize_print_grid(&a->cells, a->is_shifted);
    if (r->has_shard)
        printf("shard        %u of %u: %zu tiles from %zu\n", r->shard, r->shards, a->tiles, a->from_tile);
    if (r->fill != FILL_MIDDLES)
        printf("occupied     %zu cells (%.4g %%)%s\n", a->report.overlapping, share_percent(a), r->is_thin ? ", thin" : "");
    if (a->colours)
        printf("colours      of its %s\n", a->colours);
    if (r->result.options.has_ids)
        puts("ids          the lowest triangle of each cell");
    if (r->fill != FILL_NONE)
        printf("inside       %zu cells (%s%s)\n", a->inside, fill_words[r->fill], cells_note(a));
    if (r->fill == FILL_PARITY || r->fill == FILL_MIDDLES)
        printf("odd rows     %zu\n", a->odd_rows);
    if (a->has_bricks)
        printf("bricks       %" PRIu64 " of 8 x 8 x 8 cells", a->bricks);
    if (a->tile)
        printf(", tiles of %u", a->tile);
    if (a->has_bricks)
        putchar('\n');
    output_test(&r->test);
    printf(", %u thread%s\n", r->threads, r->threads == 1 ? "" : "s");
    print_time(a);
    result_print(&r->result);
}

static void print_json(const voxelize_answer *a)
{
    const voxelize_request *const r = a->r;
    json j = json_to(stdout);
    json_open_object(&j, NULL);
    json_string(&j, "mesh", r->from.mesh_path);
    json_whole(&j, "triangles", a->triangles);
    json_string(&j, "positions", a->is_double ? "float64" : "float32");
    json_whole(&j, "not_finite", a->not_finite);
    voxelize_json_grid(&j, &a->cells, a->is_shifted);
    if (r->has_shard) {
        json_whole(&j, "shard", r->shard);
        json_whole(&j, "shards", r->shards);
        json_whole(&j, "first_tile", a->from_tile);
        json_whole(&j, "tiles", a->tiles);
    }
    if (r->fill != FILL_MIDDLES) {
        json_whole(&j, "occupied", a->report.overlapping);
        json_number(&j, "share_percent", 6, share_percent(a));
    }
    if (r->is_thin)
        json_bool(&j, "thin", true);
    if (a->colours)
        json_string(&j, "colours", a->colours);
    if (r->result.options.has_ids)
        json_bool(&j, "ids", true);
    if (r->fill != FILL_NONE) {
        json_string(&j, "fill", fill_words[r->fill]);
        json_whole(&j, "inside", a->inside);
        json_string(&j, "cells", cells_word(a));
    }
    if (r->fill == FILL_PARITY || r->fill == FILL_MIDDLES)
        json_whole(&j, "odd_rows", a->odd_rows);
    if (a->tile)
        json_whole(&j, "tile", a->tile);
    if (a->has_bricks)
        json_whole(&j, "bricks", a->bricks);
    json_whole(&j, "undecided", a->report.undecided);
    output_json_test(&j, &r->test);
    json_whole(&j, "threads", r->threads);
    json_number(&j, "seconds", 6, a->seconds);
    json_number(&j, "total_seconds", 6, a->total_seconds);
    json_number(&j, "ns_per_triangle", 6, ns_per_triangle(a));
    result_json(&j, &r->result);
    json_close(&j);
}

int voxelize_report(const voxelize_answer *a)
{
    if (a->r->result.wants_json)
        print_json(a);
    else
        print_summary(a);
    return output_flush();
}
