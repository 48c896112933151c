/* index_results.h - what was measured of an index, and how it is printed. */
#ifndef BENCH_INDEX_RESULTS_H
#define BENCH_INDEX_RESULTS_H

#include "console/json.h"
#include "index_forms.h"
#include "mesh_lists.h"

enum { BOX_SIZES = 4, MANY_SIZES = 2 };

/* Edges of the boxes, as parts of the greatest extent. */
extern const double box_part[BOX_SIZES];

/* Boxes of one size, asked of a soup in one order: means of a box. */
typedef struct size_result {
    double hits, nodes, asked, inside;
    double us[FORMS];   /* least times */
    double cold[FORMS]; /* the same with caches that held other things before; of cuts alone, elsewhere 0 */
} size_result;

typedef struct order_result {
    const char *name;
    order_cost cost;
    size_result size[BOX_SIZES];
} order_result;

/* Nanoseconds of a box, where many are asked by one call. */
typedef struct many_result {
    size_t boxes;
    double as_drawn, in_order, ordering;
} many_result;

typedef struct scene_result {
    char name[64];
    size_t triangles;
    double memory;  /* of the index, as a part of the streams */
    double reading; /* nanoseconds of a triangle */
    order_result order[ORDERS];
    double turned[BOX_SIZES], turned_linear[BOX_SIZES]; /* microseconds of a list of cuts, and of tribox_overlap_oriented */
    many_result many[MANY_SIZES];
    double mesh[BOX_SIZES][MESH_LISTS]; /* microseconds of a list */
    double mesh_build[2];               /* nanoseconds of a triangle, of floats and doubles */
} scene_result;

void index_print_scene(const scene_result *r);
void index_print_json(json *to, const scene_result *r);

/* Geometric means over the soups that count, and each goal against what was reached. */
void index_print_goals(const scene_result *results, size_t count);
void index_json_goals(json *to, const scene_result *results, size_t count);

#endif
