#include "order_work.h"

#include <stdlib.h>
#include <string.h>

enum { CACHE_LINE = 64, LINE_FLOATS = CACHE_LINE / sizeof(float) };

size_t order_work_room(size_t triangles) { return (triangles + LINE_FLOATS - 1) / LINE_FLOATS * LINE_FLOATS; }

bool order_work_make(order_work *work, size_t jobs, size_t room)
{
    const size_t floats = 9 * sizeof(float);
    *work = (order_work){.jobs = NULL};
    if (room > SIZE_MAX / floats || jobs > SIZE_MAX / sizeof(order_job))
        return false;
    work->jobs = malloc(jobs * sizeof *work->jobs);
    work->streams = aligned_alloc(CACHE_LINE, room * floats);
    work->triangles = aligned_alloc(CACHE_LINE, room * floats);
    if (work->jobs && work->streams && work->triangles)
        return true;
    order_work_free(work);
    return false;
}

order_job order_work_soup(order_work *work, size_t count)
{
    const size_t stride = order_work_room(count);
    const float(*const triangles)[3][3] = (const float(*)[3][3])(work->triangles + work->used);
    float *to = work->streams + 9 * work->used;
    order_job job = {.soup = {.count = count}, .triangles = triangles};
    const float **const streams[3] = {job.soup.x, job.soup.y, job.soup.z};
    for (size_t a = 0; a < 3; a++)
        for (size_t j = 0; j < 3; j++, to += stride) {
            for (size_t i = 0; i < count; i++)
                to[i] = triangles[i][j][a];
            streams[a][j] = to;
        }
    work->used += stride;
    return job;
}

order_job order_work_copy(order_work *work, const tribox_soup *soup, const size_t *which, size_t count)
{
    const float *const *const streams[3] = {soup->x, soup->y, soup->z};
    float(*const triangles)[3][3] = work->triangles + work->used;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < 3; j++)
            for (size_t a = 0; a < 3; a++)
                triangles[i][j][a] = streams[a][j][which ? which[i] : i];
    return order_work_soup(work, count);
}

void order_work_add(order_work *work, const order_job *job)
{
    work->jobs[work->count++] = *job;
    work->pairs += job->soup.count;
    work->words += tribox_mask_words(job->soup.count);
}

void order_work_free(order_work *work)
{
    free(work->jobs);
    free(work->streams);
    free(work->triangles);
    *work = (order_work){.jobs = NULL};
}
