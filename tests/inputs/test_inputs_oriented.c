/*
 * test_inputs_oriented.c - oriented boxes of floats and of doubles, about soups and meshes, against rational numbers: EXACT is the
 * oracle on every kernel, CONSERVATIVE never misses, FAST errs within its bound alone, and a mesh of floats is the soup bit by bit.
 */
#include <float.h>
#include <math.h>

#include "common/fences.h"
#include "common/harness.h"
#include "common/laid_mesh.h"
#include "common/oracle.h"
#include "common/soup_or_mesh.h"
#include "common/window_bits.h"
#include "exact/oriented/oriented.h"
#include "oriented_scenes.h"

enum { STREAMS = 9, WORDS = (ORIENTED_TRIANGLES + 63) / 64 };
static guarded fence[STREAMS], mask_fence;
static laid_fences mesh_fence;

/* The question at hand. */
static const char *scene_name;
static bool is_ordinary;
static oriented_batch batch;
static soup_or_mesh of;

/* What is true of it: the triangles that overlap, and those whose bounding box in the frame does. */
static uint64_t overlapping[WORDS], bounds[WORDS];

static bool is_scene_known(const char *name)
{
    for (int s = 0; s < ORIENTED_SCENES; s++)
        if (!name || !strcmp(name, oriented_scenes[s].name))
            return true;
    fprintf(stderr, "no scene is called '%s'; there are:", name);
    for (int s = 0; s < ORIENTED_SCENES; s++)
        fprintf(stderr, " %s", oriented_scenes[s].name);
    fprintf(stderr, "\n");
    return false;
}

static int set_up(void)
{
    if (!is_scene_known(args.scenes))
        return 2;
    stream_fences_make(ORIENTED_TRIANGLES, fence);
    mask_fence = guarded_make(WORDS * sizeof(uint64_t));
    mesh_fence = laid_fences_make(args.seed);
    return 0;
}

typedef const double (*const_triangle)[3];
typedef const double (*const_triangles)[3][3];

/* The streams end at pages that cannot be touched, or begin after them. */
static void lay_soup(bool is_at_end)
{
    of.soup = streams_of_triangles(fence, is_at_end ? AT_END : 0, (const_triangles)batch.u, (size_t)batch.count);
}

/* Of any layout, as floats only where all numbers are such. */
static void lay_mesh(random_source *r)
{
    static const int turn[3] = {0, 1, 2};
    const mesh_form form = mesh_form_draw(r, batch.form != ORIENTED_DOUBLES);
    of.mesh = laid_mesh_of(r, &form, (const_triangles)batch.u, (size_t)batch.count, turn, mesh_fence);
}

static void ask_oracle(void)
{
    memset(overlapping, 0, sizeof overlapping);
    memset(bounds, 0, sizeof bounds);
    for (int t = 0; t < batch.count; t++) {
        if (!are_finite(&batch.u[t][0][0], 9))
            continue;
        const const_triangle u = (const_triangle)batch.u[t];
        bounds[t / 64] |= (uint64_t)oriented_oracle(u, &batch.box, true) << t % 64;
        overlapping[t / 64] |= (uint64_t)oriented_oracle(u, &batch.box, false) << t % 64;
    }
}

static bool bit_at(const uint64_t *mask, int i) { return bit_of(mask, (size_t)i); }

static void say(const tribox_options *options)
{
    snprintf(doing, sizeof doing, "%s, scene %s, form %d, seed %" PRIu64 ", %s, %s, axes %u, order %u, count %d",
             of.is_mesh ? "tribox_mesh_overlap_oriented" : "tribox_overlap_oriented", scene_name, (int)batch.form, args.seed,
             options->kernel ? options->kernel : "the best kernel", accuracy_name(options->accuracy), options->axes,
             options->axis_order, batch.count);
}

static void fail_at(int i, bool expected)
{
    print_error("%s: bit %d is %d and should be %d\n", doing, i, !expected, expected);
    if (i < batch.count)
        oriented_explain(stderr, (const_triangle)batch.u[i], &batch.box);
    fail();
}

/* The mask, between pages that cannot be touched; bits past the count are zero. */
static const uint64_t *ask(const tribox_options *options)
{
    const size_t words = tribox_mask_words((size_t)batch.count);
    static uint64_t got[WORDS];
    tribox_report report = {12345, 67890};
    uint64_t *const mask = guarded_tail(mask_fence, words * sizeof *mask);
    memset(mask, 0xa5, words * sizeof *mask);
    say(options);
    const tribox_status status = CALL(overlap_oriented, &of, &batch.box, options, mask, &report);
    if (status)
        fail_msg("%s: %s", doing, tribox_status_text(status));
    memset(got, 0, sizeof got);
    memcpy(got, mask, words * sizeof *mask);
    for (int i = batch.count; i < 64 * WORDS; i++)
        if (bit_at(got, i))
            fail_at(i, false);
    assert_report(&report, got, (size_t)batch.count, options->accuracy);
    tribox_report alone;
    assert_int_equal(CALL(overlap_oriented, &of, &batch.box, options, NULL, &alone), TRIBOX_OK);
    assert_memory_equal(&alone, &report, sizeof alone);
    return got;
}

static void check_exact(random_source *r, const char *kernel)
{
    const tribox_options all = {.accuracy = TRIBOX_EXACT,
                                .axes = random_int(r, 2) ? TRIBOX_AXES_ALL : 0,
                                .axis_order = axis_order_at(random_int(r, AXIS_ORDERS)),
                                .kernel = kernel};
    const uint64_t *got = ask(&all);
    for (int i = 0; i < batch.count; i++)
        if (bit_at(got, i) != bit_at(overlapping, i))
            fail_at(i, bit_at(overlapping, i));
    got = ask(&(tribox_options){.accuracy = TRIBOX_EXACT, .axes = TRIBOX_AXES_BOX, .axis_order = 0, .kernel = kernel});
    for (int i = 0; i < batch.count; i++)
        if (bit_at(got, i) != bit_at(bounds, i))
            fail_at(i, bit_at(bounds, i));
}

/* Whether the answer about triangle i would be `answer` if the half lengths were others by a share of the sizes at hand. */
static bool is_near_contact(int i, double share, bool answer)
{
    double change[3];
    for (int k = 0; k < 3; k++) {
        double size = batch.box.half[k];
        for (int a = 0; a < 3; a++)
            for (int j = 0; j < 3; j++)
                size += fabs(batch.box.axis[k][a] * (batch.u[i][j][a] - batch.box.center[a]));
        change[k] = (answer ? share : -share) * size;
    }
    return oriented_oracle_within((const_triangle)batch.u[i], &batch.box, change, false) == answer;
}

/* No wrong answer is one of rounding if the pair is this far from contact. Needles are left out: see is_ordinary. */
enum { SHARE_BITS = 12 };

static void check_near_contact(int i, bool answer)
{
    if (is_ordinary && !is_near_contact(i, ldexp(1, -SHARE_BITS), answer))
        fail_at(i, !answer);
}

/* Whatever the axes, and never a triangle that is not finite. Returns the false overlaps of all thirteen axes. */
static size_t check_conservative(random_source *r, const char *kernel)
{
    size_t too_many = 0;
    for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
        const uint64_t *const must = axes == TRIBOX_AXES_BOX ? bounds : overlapping;
        const uint64_t *const got = ask(&(tribox_options){.accuracy = TRIBOX_CONSERVATIVE,
                                                          .axes = axes,
                                                          .axis_order = axis_order_at(random_int(r, AXIS_ORDERS)),
                                                          .kernel = kernel});
        for (int i = 0; i < batch.count; i++) {
            if (bit_at(got, i) ? !are_finite(&batch.u[i][0][0], 9) : bit_at(must, i))
                fail_at(i, bit_at(must, i));
            if (axes != TRIBOX_AXES_ALL || bit_at(got, i) == bit_at(must, i))
                continue;
            too_many++;
            check_near_contact(i, true);
        }
    }
    return too_many;
}

/* Returns the wrong answers. */
static size_t check_fast(const char *kernel)
{
    size_t wrong = 0;
    const uint64_t *const got =
        ask(&(tribox_options){.accuracy = TRIBOX_FAST, .axes = TRIBOX_AXES_ALL, .axis_order = 0, .kernel = kernel});
    for (int i = 0; i < batch.count; i++) {
        if (bit_at(got, i) == bit_at(overlapping, i))
            continue;
        if (!are_finite(&batch.u[i][0][0], 9))
            fail_at(i, false);
        wrong++;
        check_near_contact(i, bit_at(got, i));
    }
    return wrong;
}

/* A mesh of floats is the soup, at every accuracy. */
static void check_same(const char *kernel)
{
    for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
        const tribox_options options = {.accuracy = accuracy, .kernel = kernel};
        uint64_t of_soup[WORDS];
        of.is_mesh = false;
        memcpy(of_soup, ask(&options), sizeof of_soup);
        of.is_mesh = true;
        if (memcmp(of_soup, ask(&options), sizeof of_soup))
            fail_msg("%s: is not what the soup's answer is", doing);
    }
}

static void check_kernels(random_source *r, size_t *too_many, size_t *wrong)
{
    for (int k = 0; k < kernels; k++) {
        check_exact(r, names[k]);
        *too_many += check_conservative(r, names[k]);
        *wrong += check_fast(names[k]);
    }
}

static void check_stage(int i, const char *stage, bool answer, bool expected)
{
    if (answer == expected)
        return;
    snprintf(doing, sizeof doing, "%s, scene %s, form %d, seed %" PRIu64, stage, scene_name, (int)batch.form, args.seed);
    fail_at(i, expected);
}

/* What few pairs reach: stages that are asked where others cannot tell. */
static void check_last_stages(void)
{
    for (int i = 0; i < batch.count; i++) {
        tribox_oriented_pair pair = {.box = batch.box};
        memcpy(pair.u, batch.u[i], sizeof pair.u);
        if (!are_finite(&batch.u[i][0][0], 9))
            continue;
        check_stage(i, "tribox_oriented_overlap", tribox_oriented_overlap(&pair, TRIBOX_AXES_ALL), bit_at(overlapping, i));
        check_stage(i, "tribox_oriented_overlap", tribox_oriented_overlap(&pair, TRIBOX_AXES_BOX), bit_at(bounds, i));
        if (i % 4 == 0)
            check_stage(i, "tribox_oriented_long", tribox_oriented_long(&pair, TRIBOX_AXES_ALL), bit_at(overlapping, i));
    }
}

static void check_batch(random_source *r, size_t *too_many, size_t *wrong)
{
    size_t unused = 0;
    ask_oracle();
    check_last_stages();
    lay_mesh(r);
    of.is_mesh = true;
    check_kernels(r, batch.form == ORIENTED_DOUBLES ? too_many : &unused, batch.form == ORIENTED_DOUBLES ? wrong : &unused);
    of.is_mesh = false;
    if (batch.form == ORIENTED_DOUBLES)
        return;
    lay_soup(true);
    check_kernels(r, too_many, wrong);
    for (int k = 0; k < kernels && of.mesh.position_bytes != 8; k++)
        check_same(names[k]);
    of.is_mesh = false;
}

static void check_scene(const oriented_scene *scene, oriented_form form)
{
    static const char *const numbers[] = {"floats", "a box of doubles", "doubles"};
    size_t asked = 0, hits = 0, too_many = 0, wrong = 0;
    random_source r = random_named(args.seed, scene_name);
    const size_t rounds = arguments_rounds(&args, ORIENTED_TRIANGLES * 80);
    for (size_t round = 0; round < rounds * scene->share; round++) {
        oriented_draw(scene, form, &r, &batch);
        check_batch(&r, &too_many, &wrong);
        asked += (size_t)batch.count;
        hits += bits_set(overlapping, WORDS);
    }
    print_message("%-14s %-16s %zu pairs, %zu overlap; per kernel CONSERVATIVE adds %zu, FAST errs in %zu\n", scene_name,
                  numbers[form], asked, hits, too_many / (size_t)kernels, wrong / (size_t)kernels);
    if (is_ordinary && asked >= 1000) /* fewer are too few to say how many there are */
        assert_in_range(hits, asked / 200, asked - asked / 200);
}

CASE(test_scenes)
{
    for (int s = 0; s < ORIENTED_SCENES; s++) {
        scene_name = oriented_scenes[s].name;
        is_ordinary = oriented_scenes[s].is_ordinary;
        if (args.scenes && strcmp(args.scenes, scene_name))
            continue;
        for (oriented_form form = ORIENTED_FLOATS; form < ORIENTED_FORMS; form++)
            check_scene(&oriented_scenes[s], form);
    }
}

static void expect_none(const char *kernel)
{
    for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
        if (bits_set(ask(&(tribox_options){.accuracy = accuracy, .kernel = kernel}), WORDS))
            fail_msg("%s: an empty box is overlapped", doing);
}

/* Any negative half length, the least of them too, makes the box empty; a zero of either sign does not. */
CASE(test_empty_boxes)
{
    static const double below[] = {-0x1p-1074, -0x1p-149, -1, -DBL_MAX};
    scene_name = "empty";
    random_source r = random_named(args.seed, scene_name);
    for (int count = 0; count <= ORIENTED_TRIANGLES; count += 1 + count / 7)
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 4; b++) {
                oriented_draw(&oriented_scenes[0], ORIENTED_FLOATS, &r, &batch);
                batch.count = count;
                lay_soup(true);
                batch.box.half[a] = below[b];
                for (int k = 0; k < kernels; k++)
                    expect_none(names[k]);
            }
}

/* Corners of the box, along each axis one ulp beyond, and one ulp within: each of six comparisons alone decides. */
CASE(test_faces)
{
    scene_name = "faces";
    is_ordinary = false;
    random_source r = random_named(args.seed, scene_name);
    size_t unused = 0;
    for (int round = 0; round < 40; round++) {
        const oriented_form form = (oriented_form)(round / 4 % ORIENTED_FORMS);
        oriented_draw(&oriented_scenes[1], form, &r, &batch); /* right angles: coordinates in the frame are those of space */
        batch.count = ORIENTED_TRIANGLES;
        for (int a = 0; a < 3; a++) {
            batch.box.center[a] = 0;
            const double half = round % 4 ? random_double(&r, 0, 2) : 0;
            batch.box.half[a] = form == ORIENTED_FLOATS ? (double)(float)half : half;
        }
        for (int t = 0; t < ORIENTED_TRIANGLES; t++) {
            const int k = t % 3, side = t / 3 % 2, beyond = t / 6 % 3;
            for (int i = 0; i < 3; i++) {
                const double *const axis = batch.box.axis[i];
                const int a = axis[0] != 0 ? 0 : axis[1] != 0 ? 1 : 2;
                const double h = batch.box.half[i], to = beyond == 1 ? DBL_MAX : -DBL_MAX;
                const double plane = beyond == 0               ? h
                                     : form == ORIENTED_FLOATS ? (double)nextafterf((float)h, (float)to)
                                                               : nextafter(h, to);
                for (int j = 0; j < 3; j++) {
                    const double place = i != k ? (random_int(&r, 2) ? h : -h) : side ? plane : -plane;
                    batch.u[t][j][a] = form == ORIENTED_DOUBLES ? place : (double)(float)place;
                }
            }
        }
        check_batch(&r, &unused, &unused);
    }
}

/* Triangles that reach far, among others: none is reported farther from contact because of another. */
CASE(test_neighbours)
{
    scene_name = "neighbours";
    is_ordinary = true;
    random_source r = random_named(args.seed, scene_name);
    size_t unused = 0;
    for (int round = 0; round < 12; round++) {
        oriented_draw(&oriented_scenes[4], (oriented_form)(round % ORIENTED_FORMS), &r, &batch); /* the ordinary one */
        batch.count = ORIENTED_TRIANGLES;
        for (int t = random_int(&r, 20); t < ORIENTED_TRIANGLES; t += 20) {
            const double far = ldexp(1, random_int_between(&r, 6, 40)), miss = random_int(&r, 2) ? far / 50 : 0;
            for (int a = 0; a < 3; a++) { /* through the center but for what is rounded, or not */
                double *const from[3] = {&batch.u[t][0][a], &batch.u[t][1][a], &batch.u[t][2][a]};
                for (int j = 0; j < 3; j++)
                    *from[j] = j < 2 ? far * random_double(&r, -1, 1) : 3 * (batch.box.center[a] + miss) - *from[0] - *from[1];
                for (int j = 0; j < 3; j++)
                    *from[j] = batch.form == ORIENTED_DOUBLES ? *from[j] : (double)(float)*from[j];
            }
        }
        check_batch(&r, &unused, &unused);
    }
}

/* Many blocks of whatever size: the triangles of a batch over and over, each time another one first. */
static void check_large(const tribox_options *options, size_t count)
{
    enum { MOST = 5000 };
    static float stream[STREAMS][MOST];
    static uint64_t mask[MOST / 64 + 1];
    const tribox_soup large = soup_of_rows(stream[0], MOST, count);
    for (size_t s = 0; s < STREAMS; s++)
        for (size_t i = 0; i < count; i++)
            stream[s][i] = (float)batch.u[(i + i / ORIENTED_TRIANGLES) % ORIENTED_TRIANGLES][s % 3][s / 3];
    tribox_report report;
    size_t hits = 0;
    say(options);
    assert_int_equal(tribox_overlap_oriented(&large, &batch.box, options, mask, &report), TRIBOX_OK);
    for (size_t i = 0; i < count; i++) {
        const int t = (int)((i + i / ORIENTED_TRIANGLES) % ORIENTED_TRIANGLES);
        const bool is_hit = mask[i / 64] >> i % 64 & 1, expected = bit_at(overlapping, t);
        hits += is_hit;
        if (options->accuracy == TRIBOX_EXACT ? is_hit != expected : expected && !is_hit)
            fail_msg("%s, of %zu: bit %zu, triangle %d, should be %d", doing, count, i, t, expected);
    }
    assert_int_equal(report.overlapping, hits);
    assert_in_range(report.undecided, 0, count);
}

CASE(test_large)
{
    static const size_t counts[] = {255, 256, 257, 511, 512, 513, 576, 1023, 1024, 1025, 2111, 4095, 4096, 4097, 5000};
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
        const oriented_scene *const s = &oriented_scenes[c % ORIENTED_SCENES];
        scene_name = s->name;
        random_source r = random_named(args.seed, scene_name);
        oriented_draw(s, ORIENTED_FLOATS, &r, &batch);
        batch.count = ORIENTED_TRIANGLES;
        ask_oracle();
        for (int k = 0; k < kernels; k++)
            for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_CONSERVATIVE; accuracy++)
                check_large(&(tribox_options){.accuracy = accuracy, .kernel = names[k]}, counts[c]);
    }
}

/* The first triangles of a batch, as many as there are and fewer. */
CASE(test_every_count)
{
    scene_name = oriented_scenes[0].name;
    is_ordinary = oriented_scenes[0].is_ordinary;
    random_source r = random_named(args.seed, "every count");
    oriented_draw(&oriented_scenes[0], ORIENTED_FLOATS, &r, &batch);
    for (int place = 0; place < 2; place++)
        for (batch.count = ORIENTED_TRIANGLES; batch.count >= 0; batch.count--) {
            size_t unused = 0;
            lay_soup(place == 0);
            lay_mesh(&r);
            ask_oracle();
            of.is_mesh = batch.count % 2;
            check_kernels(&r, &unused, &unused);
            of.is_mesh = false;
        }
}

PROGRAM_AFTER(set_up, RUN(test_scenes), RUN(test_empty_boxes), RUN(test_faces), RUN(test_every_count), RUN(test_large),
              RUN(test_neighbours))
