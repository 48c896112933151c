/*
 * test_kernels_environment.c - the caller's rounding mode, flush-to-zero and traps change no answer, and come back as they were.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "common/arguments.h"
#include "drawn_pairs.h"
#include "common/guard.h"
#include "common/kernels_here.h"
#include "common/float_environment.h"

static arguments args;
static drawn_numbers numbers;

enum { WORDS = (SCENE_TRIANGLES + 63) / 64 };

/* Whatever a setting is tried on. */
typedef tribox_status action(const pair_list *q, const tribox_options *options, uint64_t *mask, tribox_report *report);

static tribox_status count_not_finite(const pair_list *q, const tribox_options *options, uint64_t *mask, tribox_report *report)
{
    const tribox_soup soup = pair_list_soup(q);
    (void)options;
    memset(mask, 0, WORDS * sizeof *mask);
    report->undecided = tribox_soup_not_finite(&soup, &report->overlapping);
    return TRIBOX_OK;
}

/* The answer under each setting is the one under the setting that a program starts with. */
static void check(action *act, const char *name, const pair_list *q, const tribox_options *options)
{
    const unsigned normal = environment_get();
    uint64_t expected[WORDS], mask[WORDS];
    tribox_report expected_report, report;
    assert_int_equal(act(q, options, expected, &expected_report), TRIBOX_OK);
    for (unsigned k = 0; k < SETTINGS; k++) {
        const unsigned set = setting(k);
        snprintf(doing, sizeof doing, "%s under setting %#x, kernel %s", name, set, options->kernel);
        environment_set(set);
        const tribox_status status = act(q, options, mask, &report);
        const unsigned left = environment_get();
        environment_set(normal);
        assert_int_equal(status, TRIBOX_OK);
        if (left != set)
            fail_msg("%s: left as %#x", doing, left);
        if (memcmp(mask, expected, tribox_mask_words(q->count) * sizeof *mask))
            print_error("%s\n", doing);
        assert_masks_equal(q, options, expected, mask);
        assert_int_equal(report.overlapping, expected_report.overlapping);
        assert_int_equal(report.undecided, expected_report.undecided);
    }
}

static void check_question(const pair_list *q)
{
    const char *names[KERNELS_MAX];
    const int kernels = kernels_here(names);
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            check(pair_list_overlap, q->box ? "tribox_overlap" : "tribox_overlap_boxes", q,
                  &(tribox_options){.accuracy = accuracy, .kernel = names[k]});
    if (q->box)
        check(count_not_finite, "tribox_soup_not_finite", q, &(tribox_options){.kernel = names[0]});
}

static void check_scenes(bool is_soup)
{
    catch_faults();
    for (size_t i = 0; i < scene_count(); i++) {
        const scene *const s = scene_at(i);
        random_source r = random_named(args.seed, s->name);
        if (!scene_is_called(s, args.scenes))
            continue;
        const pair_list q = draw_pairs(&r, s, is_soup, &numbers);
        check_question(&q);
    }
}

static void test_soup(void **state)
{
    (void)state;
    check_scenes(true);
}

static void test_boxes(void **state)
{
    (void)state;
    check_scenes(false);
}

/* Refusals too leave everything as it was: bounds that are subnormal, NaN and infinite, and empty boxes. */
static void test_refusals(void **state)
{
    (void)state;
    catch_faults();
    const unsigned normal = environment_get();
    random_source r = random_named(args.seed, "refusals");
    pair_list q = draw_pairs(&r, scene_at(0), true, &numbers);
    static const uint64_t bounds[] = {0x0000000000000001, 0x8000000000000001, 0x36a0000000000000, 0x7ff0000000000001,
                                      0x7ff8000000000000, 0x7ff0000000000000};
    for (size_t b = 0; b < sizeof bounds / sizeof bounds[0]; b++)
        for (int axis = 0; axis < 3; axis++)
            for (unsigned k = 0; k < SETTINGS; k++) {
                tribox_box box = {{0, 0, 0}, {1, 1, 1}};
                memcpy(&box.lo[axis], &bounds[b], sizeof bounds[b]);
                box.hi[(axis + 1) % 3] = k & 1 ? 1 : -1;
                q.box = &box;
                const unsigned set = setting(k);
                const unsigned long long bound = bounds[b];
                snprintf(doing, sizeof doing, "tribox_overlap with bound %#llx under setting %#x", bound, set);
                uint64_t mask[WORDS];
                environment_set(set);
                const tribox_status status = pair_list_overlap(&q, NULL, mask, NULL);
                const unsigned left = environment_get();
                environment_set(normal);
                assert_int_equal(status, b < 3 ? TRIBOX_OK : TRIBOX_BAD_BOX);
                if (left != set)
                    fail_msg("%s: left as %#x", doing, left);
            }
}

int main(int argc, char **argv)
{
    args = arguments_parse(argc, argv);
    if (!scene_name_is_known(args.scenes))
        return 2;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_soup),
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
