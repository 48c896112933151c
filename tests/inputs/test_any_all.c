/*
 * test_any_all.c - the first triangle that overlaps, and the first that does not, wherever it stands; the search ends there.
 */
#include <math.h>

#include "common/harness.h"
#include "drawn_pairs.h"
#include "fences.h"
#include "common/guarded_pages.h"

static drawn_numbers numbers;

static guarded fence[SOUP_STREAMS];
static const tribox_box cube = {{-1, -1, -1}, {1, 1, 1}};

static int set_up(void)
{
    for (int s = 0; s < SOUP_STREAMS; s++)
        fence[s] = guarded_make(DRAWN_MAX * sizeof(float));
    return 0;
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

/* What the mask says. */
static void check_against_mask(const pair_list *q, const tribox_options *options)
{
    static uint64_t mask[DRAWN_WORDS];
    size_t set = 0, clear = 0;
    ask_ok(q, options, mask, NULL);
    while (set < q->count && !mask_bit(mask, set))
        set++;
    while (clear < q->count && mask_bit(mask, clear))
        clear++;
    expect_both(q, options, set, clear);
}

/* `count` triangles from `first` on, at the end of their fences. */
static pair_list between_fences(const pair_list *from, size_t first, size_t count)
{
    pair_list q = {.count = count, .box = from->box};
    for (int s = 0; s < SOUP_STREAMS; s++)
        q.stream[s] = memcpy(guarded_tail(fence[s], count * sizeof(float)), from->stream[s] + first, count * sizeof(float));
    return q;
}

static void check_kernels(const pair_list *q)
{
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            check_against_mask(q, &(tribox_options){.accuracy = accuracy, .kernel = names[k]});
}

CASE(test_scenes)
{
    for (size_t i = 0; i < scene_count(); i++) {
        random_source r = random_named(args.seed, scene_at(i)->name);
        const pair_list all = draw_pairs(&r, scene_at(i), true, &numbers);
        for (size_t first = 0; first <= all.count; first += 1 + (size_t)random_int(&r, 4)) {
            const pair_list from = between_fences(&all, first, all.count - first);
            check_kernels(&from);
            const pair_list to = between_fences(&all, 0, first);
            check_kernels(&to);
        }
    }
}

/* Sets of axes and orders: they decide what overlaps. */
CASE(test_axes)
{
    static const unsigned orders[] = {0, 123, 132, 213, 231, 312, 321};
    random_source r = random_named(args.seed, "axes");
    const pair_list all = draw_pairs(&r, scene_at(0), true, &numbers);
    for (size_t first = 0; first < all.count; first++) {
        const pair_list q = between_fences(&all, first, all.count - first);
        for (unsigned axes = 0; axes <= TRIBOX_AXES_ALL; axes++)
            check_against_mask(&q, &(tribox_options){.accuracy = (tribox_accuracy)(first % 3),
                                                     .axes = axes,
                                                     .axis_order = orders[first % 7],
                                                     .kernel = names[first % (size_t)kernels]});
    }
}

static void put(size_t i, float x)
{
    for (int s = 0; s < SOUP_STREAMS; s++)
        numbers.stream[s][i] = s < 3 ? x : 0;
}

static pair_list soup_of(size_t count)
{
    pair_list q = {.count = count, .box = &cube};
    for (int s = 0; s < SOUP_STREAMS; s++)
        q.stream[s] = numbers.stream[s];
    return q;
}

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
            const pair_list packed = soup_of(count), q = count < 300 ? between_fences(&packed, 0, count) : packed;
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

CASE(test_one_hit) { check_one_unlike(3, 0); }

CASE(test_one_miss) { check_one_unlike(0, 3); }

/* A triangle that is not finite overlaps nothing: any goes past it, and all stops at it. */
static void check_not_finite(size_t count, size_t at, int stream, float usual, tribox_find_what what, size_t expected)
{
    static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        put(i, i < at ? usual : 0);
    numbers.stream[stream][at] = bad[(at + (size_t)stream) % 4];
    const pair_list packed = soup_of(count), q = between_fences(&packed, 0, count);
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

PROGRAM_AFTER(set_up, RUN(test_scenes), RUN(test_axes), RUN(test_one_hit), RUN(test_one_miss), RUN(test_empty),
              RUN(test_not_finite), RUN(test_stops))
