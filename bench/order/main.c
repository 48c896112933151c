/*
 * main.c - which order of the axes is the fastest, and why? Every kernel, accuracy and order on one scene after the other, in one
 * process. order_sweep.py runs many such processes, joins what they measured, and draws it.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/command_line.h"
#include "common/contest.h"
#include "common/header.h"
#include "sweep/order_report.h"
#include "order_scenes.h"

typedef struct settings {
    const char *scene; /* NULL for all */
    const char *mesh;  /* NULL for scenes */
    uint64_t size, seed, turns, seconds;
    bool is_json, is_list;
} settings;

static const char usage[] =
    "usage: order [--scene NAME | --mesh FILE] [--size N] [--seconds N] [--seed N] [--turns N] [--json]\n"
    "       order --list\n"
    "Times every order of the axes, with every kernel and accuracy, one thread, and tells which axes reject what.\n"
    "  --scene NAME  one scene; without it all of them, in a minute or two\n"
    "  --mesh FILE   the leaves of an octree of a mesh\n"
    "  --size N      pairs of a triangle and a box, 64 to 100 million; without it 20,000\n"
    "  --seconds N   rounds for so long, 5 rounds at least; without it 2\n"
    "  --seed N      of the scenes\n"
    "  --turns N     seed of the turns that the contestants take\n"
    "  --json        JSON, with the times of all rounds, in place of tables\n"
    "  --list        the names of the scenes\n";

static bool is_scene(const char *name)
{
    for (size_t s = 0; s < order_scene_count(); s++)
        if (!strcmp(name, order_scene_name(s)))
            return true;
    return false;
}

static int take_value(settings *s, const char *option, const char *value)
{
    if (!strcmp(option, "--mesh"))
        s->mesh = value;
    else if (!strcmp(option, "--scene") && !is_scene(value))
        return argument_fail("order", "unknown scene", value, "see order --list");
    else if (!strcmp(option, "--scene"))
        s->scene = value;
    else if (!strcmp(option, "--size") && !argument_number(value, 64, 100000000, &s->size))
        return argument_fail("order", "bad size", value, "give 64 to 100000000");
    else if (!strcmp(option, "--seconds") && !argument_number(value, 0, 3600, &s->seconds))
        return argument_fail("order", "bad number of seconds", value, "give 0 to 3600");
    else if (!strcmp(option, "--seed") && !argument_number(value, 0, UINT64_MAX, &s->seed))
        return argument_fail("order", "bad seed", value, "give a whole number below 2^64");
    else if (!strcmp(option, "--turns") && !argument_number(value, 0, UINT64_MAX, &s->turns))
        return argument_fail("order", "bad seed", value, "give a whole number below 2^64");
    return 0;
}

/* 0, or the exit status. */
static int read_settings(int argc, char **argv, settings *s)
{
    static const char *const with_value[] = {"--scene", "--mesh", "--size", "--seconds", "--seed", "--turns"};
    for (int i = 1; i < argc; i++) {
        const char *const option = argv[i];
        bool takes_value = false;
        for (size_t o = 0; o < sizeof with_value / sizeof with_value[0]; o++)
            takes_value |= !strcmp(option, with_value[o]);
        if (!strcmp(option, "--json"))
            s->is_json = true;
        else if (!strcmp(option, "--list"))
            s->is_list = true;
        else if (!takes_value)
            return argument_fail("order", "unknown option", option, "see order --help");
        else if (i + 1 == argc)
            return argument_fail("order", "no value after", option, "see order --help");
        else {
            const int status = take_value(s, option, argv[++i]);
            if (status)
                return status;
        }
    }
    return s->scene && s->mesh ? argument_fail("order", "one of --scene and", "--mesh", "each is a scene of its own") : 0;
}

static size_t kernels_here(const char **names)
{
    contestant all[CONTESTANTS_MAX];
    const size_t count = contest_enter(all);
    size_t kernels = 0;
    for (size_t c = 0; c < count; c++)
        if (all[c].kind == CONTESTANT_KERNEL && all[c].options.accuracy == TRIBOX_EXACT)
            names[kernels++] = all[c].options.kernel;
    return kernels;
}

typedef struct result {
    const char *name, *what;
    const order_work *work;
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

static void print_json(const result *r, bool is_first)
{
    printf("%s\n{\"scene\": ", is_first ? "" : ",");
    json_string(stdout, r->name);
    printf(", \"what\": ");
    json_string(stdout, r->what);
    printf(", \"soups\": %zu, ", r->work->count);
    report_json_why(stdout, r->w);
    printf(",\n ");
    report_json_sweep(stdout, r->s);
    printf("}");
}

static bool run_work(const char *name, const char *what, const order_work *work, const settings *s, bool is_first)
{
    static sweep swept;
    static why found;
    const char *kernels[SWEEP_KERNELS_MAX];
    generator turns = {s->turns};
    sweep_enter(&swept, kernels, kernels_here(kernels));
    const char *failure = sweep_verify(&swept, work);
    if (!failure)
        failure = sweep_measure(&swept, work, (double)s->seconds, 5, &turns);
    if (failure) {
        fprintf(stderr, "order: scene %s: %s; nothing is reported\n", name, failure);
        return false;
    }
    why_find(work, &found);
    const result r = {name, what, work, &swept, &found};
    if (s->is_json)
        print_json(&r, is_first);
    else
        print_text(&r);
    return true;
}

static bool run_mesh(const settings *s)
{
    const char *const slash = strrchr(s->mesh, '/');
    order_work work;
    if (!order_scene_of_mesh(s->mesh, (size_t)s->size, &work))
        return false;
    const bool is_run = run_work(slash ? slash + 1 : s->mesh, "a mesh against the leaves of its octree", &work, s, true);
    order_work_free(&work);
    return is_run;
}

static bool run_scenes(const settings *s)
{
    bool is_first = true, is_run = true;
    for (size_t i = 0; is_run && i < order_scene_count(); i++) {
        order_work work;
        if (s->scene && strcmp(s->scene, order_scene_name(i)) != 0)
            continue;
        is_run = order_scene_make(i, (size_t)s->size, s->seed, &work);
        if (!is_run)
            return false;
        is_run = run_work(order_scene_name(i), order_scene_what(i), &work, s, is_first);
        order_work_free(&work);
        is_first = false;
    }
    return is_run;
}

static int list_scenes(void)
{
    for (size_t s = 0; s < order_scene_count(); s++)
        printf("%-10s %s\n", order_scene_name(s), order_scene_what(s));
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "--help")) {
        fputs(usage, stdout);
        return 0;
    }
    settings s = {.size = 20000, .seconds = 2, .seed = 1, .turns = 1};
    const int status = read_settings(argc, argv, &s);
    if (status)
        return status;
    if (s.is_list)
        return list_scenes();

    const run r = {argc, argv, s.seed, machine_here()};
    if (s.is_json) {
        printf("{");
        header_json(stdout, &r);
        printf(",\n\"scenes\": [");
    } else {
        header_text(stdout, "", &r);
    }
    const bool is_run = s.mesh ? run_mesh(&s) : run_scenes(&s);
    if (s.is_json)
        printf("]}\n");
    return is_run ? 0 : 1;
}
