/* test_gather.c - triangles in any order as streams: every range, and none beside it; an order, which is the same everywhere. */
#include <math.h>

#include "common/fences.h"
#include "common/harness.h"
#include "common/laid_mesh.h"
#include "common/soup_or_mesh.h"
#include "order_kinds.h"

enum { COUNT = 90 };

static uint32_t order[COUNT];
static guarded fence[9];
static fenced place[9];
static float *to[9];

/* Streams of so many floats, which end at a page, or begin after one and some floats. */
static void lay_streams(size_t count, bool is_at_end) { streams_place(fence, count, is_at_end ? AT_END : 1, place, to); }

static int make_fences(void)
{
    random_source r = random_named(args.seed, "order");
    stream_fences_make(COUNT, fence);
    for (size_t i = 0; i < COUNT; i++) /* some come more than once, some never */
        order[i] = (uint32_t)random_int(&r, COUNT);
    return 0;
}

static void demand_streams(const tribox_soup *soup, size_t first, size_t count)
{
    for (int k = 0; k < 9; k++) {
        const float *const from = (k < 3 ? soup->x : k < 6 ? soup->y : soup->z)[k % 3];
        for (size_t i = 0; i < count; i++)
            assert_memory_equal(to[k] + i, from + order[first + i], sizeof(float));
        assert_nothing_beside(&place[k]);
    }
}

CASE(test_soups)
{
    random_source r = random_named(args.seed, "soups");
    order_room room = order_room_make(&r, KIND_HALF_WILD, COUNT);
    for (size_t first = 0; first <= COUNT; first++)
        for (size_t count = 0; count <= COUNT - first; count += 1 + (size_t)random_int(&r, 9)) {
            lay_streams(count, random_int(&r, 2));
            assert_int_equal(tribox_soup_gather(&room.soup, order, first, count, to, to + 3, to + 6), TRIBOX_OK);
            demand_streams(&room.soup, first, count);
        }
    order_room_free(&room);
}

/* Meshes of floats in any layout, beside the streams that they stand for. */
CASE(test_meshes)
{
    static double u[COUNT][3][3];
    static float stream[9][COUNT];
    const tribox_soup soup = soup_of_rows(stream[0], COUNT, COUNT);
    const laid_fences fences = laid_fences_make(args.seed);
    random_source r = random_named(args.seed, "meshes");
    for (int round = 0; round < 60; round++) {
        mesh_form form = mesh_form_draw(&r, true);
        form.position_bytes = 4;
        form.pattern = (index_pattern)random_int(&r, INDEX_PATTERNS);
        for (int n = 0; n < 9 * COUNT; n++)
            u[n / 9][n / 3 % 3][n % 3] = random_int(&r, 50) ? (float)random_double(&r, -1, 1) : INFINITY;
        const tribox_mesh mesh = laid_mesh_of(&r, &form, (const double(*)[3][3])u, COUNT, (const int[]){0, 1, 2}, fences);
        for (size_t n = 0; n < 9 * COUNT; n++)
            stream[n % 9][n / 9] = mesh_float(&mesh, n / 9 * 3 + n % 3, (int)(n % 9 / 3));
        for (size_t first = 0; first <= COUNT; first += 1 + (size_t)random_int(&r, 9)) {
            const size_t count = (size_t)random_int_between(&r, 0, (int)(COUNT - first));
            lay_streams(count, random_int(&r, 2));
            assert_int_equal(tribox_mesh_gather(&mesh, NULL, order, first, count, to, to + 3, to + 6), TRIBOX_OK);
            demand_streams(&soup, first, count);
        }
    }
}

/* FNV-1a of an order. */
static uint64_t digest_of(const uint32_t *numbers, size_t count)
{
    uint64_t digest = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < count; i++)
        for (int shift = 0; shift < 32; shift += 8)
            digest = (digest ^ (numbers[i] >> shift & 0xff)) * UINT64_C(0x100000001b3);
    return digest;
}

/* Of 5000 triangles of each kind, drawn from seed 1. */
static const uint64_t digests[ORDER_KINDS] = {
    UINT64_C(0x393dc9e9fb5c6879), UINT64_C(0x5b35d2f40009d715), UINT64_C(0xbda55b1009df35d5), UINT64_C(0x8fd64756440fb195),
    UINT64_C(0x8779200f75e31c3d), UINT64_C(0x5b35d2f40009d715), UINT64_C(0x12807e3573b5b899), UINT64_C(0x78904ff47d938b69),
    UINT64_C(0x775b731a065900ad), UINT64_C(0x99fc645060cfbe69), UINT64_C(0x01e76026ee77b409), UINT64_C(0x9c7354221f9f13fd),
    UINT64_C(0x5b35d2f40009d715)};

CASE(test_digests)
{
    for (order_kind kind = 0; kind < ORDER_KINDS; kind++) {
        random_source r = random_named(1, order_kind_names[kind]);
        order_room room = order_room_make(&r, kind, 5000);
        tribox_soup_sort(&room.soup, room.order, room.scratch);
        const uint64_t digest = digest_of(room.order, 5000);
        order_room_free(&room);
        if (digest != digests[kind])
            fail_msg("%s: digest %016" PRIx64 " where there has to be %016" PRIx64, order_kind_names[kind], digest, digests[kind]);
    }
}

PROGRAM_AFTER(make_fences, RUN(test_soups), RUN(test_meshes), RUN(test_digests))
