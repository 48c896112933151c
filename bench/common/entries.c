/* entries.c - makes the usual field. */
#include "entries.h"

#include <stdio.h>
#include <string.h>

#include "loads.h"
#include "paper/paper.h"
#include "unbranched.h"

static bool run_loads(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const timing_work *const work = self->question;
    (void)report;
    mask[0] = 0;
    for (size_t i = 0; i < work->count; i++)
        mask[0] ^= loads_all(&work->jobs[i].soup);
    return true;
}

static bool run_plain(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const timing_work *const work = self->question;
    for (size_t i = 0; i < work->count; i++) {
        unbranched_overlap(&work->jobs[i].soup, work->jobs[i].center, work->jobs[i].half, mask);
        mask += tribox_mask_words(work->jobs[i].soup.count);
    }
    if (report)
        *report = (tribox_report){0, 0};
    return true;
}

/* A word of triangles at a time is copied to where the paper's test wants it. */
static bool run_by_indices(const contestant *self, uint64_t *mask, tribox_report *report)
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
    if (report)
        *report = (tribox_report){0, 0};
    return true;
}

size_t entries_make(const timing_work *work, contestant *list)
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

size_t entry_fast_of(const contestant *list, size_t count, size_t c)
{
    const tribox_options *const own = &list[c].options;
    for (size_t f = 0; own->kernel && f < count; f++) {
        const tribox_options *const other = &list[f].options;
        if (other->kernel && other->accuracy == TRIBOX_FAST && other->axes == own->axes && !strcmp(own->kernel, other->kernel))
            return f;
    }
    return c;
}
