/* test_order_digests.c - the order of a soup is the same in every floating-point environment, and on every processor. */
#include "common/harness.h"
#include "common/float_environment.h"
#include "order_kinds.h"

CASE(test_environments)
{
    random_source r = random_named(args.seed, "environments");
    static const order_kind kinds[] = {KIND_SUBNORMAL, KIND_ALL_SCALES, KIND_GREATEST};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        order_room room = order_room_make(&r, kinds[k], 3000);
        uint32_t *const expected = malloc(4 * 3000);
        tribox_soup_sort(&room.soup, room.order, room.scratch);
        memcpy(expected, room.order, 4 * 3000);
        for (unsigned s = 0; s < SETTINGS; s++) {
            const unsigned before = environment_get();
            environment_set(setting(s));
            const unsigned set = environment_get();
            tribox_soup_sort(&room.soup, room.order, room.scratch);
            const unsigned after = environment_get();
            environment_set(before);
            assert_int_equal(after, set);
            if (memcmp(room.order, expected, 4 * 3000))
                fail_msg("%s: another order in setting %u", order_kind_names[kinds[k]], s);
        }
        free(expected);
        order_room_free(&room);
    }
}

/* FNV-1a of an order. */
static uint64_t digest_of(const uint32_t *order, size_t count)
{
    uint64_t digest = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < count; i++)
        for (int shift = 0; shift < 32; shift += 8)
            digest = (digest ^ (order[i] >> shift & 0xff)) * UINT64_C(0x100000001b3);
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

PROGRAM(RUN(test_digests), RUN(test_environments))
