/* calls.h - every public function, a row each, with arguments that are right until a test spoils one. */
#ifndef TRIBOX_TESTS_CALLS_H
#define TRIBOX_TESTS_CALLS_H

#include <stdbool.h>
#include <string.h>

#include "tribox_threads.h"

enum {
    COUNT = 100, /* triangles, and boxes */
    SIDE = 9,
    TILE = 8,
    TILES = 8,
    ROWS = SIDE * SIDE,
    CELLS = SIDE * ROWS,
    KEYS = 16 * COUNT, /* scratch of an order */
    NODES = 1600,
    FIRST_BYTES = 19 << 14, /* of the largest scratch */
    RUNS = 1024            /* 64-bit words of tribox_fill_labels */
};

/*
 * All that is written. Of no triangles nothing is that stands before the report. To be compared: COMPARED bytes, as what stands
 * after the keys of an order in scratch means nothing.
 */
typedef struct outputs {
    uint64_t mask[2], inside[2], bits[2], occupied[ROWS];
    uint32_t list[COUNT], order[COUNT], ids[CELLS], listed[TILES * COUNT];
    float stream[9][COUNT];
    tribox_report report;
    uint64_t solid[ROWS];
    size_t found, odd_rows, start[CELLS + 1], value, bricks; /* bricks: handed to the sink */
    const char *text;
    tribox_box cell;
    uint32_t face[6][ROWS], labels;
    unsigned char nodes[NODES];
    uint8_t children[COUNT];
    size_t places[TILES + 1];          /* as a first pass left them, */
    uint32_t parents[2 * ROWS];        /* each its own, */
    uint64_t runs[RUNS];               /* as tribox_fill_labels left them, */
    uint64_t scratch[FIRST_BYTES / 8]; /* as tribox_soup_sort_start left it: calls that continue others find them so */
} outputs;
#define COMPARED (offsetof(outputs, scratch) + KEYS)

/* By words: an emulated s390x looks at each byte that memcmp does, twenty times as long. */
static inline bool outputs_differ(const outputs *some, const outputs *others, size_t bytes)
{
    for (size_t at = 0; at < bytes; at += sizeof(uint64_t)) {
        uint64_t one, other;
        memcpy(&one, (const char *)some + at, sizeof one);
        memcpy(&other, (const char *)others + at, sizeof other);
        if (one != other)
            return true;
    }
    return false;
}

/* What is asked: things, and pointers to them as they are passed. A test may spoil either. */
typedef struct asked {
    float number[9][COUNT], floats[COUNT][3][3];
    double corner[COUNT][3][3];
    uint32_t index[3 * COUNT], orders[COUNT], numbers[TILES * COUNT], labels[2][ROWS];
    uint64_t cells[ROWS], bits[2], joined[8];
    size_t tile_starts[TILES + 1];
    unsigned char built[2][NODES]; /* nodes over the soup and the mesh */
    tribox_soup the_soup;
    tribox_mesh the_mesh;
    tribox_box the_box;
    tribox_oriented_box the_oriented;
    tribox_boxes the_boxes;
    float the_triangle[9];
    tribox_index the_soup_index, the_mesh_index;
    tribox_region the_region, the_turned;
    tribox_options the_options;
    tribox_grid the_grid;
    tribox_window the_window;
    tribox_tiles the_tiles;
    tribox_sink the_sink;
    tribox_ids_sink the_ids_sink;
    tribox_lists_sink the_lists_sink;
    size_t first, count, total, room;
    uint32_t first_id;
    tribox_find_what what;
    double the_origin[3], the_middle[3];

    const tribox_soup *soup;
    const tribox_mesh *mesh;
    const tribox_box *box;
    const tribox_oriented_box *oriented;
    const tribox_boxes *boxes;
    const float *triangle;
    const tribox_index *soup_index, *mesh_index;
    const tribox_region *region, *turned;
    const tribox_options *options;
    const tribox_grid *grid;
    const tribox_window *window;
    const tribox_tiles *tiles;
    const tribox_sink *sink;
    const tribox_ids_sink *ids_sink;
    const tribox_lists_sink *lists_sink;
    const uint32_t *size, *order_in, *list_in, *side_a, *side_b;
    const uint64_t *surface, *mask_in, *outside;
    const size_t *starts_in;
    const double *origin, *middle;

    outputs *out; /* where the pointers below point to, and values are put */
    float *to[9], *const *x, *const *y, *const *z;
    uint64_t *mask, *inside, *bits_out, *occupied, *solid;
    tribox_report *report;
    size_t *found, *start, *odd_rows, *places;
    uint32_t *list, *order, *ids, *listed, *label_count, *parents, *face[6], *const *faces;
    uint8_t *children;
    void *nodes, *scratch, *runs;
} asked;

typedef struct call {
    const char *function, *about;
    const char *takes; /* words, with a blank before and after each: a fault of "soup" is one of calls that take it */
    tribox_status (*ask)(const asked *a);
} call;

extern const call calls[];
extern const size_t call_count;

/* Any of some words. One may be two, joined by &: then both. */
bool call_takes(const call *c, const char *words);

/* Right arguments: COUNT triangles through all of a grid, about an origin, as a soup and as a mesh of floats or doubles. */
void ask_rightly(unsigned position_bytes, asked *a, outputs *to);

/* What follows from other numbers: the mesh of floats, lists and indices. */
void ask_follow(asked *a);

/* To other outputs, which say of themselves what they hold before a call: `byte`, but what calls continue. */
void ask_into(asked *a, outputs *to);
void outputs_prepare(const asked *a, int byte, outputs *to);

#endif
