/*
 * index.c - what is an index worth? Lists, counts and other forms of answer by an index, over triangles in the order of the file
 * and in order by cuts (tribox_soup_sort), over the soup and over meshes, about boxes of four sizes, turned ones, and boxes whose
 * bounds are no floats; and many boxes in a call. Against the call without an index.
 *
 * Every form has to be right about boxes of every size, or nothing is timed.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/rivals.h"
#include "common/box_scenes.h"
#include "common/asked.h"
#include "timing/timing.h"

/* What is asked of whom. */
typedef enum kind { OF_FILE, OF_CUTS, TURNED, WIDE_BOXES, OF_MESH, OF_DOUBLES, KINDS } kind;
static const char *const kind_names[KINDS] = {"file",           "cuts",           "turned boxes", "boxes of doubles",
                                              "mesh of floats", "mesh of doubles"};

enum { BOX_SIZES = 4, ORDERINGS = 3, MANY_SIZES = 2 };
static const double box_part[BOX_SIZES] = {0.001, 0.01, 0.1, 0.5};

/* A linear pass has as many boxes as there is time for: one costs hardly more than another, but turned ones do. */
static const size_t linear_pairs = 100000000, turned_pairs = 25000000, verified_pairs = 20000000;

static const double sample_seconds = 2e-3;

/* Microseconds a box, nanoseconds a triangle. */
typedef struct scene_result {
    const char *name;
    size_t triangles;
    double us[BOX_SIZES][KINDS][FORMS], reading, order, gather, build[KINDS], memory;
} scene_result;

/* Of one soup. */
typedef struct field {
    const scene *scene;
    ordered_soup cuts;
    tribox_index file, mesh_index[2];
    tribox_mesh mesh[2]; /* of floats; of doubles, far from zero */
    float (*floats)[3];
    double (*doubles)[3];
    uint32_t *corners; /* in order by cuts; vertices are numbered as they come in the file */
    tribox_box *boxes, *wide, *moved;
    tribox_oriented_box *turned;
    size_t count;
    answer_room room;
} field;

/* ---- what is asked --------------------------------------------------------------------------------------------------------- */

/* As if the mesh came from a map: farther away than it is long, where floats would not tell it. */
static void far_away(const field *f, double by[3])
{
    const double extent = scene_extent(f->scene);
    by[0] = 700 * extent;
    by[1] = -9000 * extent;
    by[2] = 33 * extent;
}

static bool make_meshes(field *f)
{
    const tribox_soup *const file = &f->scene->work.jobs[0].soup;
    const size_t count = file->count;
    uint32_t(*const welded)[3] = asked_allocate(count, sizeof *welded);
    const size_t vertices = weld_soup(file, f->floats, welded);
    double by[3];
    far_away(f, by);
    for (size_t i = 0; vertices && i < count; i++)
        memcpy(f->corners + 3 * i, welded[f->cuts.ids[i]], sizeof welded[0]);
    for (size_t v = 0; v < vertices; v++)
        for (int a = 0; a < 3; a++)
            f->doubles[v][a] = (double)f->floats[v][a] + by[a];
    for (int k = 0; k < 2; k++) {
        f->mesh[k] = (tribox_mesh){.positions = k ? (const void *)f->doubles : f->floats,
                                   .vertices = vertices,
                                   .indices = f->corners,
                                   .index_bytes = 4,
                                   .count = count,
                                   .position_bytes = k ? 8 : 4};
        f->mesh_index[k] =
            (tribox_index){.nodes = asked_allocate(tribox_index_bytes(count), 1), .mesh = &f->mesh[k], .ids = f->cuts.ids};
    }
    return vertices;
}

/* The boxes' own size, turned; an ulp of double smaller; and with the mesh far away. */
static void make_boxes(field *f, int size, uint64_t seed)
{
    double by[3];
    far_away(f, by);
    scene_boxes(f->scene, box_part[size], f->count, seed + (uint64_t)size, f->boxes);
    for (size_t b = 0; b < f->count; b++) {
        f->turned[b] = scene_turned(&f->boxes[b], SCENE_TURN);
        for (int a = 0; a < 3; a++) {
            const double lo = f->boxes[b].lo[a], hi = f->boxes[b].hi[a];
            f->wide[b].lo[a] = nextafter(lo, hi);
            f->wide[b].hi[a] = nextafter(hi, lo);
            f->moved[b].lo[a] = lo + by[a];
            f->moved[b].hi[a] = hi + by[a];
        }
    }
}

static bool make(const scene *at, size_t boxes, size_t evicted, const char *kernel, field *f)
{
    const size_t count = at->work.pairs;
    *f = (field){.scene = at, .count = boxes};
    answer_room_make(count, evicted, &f->room);
    if (!ordered_soup_make(at, kernel, &f->cuts))
        return false;
    f->floats = asked_allocate(3 * count, sizeof *f->floats);
    f->doubles = asked_allocate(3 * count, sizeof *f->doubles);
    f->corners = asked_allocate(3 * count, sizeof *f->corners);
    f->boxes = asked_allocate(boxes, sizeof *f->boxes);
    f->wide = asked_allocate(boxes, sizeof *f->wide);
    f->moved = asked_allocate(boxes, sizeof *f->moved);
    f->turned = asked_allocate(boxes, sizeof *f->turned);
    f->file = (tribox_index){.nodes = asked_allocate(tribox_index_bytes(count), 1), .soup = &at->work.jobs[0].soup};
    return make_meshes(f) || message_failure("out of memory for meshes") == EXIT_CODE_OK;
}

static index_question question_of(field *f, kind k)
{
    const bool is_mesh = k >= OF_MESH;
    const tribox_index *const index = k == OF_FILE ? &f->file : is_mesh ? &f->mesh_index[k - OF_MESH] : &f->cuts.index;
    return (index_question){.name = kind_names[k],
                            .index = index,
                            .triangles = f->scene->work.pairs,
                            .boxes = k == TURNED       ? NULL
                                     : k == WIDE_BOXES ? f->wide
                                     : k == OF_DOUBLES ? f->moved
                                                       : f->boxes,
                            .turned = f->turned,
                            .count = f->count,
                            .linear_count = scene_boxes_within(f->scene, k == TURNED ? turned_pairs : linear_pairs, f->count),
                            .room = &f->room};
}

/* ---- building -------------------------------------------------------------------------------------------------------------- */

CONTESTANT_RUN(run_reading)
{
    mask[0] = loads_all(self->question);
    return true;
}

CONTESTANT_RUN(run_build)
{
    const tribox_index *const index = self->question;
    return !tribox_index_build(index, &self->options, (void *)(uintptr_t)index->nodes);
}

CONTESTANT_RUN(run_order)
{
    const ordered_soup *const made = self->question;
    return !(self->which ? tribox_soup_gather(made->file, made->ids, 0, made->soup.count, made->to, made->to + 3, made->to + 6)
                         : tribox_soup_sort(made->file, made->ids, made->scratch));
}

static void measure_builds(asked *q, field *f, effort how, scene_result *r)
{
    static const kind kinds[] = {OF_FILE, OF_CUTS, OF_MESH, OF_DOUBLES};
    enum { BUILDS = sizeof kinds / sizeof kinds[0] };
    contestant list[BUILDS + 1];
    for (size_t k = 0; k < BUILDS; k++)
        list[k] = (contestant){.run = run_build, .question = question_of(f, kinds[k]).index};
    list[BUILDS] = (contestant){.run = run_reading, .question = &f->scene->work.jobs[0].soup};
    for (size_t k = 0; k <= BUILDS; k++) {
        list[k].options.kernel = q->kernel;
        list[k].pairs = (double)r->triangles;
    }
    asked_measure(q, "build", list, BUILDS + 1, NULL, how, 1);
    for (size_t k = 0; k < BUILDS; k++)
        r->build[kinds[k]] = measure_least(&q->taken, k);
    r->reading = measure_least(&q->taken, BUILDS);
    for (int k = 0; k < 2; k++)
        list[k] = (contestant){.run = run_order, .question = &f->cuts, .which = k, .pairs = (double)r->triangles};
    asked_measure(q, "order", list, 2, NULL, (effort){.rounds = ORDERINGS, .seconds = 1e9}, 1);
    r->order = measure_least(&q->taken, 0);
    r->gather = measure_least(&q->taken, 1);
}

/* After how many lists of boxes of a size order, gathering and build are paid back. */
static double pays_after(const scene_result *r, kind k, int size)
{
    const double ns = (k == OF_CUTS ? r->order + r->gather : 0) + r->build[k];
    return ceil(1e-3 * (double)r->triangles * ns / (r->us[size][OF_FILE][FORM_LINEAR] - r->us[size][k][FORM_LIST]));
}

static void tell_builds(asked *q, const scene_result *r)
{
    static const char *const paid[BOX_SIZES] = {"paid_by_0.1_%", "by_1_%", "by_10_%", "by_50_%_lists"};
    printout_table(&q->out, "%s: ns a triangle; reading the streams takes %.2f, the index %.3f %% of their memory", r->name,
                   r->reading, 100 * r->memory);
    for (kind k = OF_FILE; k < KINDS; k++) {
        if (k == TURNED || k == WIDE_BOXES)
            continue;
        ADD(&q->out, TEXT("of", kind_names[k]), NUMBER_IF(k == OF_CUTS, "order", 1, r->order),
            NUMBER_IF(k == OF_CUTS, "gather", 1, r->gather), NUMBER("build", 2, r->build[k]),
            NUMBER("times_reading", 2, r->build[k] / r->reading));
        for (int p = 0; p < BOX_SIZES; p++)
            ADD(&q->out, NUMBER_IF(k <= OF_CUTS, paid[p], 0, pays_after(r, k, p)));
        printout_row(&q->out);
    }
}

/* ---- box after box --------------------------------------------------------------------------------------------------------- */

static void tell_forms(asked *q, const index_question *question, int size, bool is_cold, double hits, const double us[FORMS])
{
    ADD(&q->out, TEXT("of", is_cold ? "cuts, cold" : question->name), NUMBER("box_%", 1, 100 * box_part[size]),
        NUMBER("hits", 1, hits));
    for (index_form form = FORM_LIST; form < FORMS; form++)
        ADD(&q->out, NUMBER(index_form_name(form), 2, us[form]));
    ROW(&q->out, NUMBER("times_linear", 2, us[FORM_LINEAR] / us[FORM_LIST]));
}

static bool ask_size(asked *q, field *f, int size, effort how, scene_result *r)
{
    index_question questions[KINDS];
    contestant list[KINDS * FORMS];
    double cold[FORMS];
    make_boxes(f, size, q->seed);
    for (kind k = OF_FILE; k < KINDS; k++) {
        questions[k] = question_of(f, k);
        if (!index_forms_verify(&questions[k], scene_boxes_within(f->scene, verified_pairs, f->count), q->kernel))
            return false;
        for (index_form form = FORM_LIST; form < FORMS; form++)
            list[(size_t)k * FORMS + form] = index_contestant(&questions[k], form, false, q->kernel);
    }
    asked_measure(q, "forms", list, KINDS * FORMS, NULL, how, 1);
    for (size_t c = 0; c < KINDS * FORMS; c++)
        r->us[size][c / FORMS][c % FORMS] = 1e-3 * measure_least(&q->taken, c);
    for (index_form form = FORM_LIST; form < FORMS; form++)
        list[form] = index_contestant(&questions[OF_CUTS], form, true, q->kernel);
    asked_measure(q, "cold", list, FORMS, NULL, (effort){.rounds = how.rounds, .seconds = 1e9}, 1);
    for (size_t form = 0; form < FORMS; form++)
        cold[form] = 1e-3 * measure_least(&q->taken, form);
    for (kind k = OF_FILE; k < KINDS; k++)
        tell_forms(q, &questions[k], size, false, index_hits(&questions[k], q->kernel), r->us[size][k]);
    tell_forms(q, &questions[OF_CUTS], size, true, (double)NAN, cold);
    return true;
}

/* ---- many boxes at once ---------------------------------------------------------------------------------------------------- */

enum { AS_DRAWN, IN_ORDER, ORDERING, MANY_RUNS };

/* As streams: as they were drawn, and in an order in which they are near each other. */
typedef struct many {
    const tribox_index *index;
    float *bounds[2];
    tribox_boxes boxes[2];
    uint32_t *order, *list;
    void *scratch;
    size_t *start, room;
} many;

CONTESTANT_RUN(run_many)
{
    const many *const m = self->question;
    return self->which == ORDERING
               ? !tribox_boxes_sort(&m->boxes[0], m->order, m->scratch)
               : !tribox_index_lists(m->index, &m->boxes[self->which], &self->options, m->room, m->list, m->start);
}

static bool make_many(const tribox_box *boxes, size_t count, const tribox_options *options, many *m)
{
    for (int w = 0; w < 2; w++) {
        m->bounds[w] = asked_allocate(6 * count, sizeof *m->bounds[w]);
        m->boxes[w].count = count;
        for (size_t a = 0; a < 3; a++) {
            m->boxes[w].lo[a] = m->bounds[w] + a * count;
            m->boxes[w].hi[a] = m->bounds[w] + (3 + a) * count;
        }
    }
    m->order = asked_allocate(count, sizeof *m->order);
    m->scratch = asked_allocate(count, 16);
    m->start = asked_allocate(count + 1, sizeof *m->start);
    for (size_t i = 0; i < 6 * count; i++)
        m->bounds[0][i] = (float)(i / count < 3 ? boxes[i % count].lo[i / count] : boxes[i % count].hi[i / count - 3]);
    if (tribox_boxes_sort(&m->boxes[0], m->order, m->scratch))
        return false;
    for (size_t i = 0; i < 6 * count; i++)
        m->bounds[1][i] = m->bounds[0][i / count * count + m->order[i % count]];
    if (tribox_index_lists(m->index, &m->boxes[0], options, 0, NULL, m->start))
        return false;
    m->room = m->start[count];
    m->list = asked_allocate(m->room + 1, sizeof *m->list);
    return !tribox_index_lists(m->index, &m->boxes[0], options, m->room, m->list, m->start);
}

/* Whether every list of the call is that of a call about its box alone. */
static bool is_many_right(const many *m, const tribox_box *boxes, size_t triangles, const tribox_options *options, uint32_t *list)
{
    for (size_t i = 0; i < m->boxes[0].count; i++) {
        size_t found;
        if (tribox_index_list(m->index, &(tribox_region){.box = &boxes[i]}, options, triangles, list, &found) ||
            found != m->start[i + 1] - m->start[i] || memcmp(list, m->list + m->start[i], found * sizeof *m->list) != 0)
            return false;
    }
    return true;
}

static bool ask_many(asked *q, field *f, int size, size_t count, effort how)
{
    const tribox_options options = {.kernel = q->kernel};
    void *const mark = asked_mark();
    tribox_box *const boxes = asked_allocate(count, sizeof *boxes);
    many m = {.index = &f->cuts.index};
    contestant list[MANY_RUNS];
    scene_boxes(f->scene, box_part[size], count, q->seed + 99, boxes);
    const bool is_right =
        make_many(boxes, count, &options, &m) && is_many_right(&m, boxes, f->scene->work.pairs, &options, f->room.list);
    for (int c = 0; c < MANY_RUNS; c++)
        list[c] = (contestant){.run = run_many, .question = &m, .which = c, .options = options, .pairs = (double)count};
    if (is_right) {
        asked_measure(q, "many", list, MANY_RUNS, NULL, how, 1);
        ROW(&q->out, NUMBER("box_%", 1, 100 * box_part[size]), NUMBER("boxes", 0, count),
            NUMBER("as_drawn", 0, measure_least(&q->taken, AS_DRAWN)), NUMBER("in_order", 0, measure_least(&q->taken, IN_ORDER)),
            NUMBER("ordering", 0, measure_least(&q->taken, ORDERING)));
    }
    asked_release(mark);
    return is_right || message_failure("the lists of %zu boxes are wrong", count) == EXIT_CODE_OK;
}

/* ---- all of it ------------------------------------------------------------------------------------------------------------- */

static bool ask_scene(asked *q, scene *at)
{
    static scene_result result;
    scene_result *const r = &result;
    const bool is_quick = asked_has(q, OPTION_QUICK);
    const size_t count = at->work.pairs, boxes = (size_t)asked_number(q, OPTION_BOXES, is_quick ? 20 : 100);
    const effort how = {
        .rounds = (size_t)asked_number(q, OPTION_ROUNDS, is_quick ? 3 : 9), .seconds = 1e9, .sample = sample_seconds};
    static field f;
    bool is_right = make(at, boxes, (size_t)(is_quick ? 16 : 256) << 20, q->kernel, &f);
    *r = (scene_result){.triangles = count, .memory = (double)tribox_index_bytes(count) / (36.0 * (double)count)};
    r->name = at->name;
    if (is_right) {
        measure_builds(q, &f, how, r);
        printout_table(&q->out, "%s: %zu triangles; us a box, by form of the answer, the least of %zu rounds", r->name, count,
                       how.rounds);
    }
    for (int p = 0; is_right && p < BOX_SIZES; p++)
        is_right = ask_size(q, &f, p, how, r);
    if (is_right) {
        tell_builds(q, r);
        printout_table(&q->out, "%s: lists of many boxes in one call, ns a box", r->name);
    }
    for (int p = 0; is_right && p < MANY_SIZES; p++)
        is_right = ask_many(q, &f, p, is_quick ? 2000 : 20000, how);
    return is_right;
}

static bool answer(asked *q)
{
    const uint64_t terrain = asked_number(q, OPTION_TERRAIN, asked_has(q, OPTION_QUICK) ? 200000 : 10000000);
    return scenes_ask(q, SCENES_USUAL, (size_t)terrain, ask_scene);
}

const bench_question question_index = {
    .name = "index",
    .asks = "What does an index gain over calls without one, by order of triangles, size of box and form of answer?",
    .options = 1u << OPTION_TERRAIN | 1u << OPTION_BOXES | 1u << OPTION_KERNEL | 1u << OPTION_QUICK,
    .takes_meshes = true,
    .answer = answer};
