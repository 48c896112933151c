/*
 * fuzz_index.c - an index over a soup or a mesh: as it was built its answers are those of the calls without one; after damage all
 * forms still agree, and nothing is read outside.
 */
#include <string.h>

#include "things.h"

enum { MANY = 9 /* times as many triangles: more than one node has */, BOXES = 3 };

typedef struct fuzz_case {
    things t;
    tribox_box box[BOXES]; /* all asked at once; the first alone too */
    tribox_region region;  /* the first */
    unsigned char *nodes;
    tribox_index index, with_ids;
    uint32_t *ids;
    unsigned quarter;
    bool is_damaged;
} fuzz_case;

/* Every kernel builds the same bytes, and so does an update of any range. */
static void check_build(const fuzz_case *q, size_t first, size_t count)
{
    const size_t bytes = tribox_index_bytes(q->t.count);
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++) {
        const tribox_options o = {.kernel = *kernel};
        unsigned char *const again = tight_memory(bytes, 0);
        ensure_status(0, tribox_index_build(&q->index, &o, again));
        ensure(!memcmp(again, q->nodes, bytes), "kernel %s builds other bytes", *kernel);
        ensure_status(0, tribox_index_update(&q->index, first, count, &o, again));
        ensure(!memcmp(again, q->nodes, bytes), "kernel %s updates %zu and %zu more to other bytes", *kernel, first, count);
    }
}

/* Any byte anywhere, as often as the input says: half of all indices stay sound. */
static void damage(input *in, fuzz_case *q)
{
    const size_t bytes = tribox_index_bytes(q->t.count);
    const unsigned choice = input_byte(in), changes = choice & 1 ? 1 + choice / 8 : 0;
    q->is_damaged = changes;
    for (unsigned k = 0; k < changes; k++) {
        const size_t high = input_byte(in), low = input_byte(in), length = 1 + input_byte(in);
        const int byte = (int)input_byte(in);
        const size_t at = (high << 8 | low) % bytes;
        memset(q->nodes + at, byte, length < bytes - at ? length : bytes - at);
    }
}

static bool is_same(const fuzz_case *q, uint64_t mask, uint64_t without, uint64_t inside, const tribox_options *o)
{
    const bool may_have_more = q->is_damaged || (o->accuracy == TRIBOX_FAST && !(mask & ~without & ~inside));
    return mask == without || may_have_more;
}

/* The mask of the index, beside that of the call without one. */
static uint64_t *check_mask(const fuzz_case *q, const tribox_options *o)
{
    const size_t count = q->t.count;
    uint64_t *const mask = tight_mask(count), *const without = tight_mask(count), *const inside = tight_mask(count);
    tribox_report report, alone;
    ensure_status(0, things_overlap(&q->t, &q->region, o, without, NULL));
    ensure_status(0, CALL(classify, &q->t, &q->box[0], o, NULL, inside, NULL));
    ensure_status(0, tribox_index_overlap(&q->index, &q->region, o, mask, &report));
    ensure_status(0, tribox_index_overlap(&q->index, &q->region, o, NULL, &alone));
    ensure(report.overlapping == mask_population(mask, count) && alone.overlapping == report.overlapping,
           "%zu overlap by the report, %zu without a mask", report.overlapping, alone.overlapping);
    for (size_t w = 0; w < tribox_mask_words(count); w++)
        ensure(is_same(q, mask[w], without[w], inside[w], o) && (q->is_damaged || !(without[w] & ~mask[w])),
               "word %zu is not that of tribox_overlap", w);
    return mask;
}

static void check_words(const fuzz_case *q, const tribox_options *o, const uint64_t *mask)
{
    const size_t words = tribox_mask_words(q->t.count);
    size_t found = SIZE_MAX, expected = 0;
    for (size_t w = 0; w < words; w++)
        expected += mask[w] != 0;
    uint32_t *const number = tight_memory(expected * sizeof *number, 0);
    uint64_t *const bits = tight_mask(64 * expected);
    ensure_status(0, tribox_index_words(&q->index, &q->region, o, expected, number, bits, NULL, &found, NULL));
    ensure(found == expected, "%zu words", found);
    for (size_t w = 0, k = 0; w < words; w++)
        if (mask[w]) {
            ensure(number[k] == w && bits[k] == mask[w], "word %zu", w);
            k++;
        }
}

/* With the three-way answer, of an index that is sound. */
static void check_inside(const fuzz_case *q, const tribox_options *o)
{
    const size_t words = tribox_mask_words(q->t.count);
    uint32_t *const number = tight_memory(words * sizeof *number, 0);
    uint64_t *const bits = tight_mask(64 * words), *const inside = tight_mask(64 * words), *const truth = tight_mask(q->t.count);
    size_t found = SIZE_MAX;
    ensure_status(0, CALL(classify, &q->t, &q->box[0], o, NULL, truth, NULL));
    ensure_status(0, tribox_index_words(&q->index, &q->region, o, words, number, bits, inside, &found, NULL));
    ensure(found <= words, "%zu words of %zu", found, words);
    for (size_t k = 0; k < found; k++)
        ensure(number[k] < words && !(inside[k] & ~bits[k]) && (q->is_damaged || inside[k] == truth[number[k]]),
               "inside of word %u", (unsigned)number[k]);
}

/* Such a triangle may be found although FAST has lost it. */
static bool is_inside(const fuzz_case *q, const tribox_options *o, size_t i)
{
    uint64_t *const inside = tight_mask(q->t.count);
    ensure_status(0, CALL(classify, &q->t, &q->box[0], o, NULL, inside, NULL));
    return bit_of(inside, i);
}

static void check_list(const fuzz_case *q, const tribox_options *o, const uint64_t *mask)
{
    const size_t expected = mask_population(mask, q->t.count);
    uint32_t *const list = tight_memory(expected * sizeof *list, 0);
    size_t found = SIZE_MAX, k = 0, triangle = SIZE_MAX;
    ensure_status(0, tribox_index_list(&q->with_ids, &q->region, o, expected, list, &found));
    ensure(found == expected, "a list of %zu", found);
    for (size_t i = 0; i < q->t.count; i++)
        if (bit_of(mask, i))
            ensure(list[k++] == q->ids[i], "triangle %zu is not listed", i);
    ensure_status(0, tribox_index_any(&q->index, &q->region, o, &triangle));
    const bool is_none = triangle == q->t.count && !expected;
    ensure(is_none ||
               (triangle < q->t.count && (bit_of(mask, triangle) || (o->accuracy == TRIBOX_FAST && is_inside(q, o, triangle)))),
           "any finds %zu", triangle);
}

/* The lists of all boxes are those of each, one after another; with half the room, the first half. */
static void check_lists(const fuzz_case *q, const tribox_options *o)
{
    float bound[6][BOXES];
    tribox_boxes boxes = {.count = BOXES};
    size_t *const start = tight_memory((BOXES + 1) * sizeof *start, 0), total = 0;
    for (int k = 0; k < 6; k++) {
        for (int b = 0; b < BOXES; b++)
            bound[k][b] = k < 3 ? (float)q->box[b].lo[k] : (float)q->box[b].hi[k - 3];
        (k < 3 ? boxes.lo : boxes.hi)[k % 3] = bound[k];
    }
    ensure_status(0, tribox_index_lists(&q->index, &boxes, o, 0, NULL, start));
    for (int b = 0; b < BOXES; b++) {
        size_t found = 0;
        ensure(start[b] == total, "list %d starts at %zu", b, start[b]);
        if (box_is_finite(&q->box[b]))
            ensure_status(0, tribox_index_list(&q->index, &(tribox_region){.box = &q->box[b]}, o, 0, NULL, &found));
        total += found;
    }
    ensure(start[BOXES] == total, "lists of %zu and not %zu", start[BOXES], total);
    uint32_t *const half = tight_memory(total / 2 * sizeof *half, 0), *const all = tight_memory(total * sizeof *all, 0);
    ensure_status(0, tribox_index_lists(&q->index, &boxes, o, total / 2, half, start));
    ensure_status(0, tribox_index_lists(&q->index, &boxes, o, total, all, start));
    ensure(!(total / 2) || !memcmp(half, all, total / 2 * sizeof *half), "half the room, other lists");
    for (size_t k = 0; k < total; k++)
        ensure(all[k] < q->t.count, "triangle %u of %zu", (unsigned)all[k], q->t.count);
}

/* Many triangles take long: a quarter of what can be asked about them is. */
static void check(const void *about, const tribox_options *o)
{
    static unsigned quarter;
    const fuzz_case *const q = about;
    if (o->accuracy == TRIBOX_EXACT && o->kernel == runnable_kernels()[0])
        quarter = q->quarter;
    if (q->t.count > COUNT_MAX && ++quarter % 4)
        return;
    const uint64_t *const mask = check_mask(q, o);
    check_words(q, o, mask);
    check_inside(q, o);
    check_list(q, o, mask);
    check_lists(q, o);
}

static void draw(input *in, fuzz_case *q)
{
    const unsigned shape = input_byte(in);
    const size_t few = input_count(in), count = shape & 1 ? MANY * few : few;
    for (int b = 0; b < BOXES; b++)
        q->box[b] = input_box(in);
    things_draw(in, shape / 2 % KINDS, count, NULL, &q->t);
    q->quarter = input_byte(in);
    q->region.box = &q->box[0];
    q->nodes = tight_memory(tribox_index_bytes(count), shape / 32);
    q->ids = tight_memory(count * sizeof *q->ids, 0);
    for (size_t i = 0; i < count; i++)
        q->ids[i] = (uint32_t)(3 * i + 1);
    q->index.nodes = q->nodes;
    q->index.soup = q->t.is_mesh ? NULL : &q->t.soup;
    q->index.mesh = q->t.is_mesh ? &q->t.mesh : NULL;
    q->with_ids = q->index;
    q->with_ids.ids = q->ids;
}

static void check_all(input *in, fuzz_case *q, const tribox_options *o)
{
    const size_t count = q->t.count, first = count * input_byte(in) / 255, changed = (count - first) * input_byte(in) / 255;
    check_build(q, first, changed);
    damage(in, q);
    const bool is_bad_option = o->axes && !(o->axes & TRIBOX_AXES_BOX);
    const unsigned wrong = (box_is_finite(&q->box[0]) ? 0 : 1u << TRIBOX_BAD_BOX) | (is_bad_option ? 1u << TRIBOX_BAD_OPTION : 0);
    if (wrong)
        ensure_status(wrong, tribox_index_overlap(&q->index, &q->region, o, NULL, NULL));
    else
        ask_everywhere(*o, check, q);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static fuzz_case q;
    input in = input_of(data, size);
    const tribox_options o = input_options(&in);
    draw(&in, &q);
    const tribox_status status = tribox_index_build(&q.index, NULL, q.nodes);
    ensure_status(q.t.wrong, status);
    if (!status)
        check_all(&in, &q, &o);
    tight_memory_free_all();
    return 0;
}
