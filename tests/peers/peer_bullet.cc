// peer_bullet.cc - Bullet's quantised tree over triangles, and the paper's test in float for those that it names: as games do it.
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <memory>
#include <vector>

#include "paper/paper.h"
#include "paper/paper_axes.h"
#include "peer.h"

namespace
{

constexpr size_t triangles_most = size_t{1} << 21; // numbers of quantised nodes have no more bits

struct Tree {
    std::vector<int> indices;
    std::unique_ptr<btTriangleIndexVertexArray> mesh;
    std::unique_ptr<btBvhTriangleMeshShape> shape;
};

void *make(const float (*triangles)[3][3], size_t count)
{
    if (count >= triangles_most)
        return nullptr;
    Tree *const tree = new Tree;
    const int corners = static_cast<int>(3 * count);
    btIndexedMesh part;
    tree->indices.resize(3 * count);
    for (int i = 0; i < corners; i++)
        tree->indices[static_cast<size_t>(i)] = i;
    part.m_numTriangles = static_cast<int>(count);
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char *>(tree->indices.data());
    part.m_triangleIndexStride = 3 * sizeof(int);
    part.m_numVertices = corners;
    part.m_vertexBase = reinterpret_cast<const unsigned char *>(triangles);
    part.m_vertexStride = 3 * sizeof(float);
    part.m_vertexType = PHY_FLOAT;
    tree->mesh = std::make_unique<btTriangleIndexVertexArray>();
    tree->mesh->addIndexedMesh(part);
    tree->shape = std::make_unique<btBvhTriangleMeshShape>(tree->mesh.get(), true);
    return tree;
}

void release(void *tree) { delete static_cast<Tree *>(tree); }

// Tests what the tree names.
class Tester : public btTriangleCallback
{
  public:
    Tester(const tribox_box &box, peer_lists *to) : to_(to)
    {
        for (int a = 0; a < 3; a++) {
            center_[a] = box.lo[a] / 2 + box.hi[a] / 2;
            half_[a] = box.hi[a] / 2 - box.lo[a] / 2;
        }
    }

    void processTriangle(btVector3 *corner, int, int number) override
    {
        float u[3][3];
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 3; a++)
                u[v][a] = corner[v][a];
        to_->candidates++;
        if (paper_overlaps(center_, half_, u, PAPER_ORDER))
            peer_lists_add(to_, static_cast<uint32_t>(number));
    }

  private:
    float center_[3], half_[3];
    peer_lists *to_;
};

template <class Number> btVector3 vector_of(const Number p[3])
{
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

void list(void *asked, const tribox_box *boxes, size_t count, peer_lists *to)
{
    const Tree &tree = *static_cast<const Tree *>(asked);
    for (size_t b = 0; b < count; b++) {
        Tester tester(boxes[b], to);
        peer_lists_begin(to, b);
        tree.shape->processAllTriangles(&tester, vector_of(boxes[b].lo), vector_of(boxes[b].hi));
    }
    peer_lists_begin(to, count);
}

} // namespace

extern const peer peer_bullet = {"Bullet", false, make, release, nullptr, list, nullptr};
