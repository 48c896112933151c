/*
 * doubles.c - what do meshes of doubles cost, against the same triangles as floats, against reading their bytes, and against
 * CGAL?
 *
 * Nine numbers a triangle, and indices of 32 bits into half as many vertices as triangles. All of a scene are timed in the same
 * rounds; figures are of the least times. The stages that settle what floats leave open are timed on triangles that reach them.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cgal_peer.h"
#include "common/draw.h"
#include "common/rivals.h"
#include "common/asked.h"

/* ---- scenes ---------------------------------------------------------------------------------------------------------------- */

typedef struct double_scene {
    const char *name, *what;
    size_t count;
    tribox_mesh nine, indexed;               /* of doubles */
    tribox_mesh single_nine, single_indexed; /* of floats */
    tribox_box box;
    tribox_box single_box;
    void *memory[5];
} double_scene;

enum { DOUBLE_SCENES = 7 };

/* Triangles, as nine doubles, against a box for which the first stage leaves what the box normals do not separate. */
typedef enum stage_scene {
    STAGE_NONE,   /* an ordinary box: none are left */
    STAGE_DOUBLE, /* a flat box */
    STAGE_ULP,    /* within units of the last place of contact */
    STAGE_SHORT,  /* numbers below 2^-200, few bits apart */
    STAGE_LONG,   /* exponents from end to end */
    STAGE_SCENES
} stage_scene;

enum { SEED = 1, NEARNESS = 32, STAGED = 20000 };

typedef struct recipe {
    const char *name, *what;
    size_t count;
    draw_triangle *draw; /* as floats; the numbers between them are filled up */
    double offset;
    bool is_filled_up, is_sorted, is_large;
} recipe;

static const recipe recipes[DOUBLE_SCENES] = {
    {"cache", "the scene of the paper, in the first caches", 800, draw_paper, 0, true, false, false},
    {"paper", "the scene of the paper", 100000, draw_paper, 0, true, false, false},
    {"offset", "the same ten million units away", 100000, draw_paper, 1e7, true, false, false},
    {"lattice", "coordinates in quarters", 100000, draw_lattice, 0, false, false, false},
    {"tenths", "coordinates in tenths, as doubles have them", 100000, NULL, 0, false, false, false},
    {"sorted", "small triangles in Morton order, mostly far off", 1000000, draw_sparse, 0, true, true, false},
    {"memory", "the scene of the paper, beyond the caches", 4000000, draw_paper, 0, true, false, true},
};

static const char *const stage_names[STAGE_SCENES] = {"none", "in double", "an ulp off contact", "in integers of 60 bits",
                                                      "in long integers"};

static bool double_scene_is_large(size_t index) { return recipes[index].is_large; }

static double uniform(generator *g, double least, double most)
{
    return least + (most - least) * ((double)(random_bits(g) >> 11) * 0x1p-53);
}

static void draw_in_tenths(generator *g, double u[3][3])
{
    for (int k = 0; k < 9; k++)
        u[k / 3][k % 3] = (double)random_below(g, 26) / 10;
}

/* A triangle at the origin. The last 29 bits of a double, which floats have not, are drawn too. */
static void draw_one(generator *g, const recipe *from, double u[3][3])
{
    triangle t;
    if (!from->draw) {
        draw_in_tenths(g, u);
        return;
    }
    from->draw(g, t);
    for (int k = 0; k < 9; k++) {
        const double x = (double)t[k / 3][k % 3];
        u[k / 3][k % 3] = from->is_filled_up ? x * (1 + uniform(g, -0x1p-25, 0x1p-25)) : x;
    }
}

/* Vertices, half as many as triangles, at numbers near to the corner's; of sorted triangles one for each corner. */
static void draw_vertices(generator *g, const recipe *from, double (*vertex)[3], size_t vertices)
{
    for (size_t v = 0; v < vertices; v += 3) {
        double u[3][3];
        draw_one(g, from, u);
        memcpy(vertex[v], u, (vertices - v < 3 ? vertices - v : 3) * sizeof u[0]);
    }
}

static void sort_triangles(double (*vertex)[3], size_t count)
{
    triangle *const rounded = asked_allocate(count, sizeof *rounded);
    for (size_t k = 0; k < 9 * count; k++)
        rounded[k / 9][k / 3 % 3][k % 3] = (float)vertex[k / 3][k % 3];
    if (!place_sort(rounded, count, 8))
        exit(message_failure("out of memory"));
    for (size_t k = 0; k < 9 * count; k++)
        vertex[k / 3][k % 3] = (double)rounded[k / 9][k / 3 % 3][k % 3];
    free(rounded);
}

/* Near in number, and another for each corner of a triangle. */
static size_t near_number(generator *g, size_t corner, size_t corners, size_t vertices)
{
    const size_t about = (size_t)((double)corner / (double)corners * (double)(vertices - 3 * NEARNESS));
    return about + corner % 3 * NEARNESS + random_below(g, NEARNESS);
}

/* Both sizes of numbers, by index and as nine, from vertices at the origin. */
static void make_meshes(double_scene *made, double (*vertex)[3], size_t vertices, double offset, const uint32_t *index)
{
    const size_t corners = 3 * made->count;
    float(*const single)[3] = asked_allocate(vertices, sizeof *single),
                 (*const single_nine)[3] = asked_allocate(corners, sizeof *single_nine);
    double(*const nine)[3] = asked_allocate(corners, sizeof *nine);
    for (size_t v = 0; v < vertices; v++)
        for (int a = 0; a < 3; a++) {
            single[v][a] = (float)vertex[v][a];
            vertex[v][a] += offset;
        }
    for (size_t c = 0; c < corners; c++) {
        memcpy(nine[c], vertex[index[c]], sizeof nine[c]);
        memcpy(single_nine[c], single[index[c]], sizeof single_nine[c]);
    }
    made->nine = (tribox_mesh){.positions = nine, .vertices = corners, .count = made->count, .position_bytes = 8};
    made->indexed = (tribox_mesh){
        .positions = vertex, .vertices = vertices, .indices = index, .index_bytes = 4, .count = made->count, .position_bytes = 8};
    made->single_nine = (tribox_mesh){.positions = single_nine, .vertices = corners, .count = made->count};
    made->single_indexed =
        (tribox_mesh){.positions = single, .vertices = vertices, .indices = index, .index_bytes = 4, .count = made->count};
    made->memory[0] = single;
    made->memory[1] = single_nine;
    made->memory[2] = nine;
}

static void make_boxes(double_scene *made, bool is_tenths, double offset)
{
    for (int a = 0; a < 3; a++) {
        made->box.lo[a] = offset + (is_tenths ? 0.8 : -0.5);
        made->box.hi[a] = offset + (is_tenths ? 1.7 : 0.5);
        made->single_box.lo[a] = (float)(is_tenths ? 0.8 : -0.5);
        made->single_box.hi[a] = (float)(is_tenths ? 1.7 : 0.5);
    }
}

static void double_scene_make(size_t number, double_scene *made)
{
    const recipe *const from = &recipes[number];
    generator g = {SEED};
    const size_t corners = 3 * from->count, vertices = from->is_sorted ? corners : from->count / 2;
    double(*const vertex)[3] = asked_allocate(vertices, sizeof *vertex);
    uint32_t *const index = asked_allocate(corners, sizeof *index);
    *made = (double_scene){.name = from->name, .what = from->what, .count = from->count};
    draw_vertices(&g, from, vertex, vertices);
    if (from->is_sorted)
        sort_triangles(vertex, from->count);
    for (size_t c = 0; c < corners; c++)
        index[c] = (uint32_t)(from->is_sorted ? c : near_number(&g, c, corners, vertices));
    make_meshes(made, vertex, vertices, from->offset, index);
    make_boxes(made, !from->draw, from->offset);
    made->memory[3] = vertex;
    made->memory[4] = index;
}

static void double_scene_free(double_scene *made)
{
    for (size_t k = 0; k < sizeof made->memory / sizeof made->memory[0]; k++)
        free(made->memory[k]);
}

static double draw_number(generator *g, stage_scene which)
{
    const double x = uniform(g, -2, 2);
    return which == STAGE_SHORT ? ldexp(x, -600) : which == STAGE_LONG ? ldexp(x, (int)random_below(g, 2000) - 1000) : x;
}

/* Touching a box of thirds: contact that no double has. */
static void draw_off_contact(generator *g, double u[3][3])
{
    triangle t;
    draw_touching(g, t);
    for (int k = 0; k < 9; k++)
        u[k / 3][k % 3] = (double)t[k / 3][k % 3] / 3;
}

static void stage_scene_make(stage_scene which, double_scene *made)
{
    generator g = {SEED};
    double(*const nine)[3][3] = asked_allocate(STAGED, sizeof *nine);
    *made = (double_scene){.name = stage_names[which], .count = STAGED, .memory = {nine}};
    for (size_t i = 0; i < STAGED; i++) {
        if (which == STAGE_ULP)
            draw_off_contact(&g, nine[i]);
        for (int k = 0; which != STAGE_ULP && k < 9; k++)
            nine[i][k / 3][k % 3] = draw_number(&g, which);
    }
    for (int a = 0; a < 3; a++) {
        const double half = which == STAGE_SHORT ? 0x1p-601 : which == STAGE_ULP ? 0.5 / 3 : 0.5;
        made->box.lo[a] = -half;
        made->box.hi[a] = which == STAGE_DOUBLE && a == 2 ? -half : half;
    }
    made->nine = (tribox_mesh){.positions = nine, .vertices = 3 * STAGED, .count = STAGED, .position_bytes = 8};
}

/* ---- who is timed ---------------------------------------------------------------------------------------------------------- */

enum { PEER_TRIANGLES = 16384 };

/* What a contestant answers: a form of the scene. */
typedef struct form {
    const double_scene *at;
    const tribox_mesh *mesh;
    const cgal_peer *peer;
} form;

static const form *question_of(const contestant *self) { return self->question; }

CONTESTANT_RUN(run_floats)
{
    const form *const q = question_of(self);
    return !tribox_mesh_overlap(q->mesh, &q->at->single_box, &self->options, mask, report);
}

CONTESTANT_RUN(run_doubles)
{
    const form *const q = question_of(self);
    return !tribox_mesh_overlap(q->mesh, &q->at->box, &self->options, mask, report);
}

CONTESTANT_RUN(run_reading)
{
    const tribox_mesh *const mesh = question_of(self)->mesh;
    mask[0] = loads_words(mesh->positions, 6 * mesh->vertices);
    if (mesh->indices)
        mask[0] ^= loads_words(mesh->indices, 3 * mesh->count);
    return true;
}

CONTESTANT_RUN(run_peer)
{
    cgal_peer_answer(question_of(self)->peer, mask);
    return true;
}

static bool find_truth(const void *question, unsigned axes, uint64_t *mask)
{
    const form *const q = question;
    return !tribox_mesh_overlap(q->mesh, &q->at->box, &(tribox_options){.axes = axes, .kernel = "scalar"}, mask, NULL);
}

/* Whom each is held against. */
enum { FLOAT_NINE, FLOAT_INDEXED, DOUBLE_NINE, DOUBLE_INDEXED, READ_NINE, READ_INDEXED, PEER, ENTRIES };

static size_t enter(const double_scene *at, const cgal_peer *peer, const char *kernel, form questions[ENTRIES], contestant *list)
{
    const struct {
        const char *name;
        contestant_run *run;
        const tribox_mesh *mesh;
        answer_promise promise;
    } all[ENTRIES] = {
        [FLOAT_NINE] = {"nine floats", run_floats, &at->single_nine, PROMISE_NOTHING},
        [FLOAT_INDEXED] = {"indexed floats", run_floats, &at->single_indexed, PROMISE_NOTHING},
        [DOUBLE_NINE] = {"nine doubles", run_doubles, &at->nine, PROMISE_EXACT},
        [DOUBLE_INDEXED] = {"indexed doubles", run_doubles, &at->indexed, PROMISE_EXACT},
        [READ_NINE] = {"reading nine doubles", run_reading, &at->nine, PROMISE_NOTHING},
        [READ_INDEXED] = {"reading indexed doubles", run_reading, &at->indexed, PROMISE_NOTHING},
        [PEER] = {"CGAL's Epick", run_peer, &at->nine, PROMISE_NOTHING},
    };
    const size_t count = peer ? ENTRIES : PEER, asked_of_peer = at->count < PEER_TRIANGLES ? at->count : PEER_TRIANGLES;
    for (size_t k = 0; k < count; k++) {
        questions[k] = (form){at, all[k].mesh, peer};
        list[k] = (contestant){.run = all[k].run,
                               .question = &questions[k],
                               .options = {.kernel = kernel},
                               .promise = all[k].promise,
                               .pairs = (double)(k == PEER ? asked_of_peer : at->count)};
        snprintf(list[k].name, sizeof list[k].name, "%s", all[k].name);
    }
    return count;
}

/* Whether CGAL says the same of every triangle that is not degenerate. */
static bool is_peer_of_one_mind(const double_scene *at, const cgal_peer *peer)
{
    const size_t count = at->count < PEER_TRIANGLES ? at->count : PEER_TRIANGLES;
    uint64_t *const exact = asked_allocate(tribox_mask_words(at->count), sizeof *exact);
    uint64_t *const other = asked_allocate(tribox_mask_words(count), sizeof *other);
    size_t unlike = 0;
    find_truth(&(form){at, &at->nine, NULL}, TRIBOX_AXES_ALL, exact);
    cgal_peer_answer(peer, other);
    for (size_t i = 0; i < count; i++)
        unlike += ((exact[i / 64] ^ other[i / 64]) >> i % 64 & 1) && !cgal_peer_is_degenerate(peer, i);
    if (unlike)
        message_failure("%s: CGAL's answer differs on %zu triangles that are not degenerate", at->name, unlike);
    free(exact);
    free(other);
    return !unlike;
}

static void tell_scene(asked *q, const double_scene *at, const contestant *list, size_t count)
{
    double ns[ENTRIES];
    printout_table(&q->out, "%s: %zu triangles, %s; %.3f %% left to slower stages", at->name, at->count, at->what,
                   100 * (double)q->scores[DOUBLE_NINE].undecided / (double)at->count);
    for (size_t k = 0; k < count; k++) {
        const bool is_double = k == DOUBLE_NINE || k == DOUBLE_INDEXED;
        ns[k] = measure_least(&q->taken, k);
        ADD(&q->out, TEXT("triangles", list[k].name), TEXT_DATA("scene", at->name));
        printout_times(&q->out, &q->taken, k);
        ROW(&q->out, NUMBER("times_floats", 3, is_double ? ns[k] / ns[k - DOUBLE_NINE + FLOAT_NINE] : (double)NAN),
            NUMBER("times_reading", 3, is_double ? ns[k] / measure_least(&q->taken, k - DOUBLE_NINE + READ_NINE) : (double)NAN),
            NUMBER("times_nine_doubles", 1, k == PEER ? ns[k] / ns[DOUBLE_NINE] : (double)NAN));
    }
    printout_disturbed(&q->out, &q->taken);
}

static bool run_scene(asked *q, size_t number)
{
    double_scene at;
    form questions[ENTRIES];
    contestant list[CONTESTANTS_MAX];
    double_scene_make(number, &at);
    cgal_peer *const peer =
        cgal_peer_make(CGAL_EPICK_BBOX, at.nine.positions, at.count < PEER_TRIANGLES ? at.count : PEER_TRIANGLES, &at.box);
    const size_t count = enter(&at, peer, q->kernel, questions, list);
    const truth from = {find_truth, &questions[DOUBLE_NINE], tribox_mask_words(at.count)};
    const bool is_right = (!peer || is_peer_of_one_mind(&at, peer)) &&
                          asked_measure(q, at.name, list, count, &from, asked_effort(q, 51, 8, 1e-3), from.words);
    if (is_right)
        tell_scene(q, &at, list, count);
    cgal_peer_free(peer);
    double_scene_free(&at);
    return is_right;
}

/*
 * What each triangle that the first stage leaves takes beyond those that it decides: the box normals of ordinary triangles, of the
 * first scene of these.
 */
static void run_stage(asked *q, stage_scene which)
{
    double_scene at[2];
    form question[2];
    contestant list[2];
    tribox_report report = {0, 0};
    stage_scene_make(STAGE_NONE, &at[0]);
    stage_scene_make(which, &at[1]);
    for (int k = 0; k < 2; k++) {
        question[k] = (form){&at[k], &at[k].nine, NULL};
        list[k] = (contestant){.name = "stage",
                               .run = run_doubles,
                               .question = &question[k],
                               .options = {.axes = k ? TRIBOX_AXES_ALL : TRIBOX_AXES_BOX, .kernel = q->kernel},
                               .pairs = (double)at[k].count};
    }
    const size_t words = tribox_mask_words(at[1].count);
    uint64_t *const mask = asked_allocate(words, sizeof *mask);
    if (!list[1].run(&list[1], mask, &report))
        exit(message_failure("the library refuses a scene"));
    asked_measure(q, "stage", list, 2, NULL, asked_effort(q, 51, 8, 1e-3), words);
    const double more = measure_least(&q->taken, 1) - measure_least(&q->taken, 0);
    const double ns = report.undecided ? more * (double)at[1].count / (double)report.undecided : 0;
    ROW(&q->out, TEXT("settled", stage_names[which]), NUMBER("triangles", 0, (double)report.undecided),
        NUMBER("ns_a_triangle", 1, ns));
    free(mask);
    double_scene_free(&at[0]);
    double_scene_free(&at[1]);
}

static bool answer(asked *q)
{
    for (size_t k = 0; k < DOUBLE_SCENES; k++)
        if (!(asked_has(q, OPTION_QUICK) && double_scene_is_large(k)) && !run_scene(q, k))
            return false;
    printout_table(&q->out, "what a triangle costs that the first stage leaves undecided");
    for (stage_scene which = STAGE_DOUBLE; which < STAGE_SCENES; which++)
        run_stage(q, which);
    return true;
}

const bench_question question_doubles = {
    .name = "doubles",
    .asks = "What do meshes of doubles cost compared with floats, with reading their bytes, and with CGAL?",
    .options = 1u << OPTION_KERNEL | 1u << OPTION_QUICK,
    .answer = answer};
