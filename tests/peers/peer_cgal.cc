// peer_cgal.cc - CGAL's AABB_tree of triangles, asked about an Iso_cuboid_3 with exact predicates: a peer with the same answers.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <vector>

#include "peer.h"

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel; // nothing is constructed
using Point = Kernel::Point_3;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

struct Tree {
    Triangles triangles;
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> nodes;
};

template <class Number> Point point_of(const Number p[3]) { return {p[0], p[1], p[2]}; }

Kernel::Iso_cuboid_3 cuboid_of(const tribox_box &box) { return {point_of(box.lo), point_of(box.hi)}; }

void *make(const float (*triangles)[3][3], size_t count)
{
    Tree *const tree = new Tree;
    tree->triangles.reserve(count);
    for (size_t i = 0; i < count; i++)
        tree->triangles.emplace_back(point_of(triangles[i][0]), point_of(triangles[i][1]), point_of(triangles[i][2]));
    tree->nodes.do_not_accelerate_distance_queries();
    tree->nodes.insert(tree->triangles.cbegin(), tree->triangles.cend());
    tree->nodes.build();
    return tree;
}

void release(void *tree) { delete static_cast<Tree *>(tree); }

// Takes down what CGAL finds, without a container of its own.
class Taker
{
  public:
    Taker(const Tree &tree, peer_lists *to) : first_(tree.triangles.cbegin()), to_(to) {}
    Taker &operator*() { return *this; }
    Taker &operator++() { return *this; }
    Taker operator++(int) { return *this; }
    Taker &operator=(Primitive::Id found)
    {
        peer_lists_add(to_, static_cast<uint32_t>(found - first_));
        return *this;
    }

  private:
    Triangles::const_iterator first_;
    peer_lists *to_;
};

void list(void *asked, const tribox_box *boxes, size_t count, peer_lists *to)
{
    const Tree &tree = *static_cast<const Tree *>(asked);
    for (size_t b = 0; b < count; b++) {
        peer_lists_begin(to, b);
        tree.nodes.all_intersected_primitives(cuboid_of(boxes[b]), Taker(tree, to));
    }
    peer_lists_begin(to, count);
}

size_t any(void *asked, const tribox_box *boxes, size_t count)
{
    const Tree &tree = *static_cast<const Tree *>(asked);
    size_t found = 0;
    for (size_t b = 0; b < count; b++)
        found += tree.nodes.do_intersect(cuboid_of(boxes[b]));
    return found;
}

} // namespace

extern const peer peer_cgal = {"CGAL", true, make, release, nullptr, list, any};
