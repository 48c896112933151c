/* ratios.c - how many times as fast as the paper's test is each kernel, and what does each accuracy cost? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/mesh_list.h"
#include "common/soups.h"
#include "common/table.h"
#include "common/whole.h"
#include "console/message.h"
#include "console/option_reader.h"

typedef struct settings {
    uint64_t seed;
    effort how;
    const char *scene;  /* NULL for all */
    const char *filter; /* part of a contestant's name; NULL for all */
    bool is_json;
    mesh_list meshes;
} settings;

static const char usage[] =
    "Usage: ratios [--scene NAME] [--filter PART] [--rounds N] [--seed N] [--json] [MESH...]\n"
    "Times every kernel and accuracy against the paper's test, on one thread, and prints a table for each scene.\n"
    "  MESH           a PLY, OFF or OBJ file, against a box of half its sides and of a tenth, instead of the scenes;\n"
    "                 $TRIBOX_MESHES may name a folder to look in\n"
    "  --scene NAME   one scene; without it all of them, in a minute and a half\n"
    "  --filter PART  only contestants whose name contains PART (avx2, exact, avx2-fast, ...), and always the baseline\n"
    "  --rounds N     measure N rounds, 5 to 1000, however long they take; without it 31, or fewer where a scene is slow\n"
    "  --seed N       of the scenes and of the order within the rounds\n"
    "  --json         JSON instead of tables\n";

enum { OPTION_SCENE, OPTION_FILTER, OPTION_ROUNDS, OPTION_SEED, OPTION_JSON };

static const option_entry options[] = {
    [OPTION_SCENE] = {"scene", 's', true}, [OPTION_FILTER] = {"filter", 'f', true}, [OPTION_ROUNDS] = {"rounds", 'r', true},
    [OPTION_SEED] = {"seed", 0, true},     [OPTION_JSON] = {"json", 'j', false},    {NULL, 0, false}};

static int take(void *request, int which, const char *value)
{
    settings *const s = request;
    size_t index;
    uint64_t rounds;
    switch (which) {
    case OPTION_SCENE:
        s->scene = value;
        return scene_find(value, &index) ? EXIT_CODE_OK : EXIT_CODE_USAGE;
    case OPTION_FILTER:
        s->filter = value;
        return EXIT_CODE_OK;
    case OPTION_ROUNDS:
        s->how.seconds = 1e9;
        if (whole_read(value, "rounds", MEASURE_LEAST, MEASURE_MOST, &rounds))
            return EXIT_CODE_USAGE;
        s->how.rounds = (size_t)rounds;
        return EXIT_CODE_OK;
    case OPTION_SEED:
        return whole_read(value, "seed", 0, UINT64_MAX, &s->seed);
    case OPTION_JSON:
        s->is_json = true;
        return EXIT_CODE_OK;
    default:
        return mesh_list_take(&s->meshes, value);
    }
}

/* Those that the filter keeps, the baseline first. */
static size_t keep_named(contestant *list, size_t count, const char *part)
{
    size_t kept = 0;
    for (size_t c = 0; c < count; c++)
        if (!part || entry_is_baseline(&list[c]) || strstr(list[c].name, part))
            list[kept++] = list[c];
    return kept;
}

static bool run_made(const scene *at, const settings *s, generator *order, json *out)
{
    static samples taken;
    contestant list[CONTESTANTS_MAX];
    score scores[CONTESTANTS_MAX];
    const truth from = truth_of_work(&at->work);
    const size_t count = keep_named(list, entries_make(&at->work, list), s->filter);
    uint64_t *const mask = calloc(at->work.words, sizeof *mask);
    const bool is_right = mask && entries_verify(list, count, at->name, &from, scores);
    if (is_right) {
        measure(list, count, s->how, order, mask, &taken);
        const result r = {at, list, scores, &taken};
        if (s->is_json)
            table_json(out, &r);
        else
            table_scene(&r);
    }
    free(mask);
    return is_right;
}

static bool run_scene(size_t index, const settings *s, generator *order, json *out)
{
    scene at;
    if (!scene_make(index, s->seed, &at))
        return false;
    const bool is_right = run_made(&at, s, order, out);
    scene_free(&at);
    return is_right;
}

/* A share of each side, about the middle. */
static tribox_box box_in(const indexed_mesh *m, double share)
{
    const float *const positions = m->positions;
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        double lo = INFINITY, hi = -INFINITY;
        for (size_t v = 0; v < m->vertices; v++) {
            lo = fmin(lo, (double)positions[3 * v + (size_t)a]);
            hi = fmax(hi, (double)positions[3 * v + (size_t)a]);
        }
        box.lo[a] = (lo + hi) / 2 - (hi - lo) / 2 * share;
        box.hi[a] = (lo + hi) / 2 + (hi - lo) / 2 * share;
    }
    return box;
}

/* With the vertices and the order of the file. */
static bool make_mesh(const indexed_mesh *m, double share, scene *at)
{
    const float *const positions = m->positions;
    if (!timing_work_make(&at->work, 1, timing_work_room(m->triangles)))
        return message_failure("out of memory for %zu triangles", m->triangles) == EXIT_CODE_OK;
    for (size_t corner = 0; corner < 3 * m->triangles; corner++)
        memcpy(at->work.triangles[corner / 3][corner % 3], positions + 3 * (size_t)m->corners[corner], 3 * sizeof(float));
    const timing_job job = timing_work_soup(&at->work, m->triangles);
    const tribox_box box = box_in(m, share);
    timing_work_add(&at->work, &job, &box);
    at->work.mesh = (tribox_mesh){
        .positions = positions, .vertices = m->vertices, .indices = m->corners, .index_bytes = 4, .count = m->triangles};
    return true;
}

static bool run_meshes(const settings *s, generator *order, json *out)
{
    bool is_right = true;
    for (size_t k = 0; is_right && k < s->meshes.count; k++) {
        indexed_mesh m;
        is_right = mesh_list_read_indexed(s->meshes.path[k], &m);
        for (int part = 0; is_right && part < 2; part++) {
            scene at = {.name = mesh_list_name(s->meshes.path[k]), .what = part ? "a tenth of its sides" : "half its sides"};
            is_right = make_mesh(&m, part ? 0.1 : 0.5, &at) && run_made(&at, s, order, out);
            scene_free(&at);
        }
        indexed_mesh_free(&m);
    }
    return is_right;
}

static bool run_scenes(const settings *s, json *out)
{
    generator order = {~s->seed};
    if (s->meshes.count && !s->scene)
        return run_meshes(s, &order, out);
    for (size_t i = 0; i < scene_count(); i++)
        if ((!s->scene || !strcmp(s->scene, scene_name(i))) && !run_scene(i, s, &order, out))
            return false;
    return true;
}

static bool has_named(const char *part)
{
    contestant list[CONTESTANTS_MAX];
    const timing_work none = {.mesh = {.count = 1}};
    const size_t count = entries_make(&none, list);
    for (size_t c = 0; c < count; c++)
        if (strstr(list[c].name, part))
            return true;
    return false;
}

int main(int argc, char **argv)
{
    options_found found;
    settings s = {.seed = 1, .how = {.rounds = 31, .seconds = 8, .sample = 2e-3}};
    message_set_program("ratios");
    const int code = options_read(argc, argv, options, take, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return fputs(usage, stdout) < 0;
    if (s.filter && !has_named(s.filter))
        return message_usage("--filter: no contestant here has '%s' in its name; a run without --filter shows them all", s.filter);
    const run r = {argc, argv, s.seed, machine_here()};
    json out = json_to(stdout);
    if (!s.is_json) {
        header_text(stdout, "", &r);
        return !run_scenes(&s, &out);
    }
    json_open_object(&out, NULL);
    header_json(&out, &r);
    json_open_rows(&out, "scenes");
    if (!run_scenes(&s, &out))
        return EXIT_CODE_FAILURE;
    json_close(&out);
    json_close(&out);
    return EXIT_CODE_OK;
}
