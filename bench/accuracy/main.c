/*
 * main.c - what does exactness cost, and what does it save one from? Every scene, accuracy, choice of axes and kernel: time, and
 * errors against the true answer. The contestants of one choice of axes run interleaved.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/mesh_list.h"
#include "common/soups.h"
#include "common/whole.h"
#include "console/message.h"
#include "console/option_reader.h"
#include "sweep/cells.h"
#include "trade.h"

enum { CELLS_MOST = 4096, DEPTH_MOST = 12 };

typedef struct settings {
    uint64_t seed, along, cells; /* of a mesh: cells along a side of the cube over it, and how many of them at most */
    effort how;
    size_t triangles;  /* of a scene, at most */
    const char *scene; /* NULL for all */
    bool has_scenes;
    const char *csv, *json; /* NULL for none */
    mesh_list meshes;
} settings;

static const char usage[] =
    "Usage: accuracy [--quick] [--scene NAME] [--csv FILE] [--json FILE] [--rounds N] [--seed N]\n"
    "                [--octree DEPTH | --grid N] [--cells N] [--no-scenes] [MESH...]\n"
    "Times every kernel, accuracy and choice of axes on scenes and meshes, counts the errors, and prints a table.\n"
    "  --quick        fewer rounds, and the first 65536 triangles of a scene: twenty seconds instead of two minutes\n"
    "  --scene NAME   one scene; without it ten of them\n"
    "  --csv FILE     the table with all columns, for the chart\n"
    "  --json FILE    the same as JSON\n"
    "  --rounds N     measure N rounds, 5 to 1000, however long they take; without it 31, or fewer where a scene is slow\n"
    "  --seed N       of the scenes, of the cells and of the order within the rounds\n"
    "  MESH           also a mesh file, against cells that at least one of its triangles overlaps\n"
    "  --octree DEPTH the leaves of an octree over the mesh, 0 to 12 deep; without it 5\n"
    "  --grid N       instead, the cells of a grid with N along the longest side, 1 to 4096\n"
    "  --cells N      at most N cells of a mesh, 1 to 4096; without it 16\n"
    "  --no-scenes    meshes alone\n";

enum {
    OPTION_QUICK,
    OPTION_SCENE,
    OPTION_CSV,
    OPTION_JSON,
    OPTION_ROUNDS,
    OPTION_SEED,
    OPTION_OCTREE,
    OPTION_GRID,
    OPTION_CELLS,
    OPTION_NO_SCENES
};

static const option_entry options[] = {[OPTION_QUICK] = {"quick", 'q', false},
                                       [OPTION_SCENE] = {"scene", 's', true},
                                       [OPTION_CSV] = {"csv", 0, true},
                                       [OPTION_JSON] = {"json", 'j', true},
                                       [OPTION_ROUNDS] = {"rounds", 'r', true},
                                       [OPTION_SEED] = {"seed", 0, true},
                                       [OPTION_OCTREE] = {"octree", 0, true},
                                       [OPTION_GRID] = {"grid", 0, true},
                                       [OPTION_CELLS] = {"cells", 0, true},
                                       [OPTION_NO_SCENES] = {"no-scenes", 0, false},
                                       {NULL, 0, false}};

static int take_rounds(settings *s, const char *value)
{
    uint64_t rounds;
    if (whole_read(value, "rounds", MEASURE_LEAST, MEASURE_MOST, &rounds))
        return EXIT_CODE_USAGE;
    s->how = (effort){.rounds = (size_t)rounds, .seconds = 1e9, .sample = 2e-3};
    return EXIT_CODE_OK;
}

static int take_depth(settings *s, const char *value)
{
    uint64_t depth;
    if (whole_read(value, "octree", 0, DEPTH_MOST, &depth))
        return EXIT_CODE_USAGE;
    s->along = UINT64_C(1) << depth;
    return EXIT_CODE_OK;
}

static int take(void *request, int which, const char *value)
{
    settings *const s = request;
    size_t index;
    switch (which) {
    case OPTION_QUICK:
        s->how = (effort){.rounds = MEASURE_LEAST, .seconds = 0, .sample = 1e-3};
        s->triangles = 65536;
        return EXIT_CODE_OK;
    case OPTION_SCENE:
        s->scene = value;
        return scene_find(value, &index) ? EXIT_CODE_OK : EXIT_CODE_USAGE;
    case OPTION_CSV:
        s->csv = value;
        return EXIT_CODE_OK;
    case OPTION_JSON:
        s->json = value;
        return EXIT_CODE_OK;
    case OPTION_ROUNDS:
        return take_rounds(s, value);
    case OPTION_SEED:
        return whole_read(value, "seed", 0, UINT64_MAX, &s->seed);
    case OPTION_OCTREE:
        return take_depth(s, value);
    case OPTION_GRID:
        return whole_read(value, "grid", 1, CELLS_ALONG_MOST, &s->along);
    case OPTION_CELLS:
        return whole_read(value, "cells", 1, CELLS_MOST, &s->cells);
    case OPTION_NO_SCENES:
        s->has_scenes = false;
        return EXIT_CODE_OK;
    default:
        return mesh_list_take(&s->meshes, value);
    }
}

static const char *const scenes_of_all[] = {"paper",        "sparse", "cad",     "cad-tenths", "touching",
                                            "touching-ulp", "offset", "needles", "caps",       "thin"};
enum { SCENES = sizeof scenes_of_all / sizeof scenes_of_all[0] };

static const struct {
    const char *name;
    unsigned axes;
} choices[] = {
    {"all", TRIBOX_AXES_ALL},
    {"box", TRIBOX_AXES_BOX},
    {"box+plane", TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE},
    {"box+edges", TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES},
    {"plane+edges", TRIBOX_AXES_PLANE | TRIBOX_AXES_EDGES},
    {"edges", TRIBOX_AXES_EDGES},
};
enum { CHOICES = sizeof choices / sizeof choices[0] };

/* Where the rows go, and what was drawn so far. */
typedef struct output {
    FILE *csv, *json_file;
    json rows;
    bool is_first;
    generator order;
} output;

/* Kernels at every accuracy, the widest first; with all axes the paper's test before them. */
static size_t enter(const timing_work *work, unsigned axes, contestant *list)
{
    const size_t all = entries_make(work, list);
    size_t count = 0;
    for (size_t c = 0; c < all; c++) {
        contestant one = list[c];
        if (one.options.kernel)
            one.options.axes = axes;
        else if (!entry_is_baseline(&one) || axes != TRIBOX_AXES_ALL)
            continue;
        list[count++] = one;
    }
    return count;
}

static bool run_choice(size_t choice, const scene *at, const settings *s, output *out, uint64_t *mask)
{
    static samples taken;
    contestant list[CONTESTANTS_MAX];
    score scores[CONTESTANTS_MAX];
    const truth from = truth_of_work(&at->work);
    const size_t count = enter(&at->work, choices[choice].axes, list);
    if (!entries_verify(list, count, at->name, &from, scores))
        return false;
    measure(list, count, s->how, &out->order, mask, &taken);
    const trade t = {at, choices[choice].name, list, scores, &taken};
    if (choice == 0)
        trade_table_scene(&t);
    trade_table(&t);
    if (out->csv)
        trade_csv(out->csv, &t, out->is_first);
    if (out->json_file)
        trade_json(&out->rows, &t);
    out->is_first = false;
    return true;
}

static bool run_choices(const scene *at, const settings *s, output *out)
{
    uint64_t *const mask = malloc(at->work.words * sizeof *mask);
    bool is_right = mask || message_failure("out of memory for scene %s", at->name) == EXIT_CODE_OK;
    for (size_t choice = 0; is_right && choice < CHOICES; choice++)
        is_right = run_choice(choice, at, s, out, mask);
    free(mask);
    return is_right;
}

static bool run_scene(size_t index, const settings *s, output *out)
{
    scene at;
    if (!scene_make(index, s->seed, &at))
        return false;
    timing_work_shorten(&at.work, s->triangles);
    const bool is_right = run_choices(&at, s, out);
    scene_free(&at);
    return is_right;
}

static bool is_wanted(const settings *s, const char *name)
{
    if (s->scene || !s->has_scenes)
        return s->scene && !strcmp(s->scene, name);
    for (size_t k = 0; k < SCENES; k++)
        if (!strcmp(scenes_of_all[k], name))
            return true;
    return false;
}

/* The name of a file without its folder and its ending. */
static void name_of_file(const char *path, char name[64])
{
    snprintf(name, 64, "%s", mesh_list_name(path));
    char *const dot = strrchr(name, '.');
    if (dot && dot != name)
        *dot = 0;
}

static bool run_mesh(const char *path, const settings *s, output *out)
{
    char name[64], what[80];
    mesh read;
    if (!mesh_list_read(path, &read))
        return false;
    name_of_file(path, name);
    snprintf(what, sizeof what, "a mesh, against cells of a grid, %llu along its longest side", (unsigned long long)s->along);
    scene at = {.name = name, .what = what};
    const char *const failure = read.not_finite == read.soup.count
                                    ? "no triangle has finite coordinates"
                                    : cells_work(&read.soup, (unsigned)s->along, (size_t)s->cells, s->seed, &at.work);
    mesh_free(&read);
    if (failure)
        return message_failure("%s: %s", path, failure) == EXIT_CODE_OK;
    const bool is_right = run_choices(&at, s, out);
    scene_free(&at);
    return is_right;
}

static bool run_all(const settings *s, output *out)
{
    for (size_t i = 0; i < scene_count(); i++)
        if (is_wanted(s, scene_name(i)) && !run_scene(i, s, out))
            return false;
    for (size_t m = 0; m < s->meshes.count; m++)
        if (!run_mesh(s->meshes.path[m], s, out))
            return false;
    return true;
}

static bool open_file(const char *path, FILE **file)
{
    *file = path ? fopen(path, "w") : NULL;
    if (path && !*file)
        message_say("cannot write '%s'; does its folder exist?", path);
    return !path || *file;
}

static bool close_file(const char *path, FILE *file)
{
    const bool is_lost = file && ferror(file);
    const bool is_written = !file || (!fclose(file) && !is_lost);
    if (!is_written)
        message_say("'%s' is not complete; is the disk full?", path);
    return is_written;
}

static bool run_into(output *out, const run *r, const settings *s)
{
    header_text(stdout, "", r);
    if (out->csv)
        trade_csv_begin(out->csv, r);
    if (out->json_file) {
        out->rows = json_to(out->json_file);
        json_open_object(&out->rows, NULL);
        header_json(&out->rows, r);
        json_open_rows(&out->rows, "rows");
    }
    const bool is_right = run_all(s, out);
    if (out->json_file) {
        json_close(&out->rows);
        json_close(&out->rows);
    }
    return is_right;
}

int main(int argc, char **argv)
{
    options_found found;
    settings s = {.seed = 1,
                  .how = {.rounds = 31, .seconds = 1.5, .sample = 2e-3},
                  .triangles = SIZE_MAX,
                  .has_scenes = true,
                  .along = 32,
                  .cells = 16};
    message_set_program("accuracy");
    const int code = options_read(argc, argv, options, take, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return fputs(usage, stdout) < 0;
    if (!s.has_scenes && !s.scene && !s.meshes.count)
        return message_usage("nothing to run: --no-scenes wants a mesh file");
    output out = {.is_first = true, .order = {~s.seed}};
    if (!open_file(s.csv, &out.csv) || !open_file(s.json, &out.json_file))
        return EXIT_CODE_FAILURE;
    const run r = {argc, argv, s.seed, machine_here()};
    const bool is_right = run_into(&out, &r, &s), is_written = close_file(s.csv, out.csv);
    return close_file(s.json, out.json_file) && is_written && is_right ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
}
