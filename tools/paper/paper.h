/*
 * paper.h - what tribox is measured against: the test as published, T. Akenine-Moller, "Fast 3D Triangle-Box Overlap Testing",
 * journal of graphics tools 6(1), 2001, one triangle at a time, leaving at the first axis that separates. The same text is compiled
 * for several instruction sets, as the kernels are, so that a comparison is fair on every processor.
 */
#ifndef PAPER_H
#define PAPER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The order that the paper's section 3 found the fastest: bullet 3 (nine edge axes), bullet 1 (box normals), bullet 2 (plane). */
enum { PAPER_ORDER = 312 };

/*
 * Tests each triangle of a soup: bit i % 64 of mask[i / 64] is 1 if triangle i overlaps the box, touching included. Bits past count
 * are zero. Single precision.
 *
 * center, half: the centre of the box and half its size on each axis.
 * triangles: triangles[i][j][a] is axis a of vertex j.
 * mask: (count + 63) / 64 words, all of them written.
 */
typedef void paper_walk(const float center[3], const float half[3], const float (*triangles)[3][3], size_t count, uint64_t *mask);

/* The walk for the widest instruction set that this processor has. order: 123, 132, 213, 231, 312 or 321. */
paper_walk *paper_in_order(unsigned order);

/* The name of that instruction set: "avx512", "avx2", or "any" where the compiler's default was taken. */
const char *paper_instruction_set(void);

/* The walks of one compilation of paper_walk.c: orders 123, 132, 213, 231, 312, 321. */
enum { PAPER_ORDERS = 6 };
extern paper_walk *const paper_walks_any[PAPER_ORDERS], *const paper_walks_avx2[PAPER_ORDERS],
                                                            *const paper_walks_avx512[PAPER_ORDERS];

#ifdef __cplusplus
}
#endif

#endif
