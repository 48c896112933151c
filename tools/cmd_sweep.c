/* cmd_sweep.c - tribox sweep: which order of the axes is the fastest for a mesh, and why? */
#include "cmd.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/numbers.h"
#include "console/options.h"
#include "console/system.h"
#include "console/output.h"
#include "files/files.h"
#include "read/mesh_file.h"
#include "read/mesh.h"
#include "sweep/sweep.h"

static const char help[] = "tribox sweep - which order of the axes is fastest for a mesh, and why?\n"
                           "\n"
                           "Usage: tribox sweep MESH [--box LX,LY,LZ,HX,HY,HZ | --octree DEPTH | --grid N] [OPTION...]\n"
                           "\n"
                           "Times every fixed order of the three groups of axes (1 box normals, 2 plane, 3 edges) against the\n"
                           "default, which finds the order as it goes, with every kernel and accuracy; also every choice of\n"
                           "axes. Then says which to use for this mesh. Takes a few seconds; with a million triangles against\n"
                           "a box half a minute.\n"
                           "\n"
                           "What the triangles are tested against:\n"
                           "  --octree DEPTH            leaves of an octree of the mesh, 1 to 10 deep, each against the\n"
                           "                            triangles of its parent: some 20,000 pairs. Without any of\n"
                           "                            these options an octree with about 16 triangles in a leaf\n"
                           "  --grid N                  the whole mesh against cells that hold a part of it, of a grid\n"
                           "                            with N cells along the longest side, 1 to 4096: at most 64 cells\n"
                           "  -b, --box LX,LY,LZ,HX,HY,HZ  the whole mesh against one box\n"
                           "      --shift X,Y,Z|auto    subtract this from the mesh first, in double; it is then\n"
                           "                            rounded to float32. auto: a point near its corner\n"
                           "\n"
                           "The answer:\n"
                           "  --quick                   5 rounds, for a first look\n"
                           "  -v, --verbose             also the tables: all times, and what each axis rejects\n"
                           "  -j, --json                a JSON object, with the times of all rounds\n"
                           "  -q, --quiet               print no progress\n"
                           "  --chart FILE.svg          draws nanoseconds by order, for each kernel and accuracy\n"
                           "  -h, --help                this text\n"
                           "\n"
                           "Times are processor time of one thread, in nanoseconds per pair of a triangle and a box. Orders\n"
                           "take turns, shuffled anew each round, and the least time of all rounds counts. 'none' means\n"
                           "that no order is faster than the default by 1 % and in three quarters of the rounds. 'paper' is\n"
                           "the algorithm of Akenine-Moller (2001), a triangle at a time.\n"
                           "\n"
                           "Exit codes: 0 success; 1 failure (a file, memory, the output); 2 wrong command line.\n"
                           "\n"
                           "Examples:\n"
                           "  tribox sweep bunny.ply\n"
                           "  tribox sweep bunny.ply --grid 64 --verbose --chart bunny.svg\n";

typedef struct request {
    const char *mesh_path, *chart_path;
    mesh_shift shift;
    sweep_wish wish;
    int wishes; /* options that say what to test against */
    bool is_quick, is_quiet, wants_json, wants_tables;
} request;

enum { OPTION_BOX, OPTION_OCTREE, OPTION_GRID, OPTION_SHIFT, OPTION_CHART };

static const option_entry options[] = {[OPTION_BOX] = {"box", 'b', true},
                                       [OPTION_OCTREE] = {"octree", 0, true},
                                       [OPTION_GRID] = {"grid", 0, true},
                                       [OPTION_SHIFT] = {"shift", 0, true},
                                       [OPTION_CHART] = {"chart", 0, true},
                                       {"quick", 0, OPTION_SETS(request, is_quick)},
                                       {"quiet", 'q', OPTION_SETS(request, is_quiet)},
                                       {"verbose", 'v', OPTION_SETS(request, wants_tables)},
                                       {"json", 'j', OPTION_SETS(request, wants_json)},
                                       {NULL, 0, false}};

static int read_box(const char *text, tribox_box *box)
{
    double bounds[6];
    unsigned decimals;
    if (!numbers_read(text, "--box", "LX,LY,LZ,HX,HY,HZ", 6, bounds, &decimals))
        return EXIT_CODE_USAGE;
    numbers_round(bounds, 6, decimals);
    memcpy(box->lo, bounds, sizeof box->lo);
    memcpy(box->hi, bounds + 3, sizeof box->hi);
    for (int a = 0; a < 3; a++)
        if (box->lo[a] > box->hi[a])
            return message_usage("--box: the empty box overlaps nothing in any order; give lower bounds first");
    return EXIT_CODE_OK;
}

static int take_wish(request *r, sweep_kind kind, const char *value)
{
    r->wish.kind = kind;
    if (r->wishes++)
        return message_usage("--box, --octree and --grid exclude each other");
    return kind == SWEEP_BOX      ? read_box(value, &r->wish.box)
           : kind == SWEEP_OCTREE ? numbers_read_whole(value, "--octree", OCTREE_DEPTH_MOST, &r->wish.depth)
                                  : numbers_read_whole(value, "--grid", CELLS_ALONG_MOST, &r->wish.along);
}

/* A name without an ending may be a device, or a pipe. */
static int take_chart(request *r, const char *path)
{
    const char *const ending = strrchr(path + named_file_folder(path), '.');
    r->chart_path = path;
    if (ending && !mesh_kind_has_ending(path, ".svg"))
        return message_usage("--chart: '%s' would be an SVG all the same; name it .svg", path);
    return EXIT_CODE_OK;
}

static int take(void *context, int which, const char *value)
{
    request *const r = context;
    switch (which) {
    case OPTION_OPERAND:
        return options_take_mesh(value, &r->mesh_path);
    case OPTION_BOX:
        return take_wish(r, SWEEP_BOX, value);
    case OPTION_OCTREE:
        return take_wish(r, SWEEP_OCTREE, value);
    case OPTION_GRID:
        return take_wish(r, SWEEP_GRID, value);
    case OPTION_SHIFT:
        return mesh_shift_read(value, &r->shift);
    default:
        return take_chart(r, value);
    }
}

/* What a sweep found. */
typedef struct findings {
    const request *r;
    const mesh *m;
    const timing_work *work;
    char work_text[128], processor[200];
    sweep s;
    why w;
    sweep_advice advice;
} findings;

static void print_text(const findings *f)
{
    printf("%s\n\n", f->advice.text);
    printf("mesh         %s\n", f->r->mesh_path);
    if (f->r->shift.is_wanted)
        output_shift(f->r->shift.by);
    printf("triangles    %zu", f->m->soup.count);
    if (f->m->seen.not_finite)
        printf(" (%" PRIu64 " have NaN or infinite coordinates and overlap nothing)", f->m->seen.not_finite);
    putchar('\n');
    printf("tested       %s\n", f->work_text);
    printf("pairs        %zu, of which %zu overlap (%.2f %%)\n", f->work->pairs, f->w.overlapping,
           100 * (double)f->w.overlapping / (double)f->w.pairs);
    printf("processor    %s\n", f->processor);
    report_best(&f->s);
    if (f->r->wants_tables)
        report_tables(&f->s, &f->w);
}

static void print_json(const findings *f)
{
    json to = json_to(stdout);
    json_open_object(&to, NULL);
    json_string(&to, "mesh", f->r->mesh_path);
    json_whole(&to, "triangles", f->m->soup.count);
    if (f->r->shift.is_wanted)
        json_doubles(&to, "shift", f->r->shift.by, 3, false);
    json_string(&to, "tested", f->work_text);
    json_whole(&to, "soups", f->work->count);
    json_string(&to, "processor", f->processor);
    report_json(&to, &f->s, &f->w);
    json_open_object(&to, "advice");
    json_string(&to, "kernel", f->advice.kernel);
    json_whole(&to, "order", f->advice.order);
    json_whole(&to, "axes", f->advice.axes);
    json_number(&to, "gain_percent", 4, 100 * f->advice.gain);
    json_string(&to, "text", f->advice.text);
    json_close(&to);
    json_close(&to);
}

static int find(findings *f)
{
    generator turns = {1};
    if (terminal_is(stderr) && !f->r->is_quiet)
        message_say("timing %zu pairs", f->work->pairs);
    const effort how = {.rounds = SWEEP_ROUNDS, .seconds = f->r->is_quick ? 0 : 2, .sample = 5e-4};
    const char *const failure = sweep_run(&f->s, f->work, how, &turns);
    if (failure)
        return message_failure("%s: %s", f->r->mesh_path, failure);
    why_find(f->work, &f->w);
    f->advice = sweep_advise(&f->s);
    return EXIT_CODE_OK;
}

/* Before the sweep takes its time, so that it is not in vain. */
static int open_chart(const char *path, FILE **chart)
{
    *chart = path ? named_file_open(path, "wb") : NULL;
    return path && !*chart ? message_failure("--chart: cannot write '%s': %s", path, strerror(errno)) : EXIT_CODE_OK;
}

static int close_chart(const char *path, FILE *chart)
{
    const bool is_lost = ferror(chart) != 0;
    return fclose(chart) || is_lost ? message_failure("--chart: '%s' could not be written to its end", path) : EXIT_CODE_OK;
}

static void draw_chart(FILE *chart, const findings *f)
{
    char title[512];
    snprintf(title, sizeof title, "%s: %zu pairs, %s", f->r->mesh_path + named_file_folder(f->r->mesh_path), f->work->pairs,
             f->work_text);
    sweep_chart(chart, &f->s, title, f->processor);
}

static int sweep_mesh(const request *r, const mesh *m, const timing_work *work, const sweep_wish *wish)
{
    static findings f;
    FILE *chart;
    f.r = r;
    f.m = m;
    f.work = work;
    sweep_work_describe(wish, work, f.work_text, sizeof f.work_text);
    processors_name(f.processor, sizeof f.processor);
    int code = open_chart(r->chart_path, &chart);
    if (code)
        return code;
    code = find(&f);
    if (chart) {
        if (!code)
            draw_chart(chart, &f);
        const int closed = close_chart(r->chart_path, chart);
        code = code ? code : closed;
    }
    if (code)
        return code;
    if (r->wants_json)
        print_json(&f);
    else
        print_text(&f);
    return output_flush();
}

static int answer(void *asked, const options_found *found)
{
    request *const r = asked;
    mesh m;
    timing_work work;
    sweep_wish wish = r->wish;
    (void)found;
    if (!r->mesh_path)
        return message_usage("no mesh file given");
    int code = mesh_read_shifted(&(mesh_request){.path = r->mesh_path, .threads = processors_here()}, &r->shift, &m);
    if (code)
        return code;
    code = mesh_to_floats(r->mesh_path, (const double[3]){0, 0, 0}, &m);
    mesh_warn_rounded(r->mesh_path, &m);
    if (!code)
        code = sweep_work_make(r->mesh_path, &m, &wish, &work);
    if (!code) {
        code = sweep_mesh(r, &m, &work, &wish);
        timing_work_free(&work);
    }
    mesh_free(&m);
    return code;
}

int cmd_sweep(int count, char **words)
{
    return options_answer(&(options_command){help, options, take, answer}, count, words, &(request){.wish.kind = SWEEP_OCTREE});
}
