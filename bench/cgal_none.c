/* cgal_none.c - stands for the peer where CGAL is not there. */
#include "cgal_peer.h"

const char *cgal_version(void) { return NULL; }

cgal_peer *cgal_peer_make(cgal_way way, const double *nine, size_t count, const tribox_box *box)
{
    (void)way, (void)nine, (void)count, (void)box;
    return NULL;
}

void cgal_peer_free(cgal_peer *peer) { (void)peer; }

void cgal_peer_answer(const cgal_peer *peer, uint64_t *mask) { (void)peer, (void)mask; }

bool cgal_peer_is_degenerate(const cgal_peer *peer, size_t i)
{
    (void)peer, (void)i;
    return true;
}
