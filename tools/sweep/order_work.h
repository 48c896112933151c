/* order_work.h - what an order sweep times: soups, each with a box, tested one after the other. */
#ifndef BENCH_ORDER_WORK_H
#define BENCH_ORDER_WORK_H

#include <stdbool.h>

#include "tribox.h"

/** One soup and one box. A scene is one job; the leaves of an octree are many. */
typedef struct order_job {
    tribox_soup soup;
    const float (*triangles)[3][3]; /* the same triangles as the paper's test wants them: triangles[i][j][a] */
    tribox_box box;
} order_job;

typedef struct order_work {
    order_job *jobs;
    size_t count;             /* jobs */
    size_t pairs;             /* triangles of all jobs: every test of a triangle against a box */
    size_t words;             /* of the masks of all jobs */
    float *streams;           /* what the soups point into */
    float (*triangles)[3][3]; /* what the jobs' triangles point into */
    size_t used;              /* of the room */
} order_work;

/** The room that a soup of so many triangles takes: its streams begin on cache lines. */
size_t order_work_room(size_t triangles);

/** An empty work with room for so many jobs, and for soups that take so much room together. False if memory fails. */
bool order_work_make(order_work *work, size_t jobs, size_t room);

/**
 * The next soup of the work, as a job without a box: `count` triangles that the caller has written to triangles[used ...], here
 * written into the streams as well. There has to be room for them.
 */
order_job order_work_soup(order_work *work, size_t count);

/** The same of the triangles `which` of another soup; of its first ones where that is NULL. */
order_job order_work_copy(order_work *work, const tribox_soup *soup, const size_t *which, size_t count);

/** Adds a job whose soup the work holds. There has to be room for it. */
void order_work_add(order_work *work, const order_job *job);

void order_work_free(order_work *work);

#endif
