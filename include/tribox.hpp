/*
 * tribox.hpp - tribox.h for C++17 and later: your containers as triangles, lambdas as sinks, errors as you like; header only
 *
 * Names are those of tribox.h without tribox_, in namespace tribox; enumerators keep theirs. Types are the C structs with
 * constructors, so the calls that are not here take them as they are: check(tribox_mesh_find(&mesh, &box, nullptr, what, &found)).
 * What a call answers, its units and its statuses are told in tribox.h; here is what differs.
 *
 *   Containers  Are viewed where they lie, never copied, and must outlive the view: temporaries that own elements are refused.
 *   Lengths     Are known. A view that is too short is TRIBOX_BAD_ARGUMENT, and then nothing is written. For an
 *               output nullptr means that it is not wanted.
 *   Arguments   In the order of tribox.h, but options come last, as they may be left out; the report is returned.
 *   Errors      Are thrown as tribox::error. A tribox::status as the last argument receives them instead, and nothing is thrown.
 *   Sinks       Any callable. It returns nothing, or as in C what is true to end the call, which is TRIBOX_STOPPED but not thrown.
 *               If it throws, the call ends and the exception comes out of it, whoever receives the status. No sink is copied.
 *   Memory      Buffers grow as needed, to be used again: one for each thread. What returns or grows one throws std::bad_alloc.
 *   Threads     As in tribox.h; any number of them may use a const object.
 */
#ifndef TRIBOX_HPP
#define TRIBOX_HPP

#include <tribox.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <exception>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>

namespace tribox
{

using status = tribox_status;
using report = tribox_report;
using window = tribox_window;
using oriented_box = tribox_oriented_box;

/* ============================================================================================================================== */
/*                                                   Errors, views and memory                                                     */
/* ============================================================================================================================== */

/** Thrown if C returns anything but TRIBOX_OK; what() is tribox_status_text. */
struct error : std::exception {
    status code;
    explicit error(status what) noexcept : code(what) {}
    const char *what() const noexcept override { return tribox_status_text(code); }
};

/** Where the status of a call goes: to a status; or nowhere, and failures are thrown (with -fno-exceptions they end all). */
struct on_error {
    status *to = nullptr;
    on_error() = default;
    on_error(status &receives) : to(&receives) {}
    /** Hands a status on. Returns whether it is TRIBOX_OK. */
    bool operator()(status result) const
    {
        if (to)
            *to = result;
        else if (result != TRIBOX_OK && result != TRIBOX_STOPPED)
#ifdef __cpp_exceptions
            throw error(result);
#else
            std::abort();
#endif
        return result == TRIBOX_OK;
    }
};

/** Throws the status of a C call, unless it is TRIBOX_OK or TRIBOX_STOPPED. */
inline void check(status result) { on_error()(result); }

namespace detail
{
/* What a range holds, unless it is a temporary that owns it. */
template <class R, class = std::enable_if_t<std::is_lvalue_reference_v<R> || std::is_trivially_destructible_v<R>>>
using held = std::remove_pointer_t<decltype(std::data(std::declval<R &>()))>;
} // namespace detail

/** Numbers one after the other that somebody else owns: a container with data and size, an array, or a pointer and a count. */
template <class T> struct view {
    constexpr view() = default;
    constexpr view(std::nullptr_t) : length(SIZE_MAX) {} /* not wanted: as long as need be */
    constexpr view(T *data, size_t size) : first(data), length(size) {}
    template <class Range, class = std::enable_if_t<std::is_convertible_v<detail::held<Range> (*)[], T (*)[]>>>
    constexpr view(Range &&range) : first(std::data(range)), length(std::size(range))
    {
    }
    constexpr T *data() const { return first; }
    constexpr size_t size() const { return length; }
    constexpr T *begin() const { return first; }
    constexpr T *end() const { return first + length; }
    constexpr T &operator[](size_t i) const { return first[i]; }

  private:
    T *first = nullptr;
    size_t length = 0;
};

/** Memory that is not cleared, and is moved, never copied. */
template <class T> struct buffer {
    buffer() = default;
    explicit buffer(size_t size) : held(new T[size]), length(size) {}
    buffer(buffer &&from) noexcept : held(std::move(from.held)), length(std::exchange(from.length, 0)) {}
    buffer &operator=(buffer &&from) noexcept
    {
        held = std::move(from.held);
        length = std::exchange(from.length, 0);
        return *this;
    }
    /** Makes it at least so long. What it holds is lost if it grows. */
    T *grow(size_t size)
    {
        if (size > length)
            *this = buffer(), *this = buffer(size);
        return held.get();
    }
    T *data() const { return held.get(); }
    size_t size() const { return length; }
    T *begin() const { return held.get(); }
    T *end() const { return held.get() + length; }
    T &operator[](size_t i) const { return held[i]; }

  private:
    std::unique_ptr<T[]> held;
    size_t length = 0;
};

/** What calls with scratch work in. */
using scratch = buffer<unsigned char>;

/* ============================================================================================================================== */
/*                                           Triangles, boxes and grids of other programs                                         */
/* ============================================================================================================================== */

namespace detail
{
template <class T> using bare = std::remove_cv_t<std::remove_reference_t<T>>;

/* Of a struct of C itself: braces around something else are not taken for its members. */
template <class C, class Of> using if_same = std::enable_if_t<std::is_same_v<C, Of>>;

/* What has three of something: an array of three or four; or members x, y and z that follow each other, which come first. */
template <class P, class = void> struct array {
    using inner = void;
};
template <class P>
struct array<
    P, std::enable_if_t<std::is_trivially_destructible_v<P> && !std::is_pointer_v<P> &&
                        (sizeof(P) == 3 * sizeof(std::declval<P &>()[0]) || sizeof(P) == 4 * sizeof(std::declval<P &>()[0]))>> {
    static constexpr size_t offset = 0;
    using inner = bare<decltype(std::declval<P &>()[0])>;
};
template <class P, class = void> struct triple : array<P> {
};
template <class P> struct triple<P, std::enable_if_t<std::is_object_v<decltype(P::x)> && std::is_standard_layout_v<P>>> {
    static constexpr size_t offset = offsetof(P, x), one = sizeof(P::x);
    using inner =
        std::conditional_t<offsetof(P, y) == offset + one && offsetof(P, z) == offset + 2 * one, bare<decltype(P::x)>, void>;
};

/* An element of a container: one number, a point of three, or a triangle of nine; or of no use. */
template <class E, class = void> struct element {
    using number = void;
    static constexpr size_t numbers = 0, offset = 0, stride = 0;
    static constexpr unsigned bytes = 0;
};
template <class E> struct element<E, std::enable_if_t<std::is_arithmetic_v<E>>> {
    using number = E;
    static constexpr size_t numbers = 1, offset = 0, stride = 3 * sizeof(E);
    static constexpr unsigned bytes = sizeof(E);
};
template <class E> struct element<E, std::enable_if_t<std::is_arithmetic_v<typename triple<E>::inner>>> {
    using number = typename triple<E>::inner;
    static constexpr size_t numbers = 3, offset = triple<E>::offset, stride = sizeof(E);
    static constexpr unsigned bytes = sizeof(number);
};
template <class E>
struct element<E, std::enable_if_t<element<typename triple<E>::inner>::numbers == 3 &&
                                   sizeof(E) == 3 * element<typename triple<E>::inner>::stride>> {
    using point = element<typename triple<E>::inner>;
    using number = typename point::number;
    static constexpr size_t numbers = 9, offset = point::offset, stride = point::stride;
    static constexpr unsigned bytes = point::bytes;
};

template <class Range> using element_of = element<bare<held<Range>>>;

template <class E, class N = typename E::number> constexpr bool is_real = std::is_same_v<N, float> || std::is_same_v<N, double>;
template <class E, class N = typename E::number>
constexpr bool is_index = std::is_integral_v<N> && (E::bytes == 2 || E::bytes == 4) && E::stride == 3 * E::bytes;
} // namespace detail

/**
 * The points of a mesh, of float or double. Elements of a container are points, with members x, y and z or as arrays of three or
 * four, and may have more members; or triangles, as arrays of three points; or numbers, three for a point. A count that is no
 * multiple of three, where it has to be one, is TRIBOX_BAD_ARGUMENT in every call.
 */
struct points {
    const void *first;
    size_t count, stride;
    unsigned bytes; /* of a number */

    /** Points that are so many bytes apart. */
    template <class Number, class E = detail::element<Number>, class = std::enable_if_t<detail::is_real<E> && E::numbers == 1>>
    points(const Number *xyz, size_t how_many, size_t bytes_apart = E::stride)
        : first(xyz), count(how_many), stride(bytes_apart), bytes(E::bytes)
    {
    }
    template <class Range, class E = detail::element_of<Range>, class = std::enable_if_t<detail::is_real<E>>>
    points(Range &&range)
        : first(reinterpret_cast<const char *>(std::data(range)) + E::offset), count(std::size(range) * E::numbers / 3),
          stride(std::size(range) * E::numbers % 3 ? 1 : E::stride), bytes(E::bytes)
    {
    }
    /** Three members of each element, which is nothing but them: of struct triangle { float3 a, b, c; }. */
    template <class Range, class Of, class Point, class = detail::element_of<Range>, class E = detail::element<Point>,
              class = std::enable_if_t<detail::is_real<E> && E::numbers == 3 && sizeof(Of) == 3 * sizeof(Point)>>
    points(Range &&range, Point Of::*a, Point Of::*b, Point Of::*c)
        : first(nullptr), count(3 * std::size(range)), stride(sizeof(Point)), bytes(E::bytes)
    {
        if (!count)
            return;
        const Point *const at = &(std::data(range)->*a);
        first = reinterpret_cast<const char *>(at) + E::offset;
        if (&(std::data(range)->*b) != at + 1 || &(std::data(range)->*c) != at + 2)
            stride = 1; // not in the order of the members, which is refused
    }
    /**
     * A member of each element: a point, mesh({vertices, &vertex::position}, indices), or a triangle if the element is that alone.
     * A point makes each element one vertex, also without indices.
     */
    template <
        class Range, class Of, class Member, class = detail::element_of<Range>, class E = detail::element<Member>,
        class = std::enable_if_t<detail::is_real<E> && (E::numbers == 3 || (E::numbers == 9 && sizeof(Of) == sizeof(Member)))>>
    points(Range &&range, Member Of::*member)
        : first(nullptr), count(std::size(range) * E::numbers / 3), stride(E::numbers == 3 ? sizeof *std::data(range) : E::stride),
          bytes(E::bytes)
    {
        if (count)
            first = reinterpret_cast<const char *>(&(std::data(range)->*member)) + E::offset;
    }
};

/** The vertex numbers of a mesh, of 16 or 32 bits: elements of a container are numbers, or three of them. */
struct corners {
    const void *first;
    size_t count;
    unsigned bytes; /* of a number */

    template <class Range, class E = detail::element_of<Range>, class = std::enable_if_t<detail::is_index<E>>>
    corners(Range &&range)
        : first(std::data(range)), count(std::size(range) * E::numbers / 3),
          bytes(std::size(range) * E::numbers % 3 ? 0u : E::bytes)
    {
    }
};

/** A tribox_mesh over containers: mesh(vertices, indices), or mesh(vertices), each three of which are a triangle. */
struct mesh : tribox_mesh {
    template <class C, class = detail::if_same<C, tribox_mesh>> mesh(const C &from) : tribox_mesh(from) {}
    explicit mesh(const points &of) : mesh(of, nullptr, 0, of.count / 3) { stride = of.count % 3 ? 1 : stride; /* refused */ }
    mesh(const points &of, const corners &by) : mesh(of, by.first, by.bytes, by.count) {}

  private:
    mesh(const points &of, const void *by, unsigned by_bytes, size_t triangles)
        : tribox_mesh{of.first, of.stride, of.count, by, by_bytes, triangles, of.bytes, 0, 0, {}}
    {
    }
};

/** A tribox_soup over nine containers of floats: soup({x0, x1, x2}, {y0, y1, y2}, {z0, z1, z2}). They must be of one length. */
struct soup : tribox_soup {
    using streams = view<const float>[3];
    template <class C, class = detail::if_same<C, tribox_soup>> soup(const C &from) : tribox_soup(from) {}
    soup(const streams &xs, const streams &ys, const streams &zs) : tribox_soup{}
    {
        count = xs[0].size();
        for (int v = 0; v < 3; v++) {
            x[v] = xs[v].size() == count ? xs[v].data() : nullptr; /* a stream that is missing is refused */
            y[v] = ys[v].size() == count ? ys[v].data() : nullptr;
            z[v] = zs[v].size() == count ? zs[v].data() : nullptr;
        }
    }
};

/** A tribox_boxes over six containers of floats: boxes({lo_x, lo_y, lo_z}, {hi_x, hi_y, hi_z}). They must be of one length. */
struct boxes : tribox_boxes {
    template <class C, class = detail::if_same<C, tribox_boxes>> boxes(const C &from) : tribox_boxes(from) {}
    boxes(const soup::streams &los, const soup::streams &his) : tribox_boxes{}
    {
        const soup both(los, his, his);
        count = both.count;
        for (int a = 0; a < 3; a++) {
            lo[a] = both.x[a];
            hi[a] = both.y[a];
        }
    }
};

/** A tribox_box: box({-1, -1, -1}, {1, 1, 1}), or of two points of a type that meshes may have. */
struct box : tribox_box {
    template <class C, class = detail::if_same<C, tribox_box>> box(const C &from) : tribox_box(from) {}
    template <size_t N, size_t M, class = std::enable_if_t<N == 3 && M == 3>> /* {1, 1} would be (1, 1, 0) */
    box(const double (&low)[N], const double (&high)[M]) : tribox_box{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}
    {
    }
    template <class Point, class E = detail::element<Point>,
              class = std::enable_if_t<E::numbers == 3 && !std::is_same_v<Point, double[3]>>>
    box(const Point &low, const Point &high) : tribox_box{}
    {
        typename E::number from[2][3];
        std::memcpy(from[0], reinterpret_cast<const char *>(std::addressof(low)) + E::offset, sizeof from[0]);
        std::memcpy(from[1], reinterpret_cast<const char *>(std::addressof(high)) + E::offset, sizeof from[1]);
        for (int a = 0; a < 3; a++) {
            lo[a] = from[0][a];
            hi[a] = from[1][a];
        }
    }
    /** Child 0 .. 7 of the box, as tribox_split has them. */
    box child(unsigned c, const double *middle = nullptr) const
    {
        box own = *this;
        for (unsigned a = 0; a < 3; a++) {
            const double sum = lo[a] + hi[a], half = std::isfinite(sum) ? sum / 2 : lo[a] / 2 + hi[a] / 2;
            (c >> a & 1 ? own.lo : own.hi)[a] = middle ? middle[a] : half;
        }
        return own;
    }
};

/** A tribox_grid: grid({0, 0, 0}, 0.1, {256, 256, 256}), or with a length for each axis. */
struct grid : tribox_grid {
    using whole = uint32_t[3];
    template <class C, class = detail::if_same<C, tribox_grid>> grid(const C &from) : tribox_grid(from) {}
    template <size_t N, size_t M, class = std::enable_if_t<N == 3 && M == 3>>
    grid(const double (&at)[N], double length, const uint32_t (&cells)[M]) : grid(at, {length, length, length}, cells)
    {
    }
    template <size_t N, size_t L, size_t M, class = std::enable_if_t<N == 3 && L == 3 && M == 3>>
    grid(const double (&at)[N], const double (&length)[L], const uint32_t (&cells)[M])
        : tribox_grid{{at[0], at[1], at[2]}, {length[0], length[1], length[2]}, {cells[0], cells[1], cells[2]}}
    {
    }
};

/** All cells of a grid, or of a window, which have to last as long as this: voxelize(mesh, {grid, window}, occupied). */
struct cells {
    const tribox_grid *grid;
    const tribox_window *window = nullptr;
    cells(const tribox_grid &all) : grid(&all) {}
    cells(const tribox_grid &of, const tribox_window &some) : grid(&of), window(&some) {}
    const grid::whole &size() const { return window ? window->size : grid->size; }
};

/** A tribox_tiles: all tiles of a grid. */
struct tiles : tribox_tiles {
    tiles(const tribox_tiles &share) : tribox_tiles(share) {}
    explicit tiles(const tribox_grid &of, uint32_t of_side = 128) : tribox_tiles{of_side, 0, tribox_tile_count(of.size, of_side)} {}
};

/** What calls about triangles take: a soup or a mesh, which has to last as long as this. */
struct triangles {
    const tribox_soup *soup = nullptr;
    const tribox_mesh *mesh = nullptr;
    triangles(const tribox_soup &of) : soup(&of) {}
    triangles(const tribox_mesh &of) : mesh(&of) {}
    size_t count() const { return mesh ? mesh->count : soup->count; }
    /** The one of two C calls that takes it. */
    template <class Soup, class Mesh, class... Of> status call(Soup *by_soup, Mesh *by_mesh, Of... of) const
    {
        return mesh ? by_mesh(mesh, of...) : by_soup(soup, of...);
    }
};

/** tribox_options; an accuracy alone will do: overlap(mesh, box, mask, TRIBOX_FAST). */
struct options : tribox_options {
    options(tribox_accuracy how = TRIBOX_EXACT, const char *by_kernel = nullptr) : tribox_options{how, 0, 0, by_kernel, {}} {}
    options(const tribox_options &from) : tribox_options(from) {}
};

/** What an index is asked about: a box, or an oriented one. */
struct region : tribox_region {
    region(const tribox_box &of) : tribox_region{&of, nullptr} {}
    region(const tribox_oriented_box &of) : tribox_region{nullptr, &of} {}
};

/* ============================================================================================================================== */
/*                                                        Set bits and cells                                                      */
/* ============================================================================================================================== */

/** A cell: for (auto [i, j, k] : set_cells(grid, occupied)). */
struct cell {
    uint32_t i, j, k;
};

namespace detail
{
inline unsigned lowest_bit(uint64_t word)
{
#ifdef __GNUC__
    return static_cast<unsigned>(__builtin_ctzll(word));
#else
    unsigned bit = 0;
    for (unsigned half = 32; half; half /= 2)
        if (!(word << (64 - half)))
            word >>= half, bit += half;
    return bit;
#endif
}

/* The bits below one, all 64 if there are more. */
inline uint64_t bits_below(uint64_t count) { return count < 64 ? (uint64_t{1} << count) - 1 : UINT64_MAX; }

/* The set bits of words, one after the other. A place enters a word that is not zero, and returns which of its bits count. */
template <class Place> struct set_range {
    struct last {
    };
    struct iterator {
        const uint64_t *first, *stop, *at;
        Place place;
        uint64_t left;

        auto operator*() const { return place[lowest_bit(left)]; }
        bool operator!=(last) const { return at != stop; }
        iterator &operator++()
        {
            left &= left - 1;
            if (!left)
                next_word();
            return *this;
        }
        void next_word()
        {
            while (++at != stop)
                if (*at && (left = *at & place.enter(static_cast<size_t>(at - first))))
                    return;
        }
    };
    view<const uint64_t> words;
    Place start;

    iterator begin() const
    {
        iterator from{words.begin(), words.end(), words.begin(), start, 0};
        if (words.size() && !(from.left = words[0] & from.place.enter(0)))
            from.next_word();
        return from;
    }
    last end() const { return {}; }
};

struct number_place {
    size_t count, first;
    uint64_t enter(size_t word) { return first = 64 * word, bits_below(count - first); }
    size_t operator[](unsigned bit) const { return first + bit; }
};

struct row_place {
    uint32_t along_x, along_y;
    cell first;
    uint64_t enter(size_t word)
    {
        const size_t words = along_x / 64 + (along_x % 64 != 0), row = word / words;
        first = {static_cast<uint32_t>(word % words * 64), static_cast<uint32_t>(row % along_y),
                 static_cast<uint32_t>(row / along_y)};
        return bits_below(along_x - first.i);
    }
    cell operator[](unsigned bit) const { return {first.i + bit, first.j, first.k}; }
};

struct brick_place {
    cell brick, first;
    uint64_t enter(size_t word) { return first = {brick.i, brick.j, brick.k + static_cast<uint32_t>(word)}, UINT64_MAX; }
    cell operator[](unsigned bit) const { return {first.i + bit % 8, first.j + bit / 8, first.k}; }
};

inline view<const uint64_t> up_to(view<const uint64_t> words, size_t count)
{
    return {words.data(), words.size() < count ? words.size() : count};
}
} // namespace detail

/** The set bits of a mask of so many bits, as size_t, in ascending order. Words that it does not have are clear. */
inline auto set_bits(view<const uint64_t> mask, size_t count)
{
    return detail::set_range<detail::number_place>{detail::up_to(mask, tribox_mask_words(count)), {count, 0}};
}

/** The set cells of a grid or window by z, then y, then x, as i, j, k within it. Words that are not there are clear. */
inline auto set_cells(const cells &of, view<const uint64_t> occupied)
{
    const grid::whole &size = of.size();
    return detail::set_range<detail::row_place>{detail::up_to(occupied, tribox_window_words(size)), {size[0], size[1], {0, 0, 0}}};
}

/** A brick that a sink is handed, as tribox_sink says, and a range of the cells of the grid that are set in it. */
struct brick {
    const uint32_t *at;
    const uint64_t *bits;
    auto begin() const
    {
        return detail::set_range<detail::brick_place>{{bits, 8}, {{8 * at[0], 8 * at[1], 8 * at[2]}, {}}}.begin();
    }
    auto end() const { return detail::set_range<detail::brick_place>::last(); }
    /** Where the numbers that come with a brick have those of a cell of the grid. */
    static size_t place(const cell &of) { return 64 * (of.k % 8) + 8 * (of.j % 8) + of.i % 8; }
};

/* ============================================================================================================================== */
/*                                                             Boxes                                                              */
/* ============================================================================================================================== */

namespace detail
{
/* Calls a sink. Returns whether it ends the call. */
template <class Take, class... Of> bool ends(Take &take, const Of &...of)
{
    if constexpr (std::is_void_v<std::invoke_result_t<Take &, const Of &...>>) {
        take(of...);
        return false;
    } else {
        return static_cast<bool>(take(of...));
    }
}
} // namespace detail

/** tribox_overlap: bit i of the mask is set if triangle i overlaps the box; nullptr only counts. */
inline report overlap(triangles of, const box &about, view<uint64_t> mask, const options &how = {}, on_error fails = {})
{
    report counted = {};
    const bool fits = mask.size() >= tribox_mask_words(of.count());
    fails(!fits ? TRIBOX_BAD_ARGUMENT : of.call(tribox_overlap, tribox_mesh_overlap, &about, &how, mask.data(), &counted));
    return counted;
}

/** tribox_split: bit c of a byte is set if the triangle in that place of the list overlaps child c of the box. */
inline report split(triangles of, view<const uint32_t> list, const box &parent, view<uint8_t> children,
                    const double *middle = nullptr, const options &how = {}, on_error fails = {})
{
    static const uint32_t none = 0; // a list that is NULL is all triangles
    report counted = {};
    fails(children.size() < list.size() ? TRIBOX_BAD_ARGUMENT
                                        : of.call(tribox_split, tribox_mesh_split, list.size() ? list.data() : &none, list.size(),
                                                  &parent, middle, &how, children.data(), &counted));
    return counted;
}

/** What split with a sink works in. The sink may split the child that it is handed in the same memory. */
struct split_memory {
    struct level {
        buffer<uint8_t> children;
        buffer<uint32_t> list;
    };
    std::deque<level> levels; /* which stay where they are */
    size_t depth = 0;         /* of the splits that are going on */
};

/**
 * split, to a sink: take(c, list) for each child c that has triangles, in turn, with their numbers in the order of the list. They
 * are valid until it returns. The box is parent.child(c, middle).
 */
template <class Take>
report split(triangles of, view<const uint32_t> list, const box &parent, split_memory &memory, Take &&take,
             const double *middle = nullptr, const options &how = {}, on_error fails = {})
{
    if (!list.data() && list.size()) { // nullptr, as if it were an output
        fails(TRIBOX_BAD_ARGUMENT);
        return {};
    }
    struct while_here {
        size_t &depth;
        ~while_here() { depth--; }
    };
    if (memory.depth == memory.levels.size())
        memory.levels.emplace_back();
    auto &own = memory.levels[memory.depth];
    const while_here deeper{++memory.depth};
    const uint8_t *const children = own.children.grow(list.size());
    uint32_t *const found = own.list.grow(list.size() + 1);
    const report counted = split(of, list, parent, own.children, middle, how, fails);
    for (unsigned c = 0; c < 8 && counted.overlapping; c++) {
        size_t count = 0;
        for (size_t i = 0; i < list.size(); i++) { // no branch for the processor to guess
            found[count] = list[i];
            count += children[i] >> c & 1;
        }
        if (count && detail::ends(take, c, view<const uint32_t>(found, count))) {
            fails(TRIBOX_STOPPED);
            break;
        }
    }
    return counted;
}

/** tribox_soup_sort: an order in which triangles that are near in number are near in space. */
inline buffer<uint32_t> sort(triangles of, on_error fails = {})
{
    buffer<uint32_t> order(of.count());
    const scratch memory(16 * of.count());
    fails(of.call(tribox_soup_sort, tribox_mesh_sort, order.data(), static_cast<void *>(memory.data())));
    return order;
}

/** A soup that owns its streams, and may be moved. */
struct own_soup : soup {
    /** tribox_mesh_gather: triangles in this order, less an origin if they are of a mesh. */
    own_soup(triangles of, view<const uint32_t> order, const double *origin = nullptr, on_error fails = {})
        : soup(tribox_soup{}), numbers(order.size() <= SIZE_MAX / 9 ? 9 * order.size() : SIZE_MAX)
    {
        float *to[9];
        for (size_t n = 0; n < 9; n++)
            to[n] = numbers.data() + n * order.size();
        for (size_t v = 0; v < 3; v++) {
            x[v] = to[v];
            y[v] = to[3 + v];
            z[v] = to[6 + v];
        }
        const status result = of.mesh ? tribox_mesh_gather(of.mesh, origin, order.data(), 0, order.size(), to, to + 3, to + 6)
                                      : tribox_soup_gather(of.soup, order.data(), 0, order.size(), to, to + 3, to + 6);
        count = fails(result) ? order.size() : 0;
    }

  private:
    buffer<float> numbers;
};

/** A tribox_index and its nodes, over triangles that it views. It may be moved. */
struct index {
    /** tribox_index_build. What lists call the triangles may be given: the order that they were gathered in. */
    explicit index(triangles of, view<const uint32_t> by_ids = {}, const options &how = {}, on_error fails = {})
        : soup_of(of.soup ? *of.soup : tribox_soup{}), mesh_of(of.mesh ? *of.mesh : tribox_mesh{}), is_mesh(of.mesh), ids(by_ids),
          held(tribox_index_bytes(of.count()) + 63)
    {
        const tribox_index own = c();
        fails(ids.size() && ids.size() < count() ? TRIBOX_BAD_ARGUMENT : tribox_index_build(&own, &how, nodes()));
    }
    size_t count() const { return is_mesh ? mesh_of.count : soup_of.count; }
    /** For the calls that are not here; valid until the index moves. */
    tribox_index c() const { return {nodes(), is_mesh ? nullptr : &soup_of, is_mesh ? &mesh_of : nullptr, ids.data(), {}}; }
    void *nodes() const { return held.data() + (64 - reinterpret_cast<uintptr_t>(held.data()) % 64) % 64; }

    /** tribox_index_any: a triangle that overlaps; count() if none does. */
    size_t any(const region &about, const options &how = {}, on_error fails = {}) const
    {
        size_t found = count();
        const tribox_index own = c();
        fails(tribox_index_any(&own, &about, &how, &found));
        return found;
    }
    /** tribox_index_list: as many triangles as there is room for. Returns how many overlap. */
    size_t list(const region &about, view<uint32_t> room, const options &how = {}, on_error fails = {}) const
    {
        size_t found = 0;
        const tribox_index own = c();
        fails(tribox_index_list(&own, &about, &how, room.data() ? room.size() : 0, room.data(), &found));
        return found;
    }
    /** All triangles that overlap. If the memory has to grow, the index is asked twice. */
    view<const uint32_t> list(const region &about, buffer<uint32_t> &memory, const options &how = {}, on_error fails = {}) const
    {
        size_t found = list(about, view<uint32_t>(memory), how, fails);
        if (found > memory.size())
            found = list(about, view<uint32_t>(memory.grow(found), found), how, fails);
        return {memory.data(), found};
    }

  private:
    tribox_soup soup_of;
    tribox_mesh mesh_of;
    bool is_mesh;
    view<const uint32_t> ids;
    scratch held;
};

/* ============================================================================================================================== */
/*                                                        Cells of a grid                                                         */
/* ============================================================================================================================== */

/** tribox_voxelize: sets the bits of the cells that triangles overlap. Counts are not returned, as they cost. */
inline void voxelize(triangles of, const cells &in, view<uint64_t> occupied, report *counted = nullptr, const options &how = {},
                     on_error fails = {})
{
    const bool fits = occupied.size() >= tribox_window_words(in.size());
    fails(!fits ? TRIBOX_BAD_ARGUMENT
                : of.call(tribox_voxelize, tribox_mesh_voxelize, in.grid, in.window, &how, occupied.data(), counted));
}

/** Lists one after the other: (*this)[n] is the n-th. */
struct lists {
    buffer<size_t> starts;
    buffer<uint32_t> list;
    size_t size() const { return starts.size() ? starts.size() - 1 : 0; }
    view<const uint32_t> operator[](size_t n) const { return {list.data() + starts[n], starts[n + 1] - starts[n]}; }
};

/** tribox_tile_lists, both passes: the triangles of each tile. */
inline lists tile_lists(triangles of, const grid &in, const tiles &share, const options &how = {}, on_error fails = {})
{
    lists made;
    made.starts = buffer<size_t>(share.count + 1);
    const auto pass = [&](uint32_t *list) {
        return of.call(tribox_tile_lists, tribox_mesh_tile_lists, &in, &share, &how, made.starts.data(), list);
    };
    status result = pass(nullptr);
    if (result == TRIBOX_OK)
        result = pass(made.list.grow(made.starts[share.count] + 1)); // an empty one is no NULL
    if (!fails(result))
        made = {};
    return made;
}

namespace detail
{
/* A sink as C has it. An exception waits until C has returned. */
template <class Take> struct from_c {
    Take &take;
    std::exception_ptr thrown;

    template <class... Of> static int call(void *data, const Of &...of) noexcept
    {
        from_c &own = *static_cast<from_c *>(data);
#ifdef __cpp_exceptions
        try {
            return ends(own.take, of...);
        } catch (...) {
            own.thrown = std::current_exception();
            return 1;
        }
#else
        return ends(own.take, of...);
#endif
    }
    static int bits(void *data, const uint32_t *at, const uint64_t *bits) { return call(data, brick{at, bits}); }
    static int ids(void *data, const uint32_t *at, const uint64_t *bits, const uint32_t *ids)
    {
        return call(data, brick{at, bits}, view<const uint32_t>(ids, 512));
    }
    static int lists(void *data, const uint32_t *at, const uint64_t *bits, const uint32_t *starts, const uint32_t *list)
    {
        return call(data, brick{at, bits}, view<const uint32_t>(starts, 513), view<const uint32_t>(list, starts[512]));
    }
};
} // namespace detail

/**
 * tribox_bricks, tribox_bricks_ids or tribox_bricks_lists, by what the sink takes: take(brick), take(brick, ids) or take(brick,
 * starts, list). Those of a cell are at brick.place(cell) of ids and of starts.
 */
template <class Take>
report bricks(triangles of, const grid &in, const tiles &share, const lists &by_tile, scratch &memory, Take &&take,
              const options &how = {}, on_error fails = {})
{
    using numbers = view<const uint32_t>;
    using calls = detail::from_c<std::remove_reference_t<Take>>;
    calls own{take, {}};
    report counted = {};
    const auto call = [&](auto *by_soup, auto *by_mesh, size_t bytes, const auto &sink) {
        if (by_tile.size() != share.count || share.side > 1024)
            return TRIBOX_BAD_ARGUMENT;
        return of.call(by_soup, by_mesh, &in, &share, by_tile.starts.data(), by_tile.list.data(), &how,
                       static_cast<void *>(memory.grow(bytes)), &sink, &counted);
    };
    status result;
    if constexpr (std::is_invocable_v<Take &, brick>) {
        result = call(tribox_bricks, tribox_mesh_bricks, tribox_bricks_bytes(share.side), tribox_sink{calls::bits, &own});
    } else if constexpr (std::is_invocable_v<Take &, brick, numbers>) {
        result =
            call(tribox_bricks_ids, tribox_mesh_bricks_ids, tribox_bricks_ids_bytes(share.side), tribox_ids_sink{calls::ids, &own});
    } else {
        size_t most = 0;
        for (size_t n = 0; n < by_tile.size(); n++)
            most = by_tile[n].size() > most ? by_tile[n].size() : most;
        result = call(tribox_bricks_lists, tribox_mesh_bricks_lists, tribox_bricks_lists_bytes(share.side, most),
                      tribox_lists_sink{calls::lists, &own});
    }
    if (own.thrown)
        std::rethrow_exception(own.thrown);
    fails(result);
    return counted;
}

namespace detail
{
/* The tiles that triangles are in, each with its list, by halving boxes of tiles: nothing is kept of tiles without triangles. */
template <class Take> struct tile_search {
    triangles of;
    const grid &in;
    uint32_t side;
    options how; /* for splits: no triangle may be missed */
    Take &take;  /* take(i, j, k, list) returns a status, which ends the search if it is not TRIBOX_OK */
    split_memory memory;

    /* Where tile t of axis a begins, and the one before it ends. */
    double plane(unsigned a, uint32_t t) const
    {
        const bool is_end = uint64_t{t} * side >= in.size[a];
        uint32_t at[3] = {0, 0, 0};
        at[a] = is_end ? in.size[a] - 1 : t * side;
        const tribox_box of_cell = tribox_grid_cell(&in, at[0], at[1], at[2]);
        return is_end ? of_cell.hi[a] : of_cell.lo[a];
    }
    status search(const window &some, view<const uint32_t> list)
    {
        unsigned flat = 0; /* axes of one tile: their upper children are not wanted */
        double low[3], middle[3], high[3];
        for (unsigned a = 0; a < 3; a++) {
            const uint32_t first = some.first[a], size = some.size[a];
            low[a] = plane(a, first);
            high[a] = plane(a, first + size);
            middle[a] = size > 1 ? plane(a, first + size / 2) : high[a];
            flat |= static_cast<unsigned>(size == 1) << a;
        }
        if (flat == 7)
            return take(some.first[0], some.first[1], some.first[2], list);
        status result = TRIBOX_OK, of_split;
        const auto take_child = [&](unsigned c, view<const uint32_t> own) {
            window child = some;
            for (unsigned a = 0; a < 3; a++)
                if (~flat >> a & 1) {
                    const uint32_t half = some.size[a] / 2;
                    child.first[a] += c >> a & 1 ? half : 0;
                    child.size[a] = c >> a & 1 ? some.size[a] - half : half;
                }
            if (!(c & flat))
                result = search(child, own);
            return result != TRIBOX_OK;
        };
        split(of, list, box(low, high), memory, take_child, middle, how, of_split);
        return result ? result : of_split;
    }
};
} // namespace detail

/**
 * The cells that triangles overlap, to a sink: take(i, j, k), tile by tile, without a bit for each. Memory goes with the triangles,
 * however many tiles the grid has, up to SIZE_MAX.
 */
template <class Take, class = std::enable_if_t<std::is_invocable_v<Take &, uint32_t, uint32_t, uint32_t>>>
report voxelize(triangles of, const grid &in, Take &&take, const options &how = {}, on_error fails = {})
{
    const tiles all(in);
    const bool is_sparse = all.count / 4 > of.count() + (1 << 14) && (!how.axes || how.axes & TRIBOX_AXES_BOX);
    status result;
    scratch memory;
    const auto take_cells = [&take](const brick &some) {
        for (const cell &at : some)
            if (detail::ends(take, at.i, at.j, at.k))
                return true;
        return false;
    };
    lists by_tile =
        tile_lists(of, in, is_sparse ? tiles(tribox_tiles{all.side, 0, 0}) : all, how, result); // of no tile: asks whether all fits
    if (result || !is_sparse)
        return fails(result) ? bricks(of, in, all, by_tile, memory, take_cells, how, fails) : report{};

    report counted = {};
    uint32_t along[3];
    for (int a = 0; a < 3; a++)
        along[a] = (in.size[a] - 1) / all.side + 1;
    by_tile.starts = buffer<size_t>(2);
    by_tile.starts[0] = 0;
    const auto take_tile = [&](uint32_t i, uint32_t j, uint32_t k, view<const uint32_t> list) {
        std::memcpy(by_tile.list.grow(list.size()), list.data(), list.size() * sizeof(uint32_t));
        by_tile.starts[1] = list.size();
        const tiles one(tribox_tiles{all.side, (size_t{k} * along[1] + j) * along[0] + i, 1});
        const report own = bricks(of, in, one, by_tile, memory, take_cells, how, result);
        counted.overlapping += own.overlapping;
        counted.undecided += own.undecided;
        return result;
    };
    options coarse = how;
    coarse.accuracy = TRIBOX_CONSERVATIVE;
    coarse.axes = how.axes == TRIBOX_AXES_ALL ? 0 : how.axes & TRIBOX_AXES_BOX;
    buffer<uint32_t> every(of.count());
    for (size_t n = 0; n < every.size(); n++)
        every[n] = static_cast<uint32_t>(n);
    fails(detail::tile_search<decltype(take_tile)>{of, in, all.side, coarse, take_tile, {}}.search(
        {{0, 0, 0}, {along[0], along[1], along[2]}}, every));
    return counted;
}

} // namespace tribox

#endif
