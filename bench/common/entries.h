/*
 * entries.h - the usual field of a benchmark: the paper's test, the loads alone, the paper's test for compilers to vectorize, and
 * every kernel at every accuracy. If the work has a mesh, the paper's test by its indices, too.
 */
#ifndef BENCH_ENTRIES_H
#define BENCH_ENTRIES_H

#include "timing/timing.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The paper's test is called "baseline" and is the first. Returns how many there are. */
size_t entries_make(const timing_work *work, contestant *list);

/* The index of FAST of the same kernel and axes; that of the contestant itself if there is none. */
size_t entry_fast_of(const contestant *list, size_t count, size_t c);

#ifdef __cplusplus
}
#endif

#endif
