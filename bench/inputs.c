/*
 * inputs.c - what does it cost to ask about triangles as they are: indexed, or nine floats each?
 *
 * The same triangles four times over: nine streams, nine floats a triangle, and indices of 32 and 16 bits into positions. `shared` has
 * half as many vertices as triangles, as meshes do, drawn at random. Everything is verified before it is timed, runs in one process,
 * interleaved in rounds, and is compared pair by pair within a round. `reading` loads each byte of an input once.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/command_line.h"
#include "common/header.h"
#include "common/loads.h"
#include "common/measure.h"

/* A scene in every form. */
typedef struct forms {
    scene at;
    float *positions; /* of the indexed forms */
    uint32_t *wide;
    uint16_t *narrow; /* NULL where there are too many vertices */
    size_t vertices;
    tribox_mesh flat, wide_mesh, narrow_mesh;
    float *streams;   /* room for nine */
    uint64_t *inside; /* room for a mask */
} forms;

/* What a contestant does with a form. */
typedef struct job {
    const forms *f;
    const tribox_mesh *mesh;
    tribox_options options;
} job;

static void run_streams(const void *peer, const scene *at, uint64_t *mask)
{
    const job *const j = peer;
    tribox_overlap(&at->soup, &at->box, &j->options, mask, NULL);
}

static void run_mesh(const void *peer, const scene *at, uint64_t *mask)
{
    const job *const j = peer;
    tribox_overlap_indexed(j->mesh, &at->box, &j->options, mask, NULL);
}

static void run_to_streams(const void *peer, const scene *at, uint64_t *mask)
{
    const job *const j = peer;
    float *to[9];
    for (size_t k = 0; k < 9; k++)
        to[k] = j->f->streams + k * at->soup.count;
    tribox_mesh_to_streams(j->mesh, 0, at->soup.count, &j->options, to, to + 3, to + 6);
    mask[0] = 0;
}

static void run_copy(const void *peer, const scene *at, uint64_t *mask)
{
    const job *const j = peer;
    memcpy(j->f->streams, at->triangles, 9 * at->soup.count * sizeof(float));
    mask[0] = 0;
}

static void run_reading(const void *peer, const scene *at, uint64_t *mask)
{
    const job *const j = peer;
    const size_t coordinates = 3 * (j->mesh->indices ? j->mesh->vertices : 3 * at->soup.count);
    mask[0] = loads_words(j->mesh->positions, coordinates);
    if (j->mesh->indices)
        mask[0] ^= loads_words(j->mesh->indices, 3 * at->soup.count * j->mesh->index_bytes / sizeof(uint32_t));
}

static void run_any(const void *peer, const scene *at, uint64_t *mask)
{
    const job *const j = peer;
    size_t first;
    tribox_overlap_any(&at->soup, &at->box, &j->options, &first);
    mask[0] = first;
}

/* The box of the scene turned by 0.5 about x, then by 0.7 about z. */
static void run_oriented(const void *peer, const scene *at, uint64_t *mask)
{
    const job *const j = peer;
    const float c = 0.76484219f, s = 0.64421769f, e = 0.87758256f, d = 0.47942554f;
    tribox_oriented_box box = {.axis = {{c, s * e, s * d}, {-s, c * e, c * d}, {0, -d, e}}};
    memcpy(box.center, at->center, sizeof box.center);
    memcpy(box.half, at->half, sizeof box.half);
    tribox_overlap_oriented(&at->soup, &box, &j->options, mask, NULL);
}

static void run_classify(const void *peer, const scene *at, uint64_t *mask)
{
    const job *const j = peer;
    tribox_classify(&at->soup, &at->box, &j->options, mask, j->f->inside, NULL);
}

static void *allocate(size_t count, size_t size)
{
    void *const memory = calloc(count, size);
    if (!memory) {
        fprintf(stderr, "inputs: out of memory for %zu things of %zu bytes\n", count, size);
        exit(1);
    }
    return memory;
}

/* The scene's own triangles, with a vertex for each corner; or, if is_shared, as many corners among count / 2 vertices. */
static void make_forms(size_t index, uint64_t seed, bool is_shared, forms *f)
{
    if (!scene_make(index, seed, &f->at))
        exit(1);
    const size_t count = f->at.soup.count;
    generator g = {seed + 1};
    f->vertices = is_shared ? count / 2 : 3 * count;
    f->positions = allocate(3 * f->vertices, sizeof(float));
    f->wide = allocate(3 * count, sizeof *f->wide);
    f->narrow = f->vertices <= 65536 ? allocate(3 * count, sizeof *f->narrow) : NULL;
    f->streams = allocate(9 * count, sizeof(float));
    f->inside = allocate(tribox_mask_words(count), sizeof *f->inside);
    memcpy(f->positions, f->at.triangles, 3 * f->vertices * sizeof(float));
    for (size_t corner = 0; corner < 3 * count; corner++) {
        f->wide[corner] = is_shared ? (uint32_t)random_below(&g, f->vertices) : (uint32_t)corner;
        if (f->narrow)
            f->narrow[corner] = (uint16_t)f->wide[corner];
        const float *const from = f->positions + 3 * f->wide[corner];
        float(*const triangle)[3] = ((float(*)[3][3])f->at.storage[1])[corner / 3];
        const float *const *const stream[3] = {f->at.soup.x, f->at.soup.y, f->at.soup.z};
        for (size_t a = 0; a < 3; a++) {
            triangle[corner % 3][a] = from[a];
            ((float *)f->at.storage[0])[stream[a][corner % 3] + corner / 3 - (float *)f->at.storage[0]] = from[a];
        }
    }
    f->flat = (tribox_mesh){.positions = f->at.triangles, .vertices = 3 * count, .count = count};
    f->wide_mesh =
        (tribox_mesh){.positions = f->positions, .vertices = f->vertices, .indices = f->wide, .index_bytes = 4, .count = count};
    f->narrow_mesh = f->wide_mesh;
    f->narrow_mesh.indices = f->narrow;
    f->narrow_mesh.index_bytes = 2;
}

static void free_forms(forms *f)
{
    scene_free(&f->at);
    free(f->positions);
    free(f->wide);
    free(f->narrow);
    free(f->streams);
    free(f->inside);
}

/* Every form has the answer of the streams. */
static bool is_right(const contestant *list, size_t count, const forms *f)
{
    const size_t words = tribox_mask_words(f->at.soup.count);
    uint64_t *const expected = allocate(words, sizeof *expected), *const mask = allocate(words, sizeof *mask);
    bool is_same = true;
    run_streams(list[0].peer, &f->at, expected);
    for (size_t c = 0; c < count; c++) {
        list[c].run(list[c].peer, &f->at, mask);
        if (list[c].run == run_mesh && memcmp(mask, expected, words * sizeof *mask)) {
            fprintf(stderr, "inputs: %s has another answer than the streams; nothing is timed\n", list[c].name);
            is_same = false;
        }
    }
    free(expected);
    free(mask);
    return is_same;
}

static size_t enter(const forms *f, const char *kernel, job *jobs, contestant *list)
{
    const struct {
        const char *name;
        void (*run)(const void *, const scene *, uint64_t *);
        const tribox_mesh *mesh;
    } all[] = {
        {"streams", run_streams, NULL},
        {"nine floats", run_mesh, &f->flat},
        {"32-bit indices", run_mesh, &f->wide_mesh},
        {"16-bit indices", run_mesh, f->narrow ? &f->narrow_mesh : NULL},
        {"reading nine floats", run_reading, &f->flat},
        {"reading 32-bit indices", run_reading, &f->wide_mesh},
        {"nine floats to streams", run_to_streams, &f->flat},
        {"indices to streams", run_to_streams, &f->wide_mesh},
        {"memcpy of nine floats", run_copy, NULL},
        {"any", run_any, NULL},
        {"inside", run_classify, NULL},
        {"oriented", run_oriented, NULL},
    };
    size_t count = 0;
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        if (all[k].run == run_mesh && !all[k].mesh)
            continue;
        jobs[count] = (job){.f = f, .mesh = all[k].mesh, .options = {.kernel = kernel}};
        list[count] = (contestant){.kind = CONTESTANT_PEER, .run = all[k].run, .peer = &jobs[count]};
        snprintf(list[count].name, sizeof list[count].name, "%s", all[k].name);
        count++;
    }
    return count;
}

static bool run_scene(const char *name, bool is_shared, const char *kernel, uint64_t seed, effort how)
{
    static samples taken;
    contestant list[CONTESTANTS_MAX];
    job jobs[CONTESTANTS_MAX];
    forms f;
    size_t index;
    if (!argument_scene("inputs", name, &index))
        return false;
    make_forms(index, seed, is_shared, &f);
    const size_t count = enter(&f, kernel, jobs, list);
    const bool right = is_right(list, count, &f);
    if (right) {
        uint64_t *const mask = allocate(tribox_mask_words(f.at.soup.count), sizeof *mask);
        generator order = {~seed};
        measure(list, count, &f.at, 1, how, &order, mask, &taken);
        printf("\n%s%s: %zu triangles, %zu vertices, %s\n", name, is_shared ? ", vertices shared" : "", f.at.soup.count, f.vertices,
               kernel ? kernel : tribox_kernel_name(NULL));
        printf("%-24s %10s %14s\n", "", "ns", "times streams");
        for (size_t c = 0; c < count; c++)
            printf("%-24s %10.4f %14.4f\n", list[c].name, measure_spread(&taken, c).median, measure_ratio(&taken, c, 0).median);
        measure_warn_if_disturbed(&taken);
        free(mask);
    }
    free_forms(&f);
    return right;
}

static const char usage[] = "usage: inputs [--kernel NAME] [--quick]\n"
                            "Times triangles as they are, indexed or nine floats each, against nine streams: EXACT, one thread.\n";

int main(int argc, char **argv)
{
    const char *kernel = NULL;
    effort how = {.rounds = 31, .seconds = 8, .sample = 2e-3};
    for (int i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--help")) {
            fputs(usage, stdout);
            return 0;
        }
        if (!strcmp(argv[i], "--quick"))
            how = (effort){.rounds = 7, .seconds = 1, .sample = 1e-3};
        else if (!strcmp(argv[i], "--kernel") && i + 1 < argc)
            kernel = argv[++i];
        else
            return argument_fail("inputs", "unknown option, or one without its value:", argv[i], "see inputs --help");
    }
    if (!tribox_kernel_name(&(tribox_options){.kernel = kernel}))
        return argument_fail("inputs", "no such kernel here:", kernel, "see tribox info");
    header_text(stdout, "", &(run){argc, argv, 1, machine_here()});
    static const struct {
        const char *scene;
        bool is_shared;
    } plan[] = {{"paper", false}, {"paper", true}, {"cache", true}, {"sorted", false}, {"sparse", false}, {"hit", false}};
    for (size_t k = 0; k < sizeof plan / sizeof plan[0]; k++)
        if (!run_scene(plan[k].scene, plan[k].is_shared, kernel, 1, how))
            return 1;
    return 0;
}
