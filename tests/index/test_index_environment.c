/*
 * test_index_environment.c - the caller's rounding mode, flush-to-zero and traps change no byte of an index and no answer, and come
 * back
 * as they were: on errors too.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "common/arguments.h"
#include "common/float_environment.h"
#include "common/kernels_here.h"
#include "hostile.h"

enum { COUNT = 200, WORDS = (COUNT + 63) / 64, BOXES = 3, NODES = 4096 };

static arguments args;
static stored_soup stored;
static bool is_lattice;

static int make_all(void **state)
{
    (void)state;
    stored = stored_soup_make(COUNT);
    return 0;
}

static int free_all(void **state)
{
    (void)state;
    stored_soup_free(&stored);
    return 0;
}

/* What is asked, whichever call asks it. */
typedef struct asked {
    tribox_box box[BOXES];
    tribox_options options;
} asked;

/* All that a call can write. Compared as bytes. */
typedef struct answers {
    unsigned char nodes[NODES];
    uint64_t mask[WORDS], bits[WORDS], inside[WORDS];
    uint32_t number[WORDS], list[BOXES * COUNT];
    size_t start[BOXES + 1], found;
    tribox_report report;
    tribox_status status;
} answers;

typedef void action(const asked *q, answers *out);

static void build(const asked *q, answers *out) { out->status = tribox_index_build(&stored.index, &q->options, out->nodes); }

static void update(const asked *q, answers *out)
{
    memcpy(out->nodes, stored.nodes, stored_index_bytes(&stored));
    out->status = tribox_index_update(&stored.index, 70, 9, &q->options, out->nodes);
}

static void overlap(const asked *q, answers *out)
{
    out->status = tribox_index_overlap(&stored.index, &(tribox_region){.box = &q->box[0]}, &q->options, out->mask, &out->report);
}

static void words(const asked *q, answers *out)
{
    out->status = tribox_index_words(&stored.index, &(tribox_region){.box = &q->box[0]}, &q->options, WORDS, out->number, out->bits,
                                     out->inside, &out->found, &out->report);
}

static void list(const asked *q, answers *out)
{
    out->status =
        tribox_index_list(&stored.with_ids, &(tribox_region){.box = &q->box[0]}, &q->options, COUNT, out->list, &out->found);
}

static void lists(const asked *q, answers *out)
{
    float bound[6][BOXES];
    tribox_boxes boxes = {.count = BOXES};
    for (int k = 0; k < 6; k++) {
        for (int b = 0; b < BOXES; b++)
            memcpy(&bound[k][b], k < 3 ? &q->box[b].lo[k] : &q->box[b].hi[k - 3], sizeof(float));
        (k < 3 ? boxes.lo : boxes.hi)[k % 3] = bound[k];
    }
    out->status = tribox_index_lists(&stored.index, &boxes, &q->options, BOXES * COUNT, out->list, out->start);
}

static void any(const asked *q, answers *out)
{
    out->status = tribox_index_any(&stored.index, &(tribox_region){.box = &q->box[0]}, &q->options, &out->found);
}

/* Any center and half lengths, but soups of a lattice alone: others take long, and tests/inputs sees to them. */
static void overlap_oriented(const asked *q, answers *out)
{
    tribox_oriented_box box = {{0, 0, 0}, {0, 0, 0}, {{1, 0.25f, 0}, {-0.25f, 1, 0}, {0, 0, 1}}};
    memcpy(box.center, q->box[0].lo, sizeof box.center);
    memcpy(box.half, q->box[0].hi, sizeof box.half);
    if (is_lattice)
        out->status = tribox_index_overlap(&stored.index, &(tribox_region){.oriented = &box}, &q->options, out->mask, &out->report);
}

static const struct {
    action *act;
    const char *name;
} actions[] = {
    {build, "tribox_index_build"},     {update, "tribox_index_update"},
    {overlap, "tribox_index_overlap"}, {words, "tribox_index_words"},
    {list, "tribox_index_list"},       {lists, "tribox_index_lists"},
    {any, "tribox_index_any"},         {overlap_oriented, "tribox_index_overlap_oriented"},
};
enum { ACTIONS = sizeof actions / sizeof actions[0] };

/* Under each setting the answer is what it is under the one that a program starts with. */
static void check(size_t which, const asked *q)
{
    static answers expected, got;
    const unsigned normal = environment_get();
    memset(&expected, 0xa5, sizeof expected);
    actions[which].act(q, &expected);
    for (unsigned k = 0; k < SETTINGS; k++) {
        const unsigned set = setting(k);
        snprintf(doing, sizeof doing, "%s under setting %#x, kernel %s, accuracy %d", actions[which].name, set, q->options.kernel,
                 (int)q->options.accuracy);
        memset(&got, 0xa5, sizeof got);
        environment_set(set);
        actions[which].act(q, &got);
        const unsigned left = environment_get();
        environment_set(normal);
        if (left != set)
            fail_msg("%s: left as %#x", doing, left);
        if (memcmp(&got, &expected, sizeof got))
            fail_msg("%s: another answer", doing);
    }
}

static void check_kernels(asked *q)
{
    const char *names[KERNELS_MAX];
    const int kernels = kernels_here(names);
    assert_in_range(stored_index_bytes(&stored), 1, NODES);
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            for (size_t which = 0; which < ACTIONS; which++) {
                q->options = (tribox_options){.accuracy = accuracy, .kernel = names[k]};
                check(which, q);
            }
}

static void draw(random_source *r, const soup_kind *kind, asked *q)
{
    stored_soup_lay(&stored, COUNT, STORED_AT_END);
    kind->draw(r, &stored);
    is_lattice = kind == soup_kind_at(0);
    spoil_soup(r, &stored, DIRT_ONE_IN_A_WORD);
    stored_soup_build(&stored, NULL);
    for (int b = 0; b < BOXES; b++)
        q->box[b] = draw_box(r, &stored);
}

static void test_hostile_soups(void **state)
{
    (void)state;
    catch_faults();
    for (size_t k = 0; k < soup_kind_count(); k += arguments_are_short(&args) ? 3 : 1) {
        random_source r = random_named(args.seed, soup_kind_at(k)->name);
        asked q;
        draw(&r, soup_kind_at(k), &q);
        check_kernels(&q);
    }
}

/* Refusals, and boxes of subnormal numbers, which flushing to zero would make what they are not. */
static void test_refusals(void **state)
{
    (void)state;
    static const uint32_t bits[] = {0x00000001, 0x80000001, 0x7f800001, 0x7fc00000, 0x7f800000};
    catch_faults();
    random_source r = random_named(args.seed, "refusals");
    for (size_t b = 0; b < sizeof bits / sizeof bits[0]; b += arguments_are_short(&args) ? 3 : 1) {
        asked q;
        draw(&r, soup_kind_at(0), &q);
        memcpy(&q.box[0].lo[b % 3], &bits[b], sizeof bits[b]);
        q.box[0].hi[b % 3] = b & 1 ? 0 : 1;
        check_kernels(&q);
    }
}

int main(int argc, char **argv)
{
    args = arguments_parse(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hostile_soups), cmocka_unit_test(test_refusals)};
    return cmocka_run_group_tests(tests, make_all, free_all);
}
