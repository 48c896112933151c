/* test_hpp.cc - tribox.hpp gives what the C calls give: of every kind of container, into every kind of sink, and of every error. */
#include <tribox.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>
#if __cplusplus >= 202002L
#include <span>
#endif

namespace
{

int failures;
#define CHECK(...) \
    ((__VA_ARGS__) ? void() : (failures++, void(std::fprintf(stderr, "test_hpp.cc:%d: not so: %s\n", __LINE__, #__VA_ARGS__))))

template <class T> struct vec3 {
    T x, y, z;
};
using float3 = vec3<float>;
struct vertex {
    double weight;
    float3 position, normal;
    uint16_t uv[2];
};
struct triangle {
    float3 v[3];
};
struct three {
    float3 a, b, c;
};
struct swapped {
    float z, y, x;
};

/* Points as some libraries have them: with members of several names, and with functions of these names. */
struct union3 {
    union {
        float x, r;
    };
    union {
        float y, g;
    };
    union {
        float z, b;
    };
    float operator[](size_t a) const { return a == 0 ? x : a == 1 ? y : z; }
};
class double3
{
    double number[3] = {};

  public:
    double x() const { return number[0]; }
    double &operator[](size_t a) { return number[a]; }
};

/* A wavy sheet of two triangles a square, in every layout. */
struct scene {
    enum { SIDE = 20, COUNT = 2 * SIDE * SIDE };
    std::vector<float3> points;
    std::vector<uint32_t> flat;
    std::vector<std::array<uint32_t, 3>> faces;
    std::vector<triangle> triangles;
    std::vector<float> stream[9];
    tribox::mesh mesh{points, flat};

    scene()
    {
        uint32_t state = 1;
        for (uint32_t j = 0; j <= SIDE; j++)
            for (uint32_t i = 0; i <= SIDE; i++) {
                state = state * 1664525 + 1013904223;
                points.push_back({static_cast<float>(i), static_cast<float>(j), static_cast<float>(state >> 8) * 0x1p-22f});
            }
        for (uint32_t n = 0; n < COUNT; n++) {
            const uint32_t at = n / 2 / SIDE * (SIDE + 1) + n / 2 % SIDE, up = at + SIDE + 1;
            faces.push_back(n % 2 ? std::array<uint32_t, 3>{at + 1, up + 1, up} : std::array<uint32_t, 3>{at, at + 1, up});
            flat.insert(flat.end(), faces[n].begin(), faces[n].end());
            triangles.push_back({{points[faces[n][0]], points[faces[n][1]], points[faces[n][2]]}});
            for (size_t v = 0; v < 3; v++) {
                stream[v].push_back(triangles[n].v[v].x);
                stream[3 + v].push_back(triangles[n].v[v].y);
                stream[6 + v].push_back(triangles[n].v[v].z);
            }
        }
        mesh = tribox::mesh(points, flat);
    }
    tribox::soup soup() const
    {
        return {{stream[0], stream[1], stream[2]}, {stream[3], stream[4], stream[5]}, {stream[6], stream[7], stream[8]}};
    }
};

const scene at;
const tribox::box about({3.5, 2, 1}, {9, 8.25, 2});
const tribox::grid sheet({0, 0, 0}, {0.25, 0.25, 0.25}, {83, 80, 17});
const tribox::window part = {{3, 2, 1}, {70, 40, 9}};

std::vector<uint64_t> mask_of(const tribox_mesh &mesh)
{
    std::vector<uint64_t> mask(tribox_mask_words(mesh.count));
    return tribox_mesh_overlap(&mesh, &about, nullptr, mask.data(), nullptr) ? std::vector<uint64_t>() : mask;
}

template <class Of> bool is_same(const Of &of)
{
    std::vector<uint64_t> mask(tribox_mask_words(scene::COUNT));
    const tribox::report counted = tribox::overlap(of, about, mask);
    return counted.overlapping > 20 && mask == mask_of(at.mesh);
}

/* The status that a call hands to its last argument; and that it throws, where a call without one says the same. */
template <class Call> tribox::status said(const Call &call)
{
    tribox::status said = TRIBOX_STOPPED, thrown = TRIBOX_OK;
    call(said);
    try {
        call(tribox::on_error());
    } catch (const tribox::error &e) {
        thrown = e.code;
        CHECK(std::string(e.what()) == tribox_status_text(e.code));
    }
    CHECK(thrown == said);
    return said;
}

/* Whether a mesh is made of two values in braces. */
template <class A, class B, class = void> struct makes_mesh : std::false_type {
};
template <class A, class B>
struct makes_mesh<A, B, std::void_t<decltype(tribox::mesh({std::declval<A>(), std::declval<B>()}))>> : std::true_type {
};
/* Whether a corner of two numbers in braces makes a box, and a size of two a grid. */
template <class Box, class = void> struct is_flat_box : std::false_type {
};
template <class Box> struct is_flat_box<Box, std::void_t<decltype(Box({-1, -1, -1}, {1, 1}))>> : std::true_type {
};
template <class Grid, class = void> struct is_flat_grid : std::false_type {
};
template <class Grid> struct is_flat_grid<Grid, std::void_t<decltype(Grid({0, 0, 0}, 1, {4, 4}))>> : std::true_type {
};
static_assert(!is_flat_box<tribox::box>::value && !is_flat_grid<tribox::grid>::value, "three numbers each");
static_assert(makes_mesh<const float *, size_t>::value && !makes_mesh<const float3 *, size_t>::value, "no members of tribox_mesh");

void views()
{
    using tribox::mesh;
    CHECK(is_same(at.mesh) && is_same(tribox_mesh(at.mesh)) && is_same(at.soup()));
    CHECK(is_same(mesh(at.points, at.faces)));
    CHECK(is_same(mesh({at.triangles, &triangle::v})));
    CHECK(is_same(mesh({&at.points[0].x, at.points.size(), sizeof at.points[0]}, at.faces)));
    CHECK(is_same(mesh(tribox::view<const float3>(at.triangles[0].v, 3 * at.triangles.size()))));

    std::vector<three> threes;
    for (const triangle &t : at.triangles)
        threes.push_back({t.v[0], t.v[1], t.v[2]});
    CHECK(is_same(mesh({threes, &three::a, &three::b, &three::c})));
    CHECK(said([&](tribox::on_error to) {
              tribox::overlap(mesh({threes, &three::a, &three::c, &three::b}), about, nullptr, {}, to);
          }) == TRIBOX_BAD_ARGUMENT);

    std::vector<vertex> vertices;
    std::vector<std::array<double, 4>> arrays;
    std::vector<vec3<double>> doubles;
    std::vector<double3> hidden;
    std::vector<union3> unions;
    std::vector<float> numbers;
    for (const float3 &p : at.points) {
        vertices.push_back({0, p, {}, {}});
        arrays.push_back({p.x, p.y, p.z, 1});
        doubles.push_back({p.x, p.y, p.z});
        numbers.insert(numbers.end(), {p.x, p.y, p.z});
        unions.push_back({{p.x}, {p.y}, {p.z}});
        hidden.emplace_back();
        hidden.back()[0] = p.x, hidden.back()[1] = p.y, hidden.back()[2] = p.z;
    }
    const std::vector<uint16_t> narrow(at.flat.begin(), at.flat.end());
    const std::vector<int> with_sign(at.flat.begin(), at.flat.end());
    CHECK(is_same(mesh({vertices, &vertex::position}, narrow)));
    CHECK(is_same(mesh({&vertices[0].position.x, vertices.size(), sizeof(vertex)}, at.faces)));
    CHECK(is_same(mesh(arrays, with_sign)));
    CHECK(is_same(mesh(doubles, at.flat)));
    CHECK(is_same(mesh(numbers, at.flat)) && is_same(mesh({numbers.data(), at.points.size()}, at.flat)));
    CHECK(is_same(mesh(unions, at.flat)) && is_same(mesh(hidden, at.flat)));
#ifdef __cpp_lib_span
    CHECK(is_same(mesh(std::span(at.points), std::span(at.faces))));
    std::vector<uint64_t> mask(tribox_mask_words(scene::COUNT));
    CHECK(tribox::overlap(at.mesh, about, std::span(mask)).overlapping > 0 && mask == mask_of(at.mesh));
#endif

    /* Arrays of C, of points and of triangles; boxes of them. */
    static const float corner[3][3] = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}, pair[2][3][3] = {{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}};
    CHECK(mesh(corner).count == 1 && mesh(pair).count == 2 && mesh(pair).stride == 12 && mesh(pair).positions == pair);
    const tribox::box of_points(at.points[22], at.points[43]), of_arrays(corner[1], corner[2]);
    CHECK(of_points.lo[0] == 1 && of_points.hi[1] == 2 && of_points.hi[2] == double{at.points[43].z} && of_arrays.lo[2] == 5);

    const std::vector<float> two = {1, 2}, other = {3, 4}, three(3);
    const tribox::boxes pairs({two, two, other}, {other, two, other}), uneven({two, two, two}, {two, two, three});
    CHECK(pairs.count == 2 && pairs.lo[1] == two.data() && pairs.lo[2] == other.data() && pairs.hi[0] == other.data());
    CHECK(pairs.hi[1] == two.data() && tribox_overlap_boxes(pair[0][0], &uneven, nullptr, nullptr, nullptr) == TRIBOX_BAD_ARGUMENT);

    /* What is empty has no triangles. */
    const std::vector<float3> nothing;
    const std::vector<vertex> no_vertices;
    const std::vector<uint32_t> no_faces;
    for (const mesh &empty :
         {mesh(nothing), mesh(nothing, no_faces), mesh(at.points, no_faces), mesh({no_vertices, &vertex::position})})
        CHECK(empty.count == 0 && tribox::overlap(empty, about, nullptr).overlapping == 0);

    /* Refused by the compiler: temporaries that own, numbers of another type, members in another order, an index twice. */
    using tribox::corners, tribox::points, tribox::view;
    using floats = std::vector<float3>;
    static_assert(std::is_constructible_v<points, floats &> && !std::is_constructible_v<points, floats>);
    static_assert(std::is_constructible_v<corners, view<uint32_t>> && !std::is_constructible_v<corners, std::vector<uint32_t>>);
    static_assert(!std::is_constructible_v<points, std::vector<int> &> && !std::is_constructible_v<points, std::vector<swapped> &>);
    static_assert(!std::is_constructible_v<points, std::vector<triangle> &> && !std::is_constructible_v<points, float(&)[4][9]>);
    static_assert(!std::is_constructible_v<points, std::vector<floats> &> &&
                  !std::is_constructible_v<points, std::vector<float *> &>);
    static_assert(!std::is_constructible_v<corners, std::vector<size_t> &> && !std::is_constructible_v<corners, floats &>);
    static_assert(!std::is_constructible_v<corners, std::vector<uint8_t> &> &&
                  !std::is_constructible_v<corners, uint32_t(&)[9][4]>);
    static_assert(!std::is_constructible_v<view<uint64_t>, const std::vector<uint64_t> &> &&
                  !std::is_constructible_v<view<const float>, std::vector<float>>);
    static_assert(!std::is_copy_constructible_v<tribox::index> && std::is_nothrow_move_constructible_v<tribox::index>);
}

/* ---- errors: thrown, or in a status --------------------------------------------------------------------------------------- */

void errors()
{
    std::vector<uint64_t> mask(tribox_mask_words(scene::COUNT)), occupied(tribox_window_words(sheet.size));
    std::vector<uint32_t> list(9);
    std::vector<uint8_t> children(9);
    const std::vector<float> seven(7);
    const double inf = INFINITY;
    const auto on_mesh = [&](const tribox::triangles &of, tribox::status wanted) {
        CHECK(said([&](tribox::on_error to) { tribox::overlap(of, about, mask, {}, to); }) == wanted);
    };
    on_mesh(at.mesh, TRIBOX_OK);
    on_mesh(tribox::mesh(seven), TRIBOX_BAD_ARGUMENT);
    on_mesh(tribox::mesh(tribox::view<const float3>(at.points.data(), 7)), TRIBOX_BAD_ARGUMENT);
    on_mesh(tribox::mesh(at.points, tribox::view<const uint32_t>(at.flat.data(), 7)), TRIBOX_BAD_ARGUMENT);
    on_mesh(tribox::mesh(tribox::view<const float3>(at.points.data(), 7), at.flat), TRIBOX_BAD_VERTEX);
    on_mesh(tribox::soup({at.stream[0], at.stream[0], at.stream[0]}, {at.stream[0], at.stream[0], at.stream[0]},
                         {at.stream[0], at.stream[0], seven}),
            TRIBOX_BAD_ARGUMENT);
    CHECK(said([&](tribox::on_error to) { tribox::overlap(at.mesh, {{0, 0, 0}, {0, 0, inf}}, mask, {}, to); }) == TRIBOX_BAD_BOX);
    CHECK(said([&](tribox::on_error to) { tribox::overlap(at.mesh, about, mask, {TRIBOX_FAST, "none"}, to); }) == TRIBOX_NO_KERNEL);

    /* Too short: nothing is written. */
    mask.pop_back();
    const std::vector<uint64_t> before = mask;
    CHECK(said([&](tribox::on_error to) { tribox::overlap(at.mesh, about, mask, {}, to); }) == TRIBOX_BAD_ARGUMENT);
    CHECK(mask == before);
    occupied.pop_back();
    const auto voxelize = [&](tribox::on_error to) { tribox::voxelize(at.mesh, sheet, occupied, nullptr, {}, to); };
    CHECK(said(voxelize) == TRIBOX_BAD_ARGUMENT);
    list.push_back(1);
    CHECK(said([&](tribox::on_error to) { tribox::split(at.mesh, list, about, children, nullptr, {}, to); }) ==
          TRIBOX_BAD_ARGUMENT);
    CHECK(said([&](tribox::on_error to) { tribox::index(at.mesh, list, {}, to); }) == TRIBOX_BAD_ARGUMENT);
    tribox::scratch memory;
    const auto bricks = [&](tribox::on_error to) {
        tribox::bricks(
            at.mesh, sheet, tribox::tiles(sheet), tribox::lists(), memory, [](const tribox::brick &) {}, {}, to);
    };
    CHECK(said(bricks) == TRIBOX_BAD_ARGUMENT);
    tribox::grid flat = sheet;
    flat.cell[1] = 0;
    const auto cells = [&](tribox::on_error to) {
        tribox::voxelize(
            at.mesh, flat, [](uint32_t, uint32_t, uint32_t) {}, {}, to);
    };
    CHECK(said(cells) == TRIBOX_BAD_GRID);
    try {
        tribox::check(tribox_mesh_overlap(&at.mesh, nullptr, nullptr, nullptr, nullptr));
        CHECK(failures < 0); /* not reached */
    } catch (const std::exception &e) {
        CHECK(std::string(e.what()) == tribox_status_text(TRIBOX_BAD_ARGUMENT));
    }
}

/* ---- set bits and cells --------------------------------------------------------------------------------------------------- */

void ranges()
{
    for (size_t count : {0u, 1u, 63u, 64u, 65u, 128u, 200u})
        for (uint64_t word : {uint64_t{0}, uint64_t{1}, UINT64_MAX, uint64_t{1} << 63, uint64_t{0x8000000180000001}}) {
            std::vector<uint64_t> mask(tribox_mask_words(count), 0);
            for (size_t w = 0; w < mask.size(); w += 2)
                mask[w] = word;
            std::vector<uint32_t> wanted(count), found;
            wanted.resize(tribox_mask_indices(mask.data(), count, wanted.data()));
            for (size_t bit : tribox::set_bits(mask, count))
                found.push_back(static_cast<uint32_t>(bit));
            CHECK(found == wanted);
        }
    /* Rows of several words, of just one and of one cell; bits past a row's last cell are none. */
    for (const tribox_window &of : {tribox_window{{0, 0, 0}, {83, 5, 3}},
                                    {{0, 0, 0}, {64, 3, 2}},
                                    {{0, 0, 0}, {1, 7, 2}},
                                    {{0, 0, 0}, {130, 1, 2}},
                                    {{0, 0, 0}, {0, 4, 4}},
                                    {{0, 0, 0}, {128, 2, 1}}}) {
        std::vector<uint64_t> bits(tribox_window_words(of.size));
        uint64_t state = 1;
        for (uint64_t &word : bits) {
            state = state * 6364136223846793005 + 1442695040888963407;
            word = state >> 60 & 1 ? state : 0;
        }
        std::vector<std::array<uint32_t, 3>> wanted(tribox_window_cells(bits.data(), of.size, nullptr)), found;
        tribox_window_cells(bits.data(), of.size, reinterpret_cast<uint32_t(*)[3]>(wanted.data()));
        for (auto [i, j, k] : tribox::set_cells({sheet, of}, bits))
            found.push_back({i, j, k});
        CHECK(found == wanted);
    }
    const std::vector<uint64_t> some(3, UINT64_MAX);
    size_t last = 0, count = 0;
    for (size_t bit : tribox::set_bits(some, 1000))
        last = bit, count++;
    CHECK(last == 191 && count == 192);
}

/* ---- split ---------------------------------------------------------------------------------------------------------------- */

/* Lists of all nodes of three levels, once by C's bytes and once by a sink that splits on. */
using node_lists = std::vector<std::vector<uint32_t>>;

void nodes_by_bytes(const tribox::box &own, const std::vector<uint32_t> &list, int depth, node_lists &nodes)
{
    nodes.push_back(list);
    std::vector<uint8_t> children(list.size());
    if (depth == 3 || list.empty() ||
        tribox_mesh_split(&at.mesh, list.data(), list.size(), &own, nullptr, nullptr, children.data(), nullptr))
        return;
    for (unsigned c = 0; c < 8; c++) {
        std::vector<uint32_t> some;
        for (size_t i = 0; i < list.size(); i++)
            if (children[i] >> c & 1)
                some.push_back(list[i]);
        if (!some.empty())
            nodes_by_bytes(own.child(c), some, depth + 1, nodes);
    }
}

void nodes_by_sink(const tribox::box &own, tribox::view<const uint32_t> list, int depth, tribox::split_memory &memory,
                   node_lists &nodes)
{
    nodes.emplace_back(list.begin(), list.end());
    if (depth == 3)
        return;
    tribox::split(at.mesh, list, own, memory, [&](unsigned c, tribox::view<const uint32_t> some) {
        nodes_by_sink(own.child(c), some, depth + 1, memory, nodes);
    });
}

void splits()
{
    const tribox::box cube({0, 0, -8}, {20, 20, 12}), huge({-1.7e308, 0, 1.5e308}, {1.7e308, 1, 1.6e308});
    CHECK(huge.child(7).lo[0] == 0 && huge.child(7).lo[2] == 1.55e308 && huge.child(0).hi[1] == 0.5);
    std::vector<uint32_t> all;
    for (uint32_t n = 0; n < scene::COUNT; n++)
        all.push_back(n);
    const std::vector<uint32_t> none;
    node_lists by_bytes, by_sink, again;
    tribox::split_memory memory;
    nodes_by_bytes(cube, all, 0, by_bytes);
    nodes_by_sink(cube, all, 0, memory, by_sink);
    CHECK(by_bytes.size() > 80 && by_bytes == by_sink);

    /* With a middle; without a list; an empty list; a sink that stops, and one that throws in a child of a child. */
    const double middle[3] = {0, 7, 20};
    std::vector<uint8_t> wanted(all.size()), children(all.size());
    const tribox::box at_end({0, 0, -8}, {20, 20, 20});
    CHECK(!tribox_mesh_split(&at.mesh, all.data(), all.size(), &at_end, middle, nullptr, wanted.data(), nullptr));
    tribox::split(at.mesh, all, at_end, children, middle);
    CHECK(children == wanted);
    std::vector<uint8_t> flat(8);
    tribox::split(
        at.mesh, all, at_end, memory,
        [&](unsigned c, tribox::view<const uint32_t> list) {
            const tribox::box own = at_end.child(c, middle);
            for (uint32_t n : list)
                CHECK(wanted[n] >> c & 1);
            CHECK(tribox::overlap(at.mesh, own, nullptr).overlapping == list.size());
            flat[c] = 1;
        },
        middle);
    CHECK(flat[1] && flat[3] && !flat[4] && !flat[7]);
    CHECK(tribox::split(at.soup(), none, cube, nullptr).overlapping == 0);
    CHECK(tribox::split(at.mesh, none, cube, memory, [](unsigned, tribox::view<const uint32_t>) {}).overlapping == 0);
    CHECK(said([&](tribox::on_error to) {
              tribox::split(
                  at.mesh, nullptr, cube, memory, [](unsigned, const auto &) {}, nullptr, {}, to);
          }) == TRIBOX_BAD_ARGUMENT);
    int calls = 0;
    tribox::status said;
    const auto stop = [&](unsigned, const auto &) { return ++calls == 2; };
    tribox::split(at.mesh, all, cube, memory, stop, nullptr, {}, said);
    CHECK(calls == 2 && said == TRIBOX_STOPPED);
    const auto deep = [&](unsigned c, tribox::view<const uint32_t> list) {
        tribox::split(at.mesh, list, cube.child(c), memory, [](unsigned, const auto &) { throw std::runtime_error("deep"); });
    };
    try {
        tribox::split(at.mesh, all, cube, memory, deep);
        CHECK(failures < 0); /* not reached */
    } catch (const std::runtime_error &e) {
        CHECK(std::string(e.what()) == "deep" && memory.depth == 0);
    }
    nodes_by_sink(cube, all, 0, memory, again);
    CHECK(again == by_bytes);
}

/* ---- an index ------------------------------------------------------------------------------------------------------------- */

void indexes()
{
    std::vector<uint32_t> wanted;
    const std::vector<uint64_t> mask = mask_of(at.mesh);
    for (size_t n : tribox::set_bits(mask, scene::COUNT))
        wanted.push_back(static_cast<uint32_t>(n));
    const tribox::oriented_box turned = {{9, 9, 1}, {3, 2, 1}, {{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1}}};
    const tribox::buffer<uint32_t> order = tribox::sort(at.mesh), other = tribox::sort(at.soup());
    CHECK(std::vector<uint32_t>(order.begin(), order.end()) == std::vector<uint32_t>(other.begin(), other.end()));
    tribox::own_soup gathered(at.mesh, order);
    tribox::own_soup ordered = std::move(gathered);
    tribox::index first(ordered, order);
    const tribox::index by_mesh(at.mesh), by_order = std::move(first);
    tribox::buffer<uint32_t> memory;
    for (const tribox::index *by : {&by_order, &by_mesh}) {
        const tribox::view<const uint32_t> found = by->list(about, memory);
        std::vector<uint32_t> sorted(found.begin(), found.end());
        std::sort(sorted.begin(), sorted.end());
        CHECK(sorted == wanted && by->list(about, nullptr) == wanted.size());
        CHECK(by->list(turned, memory).size() == by->list(turned, nullptr));
        CHECK(by->any(about) < by->count() && by->any(tribox::box({0, 0, 90}, {1, 1, 91})) == by->count());
        const tribox_index c = by->c();
        const tribox::region region(about);
        tribox::report counted;
        tribox::check(tribox_index_overlap(&c, &region, nullptr, nullptr, &counted));
        CHECK(counted.overlapping == wanted.size() && reinterpret_cast<uintptr_t>(c.nodes) % 64 == 0);
    }
    tribox::buffer<uint32_t> from(3), into;
    into = std::move(from);
    CHECK(into.size() == 3 && from.size() == 0 && from.grow(2) && from.size() == 2);
    const std::vector<uint32_t> bad(1, scene::COUNT);
    CHECK(said([&](tribox::on_error to) { tribox::own_soup(at.mesh, bad, nullptr, to); }) == TRIBOX_BAD_VERTEX);
}

/* ---- cells ---------------------------------------------------------------------------------------------------------------- */

struct clear_bits {
    std::vector<uint64_t> bits = std::vector<uint64_t>(tribox_window_words(sheet.size));
    void set(uint32_t i, uint32_t j, uint32_t k)
    {
        uint64_t &word = bits[(size_t{k} * sheet.size[1] + j) * tribox_mask_words(sheet.size[0]) + i / 64];
        CHECK(!(word >> i % 64 & 1)); /* each cell once */
        word |= uint64_t{1} << i % 64;
    }
};

void cells()
{
    clear_bits wanted, found, by_lambda, by_bricks, by_ids, by_lists;
    tribox::report counted;
    tribox::check(tribox_mesh_voxelize(&at.mesh, &sheet, nullptr, nullptr, wanted.bits.data(), &counted));
    tribox::voxelize(at.mesh, sheet, found.bits);
    CHECK(found.bits == wanted.bits);

    std::vector<uint64_t> of_window(tribox_window_words(part.size)), windowed(of_window);
    tribox::report counted_part, wanted_part;
    tribox::check(tribox_mesh_voxelize(&at.mesh, &sheet, &part, nullptr, of_window.data(), &wanted_part));
    tribox::voxelize(at.soup(), {sheet, part}, windowed, &counted_part);
    CHECK(windowed == of_window && counted_part.overlapping == wanted_part.overlapping);
    size_t within = 0;
    for (auto [i, j, k] : tribox::set_cells({sheet, part}, windowed))
        within += wanted.bits[((k + part.first[2]) * sheet.size[1] + j + part.first[1]) * 2 + (i + part.first[0]) / 64] >>
                      (i + part.first[0]) % 64 &
                  1;
    CHECK(within == wanted_part.overlapping);

    CHECK(tribox::voxelize(at.mesh, sheet, [&](uint32_t i, uint32_t j, uint32_t k) { by_lambda.set(i, j, k); }).overlapping ==
          counted.overlapping);
    CHECK(by_lambda.bits == wanted.bits);

    /* Of 2^34 tiles that are nearly all empty, two along z, and with borders of tiles through the sheet. */
    const uint32_t before = (1 << 19) - 40, below = 128 - 8;
    const double low = -0.25 * before;
    const tribox::grid vast({low, low, -0.25 * below}, 0.25, {1 << 24, 1 << 23, below + sheet.size[2]});
    for (const tribox::options &how :
         {tribox::options(), tribox::options(tribox_options{TRIBOX_EXACT, TRIBOX_AXES_ALL, 0, nullptr, {}})}) {
        clear_bits by_search;
        size_t taken = 0;
        const tribox::report of_vast = tribox::voxelize(
            at.mesh, vast,
            [&](uint32_t i, uint32_t j, uint32_t k) {
                taken++;
                if (i - before < sheet.size[0] && j - before < sheet.size[1] && k - below < sheet.size[2])
                    by_search.set(i - before, j - before, k - below);
            },
            how);
        CHECK(by_search.bits == wanted.bits && of_vast.overlapping == taken && taken > counted.overlapping);
    }

    std::vector<uint32_t> ids(size_t{sheet.size[0]} * sheet.size[1] * sheet.size[2]);
    std::vector<uint64_t> bits(wanted.bits.size());
    tribox::check(tribox_mesh_voxelize_ids(&at.mesh, 0, &sheet, nullptr, nullptr, bits.data(), ids.data(), nullptr));
    const tribox::tiles tiles(sheet, 16);
    const tribox::lists lists = tribox::tile_lists(at.mesh, sheet, tiles);
    CHECK(lists.size() == 6 * 5 * 2 && lists[0].size() > 0);
    tribox::scratch memory;
    const tribox::report by_brick = tribox::bricks(at.soup(), sheet, tiles, lists, memory, [&](const tribox::brick &brick) {
        for (auto [i, j, k] : brick)
            by_bricks.set(i, j, k);
    });
    CHECK(by_brick.overlapping == counted.overlapping && by_bricks.bits == wanted.bits);
    const auto id_of = [&](const tribox::cell &c) { return ids[(size_t{c.k} * sheet.size[1] + c.j) * sheet.size[0] + c.i]; };
    tribox::bricks(at.mesh, sheet, tiles, lists, memory, [&](const tribox::brick &brick, tribox::view<const uint32_t> lowest) {
        for (const tribox::cell &c : brick) {
            by_ids.set(c.i, c.j, c.k);
            CHECK(lowest[brick.place(c)] == id_of(c));
        }
        return 0;
    });
    CHECK(by_ids.bits == wanted.bits);
    using numbers = tribox::view<const uint32_t>;
    tribox::bricks(at.mesh, sheet, tiles, lists, memory, [&](const tribox::brick &brick, numbers starts, numbers list) {
        CHECK(starts.size() == 513 && list.size() == starts[512]);
        for (const tribox::cell &c : brick) {
            by_lists.set(c.i, c.j, c.k);
            CHECK(starts[brick.place(c)] < starts[brick.place(c) + 1] && list[starts[brick.place(c)]] == id_of(c));
        }
    });
    CHECK(by_lists.bits == wanted.bits);

    /* Sinks that stop, of all calls that have them, and sinks that throw: the exception comes out, even where a status is given. */
    int calls = 0;
    tribox::status said;
    const auto third = [&](const tribox::brick &) { return ++calls == 3; };
    const size_t some = tribox::bricks(at.mesh, sheet, tiles, lists, memory, third, {}, said).overlapping;
    CHECK(calls == 3 && said == TRIBOX_STOPPED && some > 0 && some < counted.overlapping);
    CHECK(tribox::bricks(at.mesh, sheet, tiles, lists, memory, [](const tribox::brick &) { return true; }).overlapping < some);
    CHECK(tribox::voxelize(at.mesh, sheet, [&](uint32_t, uint32_t, uint32_t) { return --calls == 0; }).overlapping <
              counted.overlapping &&
          calls == 0);
    calls = 3;
    CHECK(tribox::voxelize(
              at.mesh, vast, [&](uint32_t, uint32_t, uint32_t) { return --calls == 0; }, {}, said)
                  .overlapping < counted.overlapping &&
          calls == 0 && said == TRIBOX_STOPPED);
    const auto thrown = [&](const auto &call) {
        try {
            call();
            return std::string("nothing");
        } catch (const std::runtime_error &e) {
            return std::string(e.what());
        }
    };
    CHECK(thrown([&] {
              tribox::bricks(
                  at.mesh, sheet, tiles, lists, memory,
                  [&](const tribox::brick &) { calls++ == 1 ? throw std::runtime_error("2nd") : 0; }, {}, said);
          }) == "2nd" &&
          calls == 2);
    CHECK(thrown([&] {
              tribox::bricks(at.soup(), sheet, tiles, lists, memory,
                             [&](const tribox::brick &, numbers) { throw std::runtime_error("ids"); });
          }) == "ids");
    CHECK(thrown([&] {
              tribox::bricks(at.soup(), sheet, tiles, lists, memory,
                             [&](const tribox::brick &, numbers, numbers) -> int { throw std::runtime_error("lists"); });
          }) == "lists");
    CHECK(thrown([&] {
              tribox::voxelize(at.mesh, sheet, [](uint32_t, uint32_t, uint32_t) { throw std::runtime_error("cell"); });
          }) == "cell" &&
          thrown([&] {
              tribox::voxelize(at.mesh, vast, [](uint32_t, uint32_t, uint32_t) { throw std::runtime_error("vast"); });
          }) == "vast");
}

} // namespace

int main()
{
    views();
    errors();
    ranges();
    splits();
    indexes();
    cells();
    return failures != 0;
}
