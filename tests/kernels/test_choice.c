/*
 * test_choice.c - the order that is found while walking: what surveys see, which order follows, when the next is due; and that it
 * changes no answer.
 */
#include "pairs/choice.h"
#include "common/harness.h"
#include "dispatch.h"
#include "drawn_pairs.h"

static drawn_numbers numbers;

enum { PLANE = TRIBOX_AXES_PLANE, EDGES = TRIBOX_AXES_EDGES };

/* A survey of packets that all meet one fate: each set of groups that has one of these rejects all lanes. */
static tribox_seen seen_alike(unsigned packets, unsigned rejecting)
{
    const uint64_t all = ~UINT64_C(0) >> (64 - packets);
    tribox_seen seen = {.packets = packets};
    seen.apart[0] = rejecting & TRIBOX_AXES_BOX ? all : 0;
    for (unsigned groups = 1; groups < TRIBOX_AXES_ALL; groups++)
        seen.rejected[groups] = !seen.apart[0] && groups & rejecting ? all : 0;
    return seen;
}

static tribox_choice fresh(void)
{
    tribox_choice choice;
    tribox_choice_start(&choice);
    return choice;
}

static bool begins_with(const tribox_choice *choice, unsigned first)
{
    const unsigned p = choice->sequence;
    return p == (first == 2 ? TRIBOX_SEQUENCE_213 : first == 3 ? TRIBOX_SEQUENCE_312 : TRIBOX_SEQUENCE_132) ||
           (first == 1 && p == TRIBOX_SEQUENCE_123);
}

CASE(test_what_rejects_comes_first)
{
    static const struct {
        unsigned rejecting, first;
    } expected[] = {{TRIBOX_AXES_BOX, 1}, {PLANE, 2}, {EDGES, 3}, {PLANE | EDGES, 2}, {0, 1}};
    for (unsigned packets = 4; packets <= 64; packets *= 2)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
                tribox_choice choice = fresh();
                const tribox_seen seen = seen_alike(packets, expected[i].rejecting);
                tribox_choice_learn(&choice, &seen, accuracy);
                assert_true(begins_with(&choice, expected[i].first));
            }
}

/* Nothing is rejected: edges and plane together cost the least. */
CASE(test_nothing_rejected)
{
    tribox_choice choice = fresh();
    const tribox_seen seen = seen_alike(8, 0);
    tribox_choice_learn(&choice, &seen, TRIBOX_EXACT);
    assert_int_equal(choice.sequence, TRIBOX_SEQUENCE_132);
}

/* One packet in two is apart from the box on x, and the plane would reject all others. */
CASE(test_costs)
{
    tribox_seen seen = {.packets = 8, .apart = {0x0f}};
    seen.rejected[PLANE] = seen.rejected[TRIBOX_AXES_BOX | PLANE] = seen.rejected[PLANE | EDGES] = 0xf0;
    unsigned cost[TRIBOX_CHOICE_ORDERS], unforeseen[TRIBOX_CHOICE_ORDERS];
    tribox_choice_costs(&seen, TRIBOX_FAST, cost);
    const unsigned exit = cost[0] - 8 * 14 - 4 * 4 - 4 * 4 - 4 * 36; /* x for all, y, z and plane for four, one unforeseen exit */
    assert_in_range(exit, 20, 150);
    assert_int_equal(cost[1] - cost[0], 4 * (78 - 36));
    assert_int_equal(cost[2], 8 * 34); /* the plane rejects everything, apart from the box too as far as is known */
    seen.apart[0] = 0x55;
    seen.rejected[PLANE] = seen.rejected[TRIBOX_AXES_BOX | PLANE] = seen.rejected[PLANE | EDGES] = 0xaa;
    tribox_choice_costs(&seen, TRIBOX_FAST, unforeseen);
    assert_int_equal(unforeseen[0] - cost[0], 3 * exit); /* four of eight exits, not one */
    assert_int_equal(unforeseen[2], cost[2]);
}

/* However long it was one way, a survey turns it that finds the order far too dear. */
CASE(test_nature_changes)
{
    for (unsigned packets = 4; packets <= 64; packets *= 2)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            const tribox_seen far = seen_alike(packets, TRIBOX_AXES_BOX), cut = seen_alike(packets, PLANE);
            const tribox_seen dense = seen_alike(packets, 0);
            for (int is_dense = 0; is_dense < 2; is_dense++) {
                tribox_choice choice = fresh();
                for (int k = 0; k < 1000; k++)
                    tribox_choice_learn(&choice, is_dense ? &dense : &far, accuracy);
                assert_true(begins_with(&choice, 1));
                tribox_choice_learn(&choice, &cut, accuracy);
                assert_true(begins_with(&choice, 2));
                tribox_choice_learn(&choice, &far, accuracy);
                assert_true(begins_with(&choice, 1));
            }
        }
}

/* One word that would go a little better in another order may be an exception; several are none. */
CASE(test_exceptions)
{
    tribox_choice choice = fresh(), other = fresh();
    const tribox_seen dense = seen_alike(8, 0);
    tribox_seen half = seen_alike(8, 0);
    half.rejected[PLANE] = half.rejected[TRIBOX_AXES_BOX | PLANE] = half.rejected[PLANE | EDGES] = 0x0f;
    for (int k = 0; k < 10; k++)
        tribox_choice_learn(&choice, &dense, TRIBOX_EXACT);
    tribox_choice_learn(&choice, &half, TRIBOX_EXACT);
    assert_int_equal(choice.sequence, TRIBOX_SEQUENCE_132);
    for (int k = 0; k < 4; k++)
        tribox_choice_learn(&choice, &half, TRIBOX_EXACT);
    tribox_choice_learn(&other, &half, TRIBOX_EXACT);
    assert_int_not_equal(choice.sequence, TRIBOX_SEQUENCE_132);
    assert_int_equal(choice.sequence, other.sequence);
}

/* The words at which surveys are due, in a call of `words` words that is asked block by block. */
static size_t survey_places(tribox_choice *choice, size_t words, size_t block, size_t *places)
{
    size_t count = 0;
    const tribox_seen seen = seen_alike(4, 0);
    for (size_t word = 0; word < words; word += block)
        for (size_t done = 0, next, most = words - word < block ? words - word : block; done < most; done += next) {
            next = tribox_choice_next(choice, words - word - done, most - done);
            assert_true(next <= most - done);
            if (next)
                continue;
            places[count++] = word + done;
            tribox_choice_learn(choice, &seen, TRIBOX_EXACT);
            next = 1;
        }
    return count;
}

CASE(test_places)
{
    static const size_t expected[] = {0, 16, 64, 192, 320}, blocks[] = {64, 8, 4};
    for (size_t b = 0; b < sizeof blocks / sizeof blocks[0]; b++) {
        size_t places[300];
        tribox_choice choice = fresh();
        assert_int_equal(survey_places(&choice, 323, blocks[b], places), 4); /* three words are not worth a survey */
        assert_memory_equal(places, expected, 4 * sizeof *places);
        tribox_choice_start(&choice);
        assert_int_equal(survey_places(&choice, 324, blocks[b], places), 5);
        assert_memory_equal(places, expected, sizeof expected);
        tribox_choice_start(&choice);
        assert_int_equal(survey_places(&choice, 3, blocks[b], places), 0);
        tribox_choice_fix(&choice, TRIBOX_SEQUENCE_213);
        assert_int_equal(survey_places(&choice, 300, blocks[b], places), 0);
        assert_int_equal(choice.sequence, TRIBOX_SEQUENCE_213);
    }
}

/* The lanes of packet k that a walk in a sequence leaves, overlapping or open. */
static uint64_t left_by(const tribox_kernel *kernel, const tribox_query *p, tribox_walk_kind kind, unsigned sequence, size_t k)
{
    uint64_t hit, open;
    kernel->walk[kind][sequence](p, 0, 64, &hit, &open);
    return (hit | open) >> k * kernel->lanes & (~UINT64_C(0) >> (64 - kernel->lanes));
}

/* What a survey says of a word, against walks that ask some of the groups alone. */
static void check_survey(const tribox_kernel *kernel, const tribox_query *p, tribox_walk_kind kind, const char *drawn)
{
    tribox_seen seen;
    uint64_t hit, open, walk_hit, walk_open;
    snprintf(doing, sizeof doing, "survey of %s by %s", drawn, kernel->name);
    hit = kernel->survey[kind](p, 0, &seen, &open);
    kernel->walk[kind][TRIBOX_SEQUENCE_123](p, 0, 64, &walk_hit, &walk_open);
    assert_int_equal(hit & open, 0);
    assert_int_equal((hit | open) & (walk_hit | walk_open), hit | open);
    assert_int_equal(walk_hit & ~(hit | open), 0);
    assert_int_equal(hit & ~(walk_hit | walk_open), 0);
    assert_int_equal(seen.packets, 64 / kernel->lanes);
    for (size_t k = 0; k < seen.packets; k++) {
        const uint64_t beside = (seen.apart[0] >> k & 1) + (seen.apart[1] >> k & 1) + (seen.apart[2] >> k & 1);
        assert_true(beside <= 1);
        assert_int_equal(beside, !left_by(kernel, p, kind, TRIBOX_SEQUENCE_1, k));
        if (beside)
            continue;
        assert_int_equal(seen.rejected[TRIBOX_AXES_BOX] >> k & 1, 0);
        assert_int_equal(seen.rejected[TRIBOX_AXES_BOX | PLANE] >> k & 1, !left_by(kernel, p, kind, TRIBOX_SEQUENCE_12, k));
        if (kind == TRIBOX_BY_SIGN) /* a margin is wider without the box normals */
            assert_int_equal(seen.rejected[PLANE] >> k & 1, !left_by(kernel, p, kind, TRIBOX_SEQUENCE_2, k));
        if (!(seen.rejected[TRIBOX_AXES_BOX | PLANE] >> k & 1))
            assert_int_equal(seen.rejected[TRIBOX_AXES_BOX | EDGES] >> k & 1, !left_by(kernel, p, kind, TRIBOX_SEQUENCE_13, k));
    }
}

CASE(test_surveys)
{
    static const struct {
        scene_draw *draw;
        const char *name;
        float size; /* of the box, as a share of the scene's: small ones let single groups reject whole packets */
    } drawn[] = {{draw_paper, "paper", 1},         {draw_paper, "paper, small box", 0.01f}, {draw_small_triangles, "small", 1},
                 {draw_eighths, "eighths", 0.25f}, {draw_big_triangles, "big", 0.001f},     {draw_cad, "cad", 1}};
    random_source r = random_named(args.seed, "surveys");
    for (size_t i = 0; i < sizeof drawn / sizeof drawn[0]; i++)
        for (int round = 0; round < (arguments_are_short(&args) ? 20 : 200); round++) {
            const pair_list q = draw_pairs(&r, &(scene){.name = drawn[i].name, .draw = drawn[i].draw}, true, &numbers);
            const tribox_soup soup = pair_list_soup(&q);
            tribox_box box = *q.box;
            for (int a = 0; a < 3; a++)
                box.hi[a] = box.lo[a] + drawn[i].size * (box.hi[a] - box.lo[a]);
            tribox_rounded_box rounded;
            tribox_box_round(&box, true, true, &rounded);
            for (size_t k = 0; k < tribox_kernel_count(); k++)
                if (tribox_kernel_runs_here(k))
                    for (int kind = 0; kind < TRIBOX_WALK_KINDS; kind++)
                        check_survey(tribox_kernel_at(k), &(tribox_query){.soup = &soup, .box = &rounded, .count = soup.count},
                                     (tribox_walk_kind)kind, drawn[i].name);
        }
}

/* Triangles that change their nature half way: far away, then about a small box or any that a scene draws. */
static void draw_changing(random_source *r, const scene *s, size_t half)
{
    for (size_t i = 0; i < DRAWN_MAX; i += SCENE_TRIANGLES) {
        scene_batch batch;
        s->draw(r, &batch);
        numbers.box = batch.box;
        for (size_t k = 0; k < SCENE_TRIANGLES && i + k < DRAWN_MAX; k++)
            for (int a = 0; a < 3; a++)
                for (int v = 0; v < 3; v++)
                    numbers.stream[3 * a + v][i + k] = batch.u[k][v][a] + (i + k < half && a == 2 ? 100.0f : 0.0f);
    }
}

/* Order 0 answers as 132 does, wherever the call ends. */
CASE(test_answers)
{
    static const size_t counts[] = {0,    1,    63,   64,   65,   255,  256,  257,  320,  1023,
                                    1024, 1025, 1088, 4095, 4096, 4097, 4159, 4160, 8255, 10240};
    const size_t step = arguments_are_short(&args) ? 5 : 1;
    for (size_t i = args.seed % step; i < scene_count(); i += step) {
        const scene *const s = scene_at(i);
        random_source r = random_named(args.seed, s->name);
        draw_changing(&r, s, i % 3 ? DRAWN_MAX / 2 : 0);
        for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
            const pair_list q = pairs_over(&numbers, counts[c], &numbers.box, NULL);
            for (int k = 0; k < kernels; k++)
                for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
                    const tribox_options found = {.accuracy = accuracy, .kernel = names[k]};
                    const tribox_options fixed = {.accuracy = accuracy, .axis_order = 132, .kernel = names[k]};
                    uint64_t mask[DRAWN_WORDS], expected[DRAWN_WORDS];
                    tribox_report report, of_fixed;
                    pair_list_text(&q, &found, doing);
                    ask_ok(&q, &fixed, expected, &of_fixed);
                    ask_ok(&q, &found, mask, &report);
                    assert_masks_equal(&q, &found, expected, mask);
                    assert_int_equal(report.overlapping, of_fixed.overlapping);
                }
        }
    }
}

PROGRAM(RUN(test_what_rejects_comes_first), RUN(test_nothing_rejected), RUN(test_costs), RUN(test_nature_changes),
        RUN(test_exceptions), RUN(test_places), RUN(test_surveys), RUN(test_answers))
