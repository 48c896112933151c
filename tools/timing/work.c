/* work.c - soups and boxes to time. */
#include "work.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "weld.h"

enum { CACHE_LINE = 64, LINE_FLOATS = CACHE_LINE / sizeof(float) };

size_t timing_work_room(size_t triangles) { return (triangles + LINE_FLOATS - 1) / LINE_FLOATS * LINE_FLOATS; }

bool timing_work_make(timing_work *work, size_t jobs, size_t room)
{
    const size_t bytes = 9 * sizeof(float);
    *work = (timing_work){.jobs = NULL};
    if (room > (SIZE_MAX - CACHE_LINE) / (2 * bytes) || jobs > SIZE_MAX / sizeof(timing_job))
        return false;
    work->jobs = malloc(jobs * sizeof *work->jobs);
    work->memory = malloc(2 * room * bytes + CACHE_LINE);
    if (!work->jobs || !work->memory) {
        timing_work_free(work);
        return false;
    }
    unsigned char *const first = (unsigned char *)work->memory + (CACHE_LINE - (uintptr_t)work->memory % CACHE_LINE);
    work->streams = (float *)(void *)first;
    work->triangles = (float(*)[3][3])(void *)(first + room * bytes);
    return true;
}

timing_job timing_work_soup(timing_work *work, size_t count)
{
    const size_t stride = timing_work_room(count);
    const float(*const triangles)[3][3] = (const float(*)[3][3])(work->triangles + work->used);
    float *to = work->streams + 9 * work->used;
    timing_job job = {.soup = {.count = count}, .triangles = triangles};
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

timing_job timing_work_copy(timing_work *work, const tribox_soup *soup, const uint32_t *which, size_t count)
{
    const float *const *const streams[3] = {soup->x, soup->y, soup->z};
    float(*const triangles)[3][3] = work->triangles + work->used;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < 3; j++)
            for (size_t a = 0; a < 3; a++)
                triangles[i][j][a] = streams[a][j][which ? which[i] : i];
    return timing_work_soup(work, count);
}

void timing_work_add(timing_work *work, const timing_job *job, const tribox_box *box)
{
    timing_job *const added = &work->jobs[work->count++];
    *added = *job;
    added->box = *box;
    for (int a = 0; a < 3; a++) {
        added->center[a] = (float)box->lo[a] / 2 + (float)box->hi[a] / 2;
        added->half[a] = (float)box->hi[a] / 2 - (float)box->lo[a] / 2;
    }
    work->pairs += job->soup.count;
    work->words += tribox_mask_words(job->soup.count);
}

bool timing_work_mesh(timing_work *work)
{
    const tribox_soup *const soup = &work->jobs[0].soup;
    work->positions = malloc(9 * soup->count * sizeof(float));
    work->corners = malloc(3 * soup->count * sizeof(uint32_t));
    const bool has_room = work->positions && work->corners;
    const size_t vertices = has_room ? weld_soup(soup, work->positions, work->corners) : 0;
    work->mesh = (tribox_mesh){.positions = work->positions,
                               .vertices = vertices,
                               .indices = work->corners,
                               .index_bytes = sizeof(uint32_t),
                               .count = vertices ? soup->count : 0};
    return vertices;
}

void timing_work_shorten(timing_work *work, size_t triangles)
{
    work->pairs = work->words = 0;
    for (size_t i = 0; i < work->count; i++) {
        tribox_soup *const soup = &work->jobs[i].soup;
        soup->count = soup->count < triangles ? soup->count : triangles;
        work->pairs += soup->count;
        work->words += tribox_mask_words(soup->count);
    }
}

void timing_work_free(timing_work *work)
{
    free(work->jobs);
    free(work->memory);
    free(work->positions);
    free(work->corners);
    *work = (timing_work){.jobs = NULL};
}
