/* index_goals.c - what the index set out to reach, and whether this run did. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/goal.h"
#include "index_results.h"

static const double list_times_linear[BOX_SIZES] = {200, 60, 12, 5};
static const double list_times_linear_terrain[BOX_SIZES] = {5000, 1000, 80, 12};
static const size_t terrain_least = 9000000, large_least = 100000;

typedef void tell_goal(void *to, const goal *g);

static const scene_result *find(const scene_result *results, size_t count, const char *name)
{
    for (size_t r = 0; r < count; r++)
        if (!strcmp(results[r].name, name))
            return &results[r];
    return NULL;
}

static double list_ratio(const scene_result *r, soup_order order, int size)
{
    return r->order[order].size[size].us[FORM_LINEAR] / r->order[order].size[size].us[FORM_LIST];
}

/* The geometric mean over the meshes that goals are about; the terrain has its own. */
static double mean_ratio(const scene_result *results, size_t count, int size, int *found)
{
    double logarithm = 0;
    *found = 0;
    for (size_t r = 0; r < count; r++)
        if (index_scene_has_goals(results[r].name)) {
            logarithm += log(list_ratio(&results[r], ORDER_CUTS, size));
            ++*found;
        }
    return exp(logarithm / *found);
}

static void tell_lists(const scene_result *results, size_t count, tell_goal *tell, void *to)
{
    char what[96];
    int found;
    const scene_result *const terrain = find(results, count, "terrain");
    for (int p = 0; p < BOX_SIZES; p++) {
        const double mean = mean_ratio(results, count, p, &found);
        snprintf(what, sizeof what, "list, cuts, boxes of %.1f %%: times linear, mean of %d", 100 * box_part[p], found);
        if (found)
            tell(to, &(goal){what, false, list_times_linear[p], mean});
        snprintf(what, sizeof what, "list, cuts, boxes of %.1f %%: times linear, terrain", 100 * box_part[p]);
        if (terrain && terrain->triangles >= terrain_least)
            tell(to, &(goal){what, false, list_times_linear_terrain[p], list_ratio(terrain, ORDER_CUTS, p)});
    }
}

/* How many times as long as by the soup, the worst of the meshes that goals are about. */
static void tell_meshes(const scene_result *results, size_t count, tell_goal *tell, void *to)
{
    double doubles = 0, boxes = 0;
    for (size_t r = 0; r < count; r++)
        for (int p = 0; index_scene_has_goals(results[r].name) && p < BOX_SIZES; p++) {
            const double *const us = results[r].mesh[p];
            doubles = fmax(doubles, us[LIST_OF_MESH_IN_DOUBLE] / us[LIST_OF_SOUP]);
            boxes = fmax(boxes, us[LIST_OF_WIDE_BOXES] / us[LIST_OF_SOUP]);
        }
    if (boxes > 0) {
        tell(to, &(goal){"list, mesh of doubles: the ordered soup's time, the worst", true, 2.5, doubles});
        tell(to, &(goal){"list, boxes of doubles: that of boxes of floats, the worst", true, 1.1, boxes});
    }
}

/* The worst of all soups; and of those that are larger than a cache. */
static void tell_worst(const scene_result *results, size_t count, tell_goal *tell, void *to)
{
    double file = 0, build = 0, large_build = 0, large_memory = 0;
    for (size_t r = 0; r < count; r++) {
        const double times = results[r].order[ORDER_CUTS].cost.build / results[r].reading;
        for (int p = 0; p < BOX_SIZES; p++)
            file = fmax(file, 1 / list_ratio(&results[r], ORDER_FILE, p));
        build = fmax(build, times);
        if (results[r].triangles >= large_least) {
            large_build = fmax(large_build, times);
            large_memory = fmax(large_memory, 100 * results[r].memory);
        }
    }
    tell(to, &(goal){"list, in the order of the file: linear's time, the worst", true, 1.15, file});
    tell(to, &(goal){"build: times reading, the worst", true, 1.5, build});
    if (large_memory > 0) {
        tell(to, &(goal){"build: times reading, the worst from 100,000 triangles on", true, 1.5, large_build});
        tell(to, &(goal){"memory: percent of the streams, the worst from 100,000 on", true, 1.2, large_memory});
    }
}

static void tell_all(const scene_result *results, size_t count, tell_goal *tell, void *to)
{
    const scene_result *const dragon = find(results, count, "dragon_vrip.ply");
    tell_lists(results, count, tell, to);
    tell_worst(results, count, tell, to);
    tell_meshes(results, count, tell, to);
    if (dragon)
        tell(to, &(goal){"order by cuts: ns a triangle, dragon", true, 80, dragon->order[ORDER_CUTS].cost.order});
}

static void tell_text(void *to, const goal *g)
{
    (void)to;
    goal_print(g);
}

static void tell_json(void *to, const goal *g)
{
    json *const j = to;
    json_open_object(j, NULL);
    json_string(j, "what", g->what);
    json_number(j, g->is_most ? "at_most" : "at_least", 6, g->goal);
    json_number(j, "reached", 6, g->reached);
    json_close(j);
}

void index_print_goals(const scene_result *results, size_t count)
{
    printf("\ngoals\n");
    tell_all(results, count, tell_text, NULL);
}

void index_json_goals(json *to, const scene_result *results, size_t count)
{
    json_open_rows(to, "goals");
    tell_all(results, count, tell_json, to);
    json_close(to);
}
