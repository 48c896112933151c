/*
 * test_classify.c - inside are the triangles whose nine coordinates are within the bounds: exactly, at every accuracy, for each set
 * of axes and kernel. The mask is that of tribox_overlap and them: FAST may miss there what lies inside. And the first triangle
 * that overlaps, and the first that does not, wherever it stands; the search ends there.
 */
#include <float.h>
#include <math.h>

#include "common/harness.h"
#include "drawn_pairs.h"
#include "common/fences.h"
#include "common/guarded_pages.h"

static drawn_numbers numbers;

static guarded stream_fence[SOUP_STREAMS], mask_fence, inside_fence;

static int set_up(void)
{
    stream_fences_make(DRAWN_MAX, stream_fence);
    mask_fence = guarded_make(DRAWN_WORDS * sizeof(uint64_t));
    inside_fence = guarded_make(DRAWN_WORDS * sizeof(uint64_t));
    return 0;
}

/* Not of a NaN, as of every comparison with one; and of no triangle where the box is empty. */
static void expect_inside(const pair_list *q, uint64_t *inside)
{
    memset(inside, 0, tribox_mask_words(q->count) * sizeof *inside);
    for (size_t i = 0; i < q->count; i++) {
        bool is = true;
        for (int s = 0; s < SOUP_STREAMS; s++)
            is = is && q->stream[s][i] >= q->box->lo[s / 3] && q->stream[s][i] <= q->box->hi[s / 3];
        inside[i / 64] |= (uint64_t)is << i % 64;
    }
}

static uint64_t *words_of(const fenced *place) { return (uint64_t *)(void *)place->at; }

/* At FAST blocks may be answered exactly: words that are, are expected so. */
static void take_exact(const tribox_options *options, uint64_t *expected, const uint64_t *exact, const uint64_t *got, size_t words)
{
    for (size_t w = 0; options->accuracy == TRIBOX_FAST && w < words; w++)
        if (got[w] == exact[w])
            expected[w] = exact[w];
}

static void expect(tribox_find_what what, const pair_list *q, const tribox_options *options, size_t expected)
{
    const tribox_soup soup = pair_list_soup(q);
    size_t first = SIZE_MAX;
    char text[PAIR_LIST_TEXT];
    snprintf(doing, sizeof doing, "%s: %s", what == TRIBOX_FIRST_HIT ? "hit" : "miss", pair_list_text(q, options, text));
    const tribox_status status = tribox_find(&soup, q->box, options, what, &first);
    if (status || first != expected)
        fail_msg("%s: %s, %zu where it should be %zu", doing, tribox_status_text(status), first, expected);
}

static void expect_both(const pair_list *q, const tribox_options *options, size_t first_set, size_t first_clear)
{
    expect(TRIBOX_FIRST_HIT, q, options, first_set);
    expect(TRIBOX_FIRST_MISS, q, options, first_clear);
}

/* Any of the three outputs may be absent. */
static void check(const pair_list *q, const tribox_options *options)
{
    static uint64_t overlapping[DRAWN_WORDS], within[DRAWN_WORDS], exact[DRAWN_WORDS];
    char text[PAIR_LIST_TEXT];
    tribox_report report = {0, 0};
    tribox_options exactly = *options;
    exactly.accuracy = TRIBOX_EXACT;
    ask_ok(q, options, overlapping, NULL);
    expect_both(q, options, first_bit(overlapping, q->count, true), first_bit(overlapping, q->count, false));
    ask_ok(q, &exactly, exact, NULL);
    expect_inside(q, within);
    for (size_t w = 0; w < tribox_mask_words(q->count); w++) {
        if (options->accuracy != TRIBOX_FAST && within[w] & ~overlapping[w])
            fail_msg("%s: what is inside does not overlap", pair_list_text(q, options, text));
        overlapping[w] |= within[w];
    }
    snprintf(doing, sizeof doing, "tribox_classify: %s", pair_list_text(q, options, text));

    const size_t bytes = tribox_mask_words(q->count) * sizeof(uint64_t);
    const tribox_soup soup = pair_list_soup(q);
    for (int wanted = 0; wanted < 8; wanted++) {
        const fenced mask = fenced_place(mask_fence, bytes, AT_END), inside = fenced_place(inside_fence, bytes, AT_END);
        assert_int_equal(tribox_classify(&soup, q->box, options, wanted & 1 ? words_of(&mask) : NULL,
                                         wanted & 2 ? words_of(&inside) : NULL, wanted & 4 ? &report : NULL),
                         TRIBOX_OK);
        if (wanted & 1) {
            take_exact(options, overlapping, exact, words_of(&mask), tribox_mask_words(q->count));
            assert_masks_equal(q, options, overlapping, words_of(&mask));
            assert_nothing_beside(&mask);
        }
        if (wanted & 2) {
            assert_masks_equal(q, options, within, words_of(&inside));
            assert_nothing_beside(&inside);
        }
        if (wanted & 4)
            assert_report(&report, overlapping, q->count, options->accuracy);
    }
}

/* Streams of some triangles, each ending at a page that cannot be touched, or beginning after one. */
static pair_list between_fences(const pair_list *from, size_t first, size_t count, bool is_at_end)
{
    pair_list q = {.count = count, .box = from->box};
    for (int s = 0; s < SOUP_STREAMS; s++) {
        void *const place = is_at_end ? guarded_tail(stream_fence[s], count * sizeof(float)) : stream_fence[s].first;
        q.stream[s] = memcpy(place, from->stream[s] + first, count * sizeof(float));
    }
    return q;
}

static void check_kernels(const pair_list *q)
{
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            check(q, &(tribox_options){.accuracy = accuracy, .kernel = names[k]});
}

/* Many vertices of the lattice lie on the faces of the box. */
static pair_list draw_lattice(random_source *r, const tribox_box *box, size_t count)
{
    for (int s = 0; s < SOUP_STREAMS; s++)
        for (size_t i = 0; i < count; i++)
            numbers.stream[s][i] = random_sign_of_zero(r, 0.5f * (float)random_int_between(r, i % 3 ? -2 : -4, i % 3 ? 2 : 4));
    return pairs_over(&numbers, count, box, NULL);
}

static const tribox_box cube = {{-1, -1, -1}, {1, 1, 1}};

CASE(test_every_count)
{
    static const size_t large[] = {511, 512, 513, 4095, 4096, 4097, 4160, 8193, 10000};
    random_source r = random_named(args.seed, "every count");
    const pair_list all = draw_lattice(&r, &cube, DRAWN_MAX);
    for (size_t count = 0; count <= 200; count++)
        for (int place = 0; place < 2; place++) {
            const pair_list q = between_fences(&all, 3 * count, count, place == 0);
            check_kernels(&q);
        }
    for (size_t c = 0; c < sizeof large / sizeof large[0]; c++) {
        const pair_list q = between_fences(&all, 0, large[c], true);
        for (int k = 0; k < kernels; k++)
            check(&q, &(tribox_options){.accuracy = (tribox_accuracy)(c % 3), .kernel = names[k]});
    }
}

CASE(test_axes)
{
    random_source r = random_named(args.seed, "axes");
    const pair_list q = draw_lattice(&r, &cube, 150);
    for (unsigned axes = 0; axes <= TRIBOX_AXES_ALL; axes++)
        for (int o = 0; o < AXIS_ORDERS; o++)
            for (int k = 0; k < kernels; k++)
                check(&q, &(tribox_options){.accuracy = (tribox_accuracy)((o + k) % 3),
                                            .axes = axes,
                                            .axis_order = axis_order_at(o),
                                            .kernel = names[k]});
}

/*
 * The whole range of floats: FAST must not lose what is inside either. Every other time with the vertices moved to the nearest
 * points of the box, where most is inside then, some of them beside it by one ulp.
 */
CASE(test_scenes)
{
    for (size_t i = 0; i < 6 * scene_count(); i++) {
        random_source r = random_named(args.seed + i % 6, scene_at(i / 6)->name);
        const pair_list q = draw_pairs(&r, scene_at(i / 6), true, &numbers);
        for (size_t k = 0; i % 2 && k < SOUP_STREAMS * q.count; k++) {
            const size_t s = k / q.count;
            float *const u = &numbers.stream[s][k % q.count];
            *u = fminf(fmaxf(*u, (float)q.box->lo[s / 3]), (float)q.box->hi[s / 3]);
            if (!random_int(&r, 40))
                *u = nextafterf(*u, random_int(&r, 2) ? FLT_MAX : -FLT_MAX);
        }
        check_kernels(&q);
    }
}

/* Boxes that are flat, or reach to the ends of the range; bounds of either zero. */
static const tribox_box special[] = {
    {{-1, -1, -1}, {1, 1, 1}},
    {{0.25f, 0.25f, 0.25f}, {0.5f, 0.75f, 1}},
    {{-1, 0.5f, -1}, {1, 0.5f, 1}},
    {{0, 0, 0}, {0, 0, 0}},
    {{-0.0f, 0, -0.0f}, {0, -0.0f, 1}},
    {{-3, 0, 0x1p-149f}, {-3, 0, 0x1p-149f}},
    {{-0x1p-149f, 0x1p-149f, -0x1p-126f}, {0x1p-149f, 0x1.8p-140f, 0x1p-126f}},
    {{-FLT_MAX, -FLT_MAX, -FLT_MAX}, {FLT_MAX, FLT_MAX, FLT_MAX}},
    {{FLT_MAX, -FLT_MAX, 0}, {FLT_MAX, -FLT_MAX, FLT_MAX}},
    {{1, 0, 0}, {0, 1, 1}},
    {{0, 0, 0x1p-149f}, {1, 1, 0}},
};

/*
 * Each of the 18 comparisons decides a triangle alone: its vertices are corners of the box, but for one number, which is beside
 * one bound by an ulp, infinite or NaN. The triangles around it, to both sides, are inside.
 */
CASE(test_each_comparison)
{
    enum { KINDS = 4, COUNT = 6 * 6 * KINDS + 37 };
    random_source r = random_named(args.seed, "each comparison");
    for (size_t b = 0; b < sizeof special / sizeof special[0]; b++)
        for (size_t spread = 1; spread <= 5; spread++) {
            const tribox_box *const box = &special[b];
            const pair_list q = pairs_over(&numbers, COUNT * spread, box, NULL);
            for (int s = 0; s < SOUP_STREAMS; s++)
                for (size_t i = 0; i < q.count; i++) {
                    const double bound = random_int(&r, 2) ? box->lo[s / 3] : box->hi[s / 3];
                    numbers.stream[s][i] = random_sign_of_zero(&r, (float)bound);
                }
            for (size_t c = 0; c < 18 * KINDS; c++) {
                const size_t s = c % 9, side = c / 9 % 2, kind = c / 18;
                const float ulp = side ? nextafterf((float)box->hi[s / 3], INFINITY) : nextafterf((float)box->lo[s / 3], -INFINITY);
                const float beside[KINDS] = {ulp, side ? INFINITY : -INFINITY, NAN, -NAN};
                numbers.stream[s][c * spread + c % spread] = beside[kind];
            }
            check_kernels(&q);
        }
}

static void put(size_t i, float x)
{
    for (int s = 0; s < SOUP_STREAMS; s++)
        numbers.stream[s][i] = s < 3 ? x : 0;
}

static pair_list soup_of(size_t count) { return pairs_over(&numbers, count, &cube, NULL); }

/* One triangle that differs from all others, at every place of short soups and about every power of two of long ones. */
static void check_one_unlike(float usual, float other)
{
    const bool is_hit = fabsf(other) <= 1;
    for (size_t i = 0; i < DRAWN_MAX; i++)
        put(i, usual);
    for (size_t at = 0; at < DRAWN_MAX - 1; at++) {
        const bool is_edge = at < 260 || (at + 1) % 64 < 2 || (at & (at - 1)) == 0;
        put(at, other);
        const tribox_options options = {.accuracy = (tribox_accuracy)(at % 3), .kernel = names[at / 3 % (size_t)kernels]};
        const size_t counts[] = {at, at + 1, at + 2, 10000};
        for (size_t c = 0; is_edge && c < 4; c++) {
            const size_t count = counts[c];
            if (c == 3 && (at >= count || at % 7))
                continue;
            const pair_list packed = soup_of(count), q = count < 300 ? between_fences(&packed, 0, count, true) : packed;
            const size_t found = at < count ? at : count, none = count ? 0 : count;
            const size_t unlike = at ? none : count < 2 ? count : 1;
            if (is_hit)
                expect_both(&q, &options, found, unlike);
            else
                expect_both(&q, &options, unlike, found);
        }
        put(at, usual);
    }
}

CASE(test_one_unlike)
{
    check_one_unlike(3, 0);
    check_one_unlike(0, 3);
}

/* A triangle that is not finite overlaps nothing: any goes past it, and all stops at it. */
static void check_not_finite(size_t count, size_t at, int stream, float usual, tribox_find_what what, size_t expected)
{
    static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        put(i, i < at ? usual : 0);
    numbers.stream[stream][at] = bad[(at + (size_t)stream) % 4];
    const pair_list packed = soup_of(count), q = between_fences(&packed, 0, count, true);
    for (int k = 0; k < kernels; k++)
        expect(what, &q, &(tribox_options){.accuracy = (tribox_accuracy)(at % 3), .kernel = names[k]}, expected);
}

CASE(test_not_finite)
{
    for (size_t count = 1; count <= 140; count += 1 + count / 9)
        for (size_t at = 0; at < count; at++)
            for (int stream = 0; stream < SOUP_STREAMS; stream++) {
                check_not_finite(count, at, stream, 3, TRIBOX_FIRST_HIT, at + 1);
                check_not_finite(count, at, stream, 0, TRIBOX_FIRST_MISS, at);
            }
}

/* Nothing overlaps the empty box; and no triangle is there to differ in an empty soup. */
CASE(test_empty)
{
    static const tribox_box empty = {{0, 0, 1}, {1, 1, 0}};
    for (size_t i = 0; i < 200; i++)
        put(i, 0);
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            const tribox_options options = {.accuracy = accuracy, .kernel = names[k]};
            pair_list q = soup_of(0);
            memset(q.stream, 0, sizeof q.stream);
            expect_both(&q, &options, 0, 0);
            q.box = &empty;
            expect_both(&q, &options, 0, 0);
            q = soup_of(200);
            q.box = &empty;
            expect_both(&q, &options, 200, 0);
        }
}

/* Streams that could not be read to their end: they are not. */
CASE(test_stops)
{
    enum { READABLE = 65536 };
    const size_t count = (size_t)1 << 22, bytes = count * sizeof(float);
    for (int k = 0; k < kernels; k++)
        for (size_t at = 0; at < 4096; at = 3 * at + 1) {
            pair_list q = {.count = count, .box = &cube};
            for (int s = 0; s < SOUP_STREAMS; s++) {
                float *const stream = pages_reserve(bytes);
                assert_non_null(stream);
                assert_true(pages_allow(stream, READABLE * sizeof(float), PAGES_OPEN));
                for (size_t i = 0; s < 3 && i < READABLE; i++)
                    stream[i] = i == at ? 0.0f : 3.0f;
                q.stream[s] = stream;
            }
            const tribox_options options = {.accuracy = (tribox_accuracy)(at % 3), .kernel = names[k]};
            expect(TRIBOX_FIRST_HIT, &q, &options, at);
            expect(TRIBOX_FIRST_MISS, &q, &options, at == 0);
            for (int s = 0; s < SOUP_STREAMS; s++)
                pages_release((void *)(uintptr_t)q.stream[s], bytes);
        }
}

PROGRAM_AFTER(set_up, RUN(test_every_count), RUN(test_axes), RUN(test_scenes), RUN(test_each_comparison), RUN(test_one_unlike),
              RUN(test_empty), RUN(test_not_finite), RUN(test_stops))
