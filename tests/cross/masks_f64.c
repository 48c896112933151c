#include "masks_f64.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/kernels_here.h"

enum { WORDS = (BATCH_F64 + 63) / 64, CORNERS = 3 * BATCH_F64, LAYOUTS = 4 };

/* One batch in every layout: nine doubles, indices of 16 and of 32 bits, the last vertex first, and columns. */
typedef struct laid {
    const batch_f64 *batch;
    double reversed[CORNERS][3], columns[3][CORNERS];
    uint16_t narrow[CORNERS];
    uint32_t wide[CORNERS];
    tribox_mesh mesh[LAYOUTS];
} laid;

static void lay(const batch_f64 *batch, laid *l)
{
    l->batch = batch;
    for (size_t c = 0; c < CORNERS; c++) {
        const double *const u = batch->u[c / 3][c % 3];
        l->wide[c] = (uint32_t)(CORNERS - 1 - c);
        l->narrow[c] = (uint16_t)(CORNERS - 1 - c);
        memcpy(l->reversed[CORNERS - 1 - c], u, sizeof l->reversed[0]);
        for (int a = 0; a < 3; a++)
            l->columns[a][c] = u[a];
    }
    const tribox_mesh same = {.positions = batch->u, .vertices = CORNERS, .count = BATCH_F64, .position_bytes = 8};
    for (int k = 0; k < LAYOUTS; k++)
        l->mesh[k] = same;
    l->mesh[1].positions = l->mesh[2].positions = l->reversed;
    l->mesh[1].indices = l->narrow;
    l->mesh[1].index_bytes = 2;
    l->mesh[2].indices = l->wide;
    l->mesh[2].index_bytes = 4;
    l->mesh[3].positions = l->columns;
    l->mesh[3].stride = sizeof l->columns[0][0];
    l->mesh[3].axis_stride = sizeof l->columns[0];
}

static void digest_doubles(digest *d, const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        digest_add(d, &bits, 1);
    }
}

typedef struct answer {
    uint64_t mask[WORDS], inside[WORDS];
} answer;

static answer answer_of(const laid *l, int layout, const tribox_options *options)
{
    answer got;
    const tribox_status status = tribox_mesh_classify(&l->mesh[layout], &l->batch->box, options, got.mask, got.inside, NULL);
    if (status) {
        fprintf(stderr, "doubles: kernel %s says: %s\n", options->kernel, tribox_status_text(status));
        exit(1);
    }
    return got;
}

static void die(const char *scene, const tribox_options *options, const char *how)
{
    fprintf(stderr, "scene %s of doubles: kernel %s at accuracy %d, axes %u %s\n", scene, options->kernel, (int)options->accuracy,
            options->axes, how);
    exit(1);
}

/* EXACT from every kernel and in every layout; CONSERVATIVE misses nothing of it. */
static answer exact_answer(const char *scene, const laid *l, unsigned axes)
{
    const char *names[KERNELS_MAX] = {NULL};
    const int kernels = kernels_here(names);
    tribox_options options = {.axes = axes, .kernel = names[0]};
    const answer expected = answer_of(l, 0, &options);
    for (int k = 0; k < kernels; k++) {
        options = (tribox_options){.axes = axes, .kernel = names[k]};
        for (int layout = 0; layout < LAYOUTS; layout++) {
            const answer got = answer_of(l, layout, &options);
            if (memcmp(&got, &expected, sizeof got))
                die(scene, &options, "answers otherwise than the scalar one");
        }
        options.accuracy = TRIBOX_CONSERVATIVE;
        const answer got = answer_of(l, 0, &options);
        for (int w = 0; w < WORDS; w++)
            if (expected.mask[w] & ~got.mask[w])
                die(scene, &options, "misses what EXACT has");
    }
    return expected;
}

/* The bits of streams relative to the box, the same of every layout and kernel. */
static digest streams_digest(const char *scene, const laid *l)
{
    static float stream[9][BATCH_F64];
    const char *names[KERNELS_MAX];
    const int kernels = kernels_here(names);
    float *to[9];
    digest first = 0;
    for (int s = 0; s < 9; s++)
        to[s] = stream[s];
    for (int k = 0; k < kernels * LAYOUTS; k++) {
        const tribox_options options = {.kernel = names[k / LAYOUTS]};
        digest d = digest_start;
        if (tribox_mesh_to_soup(&l->mesh[k % LAYOUTS], l->batch->box.lo, 0, BATCH_F64, &options, to, to + 3, to + 6))
            die(scene, &options, "makes no local streams");
        for (size_t n = 0; n < 9 * (size_t)BATCH_F64; n++) {
            uint32_t bits;
            memcpy(&bits, &stream[n / BATCH_F64][n % BATCH_F64], sizeof bits);
            digest_add(&d, &(uint64_t){bits}, 1);
        }
        first = k ? first : d;
        if (d != first)
            die(scene, &options, "makes other local streams");
    }
    return first;
}

digests_f64 digests_f64_of(const scene_f64 *scene, uint64_t seed, size_t batches)
{
    static batch_f64 batch;
    static laid l;
    random_source r = random_named(seed, scene->name);
    digests_f64 d = {digest_start, digest_start, digest_start, digest_start};
    for (size_t k = 0; k < batches; k++) {
        scene->draw(&r, &batch);
        lay(&batch, &l);
        digest_doubles(&d.drawn, batch.u[0][0], 9 * (size_t)BATCH_F64);
        digest_doubles(&d.drawn, batch.box.lo, 3);
        digest_doubles(&d.drawn, batch.box.hi, 3);
        const answer all = exact_answer(scene->name, &l, TRIBOX_AXES_ALL);
        digest_add(&d.exact, all.mask, WORDS);
        digest_add(&d.exact, all.inside, WORDS);
        const answer fewer = exact_answer(scene->name, &l, 1 + (unsigned)(k % (TRIBOX_AXES_ALL - 1)));
        digest_add(&d.axes, fewer.mask, WORDS);
        digest_add(&d.meshes, &(uint64_t){streams_digest(scene->name, &l)}, 1);
    }
    return d;
}
