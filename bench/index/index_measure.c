/* index_measure.c - every order, box size and form, verified, then timed side by side. */
#include "index_measure.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/loads.h"
#include "console/message.h"
#include "many_boxes.h"
#include "mesh_lists.h"
#include "node_bounds.h"
#include "timing/measure.h"
#include "turned_boxes.h"

/* A linear pass has as many boxes as there is time for: it costs hardly more for one box than for another. */
static const size_t linear_pairs = 100000000;

/* As many boxes are verified as can be, by linear passes too. */
static const size_t verified_pairs = 20000000;

/* Oriented boxes take four times as long. */
static const size_t turned_pairs = 25000000;

static const double sample_seconds = 2e-3;

/* Of one soup, in all orders. */
typedef struct bench {
    const index_scene *scene;
    const index_effort *how;
    generator *turns;
    ordered_soup soup[ORDERS];
    node_bounds bounds[ORDERS];
    answer_room room;
    tribox_box *boxes;
    samples *taken;
} bench;

static void take_times(bench *b, const contestant *list, size_t count, double sample)
{
    measure(list, count, (effort){.rounds = (size_t)b->how->rounds, .seconds = 1e9, .sample = sample}, b->turns, b->room.mask,
            b->taken);
}

static double least_ns(const bench *b, size_t c) { return measure_spread(b->taken, c).least; }

/* ---- reading and building -------------------------------------------------------------------------------------------------- */

static bool run_reading(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const ordered_soup *const s = self->question;
    (void)report;
    mask[0] = loads_all(&s->room.soup);
    return true;
}

static bool run_build(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const ordered_soup *const s = self->question;
    (void)mask;
    (void)report;
    return !tribox_index_build(&s->index, &self->options, s->memory);
}

static void measure_builds(bench *b, scene_result *r)
{
    contestant list[ORDERS + 1];
    for (int o = 0; o <= ORDERS; o++)
        list[o] = (contestant){.run = o < ORDERS ? run_build : run_reading,
                               .question = &b->soup[o < ORDERS ? o : ORDER_FILE],
                               .options = {.kernel = b->how->kernel},
                               .pairs = (double)r->triangles};
    take_times(b, list, ORDERS + 1, sample_seconds);
    r->reading = least_ns(b, ORDERS);
    for (size_t o = 0; o < ORDERS; o++)
        r->order[o].cost.build = least_ns(b, o);
}

/* ---- box after box --------------------------------------------------------------------------------------------------------- */

static void count_visits(const bench *b, soup_order o, size_result *s)
{
    const double boxes = (double)b->how->boxes;
    node_visits all = {0, 0, 0};
    for (size_t k = 0; k < b->how->boxes; k++) {
        const node_visits one = node_bounds_visit(&b->bounds[o], &b->boxes[k], NULL);
        all.nodes += one.nodes;
        all.asked += one.asked;
        all.inside += one.inside;
    }
    s->nodes = (double)all.nodes / boxes;
    s->asked = (double)all.asked / boxes;
    s->inside = (double)all.inside / boxes;
}

/* Every form, of every order. */
static void measure_warm(bench *b, index_question question[ORDERS][2], int size, scene_result *r)
{
    contestant list[ORDERS * FORMS];
    size_t count = 0;
    for (int o = 0; o < ORDERS; o++)
        for (int f = 0; f < FORMS; f++)
            list[count++] = index_contestant(&question[o][f == FORM_LINEAR], (index_form)f, b->how->kernel);
    take_times(b, list, count, sample_seconds);
    for (size_t c = 0; c < count; c++)
        r->order[c / FORMS].size[size].us[c % FORMS] = 1e-3 * least_ns(b, c);
}

static void measure_cold(bench *b, index_question question[2], int size, scene_result *r)
{
    contestant list[FORMS];
    for (int f = 0; f < FORMS; f++)
        list[f] = index_contestant_cold(&question[f == FORM_LINEAR], (index_form)f, b->how->kernel);
    take_times(b, list, FORMS, 0);
    for (size_t f = 0; f < FORMS; f++)
        r->order[ORDER_CUTS].size[size].cold[f] = 1e-3 * least_ns(b, f);
}

/* Hits are those of the same boxes in any order, which the verification has seen to be so. */
static double count_hits(const index_question *question, const char *kernel)
{
    const contestant counting = index_contestant(question, FORM_COUNT, kernel);
    tribox_report report = {0, 0};
    counting.run(&counting, NULL, &report);
    return (double)report.overlapping / (double)question->count;
}

/* Boxes of the same size, turned: by cuts, and without an index. */
static bool measure_turned(bench *b, int size, scene_result *r)
{
    turned_boxes question;
    const size_t boxes = (size_t)b->how->boxes, fewer = index_scene_boxes_within(b->scene, turned_pairs, boxes);
    if (!turned_boxes_make(&b->soup[ORDER_CUTS], b->boxes, boxes, b->room.list, b->room.mask, &question))
        return false;
    const bool is_right = turned_boxes_are_right(&question, fewer, b->how->kernel);
    if (is_right) {
        const contestant list[2] = {turned_boxes_by_index(&question, b->how->kernel),
                                    turned_boxes_linear(&question, fewer, b->how->kernel)};
        take_times(b, list, 2, sample_seconds);
        r->turned[size] = 1e-3 * least_ns(b, 0);
        r->turned_linear[size] = 1e-3 * least_ns(b, 1);
    }
    turned_boxes_free(&question);
    return is_right;
}

static bool measure_size(bench *b, int size, scene_result *r)
{
    index_question question[ORDERS][2];
    index_scene_boxes(b->scene, box_part[size], (size_t)b->how->boxes, b->how->seed + (uint64_t)size, b->boxes);
    for (int o = 0; o < ORDERS; o++) {
        question[o][0] = (index_question){&b->soup[o], b->boxes, (size_t)b->how->boxes, &b->room};
        question[o][1] = question[o][0];
        question[o][1].count = index_scene_boxes_within(b->scene, linear_pairs, (size_t)b->how->boxes);
        if (!index_forms_verify(&question[o][0], index_scene_boxes_within(b->scene, verified_pairs, (size_t)b->how->boxes),
                                b->how->kernel))
            return false;
        count_visits(b, (soup_order)o, &r->order[o].size[size]);
        r->order[o].size[size].hits = count_hits(&question[o][0], b->how->kernel);
    }
    measure_warm(b, question, size, r);
    measure_cold(b, question[ORDER_CUTS], size, r);
    return measure_turned(b, size, r);
}

/* ---- many boxes at once ---------------------------------------------------------------------------------------------------- */

static bool measure_many(bench *b, int size, many_result *r)
{
    const size_t count = (size_t)b->how->many;
    tribox_box *const boxes = malloc(count * sizeof *boxes);
    many_boxes m = {.room = 0};
    if (boxes)
        index_scene_boxes(b->scene, box_part[size], count, b->how->seed + 99, boxes);
    const bool is_made = boxes && many_boxes_make(&b->soup[ORDER_CUTS], boxes, count, b->how->kernel, &m) &&
                         many_boxes_are_right(&m, b->how->kernel, b->room.list);
    if (is_made) {
        contestant list[MANY_RUNS];
        for (int c = 0; c < MANY_RUNS; c++)
            list[c] = many_boxes_contestant(&m, (many_run)c, b->how->kernel);
        take_times(b, list, MANY_RUNS, sample_seconds);
        *r = (many_result){count, least_ns(b, MANY_AS_DRAWN), least_ns(b, MANY_IN_ORDER), least_ns(b, MANY_ORDERING)};
    }
    many_boxes_free(&m);
    free(boxes);
    return is_made || message_failure("the lists of %zu boxes are wrong, or there is no memory for them", count) == EXIT_CODE_OK;
}

/* ---- meshes, and boxes of doubles ------------------------------------------------------------------------------------------ */

static bool measure_meshes_at(bench *b, int size, scene_result *r)
{
    mesh_lists question;
    const char *const kernel = b->how->kernel;
    contestant list[MESH_LISTS + 2];
    index_scene_boxes(b->scene, box_part[size], (size_t)b->how->boxes, b->how->seed + (uint64_t)size, b->boxes);
    if (!mesh_lists_make(b->scene, &b->soup[ORDER_CUTS], b->boxes, (size_t)b->how->boxes, b->room.list, kernel, &question))
        return false;
    const size_t verified = index_scene_boxes_within(b->scene, verified_pairs, (size_t)b->how->boxes);
    const bool is_right = mesh_lists_are_right(&question, verified, b->room.linear, kernel);
    for (int c = 0; c < MESH_LISTS; c++)
        list[c] = mesh_lists_contestant(&question, (mesh_list_of)c, kernel);
    for (int c = 0; c < 2; c++)
        list[MESH_LISTS + c] = mesh_lists_build(&question, c, kernel);
    if (is_right)
        take_times(b, list, MESH_LISTS + 2, sample_seconds);
    for (size_t c = 0; is_right && c < MESH_LISTS; c++)
        r->mesh[size][c] = 1e-3 * least_ns(b, c);
    for (size_t c = 0; is_right && c < 2; c++)
        r->mesh_build[c] = least_ns(b, MESH_LISTS + c);
    mesh_lists_free(&question);
    return is_right;
}

static bool measure_meshes(bench *b, scene_result *r)
{
    bool is_measured = true;
    for (int p = 0; is_measured && p < BOX_SIZES; p++)
        is_measured = measure_meshes_at(b, p, r);
    return is_measured;
}

/* ---- all of it ------------------------------------------------------------------------------------------------------------- */

enum { ORDER_TRIES = 3 };

static bool make(bench *b, scene_result *r)
{
    if (!answer_room_make(r->triangles, b->how->evicted, &b->room))
        return false;
    b->boxes = malloc((size_t)b->how->boxes * sizeof *b->boxes);
    for (int o = 0; o < ORDERS; o++) {
        if (!ordered_soup_make(b->scene, (soup_order)o, ORDER_TRIES, b->how->kernel, &b->soup[o]))
            return false;
        if (!b->boxes || !node_bounds_make(&b->soup[o].room.soup, &b->bounds[o]))
            return message_failure("out of memory for bounds") == EXIT_CODE_OK;
        r->order[o].name = b->soup[o].name;
        r->order[o].cost = b->soup[o].cost;
    }
    return true;
}

static void release(bench *b)
{
    answer_room_free(&b->room);
    free(b->boxes);
    for (int o = 0; o < ORDERS; o++) {
        ordered_soup_free(&b->soup[o]);
        node_bounds_free(&b->bounds[o]);
    }
}

bool index_measure(const index_scene *scene, const index_effort *how, generator *order, scene_result *r)
{
    static samples taken;
    const size_t count = scene->room.soup.count;
    bench b = {.scene = scene, .how = how, .turns = order, .taken = &taken};
    *r = (scene_result){.triangles = count, .memory = (double)tribox_index_bytes(count) / (36.0 * (double)count)};
    memcpy(r->name, scene->name, sizeof r->name);
    bool is_measured = make(&b, r);
    if (is_measured)
        measure_builds(&b, r);
    for (int p = 0; is_measured && p < BOX_SIZES; p++)
        is_measured = measure_size(&b, p, r);
    for (int k = 0; is_measured && k < MANY_SIZES; k++)
        is_measured = measure_many(&b, k, &r->many[k]);
    is_measured = is_measured && measure_meshes(&b, r);
    release(&b);
    return is_measured;
}
