/* cgal_peer.h - CGAL's do_intersect of triangles and a box, where CGAL is there: exact in all ways. */
#ifndef BENCH_CGAL_PEER_H
#define BENCH_CGAL_PEER_H

#include <stdbool.h>

#include "tribox.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * By both its kernels. With a Bbox_3, CGAL answers most pairs by a filter in floating point; with an Iso_cuboid_3, by interval
 * arithmetic; what these leave, in exact numbers.
 */
typedef enum cgal_way { CGAL_EPICK_BBOX, CGAL_EPICK_CUBOID, CGAL_EPECK_BBOX, CGAL_EPECK_CUBOID, CGAL_WAYS } cgal_way;

typedef struct cgal_peer cgal_peer;

/* Without CGAL none of the functions is there, and this one NULL itself. */
__attribute__((weak)) const char *cgal_version(void);

/* Nine doubles a triangle, and a box, made into CGAL's own. */
__attribute__((weak)) cgal_peer *cgal_peer_make(cgal_way way, const double *nine, size_t count, const tribox_box *box);
__attribute__((weak)) void cgal_peer_free(cgal_peer *peer);

__attribute__((weak)) void cgal_peer_answer(const cgal_peer *peer, uint64_t *mask);

/* CGAL promises nothing of degenerate triangles. */
__attribute__((weak)) bool cgal_peer_is_degenerate(const cgal_peer *peer, size_t i);

#ifdef __cplusplus
}
#endif

#endif
