/* order_paper.h - the paper's own test, one triangle at a time, in each of the six orders. */
#ifndef BENCH_ORDER_PAPER_H
#define BENCH_ORDER_PAPER_H

#include <stddef.h>
#include <stdint.h>

/** As baseline_overlap_soup, whose order is 312. */
typedef void paper_walk(const float center[3], const float half[3], const float (*triangles)[3][3], size_t count, uint64_t *mask);

/** order: 123, 132, 213, 231, 312 or 321. */
paper_walk *paper_in_order(unsigned order);

#endif
