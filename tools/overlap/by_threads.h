/* by_threads.h - the order of a mesh and an index over it, by several threads: the same bytes as by one. */
#ifndef BY_THREADS_H
#define BY_THREADS_H

#include "read/mesh.h"

/* What tribox_soup_sort or, of doubles, tribox_mesh_sort does and returns. */
tribox_status sort_by_threads(const mesh *m, unsigned threads, uint32_t *order, void *scratch);

/* tribox_soup_gather of all triangles. */
tribox_status gather_by_threads(const tribox_soup *soup, const uint32_t *order, unsigned threads, float *const streams[9]);

/* tribox_index_build over so many triangles. */
tribox_status index_by_threads(const tribox_index *index, size_t count, const tribox_options *options, unsigned threads,
                               void *nodes);

#endif
