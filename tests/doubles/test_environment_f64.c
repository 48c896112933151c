/*
 * test_environment_f64.c - the caller's rounding mode, flush-to-zero and traps change no answer about doubles, and come back as
 * they were; threads that ask at once get what one alone gets.
 */
#include <pthread.h>
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "common/arguments.h"
#include "common/ask.h"
#include "common/float_environment.h"
#include "common/guard.h"

#include "scenes_f64.h"

enum { WORDS = (BATCH_F64 + 63) / 64, THREADS = 6, TURNS = 20 };

static arguments args;

/* What is asked, whichever call asks it. */
typedef struct asked {
    batch_f64 batch;
    tribox_mesh mesh;
    tribox_options options;
} asked;

/* All that a call can answer. Compared as bytes. */
typedef struct answers {
    uint64_t mask[WORDS], inside[WORDS];
    tribox_report report;
    size_t first, first_unlike;
    float stream[9][BATCH_F64];
    tribox_status status[4];
} answers;

static void ask_all(const asked *q, answers *out)
{
    float *to[9];
    for (int s = 0; s < 9; s++)
        to[s] = out->stream[s];
    out->status[0] = tribox_mesh_classify(&q->mesh, &q->batch.box, &q->options, out->mask, out->inside, &out->report);
    out->status[1] = tribox_mesh_find(&q->mesh, &q->batch.box, &q->options, TRIBOX_FIRST_HIT, &out->first);
    out->status[2] = tribox_mesh_find(&q->mesh, &q->batch.box, &q->options, TRIBOX_FIRST_MISS, &out->first_unlike);
    out->status[3] = tribox_mesh_to_soup(&q->mesh, q->batch.box.lo, 0, q->mesh.count, &q->options, to, to + 3, to + 6);
}

static void check(const asked *q)
{
    static answers expected, got;
    const unsigned normal = environment_get();
    memset(&expected, 0xa5, sizeof expected);
    ask_all(q, &expected);
    for (unsigned k = 0; k < SETTINGS; k++) {
        const unsigned set = setting(k);
        snprintf(doing, sizeof doing, "setting %#x, kernel %s, accuracy %d", set, q->options.kernel, (int)q->options.accuracy);
        memset(&got, 0xa5, sizeof got);
        environment_set(set);
        ask_all(q, &got);
        const unsigned left = environment_get();
        environment_set(normal);
        if (left != set)
            fail_msg("%s: left as %#x", doing, left);
        if (memcmp(&got, &expected, sizeof got))
            fail_msg("%s: another answer", doing);
    }
}

static void draw(const scene_f64 *scene, asked *q)
{
    random_source r = random_named(args.seed, scene->name);
    scene->draw(&r, &q->batch);
    q->batch.u[7][1][2] = NAN;
    q->mesh = (tribox_mesh){.positions = q->batch.u, .vertices = 3 * BATCH_F64, .count = BATCH_F64, .position_bytes = 8};
}

static void check_kernels(asked *q)
{
    const char *names[KERNELS_MAX];
    const int kernels = kernels_here(names);
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_CONSERVATIVE; accuracy++) {
            q->options = (tribox_options){.accuracy = accuracy, .axes = k % 2 ? TRIBOX_AXES_ALL : 0, .kernel = names[k]};
            check(q);
        }
    q->options = (tribox_options){.axes = TRIBOX_AXES_PLANE | TRIBOX_AXES_EDGES};
    check(q);
}

static void test_scenes(void **state)
{
    (void)state;
    static asked q;
    catch_faults();
    for (size_t i = 0; i < scene_f64_count(); i += arguments_are_short(&args) ? 12 : 6) {
        draw(scene_f64_at(i), &q);
        check_kernels(&q);
    }
}

/* Refusals; and a mesh of floats, with a float that flushing to zero would change. */
static void test_others(void **state)
{
    (void)state;
    static asked q;
    static float subnormal[BATCH_F64][3][3];
    catch_faults();
    draw(scene_f64_at(0), &q);
    q.mesh.vertices--;
    check_kernels(&q);
    q.mesh.vertices++;
    q.batch.box.lo[1] = NAN;
    check_kernels(&q);
    for (int k = 0; k < 9 * BATCH_F64; k++)
        subnormal[k / 9][k / 3 % 3][k % 3] = (float)(k % 7 - 3) * 0x1p-149f;
    q.mesh.positions = subnormal;
    q.mesh.position_bytes = 4;
    q.batch.box = (tribox_box){{0, -0x1p-149, 0x1p-1074}, {0x1p-140, 0x1p-148, 1}};
    check_kernels(&q);
    q.mesh.positions = q.batch.u;
    q.mesh.position_bytes = 8;
    for (int k = 0; k < 9 * BATCH_F64; k++)
        q.batch.u[k / 9][k / 3 % 3][k % 3] = (k % 7 - 3) * 0x1p-1074;
    q.batch.box = (tribox_box){{0, -0x1p-1074, 0x1p-1074}, {0x1p-1070, 0x1p-1073, 1}};
    check_kernels(&q);
}

typedef struct worker {
    pthread_t thread;
    const asked *q;
    answers got;
} worker;

static void *work(void *argument)
{
    worker *const w = argument;
    for (int turn = 0; turn < TURNS; turn++)
        ask_all(w->q, &w->got);
    return NULL;
}

static void test_threads(void **state)
{
    (void)state;
    static asked q;
    static worker workers[THREADS];
    static answers expected;
    catch_faults();
    for (size_t i = 0; i < scene_f64_count(); i += 4) {
        draw(scene_f64_at(i), &q);
        q.options = (tribox_options){0};
        memset(&expected, 0xa5, sizeof expected);
        ask_all(&q, &expected);
        for (int t = 0; t < THREADS; t++) {
            memset(&workers[t].got, 0xa5, sizeof workers[t].got);
            workers[t].q = &q;
            assert_int_equal(pthread_create(&workers[t].thread, NULL, work, &workers[t]), 0);
        }
        for (int t = 0; t < THREADS; t++) {
            assert_int_equal(pthread_join(workers[t].thread, NULL), 0);
            assert_memory_equal(&workers[t].got, &expected, sizeof expected);
        }
    }
}

int main(int argc, char **argv)
{
    args = arguments_parse(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scenes),
        cmocka_unit_test(test_others),
        cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
