/* test_words.c - the words of one vocabulary mean, in every lane, what the definition of one lane says. */
#include <float.h>
#include <math.h>

#include "common/harness.h"
#include "dispatch.h"
#include "words_lanes.h"

/* The ends and steps of the kind of number under test. */
#if defined(LANES_OF_DOUBLE)
#define LEAST DBL_TRUE_MIN
#define LEAST_NORMAL DBL_MIN
#define MOST DBL_MAX
#define STEP DBL_EPSILON
#define HALF_DIGITS 27
#else
#define LEAST FLT_TRUE_MIN
#define LEAST_NORMAL FLT_MIN
#define MOST FLT_MAX
#define STEP FLT_EPSILON
#define HALF_DIGITS 12
#endif
#define SIGN_BIT ((lane_bits)1 << (8 * sizeof(lane_bits) - 1))

static lane_bits bits_of(lane_number number)
{
    lane_bits bits;
    memcpy(&bits, &number, sizeof bits);
    return bits;
}

static lane_number number_of_bits(lane_bits bits)
{
    lane_number number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

#if defined(__MINGW32__) /* its libm rounds twice; wide kernels run only where the processor has the instruction */
#define FUSED __attribute__((target("fma"))) static
FUSED float fused_float(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
FUSED double fused_double(double a, double b, double c) { return __builtin_fma(a, b, c); }
#else
#define fused_float fmaf
#define fused_double fma
#endif

/* As the vocabulary says: rounded once, as libm defines it, or twice: the product is stored, so that no compiler fuses it. */
static lane_number multiply_add(lane_number a, lane_number b, lane_number c)
{
    if (lanes_fused && sizeof a == sizeof(float))
        return (lane_number)fused_float((float)a, (float)b, (float)c);
    if (lanes_fused)
        return (lane_number)fused_double((double)a, (double)b, (double)c);
    const volatile lane_number product = a * b;
    return product + c;
}

/* A case for each word of a table; its name; whether it is of a kind. */
#define WORD_OF_ONE(name, kind, of_lanes, of_one) \
    case WORD_##name: \
        return of_one;
#define WORD_NAME(name, kind, of_lanes, of_one) #name,
#define WORD_KIND(name, kind, of_lanes, of_one) kind,

static lane_number number_of(number_word word, lane_number first, lane_number a, lane_number b, lane_number c)
{
    switch (word) {
        NUMBER_WORDS(WORD_OF_ONE)
    default:
        return NAN;
    }
}

static bool mask_of(mask_word word, lane_number a, lane_number b, lane_number c)
{
    switch (word) {
        MASK_WORDS(WORD_OF_ONE)
    default:
        return false;
    }
}

static const char *const number_names[] = {NUMBER_WORDS(WORD_NAME)}, *const mask_names[] = {MASK_WORDS(WORD_NAME)};
enum { MOVED, MADE };
static const unsigned char payloads[] = {NUMBER_WORDS(WORD_KIND)};

static void check_numbers(number_word word, const lane_number *a, const lane_number *b, const lane_number *c)
{
    lane_number out[LANES_MAX];
    lanes_number(word, a, b, c, out);
    for (unsigned lane = 0; lane < lanes_count; lane++) {
        const lane_number expected = number_of(word, a[0], a[lane], b[lane], c[lane]);
        if (bits_of(out[lane]) == bits_of(expected) || (payloads[word] == MADE && isnan(out[lane]) && isnan(expected)))
            continue;
        fail_msg("%s in lane %u of (%a, %a, %a) gives %a, bits %" PRIx64 ", and should give %a, bits %" PRIx64, number_names[word],
                 lane, (double)a[lane], (double)b[lane], (double)c[lane], (double)out[lane], (uint64_t)bits_of(out[lane]),
                 (double)expected, (uint64_t)bits_of(expected));
    }
}

static void check_mask(mask_word word, const lane_number *a, const lane_number *b, const lane_number *c)
{
    const uint64_t bits = lanes_mask(word, a, b, c);
    uint64_t expected = 0;
    for (unsigned lane = 0; lane < lanes_count; lane++)
        expected |= (uint64_t)mask_of(word, a[lane], b[lane], c[lane]) << lane;
    if (bits == expected)
        return;
    for (unsigned lane = 0; lane < lanes_count; lane++)
        print_error("  lane %2u  %a, %a, %a\n", lane, (double)a[lane], (double)b[lane], (double)c[lane]);
    fail_msg("m_bits after %s gives %#" PRIx64 " and should give %#" PRIx64, mask_names[word], bits, expected);
}

static void check_words(const lane_number *a, const lane_number *b, const lane_number *c)
{
    for (number_word word = 0; word < NUMBER_WORD_COUNT; word++)
        check_numbers(word, a, b, c);
    for (mask_word word = 0; word < MASK_WORD_COUNT; word++)
        check_mask(word, a, b, c);
}

/* Half of the special values; the other half is these with the other sign. */
enum { SPECIALS = 2 * 19 };
static lane_number special(unsigned k)
{
    const lane_bits infinity = bits_of(INFINITY), quiet = bits_of(NAN);
    const lane_number e = (lane_number)ldexp(1, -HALF_DIGITS);
    const lane_number numbers[] = {
        0,
        LEAST,
        LEAST_NORMAL - LEAST,
        LEAST_NORMAL,
        LEAST_NORMAL + LEAST,
        STEP / 2,
        STEP,
        1 - STEP / 2,
        1,
        1 + STEP,
        1 + e,
        1 + 2 * e,
        2 / STEP - 1,
        2 / STEP,
        MOST,
        INFINITY,
        number_of_bits(quiet),
        number_of_bits(quiet | 0x12345),
        number_of_bits(infinity | 1), /* signalling */
    };
    enum { NUMBERS = sizeof numbers / sizeof numbers[0] };
    _Static_assert(2 * NUMBERS == SPECIALS, "count the special values again");
    return number_of_bits(bits_of(numbers[k % NUMBERS]) | (k >= NUMBERS ? SIGN_BIT : 0));
}

/* Every triple of special values, each lane with a triple of its own. */
CASE(test_special_values)
{
    lane_number a[LANES_MAX], b[LANES_MAX], c[LANES_MAX];
    const unsigned triples = SPECIALS * SPECIALS * SPECIALS;
    for (unsigned first = 0; first < triples; first += lanes_count) {
        for (unsigned lane = 0; lane < lanes_count; lane++) {
            const unsigned k = (first + lane) % triples;
            a[lane] = special(k % SPECIALS);
            b[lane] = special(k / SPECIALS % SPECIALS);
            c[lane] = special(k / SPECIALS / SPECIALS);
        }
        check_words(a, b, c);
    }
}

static lane_number any_bits(random_source *r) { return number_of_bits((lane_bits)random_bits(r)); }

/* Random bits, and neighbours: b near a, c near a * b, so that order and rounding are close calls. */
CASE(test_random_bits)
{
    random_source r = random_named(args.seed, "words");
    lane_number a[LANES_MAX], b[LANES_MAX], c[LANES_MAX];
    for (size_t round = 0; round < args.pairs; round++) {
        for (unsigned lane = 0; lane < lanes_count; lane++) {
            a[lane] = any_bits(&r);
            b[lane] = random_int(&r, 2) ? any_bits(&r) : number_of_bits(bits_of(a[lane]) + (lane_bits)random_int(&r, 3));
            c[lane] = random_int(&r, 2) ? any_bits(&r) : -(a[lane] * b[lane]);
        }
        check_words(a, b, c);
    }
}

/* A load from each place that a float may have. A signalling NaN may come quiet where float becomes double. */
CASE(test_loads_at_any_alignment)
{
    enum { FLOATS = 3 * LANES_MAX };
    random_source r = random_named(args.seed, "loads");
    _Alignas(64) float numbers[FLOATS];
    lane_number out[LANES_MAX];
    for (int round = 0; round < 1000; round++) {
        for (unsigned k = 0; k < FLOATS; k++) {
            const uint32_t bits = (uint32_t)random_bits(&r);
            memcpy(&numbers[k], &bits, sizeof bits);
        }
        for (unsigned at = 0; at < 2 * LANES_MAX; at++) {
            lanes_load(numbers + at, out);
            for (unsigned lane = 0; lane < lanes_count; lane++)
                if (bits_of(out[lane]) != bits_of(numbers[at + lane]) && !(isnan(out[lane]) && isnan(numbers[at + lane])))
                    fail_msg("v_load at float %u gives %a in lane %u and should give %a", at, (double)out[lane], lane,
                             (double)numbers[at + lane]);
        }
    }
}

/* Whole numbers of 32 bits, at any alignment of ints; nothing is written outside the lanes. */
CASE(test_cuts)
{
    random_source r = random_named(args.seed, "cuts");
    for (int round = 0; round < 10000; round++) {
        lane_number a[LANES_MAX];
        int32_t out[LANES_MAX + 2];
        for (unsigned k = 0; k < LANES_MAX + 2; k++)
            out[k] = 77;
        for (unsigned lane = 0; lane < lanes_count; lane++)
            a[lane] = (lane_number)ldexp((int32_t)(random_bits(&r) & ~UINT64_C(127)), -random_int(&r, 31)); /* fits as float too */
        lanes_cut(a, out + 1);
        for (unsigned lane = 0; lane < lanes_count; lane++)
            if (out[lane + 1] != (int32_t)a[lane])
                fail_msg("%a in lane %u is cut to %d", (double)a[lane], lane, (int)out[lane + 1]);
        assert_int_equal(out[0], 77);
        assert_int_equal(out[lanes_count + 1], 77);
    }
}

#if !defined(LANES_OF_DOUBLE)
/* No more numbers than lanes, with nothing to be read before or after them. */
CASE(test_loads_of_few)
{
    random_source r = random_named(args.seed, "few");
    const guarded g = guarded_make(LANES_MAX * sizeof(float));
    for (unsigned round = 0; round < 100; round++)
        for (unsigned count = 1; count <= lanes_count; count++) {
            float *const from = round % 2 ? guarded_tail(g, count * sizeof(float)) : (void *)g.first;
            lane_number out[LANES_MAX], first[LANES_MAX];
            for (unsigned k = 0; k < count; k++)
                from[k] = number_of_bits((lane_bits)random_bits(&r));
            lanes_load_few(from, count, out, first);
            for (unsigned lane = 0; lane < lanes_count; lane++)
                if (bits_of(out[lane]) != bits_of(from[lane < count ? lane : 0]) ||
                    (lane < count && bits_of(first[lane]) != bits_of(from[lane])))
                    fail_msg("%u give %a, %a in lane %u", count, (double)out[lane], (double)first[lane], lane);
        }
    guarded_free(g);
}

/* Any lane of two vectors, at any lane; their bits are kept. */
CASE(test_permutes)
{
    random_source r = random_named(args.seed, "permutes");
    for (int round = 0; round < 10000; round++) {
        lane_number a[2 * LANES_MAX], out[LANES_MAX];
        int32_t from[LANES_MAX];
        for (unsigned lane = 0; lane < 2 * lanes_count; lane++)
            a[lane] = number_of_bits((lane_bits)random_bits(&r));
        for (unsigned lane = 0; lane < lanes_count; lane++)
            from[lane] = random_int(&r, 1000);
        lanes_permute(a, a + lanes_count, from, out);
        for (unsigned lane = 0; lane < lanes_count; lane++)
            if (bits_of(out[lane]) != bits_of(a[(unsigned)from[lane] % (2 * lanes_count)]))
                fail_msg("v_permute: lane %u is not lane %d of two vectors", lane, (int)from[lane]);
    }
}

/* Four numbers from each of as many places, at any alignment of bytes; their bits are kept. */
CASE(test_transposes)
{
    enum { BYTES = 1000 };
    random_source r = random_named(args.seed, "transposes");
    unsigned char memory[BYTES];
    lane_number out[4][LANES_MAX];
    for (int round = 0; round < 10000; round++) {
        const void *from[LANES_MAX];
        for (unsigned k = 0; k < BYTES; k++)
            memory[k] = (unsigned char)random_bits(&r);
        for (unsigned lane = 0; lane < lanes_count; lane++)
            from[lane] = memory + random_int(&r, BYTES - 4 * sizeof(float) + 1);
        lanes_transpose(from, out);
        for (unsigned lane = 0; lane < lanes_count; lane++)
            for (unsigned k = 0; k < 4; k++)
                if (memcmp(&out[k][lane], (const unsigned char *)from[lane] + k * sizeof(float), sizeof(float)))
                    fail_msg("v_transpose4: number %u of lane %u is not the one at its place", k, lane);
    }
}

/* A double whose difference to lo may cancel, be halfway between two floats, underflow or overflow; or one of any bits. */
static double double_near(random_source *r, double lo)
{
    const int kind = random_int(r, 4);
    if (kind == 0) {
        const uint64_t bits = random_bits(r);
        double any;
        memcpy(&any, &bits, sizeof any);
        return any;
    }
    const double step = ldexp(random_double(r, -1, 1), random_int_between(r, -160, 130));
    return kind == 1 ? lo + step : kind == 2 ? lo + (double)(float)step + (double)(float)step * 0x1p-25 : step;
}

static void expect_near(const char *word, unsigned lane, const void *from, double lo, float found)
{
    double number;
    memcpy(&number, from, sizeof number);
    const volatile double difference = number - lo;
    const float expected = (float)difference;
    if (bits_of(found) != bits_of(expected) && !(isnan(found) && isnan(expected)))
        fail_msg("%s(%a, %a) in lane %u gives %a and should give %a", word, number, lo, lane, (double)found, (double)expected);
}

/* Doubles at any alignment of bytes, less what is given for each. */
CASE(test_near)
{
    enum { PLACES = 4 * LANES_MAX };
    random_source r = random_named(args.seed, "near");
    unsigned char memory[PLACES * sizeof(double) + 8];
    lane_number out[LANES_MAX], four[4][LANES_MAX];
    for (int round = 0; round < 20000; round++) {
        unsigned char *const at = memory + random_int(&r, 9);
        const void *from[LANES_MAX];
        double lo[LANES_MAX];
        for (unsigned k = 0; k < LANES_MAX; k++)
            lo[k] = random_int(&r, 3) ? ldexp(random_double(&r, -1, 1), random_int_between(&r, -140, 140)) : 0;
        for (unsigned k = 0; k < PLACES; k++) {
            const double number = double_near(&r, lo[random_int(&r, 2) ? k % 4 : k % lanes_count]);
            memcpy(at + k * sizeof number, &number, sizeof number);
        }
        lanes_near(at, lo, out);
        for (unsigned lane = 0; lane < lanes_count; lane++)
            expect_near("v_local", lane, at + lane * sizeof(double), lo[lane], out[lane]);
        for (unsigned lane = 0; lane < lanes_count; lane++)
            from[lane] = at + sizeof(double) * (size_t)random_int(&r, PLACES - 3);
        lanes_near_transpose(from, lo, four);
        for (unsigned lane = 0; lane < lanes_count; lane++)
            for (unsigned k = 0; k < 4; k++)
                expect_near("v_local_transpose4", lane, (const char *)from[lane] + k * sizeof(double), lo[k], four[k][lane]);
    }
}

/* Whole numbers, halves, and what lies next to them. */
static float near_whole(random_source *r)
{
    const float range = ldexpf(1, random_int(r, 23));
    const float number = roundf((float)random_double(r, -range, range)) + 0.5f * (float)random_int(r, 2);
    const float beside = random_int(r, 2) ? nextafterf(number, random_int(r, 2) ? 1e9f : -1e9f) : number;
    return fminf(fmaxf(beside, -0x1p22f), 0x1p22f);
}

CASE(test_nearest)
{
    random_source r = random_named(args.seed, "nearest");
    for (int round = 0; round < 100000; round++) {
        float a[LANES_MAX], out[LANES_MAX];
        for (unsigned lane = 0; lane < lanes_count; lane++)
            a[lane] =
                random_int(&r, 2) ? near_whole(&r) : ldexpf((float)random_double(&r, -1, 1), random_int_between(&r, -140, 22));
        lanes_nearest(a, out);
        for (unsigned lane = 0; lane < lanes_count; lane++)
            if (out[lane] != rintf(a[lane]))
                fail_msg("v_nearest of %a in lane %u gives %a", (double)a[lane], lane, (double)out[lane]);
    }
}

/* Bit by bit. */
static uint32_t bits_between(uint32_t first, uint32_t end)
{
    uint32_t bits = 0;
    for (uint32_t n = first; n < end; n++)
        bits |= UINT32_C(1) << n;
    return bits;
}

static uint32_t count_bits(uint32_t a)
{
    uint32_t count = 0;
    for (; a; a >>= 1)
        count += a & 1;
    return count;
}

static uint32_t int_of(int_word word, uint32_t first, uint32_t a, uint32_t b)
{
    switch (word) {
        INT_WORDS(WORD_OF_ONE)
    default:
        return 0;
    }
}

/* PLACES: the second number, and of a run the first too, is a number of bits: 0 to 32. */
enum { ANY, PLACES };
static const char *const int_names[] = {INT_WORDS(WORD_NAME)};
static const unsigned char int_kinds[] = {INT_WORDS(WORD_KIND)};

static void check_ints(int_word word, const int32_t *a, const int32_t *b)
{
    int32_t out[LANES_MAX];
    lanes_int(word, a, b, out);
    for (unsigned lane = 0; lane < lanes_count; lane++)
        if ((uint32_t)out[lane] != int_of(word, (uint32_t)a[0], (uint32_t)a[lane], (uint32_t)b[lane]))
            fail_msg("%s(%#x, %#x) in lane %u gives %#x", int_names[word], (unsigned)a[lane], (unsigned)b[lane], lane,
                     (unsigned)out[lane]);
}

static int32_t any_int(random_source *r)
{
    static const int32_t special[] = {0, 1, -1, 2, 0xffff, 0x10000, 0x55555555, INT32_MAX, INT32_MIN, -65536};
    enum { SPECIAL = sizeof special / sizeof special[0] };
    return random_int(r, 2) ? (int32_t)random_bits(r) : special[random_int(r, SPECIAL)];
}

CASE(test_ints)
{
    random_source r = random_named(args.seed, "ints");
    for (int round = 0; round < 100000; round++) {
        int32_t a[LANES_MAX], b[LANES_MAX];
        uint64_t with_bits = 0;
        unsigned lanes_chosen = 0;
        for (unsigned lane = 0; lane < lanes_count; lane++) {
            a[lane] = any_int(&r);
            b[lane] = any_int(&r);
            with_bits |= (uint64_t)(a[lane] != 0) << lane;
            lanes_chosen += a[lane] != 0;
        }
        for (int_word word = 0; word < INT_WORD_COUNT; word++)
            if (int_kinds[word] == ANY)
                check_ints(word, a, b);
        assert_true(lanes_with_bits(a) == with_bits);
        assert_true(lanes_count_with_bits(a) == lanes_chosen);
    }
}

/* By every number of bits in every lane. */
CASE(test_shifts)
{
    random_source r = random_named(args.seed, "shifts");
    for (unsigned round = 0; round < 33000; round++) {
        int32_t a[LANES_MAX], n[LANES_MAX];
        for (unsigned lane = 0; lane < lanes_count; lane++) {
            a[lane] = any_int(&r);
            n[lane] = lane ? random_int(&r, 33) : (int32_t)(round % 33);
        }
        for (unsigned turn = 0; turn < lanes_count; turn++) {
            const int32_t first = n[0];
            memmove(n, n + 1, (lanes_count - 1) * sizeof *n);
            n[lanes_count - 1] = first;
            check_ints(WORD_i_shl, a, n);
            check_ints(WORD_i_shr, a, n);
            int32_t fewer[LANES_MAX];
            for (unsigned lane = 0; lane < lanes_count; lane++)
                fewer[lane] = n[lane] % 32;
            check_ints(WORD_i_shl_over, a, fewer);
        }
    }
}

/* Every run, in every lane. */
CASE(test_runs)
{
    for (int32_t number = 0; number < 33 * 33; number++) {
        int32_t first[LANES_MAX], end[LANES_MAX];
        for (unsigned lane = 0; lane < lanes_count; lane++) {
            const int32_t other = (number + 7 * (int32_t)lane) % (33 * 33);
            first[lane] = other / 33;
            end[lane] = other % 33;
        }
        check_ints(WORD_i_run, first, end);
    }
}

/* Every mask; nothing is written outside the lanes. */
CASE(test_packs)
{
    random_source r = random_named(args.seed, "packs");
    for (uint32_t mask = 0; mask >> lanes_count == 0; mask++) {
        int32_t a[LANES_MAX], chosen[LANES_MAX], out[2][LANES_MAX + 2], expected[LANES_MAX];
        float number[LANES_MAX], packed[LANES_MAX + 2];
        unsigned count = 0;
        for (unsigned k = 0; k < LANES_MAX + 2; k++) {
            out[1][k] = 77;
            packed[k] = 77;
        }
        for (unsigned lane = 0; lane < lanes_count; lane++) {
            a[lane] = (int32_t)random_bits(&r);
            chosen[lane] = mask >> lane & 1 ? (int32_t)1 << random_int(&r, 31) : 0;
            if (chosen[lane])
                expected[count++] = a[lane];
        }
        memcpy(number, a, lanes_count * sizeof *a);
        lanes_pack(number, chosen, packed + 1);
        lanes_pack_int(a, chosen, out[1] + 1);
        memcpy(out[0], packed, sizeof packed);
        for (int is_int = 0; is_int < 2; is_int++)
            if (memcmp(out[is_int] + 1, expected, count * sizeof *expected))
                fail_msg("%s of mask %#x packs other lanes", is_int ? "i_pack" : "v_pack", (unsigned)mask);
        assert_true(packed[0] == 77 && packed[lanes_count + 1] == 77);
        assert_true(out[1][0] == 77 && out[1][lanes_count + 1] == 77);
    }
}
#endif

/* Each lane alone, and all lanes but one: bit k of m_bits is lane k, and no bit lies outside the lanes. */
CASE(test_bits_of_single_lanes)
{
    for (unsigned lane = 0; lane < lanes_count; lane++)
        for (int is_inverse = 0; is_inverse < 2; is_inverse++) {
            lane_number a[LANES_MAX], b[LANES_MAX], c[LANES_MAX];
            for (unsigned k = 0; k < lanes_count; k++) {
                a[k] = (k == lane) != is_inverse ? 2 : -1;
                b[k] = 1;
                c[k] = 1;
            }
            for (mask_word word = 0; word < MASK_WORD_COUNT; word++)
                check_mask(word, a, b, c);
        }
}

/* Where one rounding and two differ: (1 + e)^2 - (1 + 2e) is e^2, or 0. */
CASE(test_roundings)
{
    const lane_number e = (lane_number)ldexp(1, -HALF_DIGITS), expected = lanes_fused ? e * e : 0;
    lane_number a[LANES_MAX] = {0}, plus[LANES_MAX] = {0}, minus[LANES_MAX] = {0}, out[LANES_MAX];
    for (unsigned lane = 0; lane < lanes_count; lane++) {
        a[lane] = 1 + e;
        plus[lane] = 1 + 2 * e;
        minus[lane] = -plus[lane];
    }
    for (int is_fms = 0; is_fms < 2; is_fms++) {
        lanes_number(is_fms ? WORD_v_fms : WORD_v_fma, a, a, is_fms ? plus : minus, out);
        for (unsigned lane = 0; lane < lanes_count; lane++)
            if (bits_of(out[lane]) != bits_of(expected))
                fail_msg("%s in lane %u does not round %s, as V_FUSED says", is_fms ? "v_fms" : "v_fma", lane,
                         lanes_fused ? "once" : "twice");
    }
}

/* The float lanes are the kernel's. Every vocabulary divides a word of 64. */
CASE(test_lanes_divide_a_word)
{
    const tribox_kernel *const kernel = tribox_kernel_find(KERNEL_NAME);
    assert_non_null(kernel);
    assert_int_equal(64 % lanes_count, 0);
    if (sizeof(lane_number) == sizeof(float))
        assert_int_equal(kernel->lanes, lanes_count);
}

#if defined(LANES_OF_DOUBLE)
#define FLOAT_CASES
#else
#define FLOAT_CASES \
    RUN(test_loads_of_few), RUN(test_permutes), RUN(test_transposes), RUN(test_near), RUN(test_nearest), RUN(test_ints), \
        RUN(test_shifts), RUN(test_runs), RUN(test_packs),
#endif

static int find_kernel(void)
{
    if (tribox_kernel_find(KERNEL_NAME))
        return 0;
    puts("this processor cannot run " KERNEL_NAME ": skipped");
    return 77;
}

PROGRAM_AFTER(find_kernel, RUN(test_special_values), RUN(test_random_bits), RUN(test_loads_at_any_alignment), RUN(test_cuts),
              FLOAT_CASES RUN(test_bits_of_single_lanes), RUN(test_roundings), RUN(test_lanes_divide_a_word))
