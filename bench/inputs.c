/*
 * inputs.c - what does it cost to test triangles as they are: indexed, or nine floats each?
 *
 * The same triangles four times over: nine streams, nine floats a triangle, and indices of 32 and 16 bits into positions. `shared`
 * has half as many vertices as triangles, as meshes do, drawn at random. `reading` loads each byte of an input once.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/rivals.h"
#include "common/soups.h"
#include "common/asked.h"

/* A scene in every form. */
typedef struct forms {
    scene at;
    float *positions; /* of the indexed forms */
    uint32_t *wide;
    uint16_t *narrow; /* NULL where there are too many vertices */
    size_t vertices;
    tribox_mesh flat, wide_mesh, narrow_mesh;
    float *streams;   /* room for nine */
    uint64_t *inside; /* room for a mask */
} forms;

/* What a contestant answers: a form of the scene. */
typedef struct input {
    const forms *f;
    const tribox_mesh *mesh;
} input;

static const timing_job *job_of(const contestant *self) { return ((const input *)self->question)->f->at.work.jobs; }

static const tribox_mesh *mesh_of(const contestant *self) { return ((const input *)self->question)->mesh; }

CONTESTANT_RUN(run_streams) { return !tribox_overlap(&job_of(self)->soup, &job_of(self)->box, &self->options, mask, report); }

CONTESTANT_RUN(run_mesh) { return !tribox_mesh_overlap(mesh_of(self), &job_of(self)->box, &self->options, mask, report); }

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
    mask[0] = loads_words(m->positions, 3 * m->vertices);
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

/* The box of the scene turned about x by an angle of which e is the cosine and d the sine, then by 0.7 about z. */
static bool run_turned(const contestant *self, float e, float d, uint64_t *mask, tribox_report *report)
{
    const float c = 0.76484219f, s = 0.64421769f;
    tribox_oriented_box box = {.axis = {{c, s * e, s * d}, {-s, c * e, c * d}, {0, -d, e}}};
    for (int a = 0; a < 3; a++) {
        const double lo = job_of(self)->box.lo[a], hi = job_of(self)->box.hi[a];
        box.center[a] = (lo + hi) / 2;
        box.half[a] = (hi - lo) / 2;
    }
    return !tribox_overlap_oriented(&job_of(self)->soup, &box, &self->options, mask, report);
}

CONTESTANT_RUN(run_oriented) { return run_turned(self, 0.87758256f, 0.47942554f, mask, report); }

/* Its lower side stays in its plane, and so do triangles of scenes of contact. */
CONTESTANT_RUN(run_about_z) { return run_turned(self, 1, 0, mask, report); }

CONTESTANT_RUN(run_classify)
{
    uint64_t *const inside = ((const input *)self->question)->f->inside;
    return !tribox_classify(&job_of(self)->soup, &job_of(self)->box, &self->options, mask, inside, report);
}

/* The scene's own triangles, with a vertex for each corner; or, if is_shared, as many corners among count / 2 vertices. */
static void make_forms(size_t index, uint64_t seed, bool is_shared, forms *f)
{
    if (!scene_make(index, seed, &f->at))
        exit(EXIT_CODE_FAILURE);
    timing_work *const work = &f->at.work;
    const size_t count = work->pairs;
    const tribox_box box = work->jobs[0].box;
    generator g = {seed + 1};
    f->vertices = is_shared ? count / 2 : 3 * count;
    f->positions = asked_allocate(3 * f->vertices, sizeof(float));
    f->wide = asked_allocate(3 * count, sizeof *f->wide);
    f->narrow = f->vertices <= 65536 ? asked_allocate(3 * count, sizeof *f->narrow) : NULL;
    f->streams = asked_allocate(9 * count, sizeof(float));
    f->inside = asked_allocate(tribox_mask_words(count), sizeof *f->inside);
    memcpy(f->positions, work->triangles, 3 * f->vertices * sizeof(float));
    for (size_t corner = 0; corner < 3 * count; corner++) {
        f->wide[corner] = is_shared ? (uint32_t)random_below(&g, f->vertices) : (uint32_t)corner;
        if (f->narrow)
            f->narrow[corner] = (uint16_t)f->wide[corner];
        memcpy(work->triangles[corner / 3][corner % 3], f->positions + 3 * f->wide[corner], 3 * sizeof(float));
    }
    *work = (timing_work){.jobs = work->jobs, .memory = work->memory, .streams = work->streams, .triangles = work->triangles};
    const timing_job job = timing_work_soup(work, count);
    timing_work_add(work, &job, &box);
    f->flat = (tribox_mesh){.positions = work->triangles, .vertices = 3 * count, .count = count};
    f->wide_mesh =
        (tribox_mesh){.positions = f->positions, .vertices = f->vertices, .indices = f->wide, .index_bytes = 4, .count = count};
    f->narrow_mesh = f->wide_mesh;
    f->narrow_mesh.indices = f->narrow;
    f->narrow_mesh.index_bytes = 2;
}

static void free_forms(forms *f)
{
    scene_free(&f->at);
    free(f->positions);
    free(f->wide);
    free(f->narrow);
    free(f->streams);
    free(f->inside);
}

static size_t enter(const forms *f, const char *kernel, input *inputs, contestant *list)
{
    const struct {
        const char *name;
        contestant_run *run;
        const tribox_mesh *mesh;
        answer_promise promise;
    } all[] = {
        {"streams", run_streams, NULL, PROMISE_EXACT},
        {"nine floats", run_mesh, &f->flat, PROMISE_EXACT},
        {"32-bit indices", run_mesh, &f->wide_mesh, PROMISE_EXACT},
        {"16-bit indices", run_mesh, f->narrow ? &f->narrow_mesh : NULL, PROMISE_EXACT},
        {"reading nine floats", run_reading, &f->flat, PROMISE_NOTHING},
        {"reading 32-bit indices", run_reading, &f->wide_mesh, PROMISE_NOTHING},
        {"nine floats to streams", run_to_streams, &f->flat, PROMISE_NOTHING},
        {"indices to streams", run_to_streams, &f->wide_mesh, PROMISE_NOTHING},
        {"memcpy of nine floats", run_copy, NULL, PROMISE_NOTHING},
        {"any", run_any, NULL, PROMISE_NOTHING},
        {"inside", run_classify, NULL, PROMISE_EXACT},
        {"oriented", run_oriented, NULL, PROMISE_NOTHING}, /* another box: its answer is its own */
        {"oriented about z", run_about_z, NULL, PROMISE_NOTHING},
    };
    size_t count = 0;
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        if (all[k].run == run_mesh && !all[k].mesh)
            continue;
        inputs[count] = (input){f, all[k].mesh};
        list[count] = (contestant){.run = all[k].run,
                                   .question = &inputs[count],
                                   .options = {.kernel = kernel},
                                   .promise = all[k].promise,
                                   .pairs = (double)f->at.work.pairs};
        snprintf(list[count].name, sizeof list[count].name, "%s", all[k].name);
        count++;
    }
    return count;
}

static bool ask_scene(asked *q, const char *name, bool is_shared)
{
    contestant list[CONTESTANTS_MAX];
    input inputs[CONTESTANTS_MAX];
    forms f;
    size_t index;
    if (!scene_find(name, &index))
        return false;
    make_forms(index, q->seed, is_shared, &f);
    const truth from = truth_of_work(&f.at.work);
    const size_t count = enter(&f, q->kernel, inputs, list);
    const bool is_right = asked_measure(q, name, list, count, &from, asked_effort(q, 31, 8, 2e-3), f.at.work.words);
    if (is_right) {
        printout_table(&q->out, "%s%s: %zu triangles, %zu vertices", name, is_shared ? ", vertices shared" : "", f.at.work.pairs,
                       f.vertices);
        for (size_t c = 0; c < count; c++) {
            ADD(&q->out, TEXT("input", list[c].name));
            printout_times(&q->out, &q->taken, c);
            ROW(&q->out, NUMBER("times_streams", 4, measure_ratio(&q->taken, c, 0).median));
        }
        printout_disturbed(&q->out, &q->taken);
    }
    free_forms(&f);
    return is_right;
}

static bool answer(asked *q)
{
    static const struct {
        const char *scene;
        bool is_shared;
    } plan[] = {{"paper", false},  {"paper", true}, {"cache", true}, {"sorted", false},
                {"sparse", false}, {"hit", false},  {"cad", false},  {"touching", false}};
    bool is_right = true;
    for (size_t k = 0; is_right && k < sizeof plan / sizeof plan[0]; k++)
        is_right = ask_scene(q, plan[k].scene, plan[k].is_shared);
    return is_right;
}

const bench_question question_inputs = {.name = "inputs",
                                        .asks =
                                            "What do indexed meshes, and nine floats a triangle, cost compared with nine streams?",
                                        .options = 1u << OPTION_KERNEL | 1u << OPTION_QUICK,
                                        .answer = answer};
