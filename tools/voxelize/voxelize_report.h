/* voxelize_report.h - what tribox voxelize found, for people and as JSON. */
#ifndef VOXELIZE_REPORT_H
#define VOXELIZE_REPORT_H

#include <stdbool.h>

#include "console/json.h"
#include "tribox.h"

typedef struct voxelize_answer {
    const char *mesh_path, *out_path, *preview_path; /* preview_path: NULL for none */
    size_t triangles, not_finite;
    size_t rounded; /* vertices that rounding to float has moved */
    double moved;   /* the most that it has moved a coordinate */
    tribox_grid grid;
    uint32_t first, layers;
    uint32_t shard, shards; /* shard 0: the whole */
    tribox_options test;
    tribox_report report;
    unsigned threads;
    double seconds;
} voxelize_answer;

/* Prints the answer and flushes the output. Returns an exit_code. */
int voxelize_report(const voxelize_answer *a, bool wants_json);

/* The grid as lines of a summary, and as a member of a JSON object. */
void voxelize_print_grid(const tribox_grid *grid);
void voxelize_json_grid(json *j, const tribox_grid *grid);

#endif
