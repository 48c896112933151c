// cgal_peer.cc - the peer by CGAL's do_intersect.
#include "cgal_peer.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include <algorithm>
#include <vector>

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel; // of constructions: do_intersect has none
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;

struct cgal_peer {
    virtual ~cgal_peer() = default;
    virtual void answer(uint64_t *mask) const = 0;
    virtual bool is_degenerate(size_t i) const = 0;
};

namespace
{

template <class Kernel> CGAL::Bbox_3 make_box(const tribox_box &b, const CGAL::Bbox_3 *)
{
    return {b.lo[0], b.lo[1], b.lo[2], b.hi[0], b.hi[1], b.hi[2]};
}

template <class Kernel> typename Kernel::Iso_cuboid_3 make_box(const tribox_box &b, const typename Kernel::Iso_cuboid_3 *)
{
    using Point = typename Kernel::Point_3;
    return {Point(b.lo[0], b.lo[1], b.lo[2]), Point(b.hi[0], b.hi[1], b.hi[2])};
}

template <class Kernel, class Box> class Peer : public cgal_peer
{
  public:
    Peer(const double *nine, size_t count, const tribox_box &box) : box_(make_box<Kernel>(box, static_cast<const Box *>(nullptr)))
    {
        using Point = typename Kernel::Point_3;
        for (size_t i = 0; i < count; i++, nine += 9)
            triangles_.emplace_back(Point(nine[0], nine[1], nine[2]), Point(nine[3], nine[4], nine[5]),
                                    Point(nine[6], nine[7], nine[8]));
    }

    void answer(uint64_t *mask) const override
    {
        for (size_t first = 0; first < triangles_.size(); first += 64) {
            const size_t end = std::min(first + 64, triangles_.size());
            uint64_t word = 0;
            for (size_t i = first; i < end; i++)
                word |= static_cast<uint64_t>(CGAL::do_intersect(triangles_[i], box_)) << (i - first);
            mask[first / 64] = word;
        }
    }

    bool is_degenerate(size_t i) const override { return triangles_[i].is_degenerate(); }

  private:
    std::vector<typename Kernel::Triangle_3> triangles_;
    Box box_;
};

} // namespace

extern "C" {

const char *cgal_version(void) { return CGAL_VERSION_STR; }

cgal_peer *cgal_peer_make(cgal_way way, const double *nine, size_t count, const tribox_box *box)
{
    if (way == CGAL_EPICK_BBOX)
        return new Peer<Epick, CGAL::Bbox_3>(nine, count, *box);
    if (way == CGAL_EPICK_CUBOID)
        return new Peer<Epick, Epick::Iso_cuboid_3>(nine, count, *box);
    if (way == CGAL_EPECK_BBOX)
        return new Peer<Epeck, CGAL::Bbox_3>(nine, count, *box);
    return new Peer<Epeck, Epeck::Iso_cuboid_3>(nine, count, *box);
}

void cgal_peer_free(cgal_peer *peer) { delete peer; }

void cgal_peer_answer(const cgal_peer *peer, uint64_t *mask) { peer->answer(mask); }

bool cgal_peer_is_degenerate(const cgal_peer *peer, size_t i) { return peer->is_degenerate(i); }
}
