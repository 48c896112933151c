#include "accuracy_options.h"

#include <stdio.h>
#include <string.h>

#include "common/command_line.h"

static const char usage[] =
    "usage: accuracy [--quick] [--scene NAME] [--csv FILE] [--json FILE] [--rounds N] [--seed N]\n"
    "                [--octree DEPTH | --grid N] [--cells N] [--no-scenes] [MESH...]\n"
    "Times every kernel, accuracy and choice of axes on scenes and meshes, counts the errors, and prints a table.\n"
    "  --quick        fewer rounds, and the first 65536 triangles of a scene: twenty seconds instead of two minutes\n"
    "  --scene NAME   one scene; without it nine of them\n"
    "  --csv FILE     the table with all columns, for the chart\n"
    "  --json FILE    the same as JSON\n"
    "  --rounds N     measure N rounds, 5 to 1000, however long they take; without it 31, or fewer where a scene is slow\n"
    "  --seed N       of the scenes, of the cells and of the order within the rounds\n"
    "  MESH           also a mesh file, against cells that at least one of its triangles overlaps\n"
    "  --octree DEPTH the leaves of an octree over the mesh, 0 to 12 deep; without it 5\n"
    "  --grid N       instead, the cells of a grid with N along the longest side, 1 to 4096\n"
    "  --cells N      at most so many cells of a mesh, 1 to 4096; without it 16\n"
    "  --no-scenes    meshes alone\n";

static int fail(const char *what, const char *which, const char *help) { return argument_fail("accuracy", what, which, help); }

static int read_scene(settings *s, const char *value)
{
    size_t index;
    s->scene = value;
    return argument_scene("accuracy", value, &index) ? 0 : 2;
}

static int read_octree(settings *s, const char *value)
{
    uint64_t depth;
    if (!argument_number(value, 0, 12, &depth))
        return fail("bad depth of the octree", value, "give 0 to 12");
    s->along = 1u << depth;
    snprintf(s->cells, sizeof s->cells, "a mesh, against leaves of an octree %u deep", (unsigned)depth);
    return 0;
}

static int read_grid(settings *s, const char *value)
{
    uint64_t along;
    if (!argument_number(value, 1, 4096, &along))
        return fail("bad number of cells along a side", value, "give 1 to 4096");
    s->along = (unsigned)along;
    snprintf(s->cells, sizeof s->cells, "a mesh, against cells of a grid, %u along its longest side", s->along);
    return 0;
}

static int read_cells(settings *s, const char *value)
{
    uint64_t most;
    if (!argument_number(value, 1, 4096, &most))
        return fail("bad number of cells", value, "give 1 to 4096");
    s->cells_most = (size_t)most;
    return 0;
}

static int read_rounds(settings *s, const char *value)
{
    uint64_t rounds;
    if (!argument_number(value, MEASURE_LEAST, MEASURE_MOST, &rounds))
        return fail("bad number of rounds", value, "give 5 to 1000");
    s->how = (effort){.rounds = (size_t)rounds, .seconds = 1e9, .sample = 2e-3};
    return 0;
}

static int read_seed(settings *s, const char *value)
{
    return argument_number(value, 0, UINT64_MAX, &s->seed) ? 0 : fail("bad seed", value, "give a whole number below 2^64");
}

static int read_csv(settings *s, const char *value)
{
    s->csv = value;
    return 0;
}

static int read_json(settings *s, const char *value)
{
    s->json = value;
    return 0;
}

static const struct {
    const char *name;
    int (*read)(settings *s, const char *value);
} valued[] = {{"--scene", read_scene},   {"--octree", read_octree}, {"--grid", read_grid}, {"--cells", read_cells},
              {"--rounds", read_rounds}, {"--seed", read_seed},     {"--csv", read_csv},   {"--json", read_json}};

static int read_mesh(settings *s, const char *path)
{
    if (s->meshes == MESHES_MAX)
        return fail("too many meshes, from", path, "give 64 at most");
    s->mesh[s->meshes++] = path;
    return 0;
}

/* Reads the argument at *i, and its value. 0, or the exit status. */
static int read_argument(int argc, char **argv, int *i, settings *s)
{
    const char *const word = argv[*i];
    if (!strcmp(word, "--quick")) {
        s->how = (effort){.rounds = MEASURE_LEAST, .seconds = 0, .sample = 1e-3};
        s->stage_rounds = 3;
        s->triangles_most = 65536;
        return 0;
    }
    if (!strcmp(word, "--no-scenes")) {
        s->has_scenes = false;
        return 0;
    }
    if (word[0] != '-')
        return read_mesh(s, word);
    for (size_t v = 0; v < sizeof valued / sizeof valued[0]; v++) {
        if (strcmp(word, valued[v].name) != 0)
            continue;
        if (++*i == argc)
            return fail("no value after", word, "see accuracy --help");
        return valued[v].read(s, argv[*i]);
    }
    return fail("unknown option", word, "see accuracy --help");
}

int accuracy_options(int argc, char **argv, settings *s)
{
    if (argc == 2 && !strcmp(argv[1], "--help")) {
        fputs(usage, stdout);
        return 0;
    }
    *s = (settings){.seed = 1,
                    .how = {.rounds = 31, .seconds = 1.5, .sample = 2e-3},
                    .stage_rounds = 7,
                    .triangles_most = SIZE_MAX,
                    .has_scenes = true,
                    .cells_most = 16};
    read_octree(s, "5");
    for (int i = 1; i < argc; i++) {
        const int status = read_argument(argc, argv, &i, s);
        if (status)
            return status;
    }
    if (!s->has_scenes && !s->scene && !s->meshes)
        return fail("nothing left to run after", "--no-scenes", "give mesh files");
    return -1;
}
