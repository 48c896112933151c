/* between_boxes.c - rounds a box inwards and outwards, and settles what lies between. */
#include "between_boxes.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { BATCH = 256 };

/* Triangles that are asked about the box itself, and the bits that are set where they overlap. */
typedef struct batch {
    const tribox_soup *soup;
    const tribox_box *box;
    const tribox_options *test;
    size_t count, asked; /* now, and in all */
    float positions[BATCH][9];
    uint64_t *word[BATCH];
    unsigned bit[BATCH];
} batch;

static float round_down(double number)
{
    const float nearest = (float)number;
    return (double)nearest > number ? nextafterf(nearest, -INFINITY) : nearest;
}

static float round_up(double number) { return -round_down(-number); }

/* Empty where no box of floats is inside. */
static tribox_box inner_box(const tribox_box *box)
{
    const tribox_box empty = {{1, 1, 1}, {0, 0, 0}};
    tribox_box inner;
    for (int a = 0; a < 3; a++) {
        inner.lo[a] = round_up(box->lo[a]);
        inner.hi[a] = round_down(box->hi[a]);
        if (!isfinite(inner.lo[a]) || !isfinite(inner.hi[a]))
            return empty;
    }
    return inner;
}

/* Returns false where float ends before the box does. */
static bool outer_box(const tribox_box *box, tribox_box *outer)
{
    bool is_finite = true;
    for (int a = 0; a < 3; a++) {
        outer->lo[a] = round_down(box->lo[a]);
        outer->hi[a] = round_up(box->hi[a]);
        is_finite &= isfinite(outer->lo[a]) && isfinite(outer->hi[a]);
    }
    return is_finite;
}

static tribox_status settle(batch *b)
{
    uint64_t mask[BATCH / 64];
    const tribox_mesh mesh = {.positions = b->positions, .vertices = 3 * b->count, .count = b->count};
    const tribox_status status = tribox_mesh_overlap(&mesh, b->box, b->test, mask, NULL);
    for (size_t i = 0; !status && i < b->count; i++)
        *b->word[i] |= (mask[i / 64] >> i % 64 & 1) << b->bit[i];
    b->count = 0;
    return status;
}

static tribox_status add(batch *b, uint64_t *word, unsigned bit, size_t triangle)
{
    float *const to = b->positions[b->count];
    for (size_t v = 0; v < 3; v++) {
        to[3 * v] = b->soup->x[v][triangle];
        to[3 * v + 1] = b->soup->y[v][triangle];
        to[3 * v + 2] = b->soup->z[v][triangle];
    }
    b->word[b->count] = word;
    b->bit[b->count++] = bit;
    b->asked++;
    return b->count < BATCH ? TRIBOX_OK : settle(b);
}

/* Adds the triangles first .. first + 63 whose bits are set in `open`. */
static tribox_status add_word(batch *b, uint64_t *word, uint64_t open, size_t first)
{
    uint32_t bits[64];
    const size_t count = tribox_mask_indices(&open, 64, bits);
    tribox_status status = TRIBOX_OK;
    for (size_t i = 0; !status && i < count; i++)
        status = add(b, word, bits[i], first + bits[i]);
    return status;
}

static size_t count_bits(const uint64_t *words, size_t count)
{
    size_t bits = 0;
    for (size_t w = 0; w < count; w++)
        bits += tribox_mask_indices(&words[w], 64, NULL);
    return bits;
}

static tribox_status ask_floats(const tribox_soup *soup, const tribox_box *box, const tribox_options *test, uint64_t *mask,
                                uint64_t *inside, tribox_report *report)
{
    return inside ? tribox_classify(soup, box, test, mask, inside, report) : tribox_overlap(soup, box, test, mask, report);
}

/* Without an outer box every triangle is open. */
static tribox_status ask_outer(const tribox_soup *soup, const tribox_box *box, const tribox_options *test, uint64_t *mask,
                               tribox_report *report)
{
    tribox_box outer;
    if (outer_box(box, &outer))
        return tribox_overlap(soup, &outer, test, mask, report);
    *report = (tribox_report){soup->count, soup->count};
    memset(mask, 0xFF, tribox_mask_words(soup->count) * sizeof *mask);
    if (soup->count % 64)
        mask[soup->count / 64] = (UINT64_C(1) << soup->count % 64) - 1;
    return TRIBOX_OK;
}

/* A float is between the bounds just when it is between those of the inner box. */
tribox_status between_boxes_ask(const tribox_soup *soup, const tribox_box *box, const tribox_options *test, uint64_t *mask,
                                uint64_t *inside, uint64_t *outer, tribox_report *report)
{
    const size_t words = tribox_mask_words(soup->count);
    const tribox_box inner = inner_box(box);
    batch b = {.soup = soup, .box = box, .test = test};
    tribox_report around;
    tribox_status status = ask_outer(soup, box, test, outer, &around);
    if (!status)
        status = ask_floats(soup, &inner, test, mask, inside, report);
    if (status)
        return status;
    for (size_t w = 0; !status && w < words; w++)
        status = add_word(&b, &mask[w], outer[w] & ~mask[w], 64 * w);
    if (!status && b.count)
        status = settle(&b);
    report->overlapping = count_bits(mask, words);
    report->undecided += around.undecided + b.asked;
    return status;
}

static tribox_status find_words(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                const tribox_options *test, found_words *w, tribox_report *report)
{
    return tribox_index_words(index, soup, box, test, w->room, w->number, w->bits, NULL, &w->count, report);
}

/* Those of the outer box, where float does not end before it; else all. */
static tribox_status find_outer(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                const tribox_options *test, found_words *w, tribox_report *report)
{
    tribox_box outer;
    if (outer_box(box, &outer))
        return find_words(index, soup, &outer, test, w, report);
    w->count = w->room;
    for (size_t k = 0; k < w->count; k++)
        w->number[k] = (uint32_t)k;
    return ask_outer(soup, box, test, w->bits, report);
}

tribox_status between_boxes_index(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                  const tribox_options *test, found_words *words, found_words *inner, tribox_report *report)
{
    const tribox_box within = inner_box(box);
    batch b = {.soup = soup, .box = box, .test = test};
    tribox_report around;
    tribox_status status = find_outer(index, soup, box, test, words, &around);
    if (!status)
        status = find_words(index, soup, &within, test, inner, report);
    if (status)
        return status;
    size_t i = 0;
    for (size_t k = 0; !status && k < words->count; k++) {
        const bool is_shared = i < inner->count && inner->number[i] == words->number[k];
        const uint64_t sure = is_shared ? inner->bits[i++] : 0, open = words->bits[k] & ~sure;
        words->bits[k] = sure;
        status = add_word(&b, &words->bits[k], open, 64 * (size_t)words->number[k]);
    }
    if (!status && b.count)
        status = settle(&b);
    report->overlapping = count_bits(words->bits, words->count);
    report->undecided += around.undecided + b.asked;
    return status;
}
