/* double_peer.h - CGAL's exact answer about the same doubles, where CGAL is there. */
#ifndef BENCH_DOUBLE_PEER_H
#define BENCH_DOUBLE_PEER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "tribox.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct double_peer double_peer;

/* Nine doubles a triangle, and a box; NULL without CGAL. */
double_peer *double_peer_make(const double *nine, size_t count, const tribox_box *box);
void double_peer_free(double_peer *peer);

/* do_intersect for each of them. */
void double_peer_answer(const double_peer *peer, uint64_t *mask);

/* CGAL promises nothing of degenerate triangles. */
bool double_peer_is_degenerate(const double_peer *peer, size_t i);

#ifdef __cplusplus
}
#endif

#endif
