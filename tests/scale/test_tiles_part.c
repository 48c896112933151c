/* test_tiles_part.c - lists by tile of a few triangles at a time, put into one list, are those of all triangles at once. */
#include "tile_case.h"

#include "common/harness.h"
#include "tribox_threads.h"

enum { ROUNDS = 300, PARTS = 5, COUNT = 20, TILE = 16, TILES = 8 };

static tile_case drawn;

static const uint32_t tiles[] = {1, 2, 3, 8, 128, 0};

/* Some of the triangles, and the places of each part, in memory that ends where it has to. */
typedef struct part {
    size_t first, count;
    guarded pages;
    size_t *places, *counted;
} part;

/* Parts in a row, empty ones too, which begin and end anywhere. */
static void draw_parts(random_source *r, size_t count, part *parts)
{
    size_t at = 0;
    for (int n = 0; n < PARTS; n++) {
        const size_t left = count - at;
        parts[n] = (part){.first = at, .count = n == PARTS - 1 ? left : random_below(r, left + 1)};
        at += parts[n].count;
    }
}

static void count_part(const tile_case *c, size_t from, size_t to, part *p)
{
    const size_t bytes = (to - from) * sizeof *p->places;
    p->pages = guarded_make(bytes ? bytes : 1);
    p->places = guarded_tail(p->pages, bytes);
    assert_non_null(p->counted = malloc(bytes + 1));
    memset(p->places, 0xa5, bytes);
    assert_int_equal(tile_case_part(c, p->first, p->count, from, to, p->places, NULL), TRIBOX_OK);
    memcpy(p->counted, p->places, bytes);
}

/* In each tile the parts follow each other. */
static void place_parts(part *parts, size_t count, const size_t *starts)
{
    for (size_t t = 0; t < count; t++) {
        size_t place = starts[t];
        for (int n = 0; n < PARTS; n++) {
            parts[n].places[t] = place;
            place += parts[n].counted[t];
        }
        if (place != starts[t + 1])
            fail_msg("%s: of the %zu triangles of tile %zu of the share, parts have %zu", doing, starts[t + 1] - starts[t], t,
                     place - starts[t]);
    }
}

/* The last part first: places alone tell where each goes. */
static void check_parts(random_source *r, const tile_case *c, size_t from, size_t to)
{
    part parts[PARTS];
    const tile_lists whole = tile_case_lists(c, from, to);
    const size_t length = whole.starts[to - from];
    const guarded pages = guarded_make(length ? length * sizeof(uint32_t) : 1);
    uint32_t *const list = guarded_tail(pages, length * sizeof *list);
    draw_parts(r, tile_case_triangles(c), parts);
    for (int n = 0; n < PARTS; n++)
        count_part(c, from, to, &parts[n]);
    place_parts(parts, to - from, whole.starts);
    memset(list, 0xa5, length * sizeof *list);
    for (int n = PARTS; n-- > 0;)
        assert_int_equal(tile_case_part(c, parts[n].first, parts[n].count, from, to, parts[n].places, list), TRIBOX_OK);
    if (memcmp(list, whole.list, length * sizeof *list) != 0)
        fail_msg("%s: parts do not make up the list of tiles %zu to %zu", doing, from, to);
    for (size_t t = 0; t < to - from; t++)
        assert_int_equal(parts[PARTS - 1].places[t], whole.starts[t + 1]);
    for (int n = 0; n < PARTS; n++) {
        free(parts[n].counted);
        guarded_free(parts[n].pages);
    }
    guarded_free(pages);
    tile_lists_free(whole);
}

CASE(test_parts)
{
    enum { FEW = 2000 };
    random_source r = random_named(args.seed, "parts of tiles");
    for (size_t round = 0; round < arguments_rounds(&args, ROUNDS); round++) {
        tile_case_draw(&r, tiles[round % (sizeof tiles / sizeof tiles[0])], &drawn);
        tile_case_tell(&drawn, doing, sizeof doing);
        const size_t count = tile_case_tiles(&drawn), from = random_below(&r, count + 1), left = count - from;
        check_parts(&r, &drawn, 0, count < FEW ? count : FEW);
        check_parts(&r, &drawn, from, from + random_below(&r, (left < FEW ? left : FEW) + 1));
    }
}

/* A call that is right until a test spoils it: triangles through all tiles. */
typedef struct call {
    float streams[9][COUNT];
    double corners[COUNT][9];
    uint32_t indices[3 * COUNT];
    tribox_soup soup;
    tribox_mesh mesh;
    tribox_grid grid;
    tribox_tiles tiles;
    tribox_options options;
    size_t first, count;
} call;

static call right_call(void)
{
    static call c;
    c = (call){.soup = {.count = COUNT},
               .mesh = {.positions = c.corners, .vertices = 3 * COUNT, .indices = c.indices, .count = COUNT},
               .grid = {{0, 0, 0}, {1, 1, 1}, {2 * TILE, 2 * TILE, 2 * TILE}},
               .tiles = {TILE, 0, TILES},
               .count = COUNT};
    c.mesh.position_bytes = sizeof(double);
    c.mesh.index_bytes = sizeof *c.indices;
    for (int i = 0; i < COUNT; i++)
        for (int n = 0; n < 9; n++)
            c.streams[n][i] = (float)(c.corners[i][n] = (i + 7 * n) % (2 * TILE));
    for (uint32_t i = 0; i < 3 * COUNT; i++)
        c.indices[i] = i;
    for (int v = 0; v < 3; v++) {
        c.soup.x[v] = c.streams[3 * v];
        c.soup.y[v] = c.streams[3 * v + 1];
        c.soup.z[v] = c.streams[3 * v + 2];
    }
    return c;
}

static tribox_status ask(const call *c, bool is_double, size_t *places, uint32_t *list)
{
    return is_double ? tribox_mesh_tile_lists_part(&c->mesh, c->first, c->count, &c->grid, &c->tiles, &c->options, places, list)
                     : tribox_tile_lists_part(&c->soup, c->first, c->count, &c->grid, &c->tiles, &c->options, places, list);
}

/* Both passes end so, and write nothing where they end in an error. */
static void check_call(const call *c, bool is_double, tribox_status status)
{
    size_t places[TILES];
    uint32_t list[TILES * COUNT];
    unsigned char poison[sizeof list];
    memset(poison, 0xa5, sizeof poison);
    memset(places, 0xa5, sizeof places);
    assert_int_equal(ask(c, is_double, places, NULL), status);
    assert_true(!status == (memcmp(places, poison, sizeof places) != 0));
    for (size_t t = 0; t < TILES; t++)
        places[t] = t * COUNT;
    memset(list, 0xa5, sizeof list);
    assert_int_equal(ask(c, is_double, places, list), status);
    for (size_t t = 0; t < TILES && status; t++)
        assert_int_equal(places[t], t * COUNT);
    assert_true(!status || memcmp(list, poison, sizeof list) == 0);
}

CASE(test_bad_parts)
{
    static const size_t bad[][2] = {{0, COUNT + 1},
                                    {1, COUNT},
                                    {COUNT, 1},
                                    {COUNT + 1, 0},
                                    {SIZE_MAX, 0},
                                    {SIZE_MAX, 1},
                                    {1, SIZE_MAX},
                                    {2, SIZE_MAX - 1},
                                    {SIZE_MAX, SIZE_MAX},
                                    {0, SIZE_MAX},
                                    {SIZE_MAX / 2 + 1, SIZE_MAX / 2 + 1}};
    static const size_t good[][2] = {{0, COUNT}, {0, 0}, {COUNT, 0}, {3, 5}, {COUNT - 1, 1}};
    for (int is_double = 0; is_double < 2; is_double++) {
        call c = right_call();
        for (size_t n = 0; n < sizeof bad / sizeof bad[0]; n++) {
            c.first = bad[n][0];
            c.count = bad[n][1];
            check_call(&c, is_double, TRIBOX_BAD_ARGUMENT);
        }
        for (size_t n = 0; n < sizeof good / sizeof good[0]; n++) {
            c.first = good[n][0];
            c.count = good[n][1];
            check_call(&c, is_double, TRIBOX_OK);
        }
    }
}

CASE(test_bad_rest)
{
    for (int is_double = 0; is_double < 2; is_double++) {
        uint32_t list[TILES * COUNT];
        call c = right_call();
        assert_int_equal(ask(&c, is_double, NULL, NULL), TRIBOX_BAD_ARGUMENT);
        assert_int_equal(ask(&c, is_double, NULL, list), TRIBOX_BAD_ARGUMENT);
        c.tiles.count = TILES + 1;
        check_call(&c, is_double, TRIBOX_BAD_ARGUMENT);
        c = right_call();
        c.tiles.side = 0;
        check_call(&c, is_double, TRIBOX_BAD_ARGUMENT);
        c = right_call();
        c.grid.cell[1] = 0;
        check_call(&c, is_double, TRIBOX_BAD_GRID);
        c = right_call();
        c.options.axes = 8;
        check_call(&c, is_double, TRIBOX_BAD_OPTION);
        c = right_call();
        c.options.kernel = "none";
        check_call(&c, is_double, TRIBOX_NO_KERNEL);
        c = right_call();
        c.soup.y[1] = NULL;
        c.mesh.positions = NULL;
        check_call(&c, is_double, TRIBOX_BAD_ARGUMENT);
    }
}

/* Indices count in the triangles of the part alone. */
CASE(test_indices)
{
    call c = right_call();
    c.first = 4;
    c.count = 6;
    for (uint32_t i = 0; i < 3 * COUNT; i++) {
        c.indices[i] = i % 2 ? UINT32_MAX : 3 * COUNT;
        c.mesh.indices = c.indices;
        check_call(&c, true, i / 3 >= c.first && i / 3 < c.first + c.count ? TRIBOX_BAD_VERTEX : TRIBOX_OK);
        c.indices[i] = i;
    }
}

PROGRAM(RUN(test_parts), RUN(test_bad_parts), RUN(test_bad_rest), RUN(test_indices))
