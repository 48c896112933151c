/*
 * voxelize.cpp - the cells that a mesh touches, to a lambda; prints how high they reach, as seen from above.
 *
 *     c++ -std=c++17 -O2 voxelize.cpp $(pkg-config --cflags --libs tribox) -o voxelize && ./voxelize
 */
#include <algorithm>
#include <cstdio>
#include <tribox.hpp>
#include <vector>

struct vertex {
    float position[3], color[3];
};

int main()
{
    const std::vector<vertex> vertices = {{{-1, 0, 0}, {}}, {{1, 0, 0}, {}},  {{0, -1, 0}, {}},
                                          {{0, 1, 0}, {}},  {{0, 0, -1}, {}}, {{0, 0, 1}, {}}};
    const std::vector<uint16_t> corners = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    const tribox::mesh octahedron({vertices, &vertex::position}, corners);
    const tribox::grid grid({-1.125, -1.125, -1.125}, 0.09375, {24, 24, 24});

    std::vector<uint32_t> height(24 * 24);
    const tribox::report report = tribox::voxelize(
        octahedron, grid, [&](uint32_t i, uint32_t j, uint32_t k) { height[24 * j + i] = std::max(height[24 * j + i], k); });
    std::printf("%zu cells\n", report.overlapping);
    for (size_t n = 0; n < height.size(); n++)
        std::printf("%c%s", "............:-=+ox%*#W8@"[height[n]], n % 24 == 23 ? "\n" : "");
}
