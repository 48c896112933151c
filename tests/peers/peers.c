/*
 * peers.c - an index over a soup against other libraries that answer the same question: are the answers the same, and who is how
 * fast?
 *
 * Exact peers have to agree on every triangle and box, or the program fails and times nothing more. Those that round are counted.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "peers_field.h"

enum { SKIPPED = 77, PEER_SIZES = 7, RESULTS_MAX = MESH_LIST_MAX + 1 };

/* Edges of the boxes, as parts of the greatest extent. */
static const double peer_part[PEER_SIZES] = {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 0.5};

/* A linear pass has as many boxes as there is time for. */
static const size_t linear_pairs = 100000000, verified_pairs = 5000000;

typedef struct peers_result {
    char name[64];
    size_t entrant_count;
    entrant entrants[FIELD_MAX]; /* by name alone: their peers may be gone */
    double us[PEER_SIZES][FIELD_MAX];
} peers_result;

/* Exact peers may not differ; the index has no excuse, as CGAL and Embree have none. */
static bool are_answers_right(const field *f, const peer_errors unlike[PEERS_MAX])
{
    bool is_right = true;
    for (size_t p = 0; p < f->peer_count; p++)
        if (f->peers[p].tree && (unlike[p].any || (f->peers[p].peer->is_exact && unlike[p].missing + unlike[p].extra))) {
            message_failure("%s: %s answers otherwise: missing %zu, extra %zu%s", f->scene->name, f->peers[p].peer->name,
                            unlike[p].missing, unlike[p].extra, unlike[p].any ? ", and whether there is any" : "");
            is_right = false;
        }
    return is_right;
}

/* Whom an entrant is compared with: list and linear with list, any with any. */
static double times_own(const peers_result *r, int size, size_t e)
{
    return r->us[size][e] / r->us[size][r->entrants[e].is_any ? ENTRANT_ANY : ENTRANT_LIST];
}

static void tell_size(printout *out, const peers_result *r, int size, double hits)
{
    for (size_t e = 0; e < r->entrant_count; e++) {
        ROW(out, TEXT("contestant", r->entrants[e].name), TEXT_DATA("scene", r->name), NUMBER("box_%", 1, 100 * peer_part[size]),
            NUMBER("hits", 1, hits), NUMBER("us", 2, r->us[size][e]), NUMBER("times", 1, times_own(r, size, e)));
    }
}

static bool run_size(asked *q, field *f, int size, tribox_box *boxes, size_t count, peers_result *r, peer_errors unlike[PEERS_MAX])
{
    index_scene_boxes(f->scene, peer_part[size], count, q->seed + (uint64_t)size, boxes);
    if (!field_answer(f, boxes, count, index_scene_boxes_within(f->scene, verified_pairs, count), unlike))
        return false;
    if (!asked_has(q, OPTION_VERIFY)) {
        field_time(f, (size_t)asked_number(q, OPTION_ROUNDS, 9), index_scene_boxes_within(f->scene, linear_pairs, count), &q->order,
                   r->us[size]);
        tell_size(&q->out, r, size, (double)f->start[count] / (double)count);
    }
    return are_answers_right(f, unlike);
}

static void tell_errors(printout *out, const field *f, size_t boxes, size_t hits, const peer_errors unlike[PEERS_MAX])
{
    printout_table(out, "%s: answers about %zu boxes, %zu hits", f->scene->name, boxes, hits);
    for (size_t p = 0; p < f->peer_count; p++) {
        ROW(out, TEXT("peer", f->peers[p].peer->name), DATA("all_hits", (double)hits),
            NUMBER("missing", 0, f->peers[p].tree ? (double)unlike[p].missing : (double)NAN),
            NUMBER("extra", 0, f->peers[p].tree ? (double)unlike[p].extra : (double)NAN),
            NUMBER("within_rounding", 0, (double)unlike[p].near),
            NUMBER("candidates_a_hit", 2, hits ? (double)unlike[p].candidates / (double)hits : (double)NAN),
            NUMBER("seconds_to_build", 3, f->peers[p].seconds));
    }
}

static peers_result all_results[RESULTS_MAX];

static bool run_scene(asked *q, const index_scene *at, size_t number)
{
    peers_result *const r = &all_results[number];
    const size_t count = (size_t)asked_number(q, OPTION_BOXES, asked_has(q, OPTION_VERIFY) ? 5 : 50);
    field f;
    peer_errors unlike[PEERS_MAX] = {{0}};
    size_t hits = 0;
    tribox_box *const boxes = asked_allocate(count, sizeof *boxes);
    bool is_run = field_make(at, count, &f);
    const order_cost *const cost = &f.soup.cost;
    memcpy(r->name, at->name, sizeof r->name);
    r->entrant_count = field_entrants(&f, r->entrants);
    if (is_run && !asked_has(q, OPTION_VERIFY))
        printout_table(&q->out, "%s: %zu triangles; seconds to build the index %.3f", r->name, at->room.soup.count,
                       1e-9 * (double)at->room.soup.count * (cost->order + cost->gather + cost->build));
    for (int size = 0; is_run && size < PEER_SIZES; size++) {
        is_run = run_size(q, &f, size, boxes, count, r, unlike);
        hits += is_run ? f.start[count] : 0;
    }
    if (is_run)
        tell_errors(&q->out, &f, PEER_SIZES * count, hits, unlike);
    field_free(&f);
    free(boxes);
    return is_run;
}

/* ---- goals ----------------------------------------------------------------------------------------------------------------- */

/* Goals are about four of the sizes. */
enum { GOAL_SIZES = 4 };
static const int goal_size[GOAL_SIZES] = {0, 2, 4, 6};

static const struct peer_goal {
    const char *name;
    double times[GOAL_SIZES];
} goals[] = {{"CGAL", {15, 40, 150, 300}}, {"Embree", {4, 6, 15, 25}}, {"Embree+", {4, 6, 15, 25}}, {"linear", {200, 60, 12, 5}}};

static const double any_times = 4;

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

static void tell_any(printout *out, const peers_result *r)
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
    snprintf(what, sizeof what, "any: times CGAL, mean of all sizes, %.40s", r->name);
    printout_goal(out, what, false, any_times, exp(logarithm));
    snprintf(what, sizeof what, "any: times CGAL, the least of all sizes, %.40s", r->name);
    printout_goal(out, what, false, any_times, least);
}

static void tell_goals(printout *out, const peers_result *results, size_t count)
{
    char what[96];
    printout_table(out, "goals");
    for (size_t g = 0; g < sizeof goals / sizeof goals[0]; g++)
        for (int k = 0; k < GOAL_SIZES; k++) {
            const double mean = mean_times(results, count, goals[g].name, goal_size[k]);
            snprintf(what, sizeof what, "list: times %s, boxes of %.1f %%, mean of meshes", goals[g].name,
                     100 * peer_part[goal_size[k]]);
            if (!isnan(mean))
                printout_goal(out, what, false, goals[g].times[k], mean);
        }
    for (size_t r = 0; r < count; r++)
        tell_any(out, &results[r]);
}

static bool answer(asked *q)
{
    const size_t terrain = (size_t)asked_number(q, OPTION_TERRAIN, asked_has(q, OPTION_VERIFY) ? 20000 : 0);
    const bool is_right = index_scenes_ask(q, terrain, run_scene);
    if (is_right && !asked_has(q, OPTION_VERIFY))
        tell_goals(&q->out, all_results, q->meshes.count + (terrain > 0));
    return is_right;
}

int main(int argc, char **argv)
{
    static const bench_question peers = {
        .name = "",
        .asks = "Does an index answer as CGAL, Embree and Bullet do, and how many times as fast is it?",
        .options = 1u << OPTION_VERIFY | 1u << OPTION_TERRAIN | 1u << OPTION_BOXES,
        .takes_meshes = true,
        .answer = answer};
    static const bench_question *const all[] = {&peers};
    static asked q;
    if (!peers_here[0]) {
        printf("skipped: built without CGAL, Embree and Bullet (Debian: libcgal-dev, libembree-dev, libbullet-dev)\n");
        return SKIPPED;
    }
    return asked_main(argc, argv, all, 1, &q);
}
