/* peers_here.c - the peers that the build has found. */
#include "peer.h"

const peer *const peers_here[] = {
#if HAVE_CGAL
    &peer_cgal,
#endif
#if HAVE_EMBREE
    &peer_embree, &peer_embree_boxes,
#endif
#if HAVE_BULLET
    &peer_bullet,
#endif
    NULL,
};
