/* ratios.c - how many times as fast as the paper's test is each kernel, and what does each accuracy cost? */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/box_scenes.h"
#include "common/rivals.h"
#include "files/files.h"
#include "paper/paper.h"
#include "read/mesh.h"

CONTESTANT_RUN(run_loads)
{
    const timing_work *const work = self->question;
    mask[0] = 0;
    for (size_t i = 0; i < work->count; i++)
        mask[0] ^= loads_all(&work->jobs[i].soup);
    return true;
}

CONTESTANT_RUN(run_plain)
{
    const timing_work *const work = self->question;
    for (size_t i = 0; i < work->count; i++) {
        unbranched_overlap(&work->jobs[i].soup, work->jobs[i].center, work->jobs[i].half, mask);
        mask += tribox_mask_words(work->jobs[i].soup.count);
    }
    return true;
}

/* A word of triangles at a time is copied to where the paper's test wants it. */
CONTESTANT_RUN(run_by_indices)
{
    const timing_work *const work = self->question;
    const timing_job *const job = work->jobs;
    const float *const positions = work->mesh.positions;
    const uint32_t *const corners = work->mesh.indices;
    paper_walk *const walk = paper_in_order(PAPER_ORDER);
    for (size_t first = 0; first < work->mesh.count; first += 64) {
        const size_t count = work->mesh.count - first < 64 ? work->mesh.count - first : 64;
        float triangles[64][3][3];
        for (size_t i = 0; i < count; i++)
            for (size_t v = 0; v < 3; v++)
                memcpy(triangles[i][v], positions + 3 * (size_t)corners[3 * (first + i) + v], sizeof triangles[i][v]);
        walk(job->center, job->half, (const float(*)[3][3])triangles, count, mask + first / 64);
    }
    return true;
}

/* The paper's test, the loads alone, the paper's test for compilers to vectorize, and every kernel. Returns how many. */
static size_t entries_make(const timing_work *work, contestant *list)
{
    const double pairs = (double)work->pairs;
    size_t count = 0;
    list[count] = contestant_paper(work, PAPER_ORDER);
    snprintf(list[count++].name, sizeof list[0].name, "baseline");
    list[count] = contestant_paper(work, 123);
    snprintf(list[count++].name, sizeof list[0].name, "baseline-123");
    if (work->mesh.count)
        list[count++] = (contestant){
            .name = "baseline-indexed", .run = run_by_indices, .question = work, .promise = PROMISE_ROUNDED, .pairs = pairs};
    list[count++] = (contestant){.name = "plain", .run = run_plain, .question = work, .promise = PROMISE_ROUNDED, .pairs = pairs};
    list[count++] = (contestant){.name = "loads", .run = run_loads, .question = work, .promise = PROMISE_NOTHING, .pairs = pairs};
    return count + contestants_enter(work, &list[count]);
}

/* Those that the filter keeps, the baseline first. */
static size_t keep_named(contestant *list, size_t count, const char *part)
{
    size_t kept = 0;
    for (size_t c = 0; c < count; c++)
        if (!part || c == 0 || strstr(list[c].name, part))
            list[kept++] = list[c];
    return kept;
}

static void tell_row(asked *q, const scene *at, const contestant *list, size_t c)
{
    printout *const out = &q->out;
    const size_t fast = contestant_fast_of(list, q->taken.contestants, c);
    const spread speed = measure_ratio(&q->taken, 0, c);
    const bool is_answer = list[c].promise != PROMISE_NOTHING;
    ADD(out, TEXT("contestant", list[c].name), TEXT_DATA("scene", at->name), DATA("triangles", at->work.pairs));
    printout_times(out, &q->taken, c);
    ROW(out, NUMBER("times_baseline's_speed", 2, speed.median), NUMBER("from", 2, speed.lower_quartile),
        NUMBER("to", 2, speed.upper_quartile), NUMBER("by_least", 2, measure_least(&q->taken, 0) / measure_least(&q->taken, c)),
        NUMBER_IF(fast != c, "times_own_fast's_ns", 2, measure_ratio(&q->taken, c, fast).median),
        NUMBER_IF(list[c].options.kernel, "undecided_%", 4, 100 * (double)q->scores[c].undecided / (double)at->work.pairs),
        NUMBER_IF(is_answer, "overlaps", 0, q->scores[c].overlapping),
        NUMBER_IF(is_answer, "unlike_EXACT", 0, score_unlike(&q->scores[c])));
}

static bool ask_about(asked *q, scene *at)
{
    contestant list[CONTESTANTS_MAX];
    const truth from = truth_of_work(&at->work);
    const tribox_box *const box = &at->work.jobs[0].box;
    char boxes[64];
    const size_t count = keep_named(list, entries_make(&at->work, list), q->text[OPTION_FILTER]);
    if (count == 1)
        return message_failure("no contestant here has '%s' in its name", q->text[OPTION_FILTER]) == EXIT_CODE_OK;
    if (!asked_measure(q, at->name, list, count, &from, asked_effort(q, 31, 8, 2e-3), at->work.words))
        return false;
    if (at->work.count > 1)
        snprintf(boxes, sizeof boxes, "%zu boxes of one to three steps", at->work.count);
    else
        snprintf(boxes, sizeof boxes, "box [%.8g, %.8g]^3", box->lo[0], box->hi[0]);
    printout_table(&q->out, "scene %s: %zu triangles (%.3g MB), %s; %s; %zu rounds", at->name, at->work.pairs,
                   36e-6 * (double)at->work.pairs, at->what, boxes, q->taken.rounds);
    for (size_t c = 0; c < count; c++)
        tell_row(q, at, list, c);
    printout_disturbed(&q->out, &q->taken);
    return true;
}

/* With the vertices and the order of the file. */
static bool make_mesh(const indexed_mesh *m, double share, scene *at)
{
    const float *const positions = m->positions.of;
    const uint32_t *const corners = m->corners.of;
    const size_t triangles = m->corners.count / 3;
    if (!scene_room(at, triangles))
        return false;
    for (size_t corner = 0; corner < 3 * triangles; corner++)
        memcpy(at->work.triangles[corner / 3][corner % 3], positions + 3 * (size_t)corners[corner], 3 * sizeof(float));
    scene_add(at, triangles, share);
    at->work.mesh = (tribox_mesh){
        .positions = positions, .vertices = m->positions.count, .indices = corners, .index_bytes = 4, .count = triangles};
    return true;
}

static bool ask_mesh(asked *q, const char *path)
{
    indexed_mesh m;
    bool is_right = mesh_list_read_indexed(path, &m);
    for (int part = 0; is_right && part < 2; part++) {
        scene at = {.name = path + named_file_folder(path), .what = part ? "a tenth of its sides" : "half its sides"};
        is_right = make_mesh(&m, part ? 0.1 : 0.5, &at) && ask_about(q, &at);
        scene_free(&at);
    }
    indexed_mesh_free(&m);
    return is_right;
}

static bool answer(asked *q)
{
    bool is_right = true;
    for (size_t k = 0; is_right && k < q->meshes.count; k++)
        is_right = ask_mesh(q, q->meshes.path[k]);
    return is_right && scenes_ask_named(q, NULL, q->meshes.count ? 0 : SIZE_MAX, true, ask_about);
}

const bench_question question_ratios = {.name = "ratios",
                                        .asks = "How many times as fast as the paper's test is each kernel, at each accuracy?",
                                        .options = 1u << OPTION_SCENE | 1u << OPTION_FILTER | 1u << OPTION_QUICK,
                                        .takes_meshes = true,
                                        .answer = answer};
