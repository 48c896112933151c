/* voxelize_report.h - what tribox voxelize found, for people and as JSON. */
#ifndef VOXELIZE_REPORT_H
#define VOXELIZE_REPORT_H

#include <stdbool.h>

#include "console/json.h"
#include "fill/fill_kinds.h"
#include "tribox.h"
#include "write/voxels.h"

typedef struct voxelize_answer {
    const char *mesh_path, *out_path, *preview_path; /* the last two: NULL for none */
    const char *up;                                  /* of the preview: which axis, and why */
    size_t triangles, not_finite;
    bool is_double; /* the mesh has coordinates that float does not hold */
    bool is_shifted;
    bool lacks_place; /* the format of the file has none for origin and cell */
    voxels cells;     /* the grid and the shift alone */
    uint32_t tile;    /* cells along a side of the tiles; 0: in one piece */
    bool has_bricks;  /* they were counted */
    uint64_t bricks;
    uint32_t shard, shards;  /* shard 0: the whole */
    size_t from_tile, tiles; /* of a shard */
    bool is_thin;            /* the surface */
    bool has_ids;
    const char *colours;     /* whose they are; NULL for none */
    const char *fill;        /* the word of --fill; NULL for none */
    size_t inside, odd_rows; /* of a fill */
    bool has_rows;           /* odd_rows were counted */
    fill_cells filled;       /* which cells of it the file has */
    bool has_no_surface;     /* the fill is of the inside alone, and counted no cells of the surface */
    tribox_options test;
    tribox_report report;
    unsigned threads;
    double seconds;
} voxelize_answer;

/* Prints the answer and flushes the output. Returns an exit_code. */
int voxelize_report(const voxelize_answer *a, bool wants_json);

/* Grid and, where there is one, shift: as lines of a summary, and as members of a JSON object. The files: as lines. */
void voxelize_print_grid(const voxels *v, bool is_shifted);
void voxelize_print_written(const char *path, bool lacks_place);
void voxelize_print_preview(const char *path, const char *up);
void voxelize_json_grid(json *j, const voxels *v, bool is_shifted);

#endif
