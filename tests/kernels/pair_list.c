#include "drawn_pairs.h"

#include "common/harness.h"

static const char *call_name(const pair_list *q) { return q->box ? "tribox_overlap" : "tribox_overlap_boxes"; }

int pair_list_streams(const pair_list *q) { return q->box ? SOUP_STREAMS : BOXES_STREAMS; }

pair_list pair_list_at(const pair_list *q, size_t i)
{
    pair_list one = *q;
    one.count = 1;
    for (int s = 0; s < pair_list_streams(q); s++)
        one.stream[s] += i;
    return one;
}

tribox_soup pair_list_soup(const pair_list *q)
{
    const float *const *const s = q->stream;
    return (tribox_soup){{s[0], s[1], s[2]}, {s[3], s[4], s[5]}, {s[6], s[7], s[8]}, q->count};
}

static tribox_boxes boxes_of(const pair_list *q)
{
    const float *const *const s = q->stream;
    return (tribox_boxes){{s[0], s[1], s[2]}, {s[3], s[4], s[5]}, q->count};
}

tribox_status pair_list_overlap(const pair_list *q, const tribox_options *options, uint64_t *mask, tribox_report *report)
{
    const tribox_soup soup = pair_list_soup(q);
    const tribox_boxes boxes = boxes_of(q);
    return q->box ? tribox_overlap(&soup, q->box, options, mask, report)
                  : tribox_overlap_boxes((const float *)q->triangle, &boxes, options, mask, report);
}

const char *pair_list_text(const pair_list *q, const tribox_options *options, char text[PAIR_LIST_TEXT])
{
    snprintf(text, PAIR_LIST_TEXT, "%s, kernel %s, %s, axes %u, order %u, count %zu", call_name(q), options->kernel,
             accuracy_name(options->accuracy), options->axes, options->axis_order, q->count);
    return text;
}

static void print_pair(const pair_list *q, size_t i)
{
    for (int v = 0; v < 3; v++) {
        float u[3];
        for (int a = 0; a < 3; a++)
            u[a] = q->box ? q->stream[3 * a + v][i] : q->triangle[v][a];
        print_error("  vertex %d  %a, %a, %a\n", v, (double)u[0], (double)u[1], (double)u[2]);
    }
    for (int a = 0; a < 3; a++)
        print_error("  axis %d    %a to %a\n", a, (double)(q->box ? q->box->lo[a] : q->stream[a][i]),
                    (double)(q->box ? q->box->hi[a] : q->stream[3 + a][i]));
}

void fail_at_pair(const pair_list *q, const tribox_options *options, size_t i, bool expected)
{
    char text[PAIR_LIST_TEXT];
    print_error("%s: bit %zu is %d and should be %d\n", pair_list_text(q, options, text), i, !expected, expected);
    if (i < q->count)
        print_pair(q, i);
    else
        print_error("  it lies past the count\n");
    fail();
}

void assert_masks_equal(const pair_list *q, const tribox_options *options, const uint64_t *expected, const uint64_t *mask)
{
    const size_t words = tribox_mask_words(q->count);
    if (!words || !memcmp(mask, expected, words * sizeof *mask))
        return;
    size_t i = 0;
    while (bit_of(mask, i) == bit_of(expected, i))
        i++;
    fail_at_pair(q, options, i, bit_of(expected, i));
}

void ask_ok(const pair_list *q, const tribox_options *options, uint64_t *mask, tribox_report *report)
{
    const tribox_status status = pair_list_overlap(q, options, mask, report);
    char text[PAIR_LIST_TEXT];
    if (status)
        fail_msg("%s: %s", pair_list_text(q, options, text), tribox_status_text(status));
}
