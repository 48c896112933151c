/*
 * inputs.c - three questions about a scene in every form: what does it cost to test triangles as they are, indexed or nine floats
 * each; what do doubles cost, against floats, against reading their bytes and against CGAL; and does CGAL, which is exact too,
 * answer the same?
 *
 * Everyone is asked about the same triangles in the same rounds. `reading` loads each byte of an input once. CGAL's triangles and
 * boxes are made before the clock runs; its answers have to be equal for all but degenerate triangles, which it does not take.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cgal_peer.h"
#include "common/box_scenes.h"
#include "common/draw.h"
#include "common/rivals.h"

/* ---- a scene in every form ------------------------------------------------------------------------------------------------- */

/* Of floats, and of doubles. */
typedef enum form { FLAT, WIDE, NARROW, NINE, INDEXED, MESH_FORMS } form;

/* A vertex for each corner; or half as many as triangles, as meshes have them: any of them, or one that is near in number. */
typedef enum corners { OWN, ANY, NEAR } corners;

/* The bits of a double that floats have not: zeros, any, or those of tenths. */
typedef enum filling { ZEROS, DRAWN, TENTHS } filling;

typedef struct recipe {
    const char *name, *scene;
    corners corners;
    filling filling;
    double offset; /* of doubles alone: floats could not tell the triangles apart */
    bool is_large;
} recipe;

static const recipe of_floats[] = {
    {"paper", "paper", OWN, ZEROS, 0, false},
    {"paper, vertices shared", "paper", ANY, ZEROS, 0, false},
    {"cache, vertices shared", "cache", ANY, ZEROS, 0, false},
    {"sorted", "sorted", OWN, ZEROS, 0, false},
    {"sparse", "sparse", OWN, ZEROS, 0, false},
    {"hit", "hit", OWN, ZEROS, 0, false},
    {"cad", "cad", OWN, ZEROS, 0, false},
    {"touching", "touching", OWN, ZEROS, 0, false},
};

static const recipe of_doubles[] = {
    {"cache", "cache", NEAR, DRAWN, 0, false},    {"paper", "paper", NEAR, DRAWN, 0, false},
    {"offset", "paper", NEAR, DRAWN, 1e7, false}, {"lattice", "lattice", NEAR, ZEROS, 0, false},
    {"tenths", "tenths", NEAR, TENTHS, 0, false}, {"sorted", "sorted", OWN, DRAWN, 0, false},
    {"memory", "memory", NEAR, DRAWN, 0, true},
};

enum { NEARNESS = 32, STAGED = 20000, PEER_TRIANGLES = 16384 /* CGAL takes seconds for more where it needs exact numbers */ };

typedef struct forms {
    scene at;
    tribox_mesh mesh[MESH_FORMS]; /* without triangles where a form is not there */
    tribox_box box;               /* of the doubles */
    float *streams;               /* room for nine */
    uint64_t *inside;             /* room for a mask */
} forms;

/* What a contestant answers: a form of the scene. */
typedef struct input {
    const forms *f;
    const tribox_mesh *mesh;
} input;

static double uniform(generator *g, double least, double most)
{
    return least + (most - least) * ((double)(random_bits(g) >> 11) * 0x1p-53);
}

static double as_double(generator *g, float x, const recipe *from)
{
    const double wide = (double)x;
    return from->offset + (from->filling == DRAWN    ? wide * (1 + uniform(g, -0x1p-25, 0x1p-25))
                           : from->filling == TENTHS ? round(10 * wide) / 10
                                                     : wide);
}

static size_t corner_vertex(generator *g, corners how, size_t corner, size_t count, size_t vertices)
{
    const double about = (double)corner / (double)(3 * count) * (double)(vertices - 3 * NEARNESS);
    return how == OWN   ? corner
           : how == ANY ? random_below(g, vertices)
                        : (size_t)about + corner % 3 * NEARNESS + random_below(g, NEARNESS);
}

/* The corners' places in both widths, and the scene's own triangles and streams as they say. */
static void make_floats(const recipe *from, generator *g, forms *f)
{
    timing_work *const work = &f->at.work;
    const size_t count = work->pairs, vertices = from->corners == OWN ? 3 * count : count / 2;
    const tribox_box box = work->jobs[0].box;
    float(*const positions)[3] = asked_allocate(vertices, sizeof *positions);
    uint32_t *const wide = asked_allocate(3 * count, sizeof *wide);
    uint16_t *const narrow = vertices <= 65536 ? asked_allocate(3 * count, sizeof *narrow) : NULL;
    memcpy(positions, work->triangles, vertices * sizeof *positions);
    for (size_t corner = 0; corner < 3 * count; corner++) {
        wide[corner] = (uint32_t)corner_vertex(g, from->corners, corner, count, vertices);
        if (narrow)
            narrow[corner] = (uint16_t)wide[corner];
        memcpy(work->triangles[corner / 3][corner % 3], positions[wide[corner]], sizeof *positions);
    }
    *work = (timing_work){.jobs = work->jobs, .memory = work->memory, .streams = work->streams, .triangles = work->triangles};
    const timing_job job = timing_work_soup(work, count);
    timing_work_add(work, &job, &box);
    f->mesh[FLAT] = (tribox_mesh){.positions = work->triangles, .vertices = 3 * count, .count = count, .position_bytes = 4};
    f->mesh[WIDE] = (tribox_mesh){
        .positions = positions, .vertices = vertices, .indices = wide, .index_bytes = 4, .count = count, .position_bytes = 4};
    if (narrow) {
        f->mesh[NARROW] = f->mesh[WIDE];
        f->mesh[NARROW].indices = narrow;
        f->mesh[NARROW].index_bytes = 2;
    }
}

static void make_doubles(const recipe *from, generator *g, forms *f)
{
    const tribox_mesh *const single = &f->mesh[WIDE];
    const float *const positions = single->positions;
    const uint32_t *const vertex = single->indices;
    const tribox_box *const box = &f->at.work.jobs[0].box;
    double(*const wide)[3] = asked_allocate(single->vertices, sizeof *wide);
    double(*const nine)[3] = asked_allocate(3 * single->count, sizeof *nine);
    for (size_t k = 0; k < 3 * single->vertices; k++)
        wide[k / 3][k % 3] = as_double(g, positions[k], from);
    for (size_t corner = 0; corner < 3 * single->count; corner++)
        memcpy(nine[corner], wide[vertex[corner]], sizeof *nine);
    for (int a = 0; a < 3; a++) {
        f->box.lo[a] = from->offset + (from->filling == TENTHS ? round(10 * box->lo[a]) / 10 : box->lo[a]);
        f->box.hi[a] = from->offset + (from->filling == TENTHS ? round(10 * box->hi[a]) / 10 : box->hi[a]);
    }
    f->mesh[INDEXED] = *single;
    f->mesh[INDEXED].positions = wide;
    f->mesh[INDEXED].position_bytes = 8;
    f->mesh[NINE] = (tribox_mesh){.positions = nine, .vertices = 3 * single->count, .count = single->count, .position_bytes = 8};
}

static bool make_forms(const recipe *from, uint64_t seed, bool has_doubles, forms *f)
{
    generator g = {seed + 1};
    *f = (forms){.streams = NULL};
    if (!scene_make(from->scene, seed, false, &f->at))
        return false;
    make_floats(from, &g, f);
    if (has_doubles)
        make_doubles(from, &g, f);
    else {
        f->streams = asked_allocate(9 * f->at.work.pairs, sizeof(float));
        f->inside = asked_allocate(f->at.work.words, sizeof *f->inside);
    }
    return true;
}

/* ---- who is timed ---------------------------------------------------------------------------------------------------------- */

static const timing_job *job_of(const contestant *self) { return ((const input *)self->question)->f->at.work.jobs; }

static const tribox_mesh *mesh_of(const contestant *self) { return ((const input *)self->question)->mesh; }

CONTESTANT_RUN(run_streams) { return !tribox_overlap(&job_of(self)->soup, &job_of(self)->box, &self->options, mask, report); }

CONTESTANT_RUN(run_mesh)
{
    const forms *const f = ((const input *)self->question)->f;
    const tribox_box *const box = mesh_of(self)->position_bytes == sizeof(double) ? &f->box : &f->at.work.jobs->box;
    return !tribox_mesh_overlap(mesh_of(self), box, &self->options, mask, report);
}

CONTESTANT_RUN(run_to_streams)
{
    const forms *const f = ((const input *)self->question)->f;
    const size_t count = job_of(self)->soup.count;
    float *to[9];
    for (size_t k = 0; k < 9; k++)
        to[k] = f->streams + k * count;
    return !tribox_mesh_to_soup(mesh_of(self), NULL, 0, count, &self->options, to, to + 3, to + 6);
}

CONTESTANT_RUN(run_copy)
{
    memcpy(((const input *)self->question)->f->streams, job_of(self)->triangles, 9 * job_of(self)->soup.count * sizeof(float));
    return true;
}

CONTESTANT_RUN(run_reading)
{
    const tribox_mesh *const m = mesh_of(self);
    mask[0] = loads_words(m->positions, 3 * m->vertices * m->position_bytes / sizeof(uint32_t));
    if (m->indices)
        mask[0] ^= loads_words(m->indices, 3 * m->count * m->index_bytes / sizeof(uint32_t));
    return true;
}

CONTESTANT_RUN(run_any)
{
    size_t first;
    const bool is_answered = !tribox_find(&job_of(self)->soup, &job_of(self)->box, &self->options, TRIBOX_FIRST_HIT, &first);
    mask[0] = first;
    return is_answered;
}

static bool run_turned(const contestant *self, float e, float d, uint64_t *mask, tribox_report *report)
{
    const tribox_oriented_box box = scene_turned(&job_of(self)->box, e, d);
    return !tribox_overlap_oriented(&job_of(self)->soup, &box, &self->options, mask, report);
}

CONTESTANT_RUN(run_oriented) { return run_turned(self, SCENE_TURN, mask, report); }

/* Its lower side stays in its plane, and so do triangles of scenes of contact. */
CONTESTANT_RUN(run_about_z) { return run_turned(self, 1, 0, mask, report); }

CONTESTANT_RUN(run_classify)
{
    uint64_t *const inside = ((const input *)self->question)->f->inside;
    return !tribox_classify(&job_of(self)->soup, &job_of(self)->box, &self->options, mask, inside, report);
}

CONTESTANT_RUN(run_peer)
{
    cgal_peer_answer(self->question, mask);
    return true;
}

/* The truth about doubles; of floats it is that about the work. */
static bool find_truth(const void *question, unsigned axes, uint64_t *mask)
{
    const forms *const f = question;
    return !tribox_mesh_overlap(&f->mesh[NINE], &f->box, &(tribox_options){.axes = axes, .kernel = "scalar"}, mask, NULL);
}

typedef struct entry {
    const char *name;
    contestant_run *run;
    form form;
    answer_promise promise;
} entry;

static const entry inputs[] = {
    {"streams", run_streams, FLAT, PROMISE_EXACT},
    {"nine floats", run_mesh, FLAT, PROMISE_EXACT},
    {"32-bit indices", run_mesh, WIDE, PROMISE_EXACT},
    {"16-bit indices", run_mesh, NARROW, PROMISE_EXACT},
    {"reading nine floats", run_reading, FLAT, PROMISE_NOTHING},
    {"reading 32-bit indices", run_reading, WIDE, PROMISE_NOTHING},
    {"nine floats to streams", run_to_streams, FLAT, PROMISE_NOTHING},
    {"indices to streams", run_to_streams, WIDE, PROMISE_NOTHING},
    {"memcpy of nine floats", run_copy, FLAT, PROMISE_NOTHING},
    {"any", run_any, FLAT, PROMISE_NOTHING},
    {"inside", run_classify, FLAT, PROMISE_EXACT},
    {"oriented", run_oriented, FLAT, PROMISE_NOTHING}, /* another box: its answer is its own */
    {"oriented about z", run_about_z, FLAT, PROMISE_NOTHING},
};

/* Whom each is held against. */
enum { FLOAT_NINE, FLOAT_INDEXED, DOUBLE_NINE, DOUBLE_INDEXED, READ_NINE, READ_INDEXED, PEER, ENTRIES };

static const entry doubles[PEER] = {
    [FLOAT_NINE] = {"nine floats", run_mesh, FLAT, PROMISE_NOTHING},
    [FLOAT_INDEXED] = {"indexed floats", run_mesh, WIDE, PROMISE_NOTHING},
    [DOUBLE_NINE] = {"nine doubles", run_mesh, NINE, PROMISE_EXACT},
    [DOUBLE_INDEXED] = {"indexed doubles", run_mesh, INDEXED, PROMISE_EXACT},
    [READ_NINE] = {"reading nine doubles", run_reading, NINE, PROMISE_NOTHING},
    [READ_INDEXED] = {"reading indexed doubles", run_reading, INDEXED, PROMISE_NOTHING},
};

static size_t enter(const forms *f, const entry *all, size_t entries, const char *kernel, input *asked_of, contestant *list)
{
    size_t count = 0;
    for (size_t k = 0; k < entries; k++) {
        if (!f->mesh[all[k].form].count)
            continue;
        asked_of[count] = (input){f, &f->mesh[all[k].form]};
        list[count] = (contestant){.run = all[k].run,
                                   .question = &asked_of[count],
                                   .options = {.kernel = kernel},
                                   .promise = all[k].promise,
                                   .pairs = (double)f->at.work.pairs};
        snprintf(list[count].name, sizeof list[count].name, "%s", all[k].name);
        count++;
    }
    return count;
}

/* How many triangles CGAL answers otherwise that are degenerate, or are not. other: room for its answer. */
static size_t count_unlike(const cgal_peer *peer, const uint64_t *exact, uint64_t *other, size_t count, bool degenerate)
{
    size_t unlike = 0;
    cgal_peer_answer(peer, other);
    for (size_t i = 0; i < count; i++)
        unlike += ((exact[i / 64] ^ other[i / 64]) >> i % 64 & 1) && cgal_peer_is_degenerate(peer, i) == degenerate;
    return unlike;
}

static contestant peer_contestant(cgal_way way, const double *nine, size_t count, const tribox_box *box)
{
    static const char *const names[CGAL_WAYS] = {"cgal-epick-bbox", "cgal-epick-cuboid", "cgal-epeck-bbox", "cgal-epeck-cuboid"};
    contestant made = {
        .run = run_peer, .question = cgal_version ? cgal_peer_make(way, nine, count, box) : NULL, .pairs = (double)count};
    snprintf(made.name, sizeof made.name, "%s", names[way]);
    return made;
}

static void free_peer(const contestant *peer)
{
    if (peer->question)
        cgal_peer_free((cgal_peer *)(uintptr_t)peer->question);
}

/* Asks about the scenes of all recipes, but for large ones if it shall be quick. */
static bool ask_each(asked *q, const recipe *all, size_t count, bool has_doubles,
                     bool (*ask)(asked *q, const recipe *from, const forms *f))
{
    bool is_right = true;
    for (const recipe *from = all; is_right && from < all + count; from++) {
        void *const mark = asked_mark();
        forms f;
        if (asked_has(q, OPTION_QUICK) && from->is_large)
            continue;
        is_right = make_forms(from, q->seed, has_doubles, &f) && ask(q, from, &f);
        scene_free(&f.at);
        asked_release(mark);
    }
    return is_right;
}

/* ---- inputs ---------------------------------------------------------------------------------------------------------------- */

static bool ask_floats(asked *q, const recipe *from, const forms *f)
{
    contestant list[CONTESTANTS_MAX];
    input asked_of[CONTESTANTS_MAX];
    const truth about = truth_of_work(&f->at.work);
    const size_t count = enter(f, inputs, sizeof inputs / sizeof inputs[0], q->kernel, asked_of, list);
    if (!asked_measure(q, from->name, list, count, &about, asked_effort(q, 31, 8, 2e-3), about.words))
        return false;
    printout_table(&q->out, "%s: %zu triangles, %zu vertices", from->name, f->at.work.pairs, f->mesh[WIDE].vertices);
    for (size_t c = 0; c < count; c++) {
        ADD(&q->out, TEXT("input", list[c].name));
        printout_times(&q->out, &q->taken, c);
        ROW(&q->out, NUMBER("times_streams", 4, measure_ratio(&q->taken, c, 0).median));
    }
    printout_disturbed(&q->out, &q->taken);
    return true;
}

static bool answer_inputs(asked *q) { return ask_each(q, of_floats, sizeof of_floats / sizeof of_floats[0], false, ask_floats); }

/* ---- doubles --------------------------------------------------------------------------------------------------------------- */

static void tell_doubles(asked *q, const recipe *from, const forms *f, const contestant *list, size_t count)
{
    const double triangles = (double)f->at.work.pairs;
    double ns[ENTRIES];
    for (size_t k = 0; k < count; k++)
        ns[k] = measure_least(&q->taken, k);
    printout_table(&q->out, "%s: %.0f triangles, %s, moved by %g; %.3f %% left to slower stages", from->name, triangles, f->at.what,
                   from->offset, 100 * (double)q->scores[DOUBLE_NINE].undecided / triangles);
    for (size_t k = 0; k < count; k++) {
        const bool is_double = k == DOUBLE_NINE || k == DOUBLE_INDEXED;
        ADD(&q->out, TEXT("triangles", k == PEER ? "CGAL's Epick" : list[k].name), TEXT_DATA("scene", from->name));
        printout_times(&q->out, &q->taken, k);
        ROW(&q->out, NUMBER_IF(is_double, "times_floats", 3, ns[k] / ns[k - DOUBLE_NINE + FLOAT_NINE]),
            NUMBER_IF(is_double, "times_reading", 3, ns[k] / ns[k - DOUBLE_NINE + READ_NINE]),
            NUMBER_IF(k == PEER, "times_nine_doubles", 1, ns[k] / ns[DOUBLE_NINE]));
    }
    printout_disturbed(&q->out, &q->taken);
}

static bool ask_doubles(asked *q, const recipe *from, const forms *f)
{
    input asked_of[ENTRIES];
    contestant list[ENTRIES];
    const truth about = {find_truth, f, f->at.work.words};
    const size_t count = enter(f, doubles, PEER, q->kernel, asked_of, list),
                 asked_of_peer = f->at.work.pairs < PEER_TRIANGLES ? f->at.work.pairs : PEER_TRIANGLES;
    list[PEER] = peer_contestant(CGAL_EPICK_BBOX, f->mesh[NINE].positions, asked_of_peer, &f->box);
    uint64_t *const exact = asked_allocate(about.words, sizeof *exact), *const other = asked_allocate(about.words, sizeof *other);
    const cgal_peer *const peer = list[PEER].question;
    bool is_right = find_truth(f, TRIBOX_AXES_ALL, exact);
    if (peer && count_unlike(peer, exact, other, asked_of_peer, false))
        is_right = message_failure("%s: CGAL answers otherwise on triangles that are not degenerate", from->name) == EXIT_CODE_OK;
    is_right =
        is_right && asked_measure(q, from->name, list, count + (peer != NULL), &about, asked_effort(q, 51, 8, 1e-3), about.words);
    if (is_right)
        tell_doubles(q, from, f, list, count + (peer != NULL));
    free_peer(&list[PEER]);
    return is_right;
}

/* Nine doubles each, against a box for which the first stage leaves what the box normals do not separate. */
typedef enum stage {
    STAGE_NONE,   /* an ordinary box: none are left */
    STAGE_DOUBLE, /* a flat box */
    STAGE_ULP,    /* within units of the last place of contact */
    STAGE_SHORT,  /* numbers below 2^-200, few bits apart */
    STAGE_LONG,   /* exponents from end to end */
    STAGES
} stage;

static void draw_staged(generator *g, stage which, double u[9])
{
    triangle t;
    if (which == STAGE_ULP)
        draw_touching(g, t);
    for (int k = 0; k < 9; k++) {
        const double x = which == STAGE_ULP ? (double)t[k / 3][k % 3] / 3 : uniform(g, -2, 2); /* contact that no double has */
        u[k] = which == STAGE_SHORT ? ldexp(x, -600) : which == STAGE_LONG ? ldexp(x, (int)random_below(g, 2000) - 1000) : x;
    }
}

static void make_stage(stage which, forms *f)
{
    generator g = {1};
    double(*const nine)[9] = asked_allocate(STAGED, sizeof *nine);
    *f = (forms){.streams = NULL};
    for (size_t i = 0; i < STAGED; i++)
        draw_staged(&g, which, nine[i]);
    for (int a = 0; a < 3; a++) {
        const double half = which == STAGE_SHORT ? 0x1p-601 : which == STAGE_ULP ? 0.5 / 3 : 0.5;
        f->box.lo[a] = -half;
        f->box.hi[a] = which == STAGE_DOUBLE && a == 2 ? -half : half;
    }
    f->mesh[NINE] = (tribox_mesh){.positions = nine, .vertices = 3 * STAGED, .count = STAGED, .position_bytes = 8};
}

/*
 * What each triangle that the first stage leaves takes beyond those that it decides: the box normals of ordinary triangles, of the
 * first scene of these.
 */
static void ask_stage(asked *q, stage which)
{
    static const char *const names[STAGES] = {"none", "in double", "an ulp off contact", "in integers of 60 bits",
                                              "in long integers"};
    void *const mark = asked_mark();
    forms at[2];
    input asked_of[2];
    contestant list[2];
    tribox_report report = {0, 0};
    uint64_t mask[STAGED / 64 + 1];
    make_stage(STAGE_NONE, &at[0]);
    make_stage(which, &at[1]);
    for (int k = 0; k < 2; k++) {
        asked_of[k] = (input){&at[k], &at[k].mesh[NINE]};
        list[k] = (contestant){.name = "stage",
                               .run = run_mesh,
                               .question = &asked_of[k],
                               .options = {.axes = k ? TRIBOX_AXES_ALL : TRIBOX_AXES_BOX, .kernel = q->kernel},
                               .pairs = STAGED};
    }
    if (!list[1].run(&list[1], mask, &report))
        exit(message_failure("the library refuses a scene"));
    asked_measure(q, "stage", list, 2, NULL, asked_effort(q, 51, 8, 1e-3), tribox_mask_words(STAGED));
    const double more = measure_least(&q->taken, 1) - measure_least(&q->taken, 0);
    ROW(&q->out, TEXT("settled", names[which]), NUMBER("triangles", 0, report.undecided),
        NUMBER("ns_a_triangle", 1, report.undecided ? more * STAGED / (double)report.undecided : 0));
    asked_release(mark);
}

static bool answer_doubles(asked *q)
{
    if (!ask_each(q, of_doubles, sizeof of_doubles / sizeof of_doubles[0], true, ask_doubles))
        return false;
    printout_table(&q->out, "what a triangle costs that the first stage leaves undecided");
    for (stage which = STAGE_DOUBLE; which < STAGES; which++)
        ask_stage(q, which);
    return true;
}

/* ---- cgal ------------------------------------------------------------------------------------------------------------------ */

/* EXACT of every kernel, then the peers. */
static size_t enter_peers(const timing_work *work, contestant *list)
{
    const timing_job *const job = work->jobs;
    double *const nine = asked_allocate(9 * work->pairs, sizeof *nine);
    size_t count = 0;
    const char *kernel;
    for (size_t k = 0; k < 9 * work->pairs; k++)
        nine[k] = (double)job->triangles[k / 9][k / 3 % 3][k % 3];
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++)
        list[count++] = contestant_kernel(work, &(tribox_options){.kernel = kernel});
    for (cgal_way way = CGAL_EPICK_BBOX; way < CGAL_WAYS; way++) {
        list[count] = peer_contestant(way, nine, work->pairs, &job->box);
        list[count++].promise = PROMISE_ROUNDED; /* of degenerate triangles CGAL promises nothing */
    }
    return count;
}

static bool ask_peers(asked *q, scene *at)
{
    timing_work_shorten(&at->work, PEER_TRIANGLES);
    contestant list[CONTESTANTS_MAX];
    const size_t count = enter_peers(&at->work, list), pairs = at->work.pairs, words = at->work.words, kernels = count - CGAL_WAYS;
    size_t avx2 = 0;
    uint64_t *const exact = asked_allocate(words, sizeof *exact), *const other = asked_allocate(words, sizeof *other);
    const truth from = truth_of_work(&at->work);
    const bool is_timed = !asked_has(q, OPTION_VERIFY);
    bool is_right = asked_verify(q, at->name, list, count, &from) && from.find(&at->work, TRIBOX_AXES_ALL, exact);
    if (is_right && is_timed)
        asked_measure(q, at->name, list, count, NULL, asked_effort(q, 15, 3, 2e-3), words);
    for (size_t c = 0; c < kernels; c++)
        avx2 = strcmp(list[c].name, "avx2-exact") != 0 ? avx2 : c;
    printout_table(&q->out, "scene %s: %zu triangles, %s", at->name, pairs, at->what);
    for (size_t c = 0; is_right && c < count; c++) {
        const cgal_peer *const peer = c < kernels ? NULL : list[c].question;
        const size_t proper = peer ? count_unlike(peer, exact, other, pairs, false) : 0;
        ADD(&q->out, TEXT("contestant", list[c].name), TEXT_DATA("scene", at->name), NUMBER("unlike_EXACT", 0, proper),
            NUMBER("of_degenerate", 0, peer ? (double)count_unlike(peer, exact, other, pairs, true) : 0));
        if (is_timed) {
            printout_times(&q->out, &q->taken, c);
            ADD(&q->out, NUMBER("times_the_widest", 1, measure_ratio(&q->taken, c, 0).median),
                NUMBER("times_avx2", 1, measure_ratio(&q->taken, c, avx2).median));
        }
        printout_row(&q->out);
        is_right = !proper || message_failure("%s: CGAL answers otherwise on triangles that are not degenerate", at->name) == 0;
    }
    if (is_timed)
        printout_disturbed(&q->out, &q->taken);
    for (size_t c = kernels; c < count; c++)
        free_peer(&list[c]);
    return is_right;
}

static bool answer_cgal(asked *q)
{
    if (!cgal_version)
        return message_failure("built without CGAL (Debian: libcgal-dev)") == EXIT_CODE_OK;
    printout_note(&q->out, "CGAL       %s, in C++17 with -O3 and without its assertions", cgal_version());
    return scenes_ask_named(q, scenes_compared, SCENES_COMPARED, false, ask_peers);
}

const bench_question question_inputs = {.name = "inputs",
                                        .asks =
                                            "What do indexed meshes, and nine floats a triangle, cost compared with nine streams?",
                                        .options = 1u << OPTION_KERNEL | 1u << OPTION_QUICK,
                                        .answer = answer_inputs};
const bench_question question_doubles = {
    .name = "doubles",
    .asks = "What do meshes of doubles cost compared with floats, with reading their bytes, and with CGAL?",
    .options = 1u << OPTION_KERNEL | 1u << OPTION_QUICK,
    .answer = answer_doubles};
const bench_question question_cgal = {.name = "cgal",
                                      .asks = "Is CGAL's exact answer the same, and how long does it take?",
                                      .options = 1u << OPTION_VERIFY | 1u << OPTION_SCENE | 1u << OPTION_QUICK,
                                      .answer = answer_cgal};
