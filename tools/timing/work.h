/*
 * work.h - what is timed: soups, each with a box, tested one after the other. A scene is one such job, the leaves of an octree
 * many.
 */
#ifndef TIMING_WORK_H
#define TIMING_WORK_H

#include <stdbool.h>

#include "tribox.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One soup and one box, each twice over: as tribox and as the paper's test want them. */
typedef struct timing_job {
    tribox_soup soup;
    const float (*triangles)[3][3]; /* the same triangles: triangles[i][j][a] is axis a of vertex j */
    tribox_box box;
    float center[3], half[3]; /* of the box, rounded to float */
} timing_job;

typedef struct timing_work {
    timing_job *jobs;
    size_t count;             /* jobs */
    size_t pairs;             /* of a triangle and a box, in all jobs */
    size_t words;             /* of the masks of all jobs, which follow one another */
    void *memory;             /* of the next two */
    float *streams;           /* what the soups point into */
    float (*triangles)[3][3]; /* what the jobs' triangles point into */
    size_t used;              /* of the room */
    tribox_mesh mesh;         /* the one job's triangles with indices; none, but where timing_work_mesh has made it */
    void *positions, *corners;
} timing_work;

/* The room that a soup takes: its streams begin on cache lines. */
size_t timing_work_room(size_t triangles);

/* An empty work with room for `jobs` jobs, and for soups that take `room` together. False if memory fails. */
bool timing_work_make(timing_work *work, size_t jobs, size_t room);

/*
 * The next soup of the work, as a job without a box: `count` triangles that the caller has written to triangles[used ...], here
 * written into the streams as well. There has to be room for them.
 */
timing_job timing_work_soup(timing_work *work, size_t count);

/* The same for the triangles `which` of another soup, or for its first ones if that is NULL. */
timing_job timing_work_copy(timing_work *work, const tribox_soup *soup, const uint32_t *which, size_t count);

/* Adds a job, whose soup the work holds, against a box. There has to be room for it. */
void timing_work_add(timing_work *work, const timing_job *job, const tribox_box *box);

/* Welds the triangles of its one job to a mesh. False if memory fails. */
bool timing_work_mesh(timing_work *work);

/* Leaves the first triangles of each job. */
void timing_work_shorten(timing_work *work, size_t triangles);

void timing_work_free(timing_work *work);

#ifdef __cplusplus
}
#endif

#endif
