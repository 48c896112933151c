/*
 * main.c - which order of the axes is the fastest, and why? Measures every kernel, accuracy and order on one scene after the other,
 * in one process. order_sweep.py runs many such processes, joins what they measured, and draws it.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/header.h"
#include "common/whole.h"
#include "console/message.h"
#include "console/option_reader.h"
#include "order_scenes.h"
#include "sweep/order_report.h"

typedef struct settings {
    const char *scene; /* NULL for all */
    const char *mesh;  /* NULL for scenes */
    uint64_t size, seed, turns, seconds;
    bool is_json, is_list;
} settings;

static const char usage[] =
    "Usage: order [--scene NAME | --mesh FILE] [--size N] [--seconds N] [--seed N] [--turns N] [--json]\n"
    "       order --list\n"
    "Times every order of the axes, with every kernel and accuracy, on one thread, and counts which axes reject what.\n"
    "  --scene NAME  one scene; without it all of them, in a minute or two\n"
    "  --mesh FILE   the leaves of an octree of a mesh\n"
    "  --size N      pairs of a triangle and a box, 64 to 100 million; without it 20,000\n"
    "  --seconds N   start rounds for N seconds, but measure 5 at least; without it 2\n"
    "  --seed N      of the scenes\n"
    "  --turns N     seed of the order within the rounds\n"
    "  --json        JSON, with the times of all rounds, instead of tables\n"
    "  --list        the names of the scenes\n";

enum { OPTION_SCENE, OPTION_MESH, OPTION_SIZE, OPTION_SECONDS, OPTION_SEED, OPTION_TURNS, OPTION_JSON, OPTION_LIST };

static const option_entry options[] = {
    [OPTION_SCENE] = {"scene", 's', true},   [OPTION_MESH] = {"mesh", 0, true},    [OPTION_SIZE] = {"size", 0, true},
    [OPTION_SECONDS] = {"seconds", 0, true}, [OPTION_SEED] = {"seed", 0, true},    [OPTION_TURNS] = {"turns", 0, true},
    [OPTION_JSON] = {"json", 'j', false},    [OPTION_LIST] = {"list", 'l', false}, {NULL, 0, false}};

static bool is_scene(const char *name)
{
    for (size_t s = 0; s < order_scene_count(); s++)
        if (!strcmp(name, order_scene_name(s)))
            return true;
    return false;
}

static int take(void *request, int which, const char *value)
{
    settings *const s = request;
    switch (which) {
    case OPTION_SCENE:
        s->scene = value;
        return is_scene(value) ? EXIT_CODE_OK : message_usage("unknown scene '%s'; order --list names them", value);
    case OPTION_MESH:
        s->mesh = value;
        return EXIT_CODE_OK;
    case OPTION_SIZE:
        return whole_read(value, "size", 64, 100000000, &s->size);
    case OPTION_SECONDS:
        return whole_read(value, "seconds", 0, 3600, &s->seconds);
    case OPTION_SEED:
        return whole_read(value, "seed", 0, UINT64_MAX, &s->seed);
    case OPTION_TURNS:
        return whole_read(value, "turns", 0, UINT64_MAX, &s->turns);
    case OPTION_JSON:
        s->is_json = true;
        return EXIT_CODE_OK;
    case OPTION_LIST:
        s->is_list = true;
        return EXIT_CODE_OK;
    default:
        return message_usage("unexpected '%s'", value);
    }
}

typedef struct result {
    const char *name, *what;
    const timing_work *work;
    const sweep *s;
    const why *w;
} result;

static void print_text(const result *r)
{
    printf("\nscene %s: %s; %zu pairs (%.3g MB) in %zu soup%s\n\n", r->name, r->what, r->work->pairs,
           36e-6 * (double)r->work->pairs, r->work->count, r->work->count == 1 ? "" : "s");
    report_times(stdout, r->s);
    printf("\n");
    report_axes(stdout, r->s, r->w);
    printf("\n");
    report_why(stdout, r->w);
    fflush(stdout);
}

static void print_json(json *to, const result *r)
{
    json_open_object(to, NULL);
    json_string(to, "scene", r->name);
    json_string(to, "what", r->what);
    json_whole(to, "soups", r->work->count);
    report_json_why(to, r->w);
    report_json_sweep(to, r->s);
    json_close(to);
}

static bool run_work(const char *name, const char *what, const timing_work *work, const settings *s, json *out)
{
    static sweep swept;
    static why found;
    generator turns = {s->turns};
    const char *const failure = sweep_run(&swept, work, (double)s->seconds, &turns);
    if (failure)
        return message_failure("scene %s: %s; nothing is reported", name, failure) == EXIT_CODE_OK;
    why_find(work, &found);
    const result r = {name, what, work, &swept, &found};
    if (s->is_json)
        print_json(out, &r);
    else
        print_text(&r);
    return true;
}

static bool run_mesh(const settings *s, json *out)
{
    const char *const slash = strrchr(s->mesh, '/');
    timing_work work;
    if (!order_scene_of_mesh(s->mesh, (size_t)s->size, &work))
        return false;
    const bool is_run = run_work(slash ? slash + 1 : s->mesh, "a mesh against the leaves of its octree", &work, s, out);
    timing_work_free(&work);
    return is_run;
}

static bool run_scenes(const settings *s, json *out)
{
    for (size_t i = 0; i < order_scene_count(); i++) {
        timing_work work;
        if (s->scene && strcmp(s->scene, order_scene_name(i)) != 0)
            continue;
        if (!order_scene_make(i, (size_t)s->size, s->seed, &work))
            return false;
        const bool is_run = run_work(order_scene_name(i), order_scene_what(i), &work, s, out);
        timing_work_free(&work);
        if (!is_run)
            return false;
    }
    return true;
}

static int list_scenes(void)
{
    for (size_t s = 0; s < order_scene_count(); s++)
        printf("%-10s %s\n", order_scene_name(s), order_scene_what(s));
    return 0;
}

static bool run_chosen(const settings *s, json *out) { return s->mesh ? run_mesh(s, out) : run_scenes(s, out); }

int main(int argc, char **argv)
{
    options_found found;
    settings s = {.size = 20000, .seconds = 2, .seed = 1, .turns = 1};
    message_set_program("order");
    const int code = options_read(argc, argv, options, take, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return fputs(usage, stdout) < 0;
    if (s.scene && s.mesh)
        return message_usage("--scene and --mesh exclude each other");
    if (s.is_list)
        return list_scenes();
    const run r = {argc, argv, s.seed, machine_here()};
    json out = json_to(stdout);
    if (!s.is_json) {
        header_text(stdout, "", &r);
        return !run_chosen(&s, &out);
    }
    json_open_object(&out, NULL);
    header_json(&out, &r);
    json_open_rows(&out, "scenes");
    if (!run_chosen(&s, &out))
        return EXIT_CODE_FAILURE;
    json_close(&out);
    json_close(&out);
    return EXIT_CODE_OK;
}
