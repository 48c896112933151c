/*
 * fuzz_index.c - an index over a soup or a mesh: as it was built its answers are those of the calls without one; after damage all
 * forms still agree, and nothing is read outside.
 */
#include <string.h>

#include "answers.h"
#include "ensure.h"
#include "tight_memory.h"
#include "target.h"

enum { TRIANGLES_DRAWN = 16, MANY = 9 /* times as many triangles: more than one node has */, BOXES = 3 };

typedef struct fuzz_case {
    tribox_soup soup;
    tribox_mesh mesh;      /* of the same triangles, where the index is over it */
    tribox_box box[BOXES]; /* all asked at once; the first alone too */
    unsigned char *nodes;
    tribox_index index, with_ids;
    uint32_t *ids;
    bool is_damaged;
} fuzz_case;

/* Runs of one triangle each, so that words and nodes have bounds of their own. */
static tribox_soup draw_soup(input *in, size_t shift)
{
    float drawn[TRIANGLES_DRAWN][3][3];
    const size_t few = input_count(in), count = input_byte(in) & 1 ? MANY * few : few, run = 1 + input_byte(in);
    const unsigned kinds = 1 + input_below(in, TRIANGLES_DRAWN);
    for (unsigned k = 0; k < kinds; k++)
        input_triangle(in, drawn[k]);
    tribox_soup soup = {.count = count};
    for (int k = 0; k < 9; k++) {
        float *const stream = tight_memory(count * sizeof *stream, shift * sizeof *stream);
        for (size_t i = 0; i < count; i++)
            stream[i] = drawn[i / run % kinds][k % 3][k / 3];
        (k < 3 ? soup.x : k < 6 ? soup.y : soup.z)[k % 3] = stream;
    }
    return soup;
}

/* The triangles of a soup as a mesh: without vertex numbers, with them, or in double beside what floats are. */
static tribox_mesh draw_mesh(const tribox_soup *soup, unsigned kind)
{
    const unsigned bytes = kind > 1 ? sizeof(double) : sizeof(float);
    char *const positions = tight_memory(9 * soup->count * bytes, 0);
    uint16_t *const numbers = tight_memory(3 * soup->count * sizeof *numbers, 0);
    for (size_t k = 0; k < 9 * soup->count; k++) {
        const float single = (k % 3 == 0 ? soup->x : k % 3 == 1 ? soup->y : soup->z)[k / 3 % 3][k / 9];
        const double number = (double)single * (kind > 2 ? 1 + 0x1p-40 : 1);
        memcpy(positions + k * bytes, bytes == sizeof single ? (const void *)&single : (const void *)&number, bytes);
        if (k % 3 == 0)
            numbers[k / 3] = (uint16_t)(k / 3);
    }
    return (tribox_mesh){.positions = positions,
                         .vertices = 3 * soup->count,
                         .indices = kind > 1 ? numbers : NULL,
                         .index_bytes = sizeof *numbers,
                         .count = soup->count,
                         .position_bytes = bytes};
}

static tribox_status overlap_without(const fuzz_case *q, const tribox_options *o, uint64_t *mask)
{
    return q->index.soup ? tribox_overlap(&q->soup, &q->box[0], o, mask, NULL)
                         : tribox_mesh_overlap(&q->mesh, &q->box[0], o, mask, NULL);
}

static tribox_status classify_without(const fuzz_case *q, const tribox_options *o, uint64_t *inside)
{
    return q->index.soup ? tribox_classify(&q->soup, &q->box[0], o, NULL, inside, NULL)
                         : tribox_mesh_classify(&q->mesh, &q->box[0], o, NULL, inside, NULL);
}

/* Every kernel builds the same bytes, and so does an update of any range. */
static void check_build(const fuzz_case *q, size_t first, size_t count)
{
    const size_t bytes = tribox_index_bytes(q->soup.count);
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++) {
        const tribox_options o = {.kernel = *kernel};
        unsigned char *const again = tight_memory(bytes, 0);
        status_fits("tribox_index_build", 0, tribox_index_build(&q->index, &o, again));
        ensure(!memcmp(again, q->nodes, bytes), "kernel %s builds other bytes", *kernel);
        status_fits("tribox_index_update", 0, tribox_index_update(&q->index, first, count, &o, again));
        ensure(!memcmp(again, q->nodes, bytes), "kernel %s updates %zu and %zu more to other bytes", *kernel, first, count);
    }
}

/* Any byte anywhere, as often as the input says. */
static void damage(input *in, fuzz_case *q)
{
    const size_t bytes = tribox_index_bytes(q->soup.count);
    q->is_damaged = !input_is_over(in);
    while (!input_is_over(in)) {
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
    const size_t count = q->soup.count;
    uint64_t *const mask = tight_mask(count), *const without = tight_mask(count), *const inside = tight_mask(count);
    tribox_report report, alone;
    status_fits("tribox_overlap", 0, overlap_without(q, o, without));
    status_fits("tribox_classify", 0, classify_without(q, o, inside));
    status_fits("tribox_index_overlap", 0, tribox_index_overlap(&q->index, &(tribox_region){.box = &q->box[0]}, o, mask, &report));
    status_fits("tribox_index_overlap", 0, tribox_index_overlap(&q->index, &(tribox_region){.box = &q->box[0]}, o, NULL, &alone));
    ensure(report.overlapping == mask_population("tribox_index_overlap", mask, count) && alone.overlapping == report.overlapping,
           "accuracy %d, kernel %s: %zu overlap by the report, %zu without a mask", (int)o->accuracy, o->kernel, report.overlapping,
           alone.overlapping);
    for (size_t w = 0; w < tribox_mask_words(count); w++)
        ensure(is_same(q, mask[w], without[w], inside[w], o) && (q->is_damaged || !(without[w] & ~mask[w])),
               "accuracy %d, axes %u, kernel %s: word %zu is not that of tribox_overlap", (int)o->accuracy, o->axes, o->kernel, w);
    return mask;
}

static void check_words(const fuzz_case *q, const tribox_options *o, const uint64_t *mask)
{
    const size_t words = tribox_mask_words(q->soup.count);
    size_t found = SIZE_MAX, expected = 0;
    for (size_t w = 0; w < words; w++)
        expected += mask[w] != 0;
    uint32_t *const number = tight_memory(expected * sizeof *number, 0);
    uint64_t *const bits = tight_mask(64 * expected);
    status_fits("tribox_index_words", 0,
                tribox_index_words(&q->index, &(tribox_region){.box = &q->box[0]}, o, expected, number, bits, NULL, &found, NULL));
    ensure(found == expected, "accuracy %d, kernel %s: %zu words", (int)o->accuracy, o->kernel, found);
    for (size_t w = 0, k = 0; w < words; w++)
        if (mask[w]) {
            ensure(number[k] == w && bits[k] == mask[w], "accuracy %d, kernel %s: word %zu", (int)o->accuracy, o->kernel, w);
            k++;
        }
}

/* With the three-way answer, of an index that is sound. */
static void check_inside(const fuzz_case *q, const tribox_options *o)
{
    const size_t words = tribox_mask_words(q->soup.count);
    uint32_t *const number = tight_memory(words * sizeof *number, 0);
    uint64_t *const bits = tight_mask(64 * words), *const inside = tight_mask(64 * words), *const truth = tight_mask(q->soup.count);
    size_t found = SIZE_MAX;
    status_fits("tribox_classify", 0, classify_without(q, o, truth));
    status_fits("tribox_index_words", 0,
                tribox_index_words(&q->index, &(tribox_region){.box = &q->box[0]}, o, words, number, bits, inside, &found, NULL));
    ensure(found <= words, "%zu words of %zu", found, words);
    for (size_t k = 0; k < found; k++)
        ensure(number[k] < words && !(inside[k] & ~bits[k]) && (q->is_damaged || inside[k] == truth[number[k]]),
               "accuracy %d, kernel %s: inside of word %u", (int)o->accuracy, o->kernel, (unsigned)number[k]);
}

/* Such a triangle may be found although FAST has lost it. */
static bool is_inside(const fuzz_case *q, const tribox_options *o, size_t i)
{
    uint64_t *const inside = tight_mask(q->soup.count);
    status_fits("tribox_classify", 0, classify_without(q, o, inside));
    return mask_bit(inside, i);
}

static void check_list(const fuzz_case *q, const tribox_options *o, const uint64_t *mask)
{
    const size_t expected = mask_population("tribox_index_overlap", mask, q->soup.count);
    uint32_t *const list = tight_memory(expected * sizeof *list, 0);
    size_t found = SIZE_MAX, k = 0, triangle = SIZE_MAX;
    status_fits("tribox_index_list", 0,
                tribox_index_list(&q->with_ids, &(tribox_region){.box = &q->box[0]}, o, expected, list, &found));
    ensure(found == expected, "accuracy %d, kernel %s: a list of %zu", (int)o->accuracy, o->kernel, found);
    for (size_t i = 0; i < q->soup.count; i++)
        if (mask_bit(mask, i))
            ensure(list[k++] == q->ids[i], "accuracy %d, kernel %s: triangle %zu is not listed", (int)o->accuracy, o->kernel, i);
    status_fits("tribox_index_any", 0, tribox_index_any(&q->index, &(tribox_region){.box = &q->box[0]}, o, &triangle));
    const bool is_none = triangle == q->soup.count && !expected;
    ensure(is_none || (triangle < q->soup.count &&
                       (mask_bit(mask, triangle) || (o->accuracy == TRIBOX_FAST && is_inside(q, o, triangle)))),
           "accuracy %d, kernel %s: any finds %zu", (int)o->accuracy, o->kernel, triangle);
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
    status_fits("tribox_index_lists", 0, tribox_index_lists(&q->index, &boxes, o, 0, NULL, start));
    for (int b = 0; b < BOXES; b++) {
        size_t found = 0;
        ensure(start[b] == total, "list %d starts at %zu", b, start[b]);
        if (box_is_finite(&q->box[b]))
            status_fits("tribox_index_list", 0,
                        tribox_index_list(&q->index, &(tribox_region){.box = &q->box[b]}, o, 0, NULL, &found));
        total += found;
    }
    ensure(start[BOXES] == total, "lists of %zu and not %zu", start[BOXES], total);
    uint32_t *const half = tight_memory(total / 2 * sizeof *half, 0), *const all = tight_memory(total * sizeof *all, 0);
    status_fits("tribox_index_lists", 0, tribox_index_lists(&q->index, &boxes, o, total / 2, half, start));
    status_fits("tribox_index_lists", 0, tribox_index_lists(&q->index, &boxes, o, total, all, start));
    ensure(!(total / 2) || !memcmp(half, all, total / 2 * sizeof *half), "half the room, other lists");
    for (size_t k = 0; k < total; k++)
        ensure(all[k] < q->soup.count, "triangle %u of %zu", (unsigned)all[k], q->soup.count);
}

/* Many triangles take long: a quarter of what can be asked about them is. */
static void check_answers(const fuzz_case *q, tribox_options o, unsigned quarter)
{
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            if (q->soup.count > COUNT_MAX && ++quarter % 4)
                continue;
            o.kernel = *kernel;
            o.accuracy = (tribox_accuracy)accuracy;
            const uint64_t *const mask = check_mask(q, &o);
            check_words(q, &o, mask);
            check_inside(q, &o);
            check_list(q, &o, mask);
            check_lists(q, &o);
        }
}

static void check_refusals(const fuzz_case *q, const tribox_options *o, unsigned wrong)
{
    uint64_t *const mask = tight_mask(q->soup.count);
    size_t found;
    tribox_report report;
    memset(&report, POISON, sizeof report);
    memset(&found, POISON, sizeof found);
    status_fits("tribox_index_overlap", wrong,
                tribox_index_overlap(&q->index, &(tribox_region){.box = &q->box[0]}, o, mask, &report));
    status_fits("tribox_index_words", wrong,
                tribox_index_words(&q->index, &(tribox_region){.box = &q->box[0]}, o, 0, NULL, NULL, NULL, &found, &report));
    status_fits("tribox_index_list", wrong, tribox_index_list(&q->index, &(tribox_region){.box = &q->box[0]}, o, 0, NULL, &found));
    status_fits("tribox_index_any", wrong, tribox_index_any(&q->index, &(tribox_region){.box = &q->box[0]}, o, &found));
    ensure(is_poisoned(mask, tribox_mask_words(q->soup.count) * sizeof *mask) && is_poisoned(&report, sizeof report) &&
               is_poisoned(&found, sizeof found),
           "a call about an index writes although it refuses");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = input_of(data, size);
    const drawn_options how = input_options(&in);
    const size_t shift = input_below(&in, 8);
    fuzz_case q = {.is_damaged = false};
    for (int b = 0; b < BOXES; b++)
        q.box[b] = input_box(&in);
    q.soup = draw_soup(&in, shift % 4);
    const size_t bytes = tribox_index_bytes(q.soup.count);
    q.nodes = tight_memory(bytes, shift);
    q.ids = tight_memory(q.soup.count * sizeof *q.ids, 0);
    for (size_t i = 0; i < q.soup.count; i++)
        q.ids[i] = (uint32_t)(3 * i + 1);
    q.index = q.with_ids = (tribox_index){.nodes = q.nodes, .soup = &q.soup};
    q.with_ids.ids = q.ids;
    const size_t first = q.soup.count * input_byte(&in) / 255, changed = (q.soup.count - first) * input_byte(&in) / 255;
    const unsigned quarter = input_byte(&in), kind = quarter & 3;
    if (kind) {
        q.mesh = draw_mesh(&q.soup, kind);
        q.index.soup = q.with_ids.soup = NULL;
        q.index.mesh = q.with_ids.mesh = &q.mesh;
    }
    status_fits("tribox_index_build", 0, tribox_index_build(&q.index, NULL, q.nodes));
    check_build(&q, first, changed);
    damage(&in, &q);
    unsigned wrong = how.wrong | (box_is_finite(&q.box[0]) ? 0 : 1u << TRIBOX_BAD_BOX);
    if (how.options.axes && !(how.options.axes & TRIBOX_AXES_BOX))
        wrong |= 1u << TRIBOX_BAD_OPTION;
    if (wrong)
        check_refusals(&q, &how.options, wrong);
    else
        check_answers(&q, how.options, quarter);
    tight_memory_free_all();
    return 0;
}
