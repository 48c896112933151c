/* partition_report.c - prints a summary as text or as a JSON object. */
#define _POSIX_C_SOURCE 200809L
#include "partition_report.h"

#include <inttypes.h>
#include <stdio.h>

#include "console/message.h"
#include "console/output.h"
#include "voxelize/voxelize_report.h"

static const char *positions(const partition_header *h) { return h->position_bytes == sizeof(double) ? "float64" : "float32"; }

static void print_summary(const partition_answer *a)
{
    const partition_header *const h = &a->header;
    printf("mesh         %s", a->r->paths[0]);
    if (a->r->count > 1)
        printf(" and %zu more", a->r->count - 1);
    printf("\ntriangles    %" PRIu64 "\npositions    %s\n", h->triangles, positions(h));
    voxelize_print_grid(&a->cells, a->is_shifted);
    printf("tiles        %" PRIu64 " of %u cells along a side, of %zu in the grid\n", h->records, h->tile,
           tribox_tile_count(h->size, h->tile));
    printf("sorted       %" PRIu64 " triangles, %.3f for each of the mesh\n", h->places, (double)h->places / (double)h->triangles);
    if (h->number_bytes)
        puts("ids          the number of each triangle");
    printf("time         %.3f s with %" PRIu32 " thread%s, %.1f ns a triangle\nwritten      %s\n", a->seconds, a->r->threads,
           a->r->threads == 1 ? "" : "s", 1e9 * a->seconds / (double)h->triangles, a->r->out_path);
}

static void print_json(const partition_answer *a)
{
    const partition_header *const h = &a->header;
    json j = json_to(stdout);
    json_open_object(&j, NULL);
    json_string(&j, "mesh", a->r->paths[0]);
    json_whole(&j, "inputs", a->r->count);
    json_whole(&j, "triangles", h->triangles);
    json_string(&j, "positions", positions(h));
    json_whole(&j, "not_finite", h->not_finite);
    voxelize_json_grid(&j, &a->cells, a->is_shifted);
    json_whole(&j, "tile", h->tile);
    json_whole(&j, "tiles", tribox_tile_count(h->size, h->tile));
    json_whole(&j, "filled_tiles", h->records);
    json_whole(&j, "sorted", h->places);
    if (h->number_bytes)
        json_bool(&j, "ids", true);
    json_whole(&j, "spilled_bytes", a->spilled);
    json_whole(&j, "threads", a->r->threads);
    json_number(&j, "seconds", 6, a->seconds);
    json_string(&j, "output", a->r->out_path);
    json_close(&j);
}

int partition_report(const partition_answer *a)
{
    if (a->r->is_quiet)
        return EXIT_CODE_OK;
    if (a->r->wants_json)
        print_json(a);
    else
        print_summary(a);
    return output_flush();
}
