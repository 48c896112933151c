/*
 * test_refused.c - every function refuses every fault of what it takes, by the status that its manual names, and writes nothing;
 * and it does not mind faults of what it does not take.
 */
#include <float.h>
#include <limits.h>
#include <math.h>

#include "calls.h"
#include "common/harness.h"
#include "dispatch.h"

static asked a;
static outputs out, poison;

static void begin(unsigned position_bytes)
{
    static asked right[9];
    if (!right[position_bytes].soup) {
        ask_rightly(position_bytes, &a, &out);
        right[position_bytes] = a;
    }
    a = right[position_bytes];
    memcpy(&out, &poison, COMPARED);
}

/* Bricks of tiles before that of a fault have been handed to the sink. */
static bool is_written(const call *c, tribox_status status)
{
    const bool has_bricks = status == TRIBOX_BAD_VERTEX && call_takes(c, "lists");
    out.bricks = has_bricks ? 0 : out.bricks;
    return status && outputs_differ(&out, &poison, has_bricks ? offsetof(outputs, scratch) : COMPARED);
}

static void ask(const call *c, tribox_status due, const char *what, int n)
{
    snprintf(doing, sizeof doing, "%s %s: %s %d", c->function, c->about, what, n);
    const tribox_status status = c->ask(&a);
    if (status != due)
        fail_msg("%s: status %d in place of %d", doing, (int)status, (int)due);
    if (is_written(c, status))
        fail_msg("%s: something is written", doing);
    if (!status || due == TRIBOX_BAD_VERTEX)
        memcpy(&out, &poison, COMPARED);
}

/* Pointers that have to be there, by the calls that need them; and those that need not be. */
#define AT(member) offsetof(asked, member)
#define AT3(member) AT(member[0]), AT(member[1]), AT(member[2])
static const struct needed {
    const char *of;
    size_t at[18]; /* and 0 */
} pointers[] = {
    {"-",
     {AT(options), AT(window), AT(mask), AT(inside), AT(report), AT(odd_rows), AT(origin), AT(middle), AT(children), AT(side_b),
      AT(face[0]), AT(face[3]), AT(face[5]), AT(the_mesh_index.ids), AT(the_mesh.indices)}},
    {"soup any_soup", {AT(soup)}},
    {"mesh", {AT(mesh)}},
    {"box", {AT(box)}},
    {"oriented", {AT(oriented)}},
    {"boxes", {AT(boxes), AT3(the_boxes.lo), AT3(the_boxes.hi)}},
    {"triangle", {AT(triangle)}},
    {"in_soup", {AT(soup_index), AT(the_soup_index.soup)}},
    {"in_mesh", {AT(mesh_index), AT(the_mesh_index.mesh)}},
    {"in_soup&asked", {AT(the_soup_index.nodes)}},
    {"in_mesh&asked", {AT(the_mesh_index.nodes)}},
    {"region", {AT(region), AT(the_region.box)}},
    {"turned", {AT(turned), AT(the_turned.oriented)}},
    {"grid", {AT(grid)}},
    {"tiles", {AT(tiles)}},
    {"lists", {AT(starts_in), AT(list_in)}},
    {"sink", {AT(sink), AT(the_sink.take)}},
    {"ids_sink", {AT(ids_sink), AT(the_ids_sink.take)}},
    {"lists_sink", {AT(lists_sink), AT(the_lists_sink.take)}},
    {"size", {AT(size)}},
    {"surface", {AT(surface)}},
    {"order_in", {AT(order_in)}},
    {"outside", {AT(outside)}},
    {"faces", {AT(faces), AT(label_count)}},
    {"joins", {AT(parents), AT(side_a)}},
    {"streams", {AT(x), AT(y), AT(z), AT3(to), AT(to[3]), AT(to[4]), AT(to[5]), AT(to[6]), AT(to[7]), AT(to[8])}},
    {"bits", {AT(bits_out)}},
    {"list", {AT(list)}},
    {"found", {AT(found)}},
    {"start", {AT(start)}},
    {"places", {AT(places)}},
    {"order", {AT(order)}},
    {"ids", {AT(ids)}},
    {"occupied", {AT(occupied)}},
    {"solid", {AT(solid)}},
    {"nodes", {AT(nodes)}},
    {"scratch sorted", {AT(scratch)}},
    {"runs", {AT(runs)}},
    {"mesh in_mesh", {AT(the_mesh.positions)}},
    {"soup in_soup any_soup", {AT3(the_soup.x), AT3(the_soup.y), AT3(the_soup.z)}},
};
enum { POINTERS = sizeof pointers / sizeof pointers[0] };

static void take_away(size_t at) { memset((char *)&a + at, 0, sizeof(void *)); }

static const double not_finite[] = {NAN, -NAN, INFINITY, -INFINITY};

static void bad_box(int n) { (n < 12 ? a.the_box.lo : a.the_box.hi)[n % 3] = not_finite[n / 3 % 4]; }

/* Empty along an axis, by little; and the largest. */
static void right_box(int n)
{
    for (int k = 0; k < 3; k++) {
        a.the_box.lo[k] = n < 3 ? k == n ? 1e-300 : 0 : -FLT_MAX;
        a.the_box.hi[k] = n < 3 ? 0 : DBL_MAX;
    }
}

static void bad_oriented(int n)
{
    double *const of[] = {a.the_oriented.center, a.the_oriented.half, a.the_oriented.axis[0], a.the_oriented.axis[1],
                          a.the_oriented.axis[2]};
    a.the_oriented.half[(n + 1) % 3] = n / 60 ? -1 : 1; /* empty or not */
    of[n / 12 % 5][n % 3] = not_finite[n / 3 % 4];
}

static void two_regions(int n) { (void)n, a.the_region.oriented = &a.the_oriented, a.the_turned.box = &a.the_box; }

static void turn_region(int n) { (void)n, a.the_region = a.the_turned; }

static void two_triangles(int n) { (void)n, a.the_soup_index.mesh = &a.the_mesh, a.the_mesh_index.soup = &a.the_soup; }

static void reserved_index(int n) { a.the_soup_index.reserved[n] = a.the_mesh_index.reserved[n] = 1u << 7 * n; }

static void reserved_mesh(int n) { a.the_mesh.reserved[n] = 1u << 7 * n; }

static void reserved_options(int n) { a.the_options.reserved[n] = 1u << 7 * n; }

static void set_counts(size_t count) { a.the_soup.count = a.the_mesh.count = a.the_boxes.count = a.total = count; }

/* More than an address space holds. */
static void endless_count(int n)
{
    set_counts((const size_t[]){(size_t)PTRDIFF_MAX / sizeof(float) + 1, SIZE_MAX / sizeof(float), SIZE_MAX / sizeof(float) + 1,
                                SIZE_MAX / 3 + 1, SIZE_MAX / 9 * 4, SIZE_MAX - 63, SIZE_MAX - 1, SIZE_MAX}[n]);
}

/* More triangles than nine streams, and more keys of an order. */
static void endless_triangles(int n) { set_counts((size_t)PTRDIFF_MAX / 12 + 1 + (size_t)n); }

static void endless_keys(int n) { set_counts((size_t)PTRDIFF_MAX / 16 + 1 + (size_t)n); }

static void endless_order(int n)
{
    a.first = (const size_t[]){SIZE_MAX, SIZE_MAX - COUNT + 1, SIZE_MAX / sizeof(float) + 1, PTRDIFF_MAX / sizeof(float)}[n];
}

#if SIZE_MAX > UINT32_MAX
static void many(int n) { set_counts(((size_t)1 << 32) + 1 + (size_t)n); }

static void all_numbers(int n) { set_counts(((size_t)1 << 32) + (size_t)n); }

static void many_words(int n) { set_counts(((size_t)1 << 38) + 1 + (size_t)n); }
#else
/* The words can be addressed, the ids cannot. */
static void many_cells(int n)
{
    a.the_grid.size[0] = 64, a.the_grid.size[1] = 1 << 12, a.the_grid.size[2] = 1u << (13 - n);
    a.window = NULL;
}
#endif

static void position_bytes(int n)
{
    a.the_mesh.position_bytes = (const unsigned[]){1, 2, 3, 5, 6, 7, 9, 12, 16, 24, 0x80000008u, UINT_MAX}[n];
}

static void index_bytes(int n) { a.the_mesh.index_bytes = (const unsigned[]){0, 1, 3, 5, 8, 258, 0x80000002u, UINT_MAX}[n]; }

static void unused_index_bytes(int n) { index_bytes(n), a.the_mesh.indices = NULL; }

static size_t position_size(void) { return a.the_mesh.position_bytes == 8 ? 8 : 4; }

static void stride(int n) { a.the_mesh.stride = (size_t)n % (3 * position_size() - 1) + 1; }

static void stride_of_columns(int n)
{
    a.the_mesh.axis_stride = 3 * COUNT * position_size();
    a.the_mesh.stride = (size_t)n % (position_size() - 1) + 1;
}

static void columns(int n)
{
    a.the_mesh.axis_stride = (size_t)n * position_size();
    a.the_mesh.vertices = 3;
    memset(a.index, 0, sizeof a.index);
}

static void axis_stride(int n)
{
    a.the_mesh.axis_stride = n < 3 ? (size_t)n + 1 : n < 5 ? SIZE_MAX >> (n - 3) : (size_t)PTRDIFF_MAX / 3 + 1;
    a.the_mesh.stride = 3 * position_size();
}

static void mesh_axes(int n)
{
    static const unsigned no_orders[] = {1, 12, 111, 122, 124, 23, 321123, 1123, UINT_MAX, 3, 213 + 1000, 120};
    a.the_mesh.axes = no_orders[n];
}

static void endless_vertices(int n)
{
    static const size_t layouts[][2] = {{SIZE_MAX, 0},           {(size_t)PTRDIFF_MAX / 12 + 2, 0},
                                        {300, SIZE_MAX},         {SIZE_MAX, SIZE_MAX},
                                        {SIZE_MAX / 24 + 2, 24}, {300, SIZE_MAX / 299},
                                        {4, SIZE_MAX / 4 + 1},   {SIZE_MAX, 32}};
    a.the_mesh.vertices = layouts[n][0];
    a.the_mesh.stride = layouts[n][1];
}

static void missing_vertex(int n)
{
    a.what = TRIBOX_FIRST_MISS; /* then all are tested */
    a.index[7 * n % (3 * COUNT)] = n % 2 ? 3 * COUNT : UINT32_MAX;
}

static void missing_last(int n)
{
    a.what = TRIBOX_FIRST_MISS;
    a.the_mesh.indices = n ? a.the_mesh.indices : NULL;
    a.the_mesh.vertices--;
    memset(a.numbers, 0, sizeof a.numbers); /* which no list names */
}

static void missing_and_kernel(int n) { missing_vertex(n), a.the_options.kernel = "nope"; }

static void accuracy(int n) { a.the_options.accuracy = (tribox_accuracy)(const int[]){3, 4, 99, -1, INT_MAX, INT_MIN}[n]; }

static void axes(int n) { a.the_options.axes = (const unsigned[]){8, 9, 15, 16, 0x80000000u, UINT_MAX}[n]; }

static const unsigned orders[] = {0, 123, 132, 213, 231, 312, 321};

/* Whichever axes are asked. */
static void axis_order(int n)
{
    static const unsigned large[] = {1123, 3210, 123123, 0x80000000u + 123, UINT_MAX};
    a.the_options.axis_order = (unsigned)n;
    for (size_t k = 0; k < sizeof orders / sizeof orders[0]; k++)
        if (n == (int)orders[k])
            a.the_options.axis_order = large[k % 5];
    a.the_options.axes = (unsigned)n % 8;
}

static void kernel(int n) { a.the_options.kernel = (const char *const[]){"", "AVX2", "nope", "scalar ", "sse", "avx512f"}[n]; }

/* EXACT moves no edge and no plane. */
static void axes_of_turned(int n) { a.the_options.axes = (const unsigned[]){2, 3, 4, 5, 6}[n]; }

static void axes_without_box(int n) { a.the_options.axes = (const unsigned[]){2, 4, 6}[n]; }

/* For all but thin surfaces: axes that every call takes. */
static void right_options(int n)
{
    a.the_options.accuracy = (tribox_accuracy)(n % 3);
    a.the_options.axes = (const unsigned[]){1, 0, 7}[n % 3 ? n / 3 % 3 : 0];
    a.the_options.axis_order = orders[(size_t)n % 7];
}

static void no_what(int n) { a.what = (tribox_find_what)(const int[]){2, 3, -1, INT_MIN}[n]; }

static void outside(int n)
{
    static const size_t ranges[][2] = {{0, COUNT + 1}, {1, COUNT},        {COUNT, 1},          {COUNT + 1, 0},
                                       {COUNT - 1, 2}, {SIZE_MAX, 0},     {SIZE_MAX, 1},       {0, SIZE_MAX},
                                       {2, SIZE_MAX},  {2, SIZE_MAX - 1}, {50, SIZE_MAX - 49}, {SIZE_MAX, SIZE_MAX}};
    a.first = ranges[n][0];
    a.count = ranges[n][1];
}

static void no_range(int n) { a.first = (size_t)n * (COUNT / 2), a.count = 0, memset(a.to, 0, sizeof a.to), a.order_in = NULL; }

static void bad_origin(int n) { a.the_origin[n % 3] = not_finite[n / 3]; }

static void bad_middle(int n) { a.the_middle[n % 3] = n < 12 ? not_finite[n / 3] : n < 15 ? -0x1p-1074 : (double)SIDE + 0x1p-49; }

static void bad_order(int n) { a.orders[n] = n % 2 ? COUNT : UINT32_MAX; }

/* Of the first tile and the last, and of triangles that these list. */
static void bad_list(int n) { a.numbers[n % 2 ? 0 : a.tile_starts[TILES] - 1] = n / 2 ? COUNT : UINT32_MAX; }

static void bad_listed(int n) { a.index[3 * a.numbers[n % 2 ? 0 : a.tile_starts[TILES] - 1] + (uint32_t)n / 2] = 3 * COUNT; }

static void bad_unlisted(int n)
{
    a.index[3 * COUNT - 1 - (unsigned)n] = UINT32_MAX;
    memset(a.numbers, 0, sizeof a.numbers);
}

/* Only the range that is asked for is looked at. */
static void beside_range(int n)
{
    a.first = 4, a.count = COUNT - 8;
    for (uint32_t i = 0; i < COUNT; i += i == 3 ? COUNT - 7 : 1)
        a.orders[i] = a.index[3 * i + (uint32_t)n] = n == 1 ? 3 * COUNT : UINT32_MAX;
}

static void grid_numbers(int n)
{
    static const double cells[] = {0, -1, NAN, INFINITY, 1e-30, -INFINITY, DBL_MAX / 4};
    a.the_grid.cell[n % 3] = cells[n / 3];
    a.the_grid.origin[n % 3] = 1;
}

/* Planes that fall, and no more than two. */
static void grid_falls(int n)
{
    a.the_grid.size[n] = a.the_window.size[n] = 1;
    a.the_grid.cell[n] = -8;
    a.the_grid.origin[n] = 1;
}

static void grid_origin(int n) { a.the_grid.origin[n % 3] = (const double[]){NAN, INFINITY, -INFINITY, DBL_MAX}[n / 3]; }

static void grid_size(int n) { a.the_grid.size[n] = 0, a.the_window.size[n] = 0; }

static void set_size(uint32_t x, uint32_t y, uint32_t z) { a.the_grid.size[0] = x, a.the_grid.size[1] = y, a.the_grid.size[2] = z; }

/* More words than a call writes: of the grid, and of the window if there is one. */
static void grid_words(int n)
{
    static const uint32_t sizes[][3] = {{1, 65536, 32769},         {64, 32769, 65536},
                                        {65, 32768, 32769},        {4194304, 4194304, 4194304},
                                        {UINT32_MAX, 1u << 20, 1}, {UINT32_MAX, UINT32_MAX, UINT32_MAX}};
    const uint32_t *const size = sizes[n / 2];
    set_size(size[0], size[1], size[2]);
    memcpy(a.the_window.size, size, sizeof a.the_window.size);
    a.window = n % 2 ? &a.the_window : NULL;
}

/* Too many tiles to number. */
static void endless_tiles(int n)
{
    set_size(UINT32_MAX, UINT32_MAX, UINT32_MAX);
    memcpy(a.the_window.size, a.the_grid.size, sizeof a.the_window.size);
    a.window = n % 2 ? &a.the_window : NULL;
    a.the_tiles = (tribox_tiles){n / 2 ? 1 : 8, 0, n / 2 ? 1 : 0};
}

static void bad_window(int n)
{
    static const uint32_t spans[][2] = {{0, SIDE + 1}, {SIDE, 1}, {SIDE + 1, 0}, {1, SIDE}, {1, UINT32_MAX}, {UINT32_MAX, 1}};
    a.the_window.first[n % 3] = spans[n / 3][0];
    a.the_window.size[n % 3] = spans[n / 3][1];
}

static void empty_window(int n) { a.the_window.first[n % 3] = (uint32_t)n, a.the_window.size[n % 3] = 0; }

/* Of a grid without end. */
static void empty_part(int n)
{
    set_size(UINT32_MAX, UINT32_MAX, UINT32_MAX);
    memcpy(a.the_window.size, a.the_grid.size, sizeof a.the_window.size);
    a.the_window.size[n] = 0;
}

static void bad_tiles(int n)
{
    static const tribox_tiles shares[] = {
        {0, 0, TILES}, {0, 0, 0},    {UINT32_MAX, 0, TILES}, {TILE, 0, TILES + 1}, {TILE, 3, SIZE_MAX - 1},
        {TILE, 9, 0},  {TILE, 8, 1}, {TILE, SIZE_MAX, 1},    {1, 1, CELLS}};
    a.the_tiles = shares[n];
}

static void no_bricks(int n) { a.the_tiles = (tribox_tiles){(const uint32_t[]){4, 15, 17, 20, 1032, UINT32_MAX - 7}[n], 0, 1}; }

static void falling_starts(int n) { a.tile_starts[n] = a.tile_starts[n + 1] + 1; }

/* No list is needed by tiles without triangles. */
static void empty_lists(int n) { memset(a.tile_starts, n, sizeof a.tile_starts), a.list_in = NULL; }

static void many_ids(int n) { a.first_id = UINT32_MAX - COUNT + 1 + (uint32_t)n; }

static void last_ids(int n) { a.first_id = UINT32_MAX - COUNT - (uint32_t)n; }

static void no_room(int n) { a.room = 0, a.list = NULL, a.bits_out = n ? a.bits_out : NULL; }

/* Runs of free cells beyond 2^31; a layer more would be beyond 2^64. */
static void many_runs(int n)
{
    set_size((const uint32_t[]){3, 127, 1, UINT32_MAX}[n], (const uint32_t[]){32768, 65536, 65536, 2}[n],
             (const uint32_t[]){32768, 512, 32768, 1}[n]);
}

/*
 * For the calls that take some of these words. The others are right in spite of it, at least at first, or EVERY time; if it is
 * ALONE they are not asked. NOTHING: it is a fault of no triangles, too.
 */
enum { NOTHING = 1, ALONE = 2, EVERY = 4 };
static const struct fault {
    const char *name, *of;
    tribox_status status;
    int count;
    void (*spoil)(int n);
    unsigned how;
} faults[] = {
    {"box", "box region", TRIBOX_BAD_BOX, 24, bad_box, NOTHING},
    {"largest and empty box", "-", TRIBOX_OK, 4, right_box, EVERY},
    {"oriented box", "oriented turned", TRIBOX_BAD_BOX, 120, bad_oriented, NOTHING},
    {"two regions", "region turned", TRIBOX_BAD_ARGUMENT, 1, two_regions, NOTHING},
    {"inside an oriented box", "inside", TRIBOX_BAD_ARGUMENT, 1, turn_region, NOTHING},
    {"two kinds of triangles", "in_soup in_mesh", TRIBOX_BAD_ARGUMENT, 1, two_triangles, NOTHING},
    {"index reserved", "in_soup in_mesh", TRIBOX_BAD_ARGUMENT, 4, reserved_index, NOTHING},
    {"mesh reserved", "mesh in_mesh", TRIBOX_BAD_ARGUMENT, 4, reserved_mesh, NOTHING},
    {"options reserved", "test", TRIBOX_BAD_OPTION, 4, reserved_options, NOTHING},
    {"endless", "soup mesh boxes in_soup in_mesh sorted", TRIBOX_BAD_ARGUMENT, 8, endless_count, ALONE},
    {"endless triangles", "mesh in_mesh", TRIBOX_BAD_ARGUMENT, 2, endless_triangles, ALONE},
    {"endless keys", "sorted", TRIBOX_BAD_ARGUMENT, 2, endless_keys, ALONE},
    {"endless order", "order_in", TRIBOX_BAD_ARGUMENT, 4, endless_order, ALONE},
#if SIZE_MAX > UINT32_MAX
    {"too many for numbers", "many uncounted", TRIBOX_BAD_ARGUMENT, 2, many, ALONE},
    {"too many for ids", "ids_sink", TRIBOX_BAD_ARGUMENT, 2, all_numbers, ALONE},
    {"too many words", "bits", TRIBOX_BAD_ARGUMENT, 2, many_words, ALONE},
#else
    {"too many cells for ids", "ids", TRIBOX_BAD_GRID, 2, many_cells, ALONE},
#endif
    {"position_bytes", "mesh in_mesh", TRIBOX_BAD_ARGUMENT, 12, position_bytes, NOTHING},
    {"index_bytes", "mesh in_mesh", TRIBOX_BAD_ARGUMENT, 8, index_bytes, NOTHING},
    {"index_bytes of none", "-", TRIBOX_OK, 8, unused_index_bytes, EVERY},
    {"stride", "mesh in_mesh", TRIBOX_BAD_ARGUMENT, 23, stride, NOTHING},
    {"stride of columns", "mesh in_mesh", TRIBOX_BAD_ARGUMENT, 7, stride_of_columns, NOTHING},
    {"columns", "-", TRIBOX_OK, 4, columns, EVERY},
    {"axis_stride", "mesh in_mesh", TRIBOX_BAD_ARGUMENT, 6, axis_stride, NOTHING},
    {"mesh axes", "mesh in_mesh", TRIBOX_BAD_ARGUMENT, 12, mesh_axes, NOTHING},
    {"endless vertices", "mesh in_mesh", TRIBOX_BAD_ARGUMENT, 8, endless_vertices, NOTHING},
    {"missing vertex", "vertices&mesh vertices&in_mesh tested listed", TRIBOX_BAD_VERTEX, 43, missing_vertex, ALONE},
    {"missing last vertex", "vertices&mesh vertices&in_mesh", TRIBOX_BAD_VERTEX, 2, missing_last, ALONE},
    {"missing last vertex of all", "listed tested", TRIBOX_BAD_VERTEX, 1, missing_last, ALONE},
    {"missing vertex and kernel", "vertices&mesh&test vertices&mesh&kernel vertices&in_mesh", TRIBOX_NO_KERNEL, 2,
     missing_and_kernel, ALONE},
    {"accuracy", "test", TRIBOX_BAD_OPTION, 6, accuracy, NOTHING},
    {"axes", "test", TRIBOX_BAD_OPTION, 6, axes, NOTHING},
    {"axis_order", "test", TRIBOX_BAD_OPTION, 401, axis_order, NOTHING},
    {"kernel", "test kernel", TRIBOX_NO_KERNEL, 6, kernel, NOTHING},
    {"axes of oriented boxes", "oriented turned thin split", TRIBOX_BAD_OPTION, 5, axes_of_turned, ALONE | NOTHING},
    {"axes of an index", "asked oriented thin split", TRIBOX_BAD_OPTION, 3, axes_without_box, NOTHING},
    {"options of thin surfaces", "thin", TRIBOX_BAD_OPTION, 9, right_options, NOTHING | EVERY},
    {"range", "range", TRIBOX_BAD_ARGUMENT, 12, outside, ALONE | NOTHING},
    {"no range", "-", TRIBOX_OK, 3, no_range, EVERY},
    {"origin", "origin", TRIBOX_BAD_ARGUMENT, 12, bad_origin, NOTHING},
    {"middle", "split", TRIBOX_BAD_BOX, 18, bad_middle, NOTHING},
    {"order", "order_in split", TRIBOX_BAD_VERTEX, COUNT, bad_order, ALONE},
    {"list", "lists", TRIBOX_BAD_VERTEX, 4, bad_list, 0},
    {"vertex of a listed triangle", "listed", TRIBOX_BAD_VERTEX, 6, bad_listed, ALONE},
    {"vertex of another triangle", "listed", TRIBOX_OK, 3, bad_unlisted, ALONE},
    {"numbers beside the range", "range&vertices&mesh order_in", TRIBOX_OK, 3, beside_range, ALONE},
    {"cell", "grid", TRIBOX_BAD_GRID, 21, grid_numbers, NOTHING},
    {"falling planes", "grid", TRIBOX_BAD_GRID, 3, grid_falls, ALONE | NOTHING},
    {"grid origin", "grid", TRIBOX_BAD_GRID, 12, grid_origin, NOTHING},
    {"grid size", "grid size surface", TRIBOX_BAD_GRID, 3, grid_size, NOTHING},
    {"grid words", "cells", TRIBOX_BAD_GRID, 12, grid_words, ALONE | NOTHING},
    {"grid tiles", "tiles uncounted", TRIBOX_BAD_ARGUMENT, 4, endless_tiles, ALONE | NOTHING},
    {"runs", "runs", TRIBOX_BAD_GRID, 4, many_runs, ALONE},
    {"window", "window", TRIBOX_BAD_ARGUMENT, 18, bad_window, NOTHING},
    {"empty window", "-", TRIBOX_OK, SIDE + 1, empty_window, EVERY},
    {"empty part", "window", TRIBOX_OK, 3, empty_part, ALONE},
    {"tiles", "tiles", TRIBOX_BAD_ARGUMENT, 9, bad_tiles, NOTHING},
    {"side of bricks", "lists", TRIBOX_BAD_ARGUMENT, 6, no_bricks, ALONE | NOTHING},
    {"falling starts", "lists", TRIBOX_BAD_ARGUMENT, TILES, falling_starts, ALONE},
    {"no lists", "-", TRIBOX_OK, 1, empty_lists, EVERY},
    {"ids", "ids", TRIBOX_BAD_ARGUMENT, 3, many_ids, 0},
    {"last ids", "-", TRIBOX_OK, 2, last_ids, EVERY},
    {"what", "what", TRIBOX_BAD_ARGUMENT, 4, no_what, NOTHING},
    {"no room", "-", TRIBOX_OK, 2, no_room, EVERY},
};

static const unsigned widths[] = {4, 8, 0};

/* Nothing to do: all that would be read may be NULL. */
static void ask_about_nothing(void)
{
    a.the_soup = (tribox_soup){.count = 0};
    a.the_mesh = (tribox_mesh){.position_bytes = a.the_mesh.position_bytes};
    a.the_boxes = (tribox_boxes){.count = 0};
    a.count = a.total = 0;
    memset(a.tile_starts, 0, sizeof a.tile_starts);
}

/* Without one pointer, with and without those that need not be there. */
static void ask_without(const call *c, const struct needed *p, size_t at, int way)
{
    const bool is_refused = call_takes(c, p->of);
    for (int w = 0; w < 6; w++) {
        if (!is_refused && w != way % 6)
            continue;
        begin(widths[w / 2]);
        for (const size_t *other = pointers[0].at; w % 2 && *other; other++)
            take_away(*other);
        take_away(at);
        ask(c, is_refused ? TRIBOX_BAD_ARGUMENT : TRIBOX_OK, "without pointer", way);
    }
}

CASE(test_needed)
{
    for (size_t k = 0; k < call_count; k++) {
        int way = 0;
        for (size_t n = 0; n < POINTERS; n++)
            for (const size_t *at = pointers[n].at; *at; at++)
                ask_without(&calls[k], &pointers[n], *at, way++);
    }
}

CASE(test_nothing)
{
    for (int w = 0; w < 3; w++)
        for (size_t k = 0; k < call_count; k++) {
            begin(widths[w]);
            ask_about_nothing();
            memset(a.to, 0, sizeof a.to);
            a.order = NULL, a.order_in = a.list_in = NULL;
            snprintf(doing, sizeof doing, "%s %s about nothing", calls[k].function, calls[k].about);
            const tribox_status due = call_takes(&calls[k], "counted") ? TRIBOX_BAD_ARGUMENT : TRIBOX_OK;
            if (calls[k].ask(&a) != due || memcmp(&out, &poison, offsetof(outputs, report)))
                fail_msg("%s", doing);
        }
}

static void ask_all(const struct fault *f, int n, bool is_nothing)
{
    for (size_t k = 0; k < call_count; k++) {
        const bool is_refused = call_takes(&calls[k], f->of);
        if (is_refused || (!is_nothing && !(f->how & ALONE) && (!n || f->how & EVERY)))
            ask(&calls[k], is_refused ? f->status : TRIBOX_OK, f->name, n);
    }
}

CASE(test_faults)
{
    for (size_t f = 0; f < sizeof faults / sizeof faults[0]; f++)
        for (int w = 0; w < (strstr(faults[f].of, "mesh") || strstr(faults[f].of, "vert") ? 3 : 1); w++)
            for (int n = 0; n < faults[f].count; n++)
                for (int is_nothing = 0; is_nothing <= (int)(faults[f].how & NOTHING); is_nothing++) {
                    begin(widths[w]);
                    if (is_nothing) {
                        ask_about_nothing();
                        a.the_mesh.indices = a.index;
                        a.the_mesh.index_bytes = 4;
                    }
                    faults[f].spoil(n);
                    ask_all(&faults[f], n, is_nothing);
                }
}

/* Each kernel by its name, where it runs. */
CASE(test_kernels)
{
    for (size_t i = 0; i < tribox_kernel_count(); i++)
        for (size_t k = 0; k < call_count; k++) {
            begin(4);
            a.the_options.kernel = tribox_kernel_at(i)->name;
            const bool is_refused = !tribox_kernel_runs_here(i) && call_takes(&calls[k], "test kernel");
            ask(&calls[k], is_refused ? TRIBOX_NO_KERNEL : TRIBOX_OK, "kernel", (int)i);
        }
}

/* Every public function has a row, and every row a function. */
CASE(test_names)
{
#define NAME(function) #function,
    static const char *const functions[] = {
#include "public_names.h"
    };
    enum { NAMES = sizeof functions / sizeof functions[0] };
    for (size_t n = 0, k; n < NAMES; n++) {
        for (k = 0; k < call_count && strcmp(calls[k].function, functions[n]) != 0; k++)
            ;
        if (k == call_count)
            fail_msg("%s is in no row of calls.c", functions[n]);
    }
    assert_true(NAMES > 60);
}

CASE(test_mask_words)
{
    assert_int_equal(tribox_mask_words(0), 0);
    for (size_t count = 1; count < 1000; count++)
        assert_int_equal(tribox_mask_words(count), (count - 1) / 64 + 1);
    assert_true(tribox_mask_words(SIZE_MAX) == SIZE_MAX / 64 + 1 && tribox_mask_words(SIZE_MAX - 63) == SIZE_MAX / 64);
}

CASE(test_status_texts)
{
    static const int unknown[] = {TRIBOX_STOPPED + 1, 99, -1, INT_MAX, INT_MIN};
    for (int s = TRIBOX_OK; s <= TRIBOX_STOPPED + 1; s++) {
        const char *const text = tribox_status_text((tribox_status)s);
        assert_true(text && *text && text[strlen(text) - 1] != '.');
        for (int other = TRIBOX_OK; other < s; other++)
            assert_string_not_equal(text, tribox_status_text((tribox_status)other));
    }
    for (size_t k = 0; k < sizeof unknown / sizeof unknown[0]; k++)
        assert_string_equal(tribox_status_text((tribox_status)unknown[k]), tribox_status_text((tribox_status)99));
}

/* A triangle in the plane x + y = 2 meets boxes in an edge alone, which goes to a slower stage; of that FAST is silent. */
CASE(test_undecided)
{
    static const float x[3] = {2.25f, -0.25f, 1.25f}, y[3] = {-0.25f, 2.25f, 0.75f}, z[3] = {0.5f, 0.25f, -2};
    const tribox_soup soup = {{x, x + 1, x + 2}, {y, y + 1, y + 2}, {z, z + 1, z + 2}, 1};
    const tribox_box cube = {{-1, -1, -1}, {1, 1, 1}};
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {4, 4, 4}};
    tribox_report report;
    assert_int_equal(tribox_overlap(&soup, &cube, &(tribox_options){.accuracy = TRIBOX_CONSERVATIVE}, NULL, &report), TRIBOX_OK);
    assert_true(report.overlapping == 1 && report.undecided == 1);
    for (unsigned axes = 0; axes <= TRIBOX_AXES_ALL; axes++) {
        uint64_t cells[16] = {0};
        assert_int_equal(tribox_voxelize(&soup, &grid, NULL, &(tribox_options){.axes = axes}, cells, &report), TRIBOX_OK);
        assert_in_range(report.undecided, axes % TRIBOX_AXES_ALL == 0, 64);
        const tribox_options fast = {.axes = axes, .accuracy = TRIBOX_FAST};
        assert_int_equal(tribox_voxelize(&soup, &grid, NULL, &fast, cells, &report), TRIBOX_OK);
        assert_int_equal(report.undecided, 0);
    }
}

/* A window of a grid that is too large for one call is not. */
CASE(test_large_grid)
{
    begin(8);
    a.the_grid.size[1] = 65536, a.the_grid.size[2] = 32769;
    for (size_t k = 0; k < call_count; k++)
        if (call_takes(&calls[k], "window"))
            ask(&calls[k], TRIBOX_OK, "a large grid", 0);
}

CASE(test_bytes)
{
    static const uint32_t endless[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};
    assert_true(tribox_bricks_bytes(128) >= 128 * 128 * 2 * sizeof(uint64_t) && tribox_bricks_bytes(128) < 512 * 1024);
    assert_true(tribox_bricks_bytes(0) < 128 * 1024 && tribox_bricks_ids_bytes(64) > 64 * 64 * 64 * sizeof(uint32_t));
    assert_true(tribox_bricks_bytes(UINT32_MAX) == SIZE_MAX && tribox_bricks_ids_bytes(UINT32_MAX) == SIZE_MAX);
    assert_true(tribox_bricks_lists_bytes(1032, 0) == SIZE_MAX && tribox_bricks_lists_bytes(8, SIZE_MAX / 2304) == SIZE_MAX);
    assert_true(tribox_bricks_lists_bytes(64, 9) - tribox_bricks_lists_bytes(64, 8) >= 512 * sizeof(uint32_t));
    assert_true(tribox_window_words(endless) == SIZE_MAX && tribox_tile_count(endless, 1) == SIZE_MAX);
    assert_true(tribox_fill_labels_bytes(endless) == SIZE_MAX && tribox_index_bytes(SIZE_MAX) < SIZE_MAX);
    assert_true(tribox_fill_bytes((const uint32_t[]){1024, 1024, 1024}) <= 1024 * 1024 / 4 + 64);
    assert_true(sizeof(size_t) == 4 ? tribox_fill_bytes(endless) == SIZE_MAX : tribox_fill_bytes(endless) >= SIZE_MAX / 16);
    for (uint32_t k = 0; k < 4; k++) { /* no cells, or too many runs of them */
        const uint32_t size[3] = {k == 3 ? 3 : 9 * (k != 0), k == 3 ? 1 << 15 : 3 * (k != 1), k == 3 ? 1 << 15 : 2 * (k != 2)};
        assert_true(tribox_fill_labels_bytes(size) == SIZE_MAX);
    }
    assert_int_equal(tribox_fill_join(NULL, NULL, 0, NULL, 0, 0), TRIBOX_OK);
}

static int set_up(void)
{
    ask_rightly(4, &a, &out);
    outputs_prepare(&a, 0xa5, &poison);
    return 0;
}

PROGRAM_AFTER(set_up, RUN(test_needed), RUN(test_nothing), RUN(test_faults), RUN(test_kernels), RUN(test_names),
              RUN(test_mask_words), RUN(test_status_texts), RUN(test_undecided), RUN(test_large_grid), RUN(test_bytes))
