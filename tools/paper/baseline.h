/* baseline.h - what tribox is measured against: the paper's own test, one triangle at a time. */
#ifndef BENCH_BASELINE_H
#define BENCH_BASELINE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * 1 if the triangle overlaps the box, 0 if not. Single precision, touching is overlap.
 *
 * center, half: the centre of the box and half its size on each axis.
 * triangle: triangle[j][a] is axis a of vertex j.
 */
int baseline_overlap(const float center[3], const float half[3], const float triangle[3][3]);

/**
 * The same for each triangle of a soup, in sequence: bit i % 64 of mask[i / 64]; bits past count are zero.
 *
 * mask: (count + 63) / 64 words, all of them written.
 */
void baseline_overlap_soup(const float center[3], const float half[3], const float (*triangles)[3][3], size_t count,
                           uint64_t *mask);

#ifdef __cplusplus
}
#endif

#endif
