/*
 * tribox_threads.h - the steps of a spatial order, for threads that share the work
 *
 * tribox_soup_sort, tribox_mesh_sort and tribox_boxes_sort are these steps, one after another: start all of it, cut it as often as
 * there are threads, finish every part. Any number of threads may take part in a step; the order is the same as in one call.
 */
#ifndef TRIBOX_THREADS_H
#define TRIBOX_THREADS_H

#include <tribox.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ============================================================================================================================== */
/*                                              Spatial order, step by step (threads)                                             */
/* ============================================================================================================================== */

/**
 * The first step of tribox_soup_sort, for threads that share the work: writes to scratch where triangles first to
 * first + count - 1 lie. When that is done for all of the soup, tribox_sort_cut or tribox_sort_finish follows.
 *
 * scratch: the whole of it, as for tribox_soup_sort. Threads may start parts of the soup.
 *
 * Returns what tribox_soup_sort does; TRIBOX_BAD_ARGUMENT also where first + count exceeds soup->count.
 */
TRIBOX_API tribox_status tribox_soup_sort_start(const tribox_soup *soup, size_t first, size_t count, void *scratch);

/** The same for boxes. */
TRIBOX_API tribox_status tribox_boxes_sort_start(const tribox_boxes *boxes, size_t first, size_t count, void *scratch);

/** The same for the triangles of a mesh, of which only the indices of these triangles are checked. */
TRIBOX_API tribox_status tribox_mesh_sort_start(const tribox_mesh *mesh, size_t first, size_t count, void *scratch);

/**
 * Cuts one part of an order in two: places first .. first + count - 1, all of them to begin with. Threads may take different parts.
 *
 * scratch: as the calls before have left it.
 * total: the count of the soup, the boxes or the mesh.
 * before: receives how many places the first of the two parts has, which begins at `first`; 0 if there is nothing to cut, as count
 *   is 64 or less.
 *
 * Returns TRIBOX_OK or TRIBOX_BAD_ARGUMENT (before is NULL; scratch is NULL where count > 0; or first + count exceeds total).
 */
TRIBOX_API tribox_status tribox_sort_cut(void *scratch, size_t total, size_t first, size_t count, size_t *before);

/**
 * The last step: makes all further cuts of a part and writes order[first] .. order[first + count - 1]. So the order is the same as
 * in one call, however many parts are cut before they are finished. Threads may take different parts.
 *
 * scratch, total: as for tribox_sort_cut.
 * order: the whole of it, as for tribox_soup_sort.
 *
 * Returns TRIBOX_OK or TRIBOX_BAD_ARGUMENT (scratch or order is NULL where count > 0, or first + count exceeds total).
 */
TRIBOX_API tribox_status tribox_sort_finish(void *scratch, size_t total, size_t first, size_t count, uint32_t *order);

#ifdef __cplusplus
}
#endif

#endif
