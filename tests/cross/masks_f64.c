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

static void die(const char *scene, const tribox_options *options, const char *how)
{
    fprintf(stderr, "scene %s of doubles: kernel %s at accuracy %d, axes %u %s\n", scene, options->kernel, (int)options->accuracy,
            options->axes, how);
    exit(1);
}

/* Masks of what overlaps and of what is inside: EXACT, of which CONSERVATIVE misses nothing, asked in the first layout alone. */
static void ask_masks(const char *scene, const tribox_mesh *mesh, const tribox_box *box, tribox_options o, digest *to)
{
    uint64_t mask[WORDS], inside[WORDS], more[WORDS];
    tribox_status status = tribox_mesh_classify(mesh, box, &o, mask, inside, NULL);
    memcpy(more, mask, sizeof more);
    o.accuracy = TRIBOX_CONSERVATIVE;
    if (!status && !mesh->indices && !mesh->axis_stride)
        status = tribox_mesh_overlap(mesh, box, &o, more, NULL);
    if (status)
        die(scene, &o, "is refused");
    for (int w = 0; w < WORDS; w++)
        if (mask[w] & ~more[w])
            die(scene, &o, "misses what EXACT has");
    digest_add(to, mask, WORDS);
    if (o.axes == TRIBOX_AXES_ALL)
        digest_add(to, inside, WORDS);
}

/* The bits of streams relative to the box. */
static void ask_streams(const char *scene, const tribox_mesh *mesh, const tribox_box *box, tribox_options o, digest *to)
{
    static float stream[9][BATCH_F64];
    float *rows[9];
    digest d = digest_start;
    for (int s = 0; s < 9; s++)
        rows[s] = stream[s];
    if (tribox_mesh_to_soup(mesh, box->lo, 0, BATCH_F64, &o, rows, rows + 3, rows + 6))
        die(scene, &o, "makes no local streams");
    for (size_t n = 0; n < 9 * (size_t)BATCH_F64; n++) {
        uint32_t bits;
        memcpy(&bits, &stream[n / BATCH_F64][n % BATCH_F64], sizeof bits);
        digest_add(&d, &(uint64_t){bits}, 1);
    }
    digest_add(to, &d, 1);
}

/* From every kernel and in every layout the same. */
static void ask_all(const char *scene, const laid *l, unsigned axes,
                    void ask(const char *, const tribox_mesh *, const tribox_box *, tribox_options, digest *), digest *to)
{
    const char *names[KERNELS_MAX] = {NULL};
    const int kernels = kernels_here(names);
    digest first = *to;
    for (int k = 0; k < kernels * LAYOUTS; k++) {
        const tribox_options options = {.axes = axes, .kernel = names[k / LAYOUTS]};
        digest got = *to;
        ask(scene, &l->mesh[k % LAYOUTS], &l->batch->box, options, &got);
        first = k ? first : got;
        if (got != first)
            die(scene, &options, "answers otherwise than the scalar one");
    }
    *to = first;
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
        ask_all(scene->name, &l, TRIBOX_AXES_ALL, ask_masks, &d.exact);
        ask_all(scene->name, &l, 1 + (unsigned)(k % (TRIBOX_AXES_ALL - 1)), ask_masks, &d.axes);
        ask_all(scene->name, &l, 0, ask_streams, &d.meshes);
    }
    return d;
}
