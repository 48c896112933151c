/* contestant.c - the paper's test and tribox's kernels as contestants. */
#include "contestant.h"

#include <stdio.h>

#include "console/accuracy.h"
#include "paper/paper.h"

static bool run_paper(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const timing_work *const work = self->question;
    paper_walk *const walk = paper_in_order(self->options.axis_order);
    for (size_t i = 0; i < work->count; i++) {
        const timing_job *const job = &work->jobs[i];
        walk(job->center, job->half, job->triangles, job->soup.count, mask);
        mask += tribox_mask_words(job->soup.count);
    }
    if (report)
        *report = (tribox_report){0, 0};
    return true;
}

static bool run_kernel(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const timing_work *const work = self->question;
    tribox_report total = {0, 0}, of_job;
    for (size_t i = 0; i < work->count; i++) {
        const timing_job *const job = &work->jobs[i];
        if (tribox_overlap(&job->soup, &job->box, &self->options, mask, report ? &of_job : NULL))
            return false;
        mask += tribox_mask_words(job->soup.count);
        if (report) {
            total.overlapping += of_job.overlapping;
            total.undecided += of_job.undecided;
        }
    }
    if (report)
        *report = total;
    return true;
}

contestant contestant_paper(const timing_work *work, unsigned order)
{
    return (contestant){.name = "paper",
                        .run = run_paper,
                        .question = work,
                        .options = {.accuracy = TRIBOX_FAST, .axes = TRIBOX_AXES_ALL, .axis_order = order},
                        .promise = PROMISE_ROUNDED,
                        .pairs = (double)work->pairs};
}

contestant contestant_kernel(const timing_work *work, const tribox_options *options)
{
    contestant one = {.run = run_kernel,
                      .question = work,
                      .options = *options,
                      .promise = options->accuracy == TRIBOX_EXACT          ? PROMISE_EXACT
                                 : options->accuracy == TRIBOX_CONSERVATIVE ? PROMISE_SUPERSET
                                                                            : PROMISE_ROUNDED,
                      .pairs = (double)work->pairs};
    snprintf(one.name, sizeof one.name, "%s-%s", options->kernel, accuracy_word(options->accuracy));
    return one;
}

static bool run_mesh(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const timing_work *const work = self->question;
    return !tribox_mesh_overlap(&work->mesh, &work->jobs[0].box, &self->options, mask, report);
}

contestant contestant_mesh(const timing_work *work, const char *kernel)
{
    contestant one = contestant_kernel(work, &(tribox_options){.kernel = kernel});
    one.run = run_mesh;
    snprintf(one.name, sizeof one.name, "%s-mesh", kernel);
    return one;
}

size_t contestants_enter(const timing_work *work, contestant *list)
{
    static const tribox_accuracy accuracies[] = {TRIBOX_FAST, TRIBOX_CONSERVATIVE, TRIBOX_EXACT};
    const char *kernel;
    size_t count = 0;
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++) {
        for (size_t a = 0; a < sizeof accuracies / sizeof accuracies[0]; a++)
            list[count++] = contestant_kernel(work, &(tribox_options){.accuracy = accuracies[a], .kernel = kernel});
        if (work->mesh.count)
            list[count++] = contestant_mesh(work, kernel);
    }
    return count;
}

bool contestant_truth(const void *work, unsigned axes, uint64_t *mask)
{
    const contestant scalar = contestant_kernel(work, &(tribox_options){.axes = axes, .kernel = "scalar"});
    return run_kernel(&scalar, mask, NULL);
}
