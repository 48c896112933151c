/*
 * test_rank.c - the key of a rank by counting bits, which no input is likely to need, is that by sorting, and that by samples; and
 * samples find it, however many keys there are.
 */
#include "scalar/vec_scalar.h"
#include "base/bits.h"
#include "kernel/nodes/rank.h"

#include "common/harness.h"
#include "order_kinds.h"

enum { MOST = 3000 };

static float middles[MOST];
static uint32_t numbers[MOST];

static int by_image(const void *one, const void *other)
{
    const uint64_t a = *(const uint64_t *)one, b = *(const uint64_t *)other;
    return a < b ? -1 : a > b;
}

static void demand_key(place_key key, uint64_t expected) { assert_int_equal(image_of_key(key), expected); }

CASE(test_ranks)
{
    random_source r = random_named(args.seed, "ranks");
    static uint64_t images[MOST];
    for (int round = 0; round < 300; round++) {
        const size_t count = 1 + (size_t)random_int(&r, round % 2 ? 100 : MOST);
        for (size_t i = 0; i < count; i++) {
            middles[i] = round % 3 ? (float)random_int_between(&r, -5, 5) : (float)random_double(&r, -1, 1);
            middles[i] = random_int(&r, 20) ? middles[i] : INFINITY;
            numbers[i] = (uint32_t)(count - i) * (round % 5 ? 1 : UINT32_MAX / MOST); /* from 2^31 on, too */
            images[i] = image_of_key((place_key){middles[i], numbers[i]});
        }
        qsort(images, count, sizeof *images, by_image);
        for (size_t k = 0; k < 5; k++) {
            const size_t rank = k < 2 ? k * (count - 1) : (size_t)random_int(&r, (int)count);
            demand_key(rank_by_bits(middles, numbers, count, rank), images[rank]);
            demand_key(key_of_rank(middles, numbers, count, rank), images[rank]);
        }
    }
}

/* Of random keys and of ordered ones, as many as limits and lists just hold, and so many that few are left in limits. */
static void check_samples(random_source *r, size_t count, bool is_ordered)
{
    float *const many = malloc(count * sizeof *many);
    uint32_t *const number = malloc(count * sizeof *number);
    assert_true(many && number);
    for (size_t i = 0; i < count; i++) {
        many[i] = is_ordered ? (float)i : (float)random_double(r, -1, 1);
        number[i] = (uint32_t)i;
    }
    for (size_t rank = count / 8; rank < count; rank += count / 3) {
        key_list list;
        place_key key;
        assert_true(find_by_samples(many, number, count, rank, &list, &key));
        demand_key(rank_by_bits(many, number, count, rank), image_of_key(key));
    }
    free(many);
    free(number);
}

CASE(test_samples)
{
    random_source r = random_named(args.seed, "samples");
    const size_t most = args.pairs >= 10000000 ? 10000000 : 3000000; /* more with --long */
    for (int is_ordered = 0; is_ordered < 2; is_ordered++) {
        check_samples(&r, most, is_ordered);
        for (size_t count = 18000; count < 30000; count += 1000)
            check_samples(&r, count, is_ordered);
    }
}

PROGRAM(RUN(test_ranks), RUN(test_samples))
