/*
 * test_damaged.c - an index of random bytes, with flipped bits, or of another soup of as many triangles: nothing is read outside,
 * and answers may be wrong but are answers. A copy anywhere answers as the index does.
 */
#include "common/harness.h"
#include "hostile.h"
#include "forms.h"

enum { COUNT_MAX = 9000, BOXES = 4, PAIRS = 100000, ROUNDS = 300 };

static bool is_lattice; /* oriented boxes about others take long */

static int make_all(void) { return index_fixture_make(COUNT_MAX, BOXES); }

static void check_all(random_source *r)
{
    for (int b = 0; b < BOXES; b++) {
        const tribox_box box = draw_box(r);
        tribox_options options = any_index_options(r);
        check_damaged(&(tribox_region){.box = &box}, &options, "damaged");
        if (!is_lattice)
            continue;
        const tribox_oriented_box oriented = draw_oriented(r, &box);
        options.axes = 0;
        options.accuracy = TRIBOX_FAST;
        check_damaged(&(tribox_region){.oriented = &oriented}, &options, "damaged");
    }
}

static void draw(random_source *r)
{
    static const int most[] = {1, 64, 300, 4096, 4200, COUNT_MAX};
    const size_t count = (size_t)random_int(r, 1 + most[random_int(r, sizeof most / sizeof most[0])]);
    const size_t kind = random_below(r, soup_kind_count());
    is_lattice = kind == 0;
    draw_stored(r, soup_kind_at(kind), count);
}

/* Random bytes, or all of them alike. */
static void put_bytes(random_source *r)
{
    const int kind = random_int(r, 4);
    for (size_t k = 0; k < stored_index_bytes(); k++)
        stored.nodes[k] = kind == 0 ? 0xff : kind == 1 ? 0 : (unsigned char)random_int(r, 256);
}

static void flip_bits(random_source *r)
{
    for (int times = 1 << random_int(r, 12); times > 0; times--)
        stored.nodes[random_below(r, stored_index_bytes())] ^= (unsigned char)(1 << random_int(r, 8));
}

/* Every child is said to be everywhere and whole: nodes and words past the last are still not there. */
static void put_all_inside(random_source *r)
{
    enum { BOUNDS = 6 * 64, NODE = BOUNDS * sizeof(float) + 64 };
    const float bounds[2] = {random_int(r, 2) ? 0 : -1, random_int(r, 2) ? 0 : 1};
    for (size_t node = 0; node < stored_index_bytes() / NODE; node++) {
        for (size_t k = 0; k < BOUNDS; k++)
            memcpy(stored.nodes + node * NODE + k * sizeof(float), &bounds[k >= BOUNDS / 2], sizeof(float));
        memset(stored.nodes + node * NODE + BOUNDS * sizeof(float), random_int(r, 3) ? 0xff : 0, sizeof(uint64_t));
    }
    for (int k = 0; k < 9; k++)
        for (size_t i = 0; i < stored.soup.count; i++)
            stored.stream[k][i] = (float)(i % 3) - 1;
    is_lattice = true;
}

static void put_another_soup(random_source *r)
{
    const size_t kind = random_below(r, soup_kind_count());
    is_lattice = kind == 0;
    soup_kind_at(kind)->draw(r);
}

CASE(test_damage)
{
    static void (*const damages[])(random_source * r) = {put_bytes, flip_bits, put_all_inside, put_another_soup};
    random_source r = random_named(args.seed, "damage");
    for (size_t round = 0; round < 4 * arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw(&r);
        damages[round % 4](&r);
        check_all(&r);
    }
}

/* The original is gone when the copy is asked. */
CASE(test_copies)
{
    random_source r = random_named(args.seed, "copies");
    const guarded elsewhere = guarded_make(tribox_index_bytes(COUNT_MAX) + STORED_SHIFTS);
    for (int shift = 0; shift < STORED_SHIFTS; shift++) {
        draw(&r);
        const size_t bytes = stored_index_bytes();
        stored.index.nodes = stored.with_ids.nodes =
            memcpy(shift % 3 ? elsewhere.first + shift : guarded_tail(elsewhere, bytes), stored.nodes, bytes);
        memset(stored.nodes, 0, bytes);
        guarded_read_only(elsewhere, true);
        for (int b = 0; b < 3 * BOXES; b++) {
            const tribox_box box = draw_box(&r);
            const tribox_options options = any_index_options(&r);
            check_forms(&box, &options, "a copy");
        }
        guarded_read_only(elsewhere, false);
    }
    guarded_free(elsewhere);
}

PROGRAM_AFTER(make_all, RUN(test_damage), RUN(test_copies))
