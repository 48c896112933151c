/* peers_report.c - tables of an index and its peers. */
#include "peers_report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/goal.h"

const double peer_part[PEER_SIZES] = {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 0.5};

/* Goals are about four of the sizes. */
enum { GOAL_SIZES = 4 };
static const int goal_size[GOAL_SIZES] = {0, 2, 4, 6};

static const struct peer_goal {
    const char *name;
    double times[GOAL_SIZES];
} goals[] = {{"CGAL", {15, 40, 150, 300}}, {"Embree", {4, 6, 15, 25}}, {"Embree+", {4, 6, 15, 25}}, {"linear", {200, 60, 12, 5}}};

static const double any_times = 4;

/* Whom an entrant is compared with: list and linear with list, any with any. */
static double times_own(const peers_result *r, int size, size_t e)
{
    return r->us[size][e] / r->us[size][r->entrants[e].is_any ? ENTRANT_ANY : ENTRANT_LIST];
}

void peers_print_head(const field *f, const peers_result *r)
{
    const order_cost *const cost = &f->soup.cost;
    printf("\n%s: %zu triangles; seconds to build: index %.3f", r->name, r->triangles,
           1e-9 * (double)r->triangles * (cost->order + cost->gather + cost->build));
    for (size_t p = 0; p < f->peer_count; p++)
        if (f->peers[p].tree)
            printf(", %s %.2f", f->peers[p].peer->name, f->peers[p].seconds);
        else
            printf(", %s holds fewer triangles", f->peers[p].peer->name);
    printf("\n%7s %9s", "box", "hits");
    for (size_t e = 0; e < r->entrant_count; e++)
        printf(e < ENTRANTS_OF_INDEX - 1 ? " %10s" : " %10s  times ", r->entrants[e].name);
    printf("\n");
}

void peers_print_row(const peers_result *r, int size, double hits)
{
    printf("%5.1f %% %9.1f", 100 * peer_part[size], hits);
    for (size_t e = 0; e < r->entrant_count; e++)
        if (e < ENTRANTS_OF_INDEX - 1)
            printf(" %10.2f", r->us[size][e]);
        else if (isnan(r->us[size][e]))
            printf(" %10s %7s", "-", "-");
        else
            printf(" %10.2f %7.1f", r->us[size][e], times_own(r, size, e));
    printf("\n");
    fflush(stdout);
}

void peers_print_errors(const field *f, size_t boxes, size_t hits, const peer_errors errors[PEERS_MAX])
{
    printf("answers about %zu boxes, %zu hits:", boxes, hits);
    for (size_t p = 0; p < f->peer_count; p++) {
        if (!f->peers[p].tree)
            continue;
        printf("%s %s missing %zu, extra %zu", p ? ";" : "", f->peers[p].peer->name, errors[p].missing, errors[p].extra);
        if (errors[p].missing + errors[p].extra)
            printf(" (%zu of them within rounding of contact)", errors[p].near);
        if (errors[p].candidates && hits)
            printf(", %.2f candidates a hit", (double)errors[p].candidates / (double)hits);
    }
    printf("\n");
    fflush(stdout);
}

static size_t entrant_called(const peers_result *r, const char *name, bool is_any)
{
    size_t e = 0;
    for (; e < r->entrant_count; e++)
        if (!strncmp(r->entrants[e].name, name, strlen(name)) && r->entrants[e].is_any == is_any)
            break;
    return e;
}

/* The geometric mean over the meshes that count; NaN where there are none. */
static double mean_times(const peers_result *results, size_t count, const char *name, int size)
{
    double logarithm = 0;
    size_t found = 0;
    for (size_t r = 0; r < count; r++) {
        const size_t e = entrant_called(&results[r], name, false);
        if (!index_scene_has_goals(results[r].name) || e == results[r].entrant_count)
            continue;
        logarithm += log(times_own(&results[r], size, e));
        found++;
    }
    return found ? exp(logarithm / (double)found) : (double)NAN;
}

static void print_any(const peers_result *r)
{
    const size_t e = entrant_called(r, "CGAL", true);
    char what[96];
    double logarithm = 0, least = INFINITY;
    if (e == r->entrant_count)
        return;
    for (int size = 0; size < PEER_SIZES; size++) {
        logarithm += log(times_own(r, size, e)) / PEER_SIZES;
        least = fmin(least, times_own(r, size, e));
    }
    snprintf(what, sizeof what, "any: times CGAL, mean of all sizes, %s", r->name);
    goal_print(&(goal){what, false, any_times, exp(logarithm)});
    snprintf(what, sizeof what, "any: times CGAL, the least of all sizes, %s", r->name);
    goal_print(&(goal){what, false, any_times, least});
}

void peers_print_goals(const peers_result *results, size_t count)
{
    char what[96];
    printf("\ngoals\n");
    for (size_t g = 0; g < sizeof goals / sizeof goals[0]; g++)
        for (int k = 0; k < GOAL_SIZES; k++) {
            const double mean = mean_times(results, count, goals[g].name, goal_size[k]);
            snprintf(what, sizeof what, "list: times %s, boxes of %.1f %%, mean of meshes", goals[g].name,
                     100 * peer_part[goal_size[k]]);
            if (!isnan(mean))
                goal_print(&(goal){what, false, goals[g].times[k], mean});
        }
    for (size_t r = 0; r < count; r++)
        print_any(&results[r]);
}

void peers_csv_head(FILE *to) { fprintf(to, "scene,triangles,part,contestant,us\n"); }

void peers_csv(FILE *to, const peers_result *r)
{
    for (int size = 0; size < PEER_SIZES; size++)
        for (size_t e = 0; e < r->entrant_count; e++)
            if (!isnan(r->us[size][e]))
                fprintf(to, "%s,%zu,%g,%s,%.4f\n", r->name, r->triangles, peer_part[size], r->entrants[e].name, r->us[size][e]);
}
