/* loads.h - what memory alone allows: load every float of a soup and do next to nothing with it. */
#ifndef BENCH_LOADS_H
#define BENCH_LOADS_H

#include "tribox.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The exclusive or of the bits of all coordinates: it takes all nine streams, whole, and one instruction for each load. */
uint32_t loads_all(const tribox_soup *soup);

/* The exclusive or of `count` words, at any alignment. */
uint32_t loads_words(const void *words, size_t count);

#ifdef __cplusplus
}
#endif

#endif
