/* voxelize_report.c - prints the summary of a voxelization. */
#include "voxelize_report.h"

#include <stdio.h>

#include "console/options.h"
#include "console/output.h"

static double cells_of(const voxelize_answer *a) { return (double)a->grid.size[0] * a->grid.size[1] * a->layers; }

static double share_percent(const voxelize_answer *a) { return a->layers ? 100 * (double)a->report.overlapping / cells_of(a) : 0; }

static double ns_per_triangle(const voxelize_answer *a) { return 1e9 * a->seconds / (double)a->triangles; }

void voxelize_print_grid(const tribox_grid *grid)
{
    printf("grid         %u x %u x %u cells of ", grid->size[0], grid->size[1], grid->size[2]);
    output_point(grid->cell, " x ");
    printf(", from ");
    output_point(grid->origin, ",");
    putchar('\n');
}

void voxelize_print_json_grid(const tribox_grid *grid)
{
    printf("\"grid\": {\"origin\": [");
    output_point(grid->origin, ", ");
    printf("], \"cell\": [");
    output_point(grid->cell, ", ");
    printf("], \"size\": [%u, %u, %u]}", grid->size[0], grid->size[1], grid->size[2]);
}

static void print_summary(const voxelize_answer *a)
{
    printf("mesh         %s\n", a->mesh_path);
    printf("triangles    %zu\n", a->triangles);
    voxelize_print_grid(&a->grid);
    if (a->shard)
        printf("shard        %u of %u: %u layers from %u\n", a->shard, a->shards, a->layers, a->first);
    printf("occupied     %zu cells (%.4g %%)\n", a->report.overlapping, share_percent(a));
    printf("undecided    %zu\n", a->report.undecided);
    printf("test         %s, axes ", options_accuracy_word(a->test.accuracy));
    output_axes(a->test.axes, "", ",");
    printf(", kernel %s, %u thread%s\n", tribox_kernel_name(&a->test), a->threads, a->threads == 1 ? "" : "s");
    printf("time         %.3f ms, %.2f ns per triangle (the voxelization alone)\n", 1e3 * a->seconds, ns_per_triangle(a));
    printf("written      %s\n", a->out_path);
    if (a->preview_path)
        printf("preview      %s\n", a->preview_path);
}

static void print_json(const voxelize_answer *a)
{
    printf("{\"mesh\": ");
    output_json_string(a->mesh_path);
    printf(", \"triangles\": %zu, \"not_finite\": %zu, ", a->triangles, a->not_finite);
    voxelize_print_json_grid(&a->grid);
    if (a->shard)
        printf(", \"shard\": %u, \"shards\": %u", a->shard, a->shards);
    printf(", \"first_layer\": %u, \"layers\": %u, \"occupied\": %zu, \"share_percent\": %.6g, \"undecided\": %zu, \"accuracy\": "
           "\"%s\", \"axes\": [",
           a->first, a->layers, a->report.overlapping, share_percent(a), a->report.undecided,
           options_accuracy_word(a->test.accuracy));
    output_axes(a->test.axes, "\"", ", ");
    printf("], \"kernel\": \"%s\", \"threads\": %u, \"seconds\": %.6g, \"ns_per_triangle\": %.6g, \"output\": ",
           tribox_kernel_name(&a->test), a->threads, a->seconds, ns_per_triangle(a));
    output_json_string(a->out_path);
    if (a->preview_path) {
        printf(", \"preview\": ");
        output_json_string(a->preview_path);
    }
    puts("}");
}

int voxelize_report(const voxelize_answer *a, bool wants_json)
{
    if (wants_json)
        print_json(a);
    else
        print_summary(a);
    return output_flush();
}
