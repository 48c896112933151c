/* double_no_cgal.c - stands for the peer where CGAL is not there. */
#include "double_peer.h"

double_peer *double_peer_make(const double *nine, size_t count, const tribox_box *box)
{
    (void)nine;
    (void)count;
    (void)box;
    return NULL;
}

void double_peer_free(double_peer *peer) { (void)peer; }

void double_peer_answer(const double_peer *peer, uint64_t *mask)
{
    (void)peer;
    (void)mask;
}

bool double_peer_is_degenerate(const double_peer *peer, size_t i)
{
    (void)peer;
    (void)i;
    return true;
}
