/*
 * main.c - what is an index worth? Soups in the order of the file, along a Morton curve, and as tribox_soup_sort has them, asked
 * about boxes of four sizes in every form, against tribox_overlap without an index.
 *
 * Every form has to be right about boxes of every size, or nothing is timed.
 */
#include <stdio.h>

#include "common/header.h"
#include "common/mesh_list.h"
#include "common/whole.h"
#include "console/message.h"
#include "console/option_reader.h"
#include "index_measure.h"

enum { SCENES_MAX = MESH_LIST_MAX + 1 };

typedef struct settings {
    index_effort how;
    uint64_t terrain; /* triangles; 0 for none */
    bool is_json;
    mesh_list meshes;
} settings;

static const char usage[] =
    "Usage: index [--terrain N] [--boxes N] [--rounds N] [--kernel NAME] [--seed N] [--quick] [--json] [MESH...]\n"
    "Times questions about boxes by an index over a soup, in three orders, against the same without an index.\n"
    "  MESH             a mesh file; $TRIBOX_MESHES may name a folder to look in. Without one dragon_vrip, buildings, "
    "SainteHelens\n"
    "                   and sponza (.ply) of that folder\n"
    "  --terrain N      triangles of the terrain that is made here; without it 10000000; 0 for no terrain\n"
    "  --boxes N        boxes of each size; without it 100\n"
    "  --rounds N       rounds, 3 to 101; without it 9\n"
    "  --kernel NAME    the kernel to time; without it the widest\n"
    "  --seed N         of the terrain, the boxes and the order within the rounds\n"
    "  --quick          a terrain of 200000 triangles, 20 boxes, 3 rounds: some seconds\n"
    "  --json           JSON instead of tables\n";

enum { OPTION_TERRAIN, OPTION_BOXES, OPTION_ROUNDS, OPTION_KERNEL, OPTION_SEED, OPTION_QUICK, OPTION_JSON };

static const option_entry options[] = {[OPTION_TERRAIN] = {"terrain", 't', true}, [OPTION_BOXES] = {"boxes", 'b', true},
                                       [OPTION_ROUNDS] = {"rounds", 0, true},     [OPTION_KERNEL] = {"kernel", 'k', true},
                                       [OPTION_SEED] = {"seed", 0, true},         [OPTION_QUICK] = {"quick", 'q', false},
                                       [OPTION_JSON] = {"json", 'j', false},      {NULL, 0, false}};

static int take(void *request, int which, const char *value)
{
    settings *const s = request;
    switch (which) {
    case OPTION_TERRAIN:
        return whole_read(value, "terrain", 0, UINT32_MAX, &s->terrain);
    case OPTION_BOXES:
        return whole_read(value, "boxes", 1, 100000, &s->how.boxes);
    case OPTION_ROUNDS:
        return whole_read(value, "rounds", 3, 101, &s->how.rounds);
    case OPTION_KERNEL:
        s->how.kernel = tribox_kernel_name(&(tribox_options){.kernel = value});
        return s->how.kernel ? EXIT_CODE_OK : message_usage("--kernel: there is no '%s' here; see tribox info", value);
    case OPTION_SEED:
        return whole_read(value, "seed", 0, UINT64_MAX, &s->how.seed);
    case OPTION_QUICK:
        s->how.many = 2000;
        s->how.evicted = (size_t)16 << 20;
        return EXIT_CODE_OK;
    case OPTION_JSON:
        s->is_json = true;
        return EXIT_CODE_OK;
    default:
        return mesh_list_take(&s->meshes, value);
    }
}

/* What was not given. */
static void choose_rest(settings *s, const options_found *found)
{
    const bool is_quick = options_has(found, OPTION_QUICK);
    if (!options_has(found, OPTION_TERRAIN))
        s->terrain = is_quick ? 200000 : 10000000;
    if (!options_has(found, OPTION_BOXES))
        s->how.boxes = is_quick ? 20 : 100;
    if (!options_has(found, OPTION_ROUNDS))
        s->how.rounds = is_quick ? 3 : 9;
}

static bool run_scene(const index_scene *at, const settings *s, generator *order, json *out, scene_result *r)
{
    if (!index_measure(at, &s->how, order, r))
        return false;
    if (s->is_json)
        index_print_json(out, r);
    else
        index_print_scene(r);
    return true;
}

static bool run_all(const settings *s, json *out, scene_result *results, size_t *count)
{
    generator order = {~s->how.seed};
    bool is_run = true;
    index_scene at;
    *count = 0;
    for (size_t i = 0; is_run && i < s->meshes.count; i++) {
        is_run = index_scene_read(s->meshes.path[i], &at);
        if (is_run) {
            is_run = run_scene(&at, s, &order, out, &results[(*count)++]);
            index_scene_free(&at);
        }
    }
    if (is_run && s->terrain) {
        is_run = index_scene_terrain((size_t)s->terrain, s->how.seed, &at);
        if (is_run) {
            is_run = run_scene(&at, s, &order, out, &results[(*count)++]);
            index_scene_free(&at);
        }
    }
    return is_run;
}

static int report_json(const settings *s, const run *r, scene_result *results)
{
    json out = json_to(stdout);
    size_t count;
    json_open_object(&out, NULL);
    header_json(&out, r);
    json_string(&out, "kernel", s->how.kernel);
    json_open_rows(&out, "results");
    if (!run_all(s, &out, results, &count))
        return EXIT_CODE_FAILURE;
    json_close(&out);
    index_json_goals(&out, results, count);
    json_close(&out);
    return EXIT_CODE_OK;
}

static int report_text(const settings *s, const run *r, scene_result *results)
{
    size_t count;
    header_text(stdout, "", r);
    printf("kernel     %s\n", s->how.kernel);
    printf("%llu boxes of each size; us a box, the least of %llu rounds\n", (unsigned long long)s->how.boxes,
           (unsigned long long)s->how.rounds);
    if (!run_all(s, NULL, results, &count))
        return EXIT_CODE_FAILURE;
    index_print_goals(results, count);
    return EXIT_CODE_OK;
}

int main(int argc, char **argv)
{
    static scene_result results[SCENES_MAX];
    options_found found;
    settings s = {.how = {.many = 20000, .seed = 1, .evicted = (size_t)256 << 20, .kernel = tribox_kernel_name(NULL)}};
    message_set_program("index");
    const int code = options_read(argc, argv, options, take, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return fputs(usage, stdout) < 0;
    choose_rest(&s, &found);
    const char *const *usual;
    const size_t usual_count = s.meshes.count ? 0 : index_scene_usual(&usual);
    for (size_t k = 0; k < usual_count; k++)
        mesh_list_take(&s.meshes, usual[k]);
    const run r = {argc, argv, s.how.seed, machine_here()};
    return s.is_json ? report_json(&s, &r, results) : report_text(&s, &r, results);
}
