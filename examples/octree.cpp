/*
 * octree.cpp - an octree over a surface, in which a triangle belongs to every leaf that it overlaps, by one split a node.
 *
 *     c++ -std=c++17 -O2 octree.cpp $(pkg-config --cflags --libs tribox) -o octree && ./octree
 *
 * If you want the cells of a uniform grid, do not build top-down: voxelize.cpp gives them many times as fast. octree.c is longer,
 * and compares this way with an index.
 */
#include <cstdio>
#include <numeric>
#include <tribox.hpp>
#include <vector>

constexpr uint32_t SIDE = 256, LEVELS = 6, LEAF = 32 /* triangles, at most, of a node without children */;

struct octree {
    tribox::mesh mesh;
    tribox::split_memory memory = {};
    size_t nodes[LEVELS + 1] = {1}, leaves[LEVELS] = {1}, references[LEVELS] = {}; // references: triangles in the level's leaves

    void build(const tribox::box &box, tribox::view<const uint32_t> list, uint32_t level)
    {
        if (list.size() <= LEAF || level + 1 == LEVELS) {
            references[level] += list.size(); // here a program would keep the list
            return;
        }
        leaves[level]--;
        leaves[level + 1] += 8;
        nodes[level + 1] += 8;
        tribox::split(mesh, list, box, memory, [&](unsigned child, tribox::view<const uint32_t> own) {
            build(box.child(child), own, level + 1); // of a child that has triangles
        });
    }
};

int main()
{
    std::vector<float> vertices; // of the saddle z = x * y
    std::vector<uint32_t> corners;
    for (uint32_t n = 0; n < (SIDE + 1) * (SIDE + 1); n++) {
        const uint32_t i = n % (SIDE + 1), j = n / (SIDE + 1), up = n + SIDE + 1;
        const float x = static_cast<float>(i) * 2 / SIDE - 1, y = static_cast<float>(j) * 2 / SIDE - 1;
        vertices.insert(vertices.end(), {x, y, x * y});
        if (i < SIDE && j < SIDE)
            corners.insert(corners.end(), {n, n + 1, up, up + 1, up, n + 1});
    }
    std::vector<uint32_t> all(corners.size() / 3);
    std::iota(all.begin(), all.end(), 0u);
    octree tree = {tribox::mesh(vertices, corners)};
    tree.build(tribox::box({-1, -1, -1}, {1, 1, 1}), all, 0);
    std::printf("%zu triangles\nlevel   nodes  leaves  triangles in leaves\n", all.size());
    for (uint32_t d = 0; d < LEVELS; d++)
        std::printf("%5u %7zu %7zu %20zu\n", d, tree.nodes[d], tree.leaves[d], tree.references[d]);
}
