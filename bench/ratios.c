/*
 * ratios.c - how many times faster than the paper's test is each kernel, on a machine that other work may share?
 *
 * Ratios survive there where times do not: all contestants run in one process, interleaved in rounds, and are compared pair by
 * pair within a round. Nothing is timed before all answers agree.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/command_line.h"
#include "common/table.h"

typedef struct settings {
    uint64_t seed;
    effort how;
    const char *scene;  /* NULL for all */
    const char *filter; /* part of a contestant's name; NULL for all */
    bool is_json;
} settings;

static const char usage[] =
    "usage: ratios [--scene NAME] [--filter PART] [--rounds N] [--seed N] [--json]\n"
    "Times every kernel and accuracy against the paper's test, one thread, and prints a table for each scene.\n"
    "  --scene NAME   one scene; without it all of them, in a minute and a half\n"
    "  --filter PART  only contestants whose name contains PART (avx2, exact, avx2-fast, ...), and always the baseline\n"
    "  --rounds N     measure N rounds, 5 to 1000, however long they take; without it 31, or fewer where a scene is slow\n"
    "  --seed N       of the scenes and of the order within the rounds\n"
    "  --json         JSON instead of tables\n";

static int fail(const char *what, const char *which, const char *help) { return argument_fail("ratios", what, which, help); }

/* 0, or the exit status. */
static int read_settings(int argc, char **argv, settings *s)
{
    for (int i = 1; i < argc; i++) {
        const char *const option = argv[i];
        if (!strcmp(option, "--json")) {
            s->is_json = true;
            continue;
        }
        const bool is_known =
            !strcmp(option, "--scene") || !strcmp(option, "--filter") || !strcmp(option, "--rounds") || !strcmp(option, "--seed");
        if (!is_known)
            return fail("unknown option", option, "see ratios --help");
        if (++i == argc)
            return fail("no value after", option, "see ratios --help");
        uint64_t rounds;
        if (!strcmp(option, "--scene")) {
            size_t index;
            s->scene = argv[i];
            if (!argument_scene("ratios", s->scene, &index))
                return 2;
        } else if (!strcmp(option, "--filter"))
            s->filter = argv[i];
        else if (!strcmp(option, "--seed") && !argument_number(argv[i], 0, UINT64_MAX, &s->seed))
            return fail("bad seed", argv[i], "give a whole number below 2^64");
        else if (!strcmp(option, "--rounds")) {
            if (!argument_number(argv[i], MEASURE_LEAST, MEASURE_MOST, &rounds))
                return fail("bad number of rounds", argv[i], "give 5 to 1000");
            s->how = (effort){.rounds = (size_t)rounds, .seconds = 1e9, .sample = 2e-3};
        }
    }
    return 0;
}

/* Those that the filter keeps, the baseline first. */
static size_t keep_named(contestant *list, size_t count, const char *part)
{
    size_t kept = 0;
    for (size_t c = 0; c < count; c++)
        if (!part || list[c].kind == CONTESTANT_BASELINE || strstr(list[c].name, part))
            list[kept++] = list[c];
    return kept;
}

static bool run_scene(size_t index, const settings *s, const contestant *list, size_t count, generator *order, bool is_first)
{
    static samples taken;
    score scores[CONTESTANTS_MAX];
    scene at;
    if (!scene_make(index, s->seed, &at))
        return false;
    uint64_t *const mask = calloc(tribox_mask_words(at.soup.count), sizeof *mask);
    const bool is_right = mask && contest_verify(list, count, &at, scores);
    if (is_right) {
        measure(list, count, &at, 1, s->how, order, mask, &taken);
        const result r = {&at, list, scores, &taken};
        if (s->is_json)
            json_scene(&r, is_first);
        else
            table_scene(&r);
    }
    free(mask);
    scene_free(&at);
    return is_right;
}

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "--help")) {
        fputs(usage, stdout);
        return 0;
    }
    settings s = {.seed = 1, .how = {.rounds = 31, .seconds = 8, .sample = 2e-3}};
    const int status = read_settings(argc, argv, &s);
    if (status)
        return status;

    contestant list[CONTESTANTS_MAX];
    const size_t count = keep_named(list, contest_enter(list), s.filter);
    if (s.filter && count == 1 && !strstr(list[0].name, s.filter))
        return fail("no contestant here has in its name", s.filter, "the table of a run without --filter has them all");
    const run r = {argc, argv, s.seed, machine_here()};
    if (s.is_json)
        json_begin(&r);
    else
        table_begin(&r);

    generator order = {~s.seed};
    bool is_first = true;
    for (size_t i = 0; i < scene_count(); i++) {
        if (s.scene && strcmp(s.scene, scene_name(i)) != 0)
            continue;
        if (!run_scene(i, &s, list, count, &order, is_first))
            return 1;
        is_first = false;
    }
    if (s.is_json)
        json_end();
    return 0;
}
