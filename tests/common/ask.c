#include "ask.h"

#include <inttypes.h>

const int permutations[ORDERS][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};

unsigned order_digits(int permutation)
{
    const int *const p = permutations[permutation];
    return (unsigned)(100 * (p[0] + 1) + 10 * (p[1] + 1) + p[2] + 1);
}

void fail_pair(const origin *where, const pair_f64 *pair, bool answer)
{
    const tribox_options *const o = &where->options;
    fprintf(stderr, "%s answers '%s' and is wrong\n", where->function, answer ? "overlaps" : "does not overlap");
    fprintf(stderr, "  scene %s, seed %" PRIu64 "\n", where->scene, where->seed);
    fprintf(stderr, "  %s, axes %u, order %u, kernel %s\n", accuracy_name(o->accuracy), o->axes, o->axis_order, o->kernel);
    oracle_explain(stderr, pair);
    fail_msg("%s is wrong for a pair of scene %s", where->function, where->scene);
}

static void check_answer(tribox_status status, size_t count, tribox_accuracy accuracy, const uint64_t *mask,
                         const tribox_report *report)
{
    assert_int_equal(status, TRIBOX_OK);
    if (count % 64)
        assert_true(mask[count / 64] >> count % 64 == 0);
    assert_int_equal(report->overlapping, bits_set(mask, tribox_mask_words(count)));
    assert_in_range(report->undecided, 0, accuracy == TRIBOX_FAST ? 0 : count);
}

void ask_soup(const tribox_soup *soup, const tribox_box *box, const tribox_options *options, uint64_t *mask)
{
    tribox_report report;
    const tribox_status status = tribox_overlap(soup, box, options, mask, &report);
    check_answer(status, soup->count, options->accuracy, mask, &report);
}

void ask_mesh(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options, uint64_t *mask)
{
    tribox_report report;
    const tribox_status status = tribox_mesh_overlap(mesh, box, options, mask, &report);
    check_answer(status, mesh->count, options->accuracy, mask, &report);
}

void ask_boxes(const float *triangle, const tribox_boxes *boxes, const tribox_options *options, uint64_t *mask)
{
    tribox_report report;
    const tribox_status status = tribox_overlap_boxes(triangle, boxes, options, mask, &report);
    check_answer(status, boxes->count, options->accuracy, mask, &report);
}
