/*
 * test_inputs_environment.c - the caller's rounding mode, flush-to-zero and traps change no answer of the calls about meshes, any
 * and all,
 * inside and oriented boxes, and come back as they were: on errors too.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "common/arguments.h"
#include "drawn_pairs.h"
#include "mesh_layout.h"
#include "oriented_scenes.h"
#include "common/kernels_here.h"
#include "common/float_environment.h"

static arguments args;
static drawn_numbers numbers;
static oriented_batch batch;

enum { TRIANGLES = ORIENTED_TRIANGLES, WORDS = (TRIANGLES + 63) / 64 };

/* What is asked, whichever call asks it. */
typedef struct asked {
    tribox_soup soup;
    tribox_mesh mesh;
    tribox_box box;
    tribox_oriented_box oriented;
    tribox_options options;
} asked;

/* All that a call can answer. Compared as bytes. */
typedef struct answers {
    uint64_t mask[WORDS], inside[WORDS];
    tribox_report report;
    size_t first;
    uint32_t index[TRIANGLES];
    float stream[9][TRIANGLES];
    tribox_status status;
} answers;

typedef void action(const asked *q, answers *out);

static void indexed(const asked *q, answers *out)
{
    out->status = tribox_mesh_overlap(&q->mesh, &q->box, &q->options, out->mask, &out->report);
}

static void streams(const asked *q, answers *out)
{
    float *to[9];
    for (int s = 0; s < 9; s++)
        to[s] = out->stream[s];
    out->status = tribox_mesh_to_soup(&q->mesh, NULL, 0, q->mesh.count, &q->options, to, to + 3, to + 6);
}

static void not_finite(const asked *q, answers *out)
{
    out->report.overlapping = tribox_mesh_not_finite(&q->mesh, &out->first);
    out->report.undecided = tribox_soup_not_finite(&q->soup, NULL);
}

static void any(const asked *q, answers *out)
{
    out->status = tribox_find(&q->soup, &q->box, &q->options, TRIBOX_FIRST_HIT, &out->first);
}

static void all(const asked *q, answers *out)
{
    out->status = tribox_find(&q->soup, &q->box, &q->options, TRIBOX_FIRST_MISS, &out->first);
}

static void classify(const asked *q, answers *out)
{
    out->status = tribox_classify(&q->soup, &q->box, &q->options, out->mask, out->inside, &out->report);
}

static void oriented(const asked *q, answers *out)
{
    out->status = tribox_overlap_oriented(&q->soup, &q->oriented, &q->options, out->mask, &out->report);
}

static void mesh_oriented(const asked *q, answers *out)
{
    out->status = tribox_mesh_overlap_oriented(&q->mesh, &q->oriented, &q->options, out->mask, &out->report);
}

/* A word for each row. Of cells for float, and of others; of thin surfaces. */
static void cells(const asked *q, answers *out)
{
    const tribox_grid grid = {{-4, -4, -4}, {0.25, 2, 4}, {32, WORDS / 2, 2}},
                      fine = {{0, 0, 0}, {1e-33, 2, 4}, {32, WORDS / 2, 2}};
    memset(out->mask, 0, sizeof out->mask);
    memset(out->inside, 0, sizeof out->inside);
    out->status = tribox_voxelize(&q->soup, &grid, NULL, &q->options, out->mask, &out->report);
    tribox_voxelize(&q->soup, &fine, NULL, &q->options, out->inside, &out->report);
    tribox_voxelize_thin(&q->soup, &grid, NULL, &q->options, out->inside, &out->report);
}

static void lists(const asked *q, answers *out)
{
    static const uint64_t mask[2] = {UINT64_C(0x8000000000000001), 6};
    (void)q;
    out->first = tribox_mask_indices(mask, 70, out->index) + tribox_mesh_bad_vertices(&q->mesh, NULL);
}

static const struct {
    action *act;
    const char *name;
} actions[] = {
    {indexed, "tribox_mesh_overlap"},
    {streams, "tribox_mesh_to_soup"},
    {not_finite, "tribox_mesh_not_finite"},
    {any, "tribox_find"},
    {all, "tribox_find"},
    {classify, "tribox_classify"},
    {oriented, "tribox_overlap_oriented"},
    {mesh_oriented, "tribox_mesh_overlap_oriented"},
    {cells, "tribox_voxelize"},
    {lists, "tribox_mask_indices"},
};

/* Under each setting the answer is what it is under the one that a program starts with. */
static void check(action *act, const char *name, const asked *q)
{
    static answers expected, got;
    const unsigned normal = environment_get();
    memset(&expected, 0xa5, sizeof expected);
    act(q, &expected);
    for (unsigned k = 0; k < SETTINGS; k++) {
        const unsigned set = setting(k);
        snprintf(doing, sizeof doing, "%s under setting %#x, kernel %s, accuracy %d", name, set, q->options.kernel,
                 (int)q->options.accuracy);
        memset(&got, 0xa5, sizeof got);
        environment_set(set);
        act(q, &got);
        const unsigned left = environment_get();
        environment_set(normal);
        if (left != set)
            fail_msg("%s: left as %#x", doing, left);
        if (memcmp(&got, &expected, sizeof got))
            fail_msg("%s: another answer", doing);
    }
}

static void check_kernels(asked *q, size_t first_action, size_t actions_end)
{
    const char *names[KERNELS_MAX];
    const int kernels = kernels_here(names);
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            for (size_t i = first_action; i < actions_end; i++) {
                q->options = (tribox_options){.accuracy = accuracy, .kernel = names[k]};
                check(actions[i].act, actions[i].name, q);
            }
}

enum { ORIENTED = 6, ACTIONS = sizeof actions / sizeof actions[0] };

/* The nine streams of a soup as one array of structures. */
static tribox_mesh mesh_of(const tribox_soup *soup)
{
    static float vertex[3 * DRAWN_MAX][3];
    const float *const *const axis[3] = {soup->x, soup->y, soup->z};
    for (size_t c = 0; c < 3 * soup->count; c++)
        for (int a = 0; a < 3; a++)
            memcpy(&vertex[c][a], &axis[a][c % 3][c / 3], sizeof(float));
    return (tribox_mesh){.positions = vertex, .vertices = 3 * soup->count, .count = soup->count};
}

static void test_scenes(void **state)
{
    (void)state;
    catch_faults();
    for (size_t i = 0; i < scene_count(); i += arguments_are_short(&args) ? 12 : 3) {
        random_source r = random_named(args.seed, scene_at(i)->name);
        const pair_list q = draw_pairs(&r, scene_at(i), true, &numbers);
        const uint32_t signalling = 0x7fa00001u;
        memcpy(&numbers.stream[0][q.count - 1], &signalling, sizeof signalling);
        asked ask = {.soup = pair_list_soup(&q), .box = *q.box};
        ask.mesh = mesh_of(&ask.soup);
        check_kernels(&ask, 0, ORIENTED);
    }
}

/* A byte past where floats lie, streams and vertices alike: as misaligned as they can be. */
static asked moved_by_a_byte(const asked *q)
{
    static unsigned char stream[9][1 + sizeof numbers.stream[0]], vertex[1 + 36 * DRAWN_MAX];
    asked odd = *q;
    for (int s = 0; s < 9; s++) {
        const float **const of = s < 3 ? odd.soup.x : s < 6 ? odd.soup.y : odd.soup.z;
        memcpy(stream[s] + 1, of[s % 3], q->soup.count * sizeof(float));
        of[s % 3] = (const float *)(const void *)(stream[s] + 1);
    }
    memcpy(vertex + 1, q->mesh.positions, 36 * q->mesh.count);
    odd.mesh.positions = vertex + 1;
    return odd;
}

static void test_odd_addresses(void **state)
{
    (void)state;
    static answers expected, got;
    const char *names[KERNELS_MAX];
    const int kernels = kernels_here(names);
    oriented_draw(&oriented_scenes[0], ORIENTED_FLOATS, &(random_source){0}, &batch);
    for (size_t i = 0; i < scene_count(); i += 3) {
        random_source r = random_named(args.seed, scene_at(i)->name);
        const pair_list q = draw_pairs(&r, scene_at(i), true, &numbers);
        asked ask = {.soup = pair_list_soup(&q), .box = *q.box, .oriented = batch.box};
        ask.mesh = mesh_of(&ask.soup);
        asked odd = moved_by_a_byte(&ask);
        for (int k = 0; k < kernels; k++)
            for (int n = 0; n < 3 * ACTIONS; n++) {
                ask.options = odd.options = (tribox_options){.accuracy = (tribox_accuracy)(n % 3), .kernel = names[k]};
                memset(&expected, 0xa5, sizeof expected);
                memset(&got, 0xa5, sizeof got);
                actions[n / 3].act(&ask, &expected);
                actions[n / 3].act(&odd, &got);
                if (memcmp(&got, &expected, sizeof got))
                    fail_msg("%s at odd addresses, kernel %s: another answer", actions[n / 3].name, names[k]);
            }
    }
}

static tribox_soup soup_of_batch(void)
{
    tribox_soup soup = {.count = (size_t)batch.count};
    const float **const axis[3] = {soup.x, soup.y, soup.z};
    for (int s = 0; s < 9; s++) {
        for (int t = 0; t < batch.count; t++)
            numbers.stream[s][t] = (float)batch.u[t][s % 3][s / 3];
        axis[s / 3][s % 3] = numbers.stream[s];
    }
    return soup;
}

static void test_oriented(void **state)
{
    (void)state;
    catch_faults();
    for (int s = 0; s < ORIENTED_SCENES; s += arguments_are_short(&args) ? 4 : 1) {
        random_source r = random_named(args.seed, oriented_scenes[s].name);
        oriented_draw(&oriented_scenes[s], (oriented_form)(s % ORIENTED_FORMS), &r, &batch);
        const size_t count = (size_t)batch.count;
        asked ask = {.soup = soup_of_batch(),
                     .mesh = {.positions = batch.u, .vertices = 3 * count, .count = count, .position_bytes = 8},
                     .oriented = batch.box};
        check_kernels(&ask, ORIENTED, ORIENTED + 2);
    }
}

/* Refusals, and boxes of subnormal numbers, which flushing to zero would make what they are not. */
static void test_refusals(void **state)
{
    (void)state;
    static const uint64_t bits[] = {1, UINT64_C(1) << 63 | 1, UINT64_C(0x7ff) << 52 | 1, UINT64_C(0xfff) << 51,
                                    UINT64_C(0x7ff) << 52};
    catch_faults();
    random_source r = random_named(args.seed, "refusals");
    oriented_draw(&oriented_scenes[0], ORIENTED_FLOATS, &r, &batch);
    asked ask = {.soup = soup_of_batch(), .oriented = batch.box, .box = {{0, 0, 0}, {1, 1, 1}}};
    ask.mesh = mesh_of(&ask.soup);
    ask.mesh.vertices--;
    check_kernels(&ask, 0, ACTIONS);
    ask.mesh.vertices++;
    for (size_t b = 0; b < sizeof bits / sizeof bits[0]; b++) {
        const size_t a = (size_t)((b + args.seed) % 3);
        asked spoiled = ask;
        memcpy(&spoiled.box.lo[a], &bits[b], sizeof bits[b]);
        memcpy(&spoiled.oriented.half[a], &bits[b], sizeof bits[b]);
        spoiled.box.hi[a] = b & 1 ? 0 : 1;
        check_kernels(&spoiled, 0, ACTIONS);
    }
}

int main(int argc, char **argv)
{
    args = arguments_parse(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scenes),
        cmocka_unit_test(test_odd_addresses),
        cmocka_unit_test(test_oriented),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
