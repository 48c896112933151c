/* index_goals.c - what the index set out to reach, and whether this run did. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/goal.h"
#include "index_results.h"

/* Goals for means are about these; the terrain has its own. */
static const char *const counted[] = {"dragon_vrip.ply", "buildings.ply", "SainteHelens.ply"};
enum { COUNTED = sizeof counted / sizeof counted[0] };

static const double list_times_linear[BOX_SIZES] = {200, 60, 12, 5};
static const double list_times_linear_terrain[BOX_SIZES] = {5000, 1000, 80, 12};
static const size_t terrain_least = 9000000, memory_least = 100000;

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

static void tell_lists(const scene_result *results, size_t count, tell_goal *tell, void *to)
{
    char what[96];
    const scene_result *const terrain = find(results, count, "terrain");
    for (int p = 0; p < BOX_SIZES; p++) {
        double logarithm = 0;
        int found = 0;
        for (int k = 0; k < COUNTED; k++) {
            const scene_result *const r = find(results, count, counted[k]);
            logarithm += r ? log(list_ratio(r, ORDER_CUTS, p)) : 0;
            found += r != NULL;
        }
        snprintf(what, sizeof what, "list, cuts, boxes of %.1f %%: times linear, mean of %d", 100 * box_part[p], found);
        if (found)
            tell(to, &(goal){what, false, list_times_linear[p], exp(logarithm / found)});
        snprintf(what, sizeof what, "list, cuts, boxes of %.1f %%: times linear, terrain", 100 * box_part[p]);
        if (terrain && terrain->triangles >= terrain_least)
            tell(to, &(goal){what, false, list_times_linear_terrain[p], list_ratio(terrain, ORDER_CUTS, p)});
    }
}

/* The worst of all soups. */
static void tell_worst(const scene_result *results, size_t count, tell_goal *tell, void *to)
{
    double file = 0, build = 0, memory = 0;
    for (size_t r = 0; r < count; r++) {
        for (int p = 0; p < BOX_SIZES; p++)
            file = fmax(file, 1 / list_ratio(&results[r], ORDER_FILE, p));
        build = fmax(build, results[r].order[ORDER_CUTS].cost.build / results[r].reading);
        memory = fmax(memory, results[r].triangles >= memory_least ? 100 * results[r].memory : 0);
    }
    tell(to, &(goal){"list, in the order of the file: linear's time, the worst", true, 1.15, file});
    tell(to, &(goal){"build: times reading, the worst", true, 1.5, build});
    if (memory > 0)
        tell(to, &(goal){"memory: percent of the streams, the worst", true, 1.2, memory});
}

static void tell_all(const scene_result *results, size_t count, tell_goal *tell, void *to)
{
    const scene_result *const dragon = find(results, count, counted[0]);
    tell_lists(results, count, tell, to);
    tell_worst(results, count, tell, to);
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
