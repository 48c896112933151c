// double_cgal.cc - the peer by CGAL's do_intersect of a triangle and a Bbox_3, with Epick: a filter, then exact numbers.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <vector>

#include "double_peer.h"

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel; // of constructions: do_intersect has none

struct double_peer {
    std::vector<Kernel::Triangle_3> triangles;
    CGAL::Bbox_3 box;
};

extern "C" {

double_peer *double_peer_make(const double *nine, size_t count, const tribox_box *box)
{
    auto *const peer = new double_peer;
    peer->box = {box->lo[0], box->lo[1], box->lo[2], box->hi[0], box->hi[1], box->hi[2]};
    for (size_t i = 0; i < count; i++, nine += 9)
        peer->triangles.emplace_back(Kernel::Point_3(nine[0], nine[1], nine[2]), Kernel::Point_3(nine[3], nine[4], nine[5]),
                                     Kernel::Point_3(nine[6], nine[7], nine[8]));
    return peer;
}

void double_peer_free(double_peer *peer) { delete peer; }

void double_peer_answer(const double_peer *peer, uint64_t *mask)
{
    const size_t count = peer->triangles.size();
    for (size_t first = 0; first < count; first += 64) {
        uint64_t word = 0;
        for (size_t i = first; i < std::min(first + 64, count); i++)
            word |= static_cast<uint64_t>(CGAL::do_intersect(peer->triangles[i], peer->box)) << (i - first);
        mask[first / 64] = word;
    }
}

bool double_peer_is_degenerate(const double_peer *peer, size_t i) { return peer->triangles[i].is_degenerate(); }
}
