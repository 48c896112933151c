/* test_dispatch.c - the kernel that is asked for is the one that runs, and what cannot run is refused. */
#include "dispatch.h"
#include "common/harness.h"
#include "drawn_pairs.h"

/* The kernel that the default has to be on an emulated processor; NULL on the real one. */
static const char *widest;

static drawn_numbers numbers;

static const char *name_chosen(const char *asked) { return tribox_kernel_name(&(tribox_options){.kernel = asked}); }

static tribox_status status_of(const char *asked)
{
    const tribox_box box = {{0, 0, 0}, {1, 1, 1}};
    const tribox_soup none = {.count = 0};
    return tribox_overlap(&none, &box, &(tribox_options){.kernel = asked}, NULL, NULL);
}

CASE(test_each_kernel_by_name)
{
    for (size_t i = 0; i < tribox_kernel_count(); i++) {
        const char *const name = tribox_kernel_at(i)->name;
        char copy[32];
        snprintf(copy, sizeof copy, "%s", name);
        if (tribox_kernel_runs_here(i)) {
            assert_string_equal(name_chosen(copy), name);
            assert_ptr_equal(tribox_kernel_find(copy), tribox_kernel_at(i));
            assert_int_equal(status_of(copy), TRIBOX_OK);
        } else {
            assert_null(name_chosen(copy));
            assert_int_equal(status_of(copy), TRIBOX_NO_KERNEL);
            print_message("%s cannot run here, and is refused\n", name);
        }
    }
}

CASE(test_unknown_names)
{
    static const char *const unknown[] = {"", "AVX2", "nope", "avx", "avx2 ", " avx2", "scala", "scalarx"};
    for (size_t k = 0; k < sizeof unknown / sizeof unknown[0]; k++) {
        assert_null(name_chosen(unknown[k]));
        assert_int_equal(status_of(unknown[k]), TRIBOX_NO_KERNEL);
    }
}

CASE(test_default_is_the_widest_that_runs)
{
    size_t i = 0;
    while (!tribox_kernel_runs_here(i))
        i++;
    assert_string_equal(tribox_kernel_name(NULL), tribox_kernel_at(i)->name);
    assert_string_equal(name_chosen(NULL), tribox_kernel_at(i)->name);
    if (widest)
        assert_string_equal(tribox_kernel_name(NULL), widest);
}

CASE(test_a_name_changes_no_default)
{
    const char *const best = tribox_kernel_name(NULL);
    for (size_t i = 0; i < tribox_kernel_count(); i++) {
        name_chosen(tribox_kernel_at(i)->name);
        assert_string_equal(tribox_kernel_name(NULL), best);
    }
}

CASE(test_list_is_what_runs)
{
    size_t listed = 0;
    for (size_t i = 0; i < tribox_kernel_count(); i++)
        if (tribox_kernel_runs_here(i))
            assert_string_equal(tribox_kernel_list(listed++), tribox_kernel_at(i)->name);
    assert_string_equal(tribox_kernel_list(0), tribox_kernel_name(NULL));
    assert_null(tribox_kernel_list(listed));
    assert_null(tribox_kernel_list(listed + 1));
    assert_null(tribox_kernel_list(SIZE_MAX));
}

CASE(test_table_is_widest_first)
{
    const size_t count = tribox_kernel_count();
    assert_string_equal(tribox_kernel_at(count - 1)->name, "scalar");
    assert_true(tribox_kernel_runs_here(count - 1));
    for (size_t i = 1; i < count; i++) {
        assert_true(tribox_kernel_at(i - 1)->lanes >= tribox_kernel_at(i)->lanes);
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(tribox_kernel_at(k)->name, tribox_kernel_at(i)->name);
    }
}

/* A name proves little. Near contact, kernels that round once and those that round twice differ in FAST, or one ran for all. */
CASE(test_the_named_kernel_runs)
{
    kernels = kernels_here(names);
    random_source r = random_named(1, "dispatch");
    const scene near_contact = {.name = "near-contact", .draw = draw_near_contact};
    size_t fused = 0, differing = 0;
    for (int round = 0; round < 100; round++) {
        const pair_list q = draw_pairs(&r, &near_contact, true, &numbers);
        uint64_t first[DRAWN_WORDS], mask[DRAWN_WORDS];
        ask_ok(&q, &(tribox_options){.accuracy = TRIBOX_FAST, .kernel = names[0]}, first, NULL);
        for (int k = 1; k < kernels; k++) {
            ask_ok(&q, &(tribox_options){.accuracy = TRIBOX_FAST, .kernel = names[k]}, mask, NULL);
            fused += kernel_is_fused(names[k]);
            differing += kernel_is_fused(names[k]) && memcmp(mask, first, tribox_mask_words(q.count) * sizeof *mask);
        }
    }
    if (!fused)
        skip();
    assert_true(differing > 0);
}

int main(int argc, char **argv)
{
    if (argc > 2) {
        fprintf(stderr, "usage: %s [NAME]\n  NAME  the kernel that the default has to be on this processor\n", argv[0]);
        return 2;
    }
    widest = argc == 2 ? argv[1] : NULL;
    const struct CMUnitTest tests[] = {
        RUN(test_each_kernel_by_name),       RUN(test_unknown_names),     RUN(test_default_is_the_widest_that_runs),
        RUN(test_a_name_changes_no_default), RUN(test_list_is_what_runs), RUN(test_table_is_widest_first),
        RUN(test_the_named_kernel_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
