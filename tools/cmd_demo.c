/* cmd_demo.c - tribox demo: every kernel and the paper's algorithm on two generated scenes, with nothing to install or download. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "demo/demo_voxels.h"
#include "console/message.h"
#include "console/option_reader.h"
#include "console/options.h"
#include "console/output.h"
#include "demo/picture.h"
#include "picture/picture_png.h"
#include "picture/preview.h"
#include "demo/trial.h"

static const char help[] = "tribox demo - speed and answers on two built-in scenes; needs no file\n"
                           "\n"
                           "Usage: tribox demo [--quick] [--json] [--picture FILE.png]\n"
                           "\n"
                           "Tests 100,000 random triangles (the workload of the paper) and a mesh of 200,000 triangles\n"
                           "against a box each: with the paper's own algorithm, one triangle at a time, and with every\n"
                           "kernel that this processor runs, fast, conservative and exact. Prints a table per scene and a\n"
                           "picture of the mesh with the overlapping triangles marked. Then puts the mesh into a grid and\n"
                           "leaves a picture of the voxels. Takes a few seconds.\n"
                           "\n"
                           "  --quick              3 rounds in place of 25: for a first look\n"
                           "  --json               the tables as a JSON object\n"
                           "  --picture FILE.png   where the picture of the voxels goes; default: tribox-demo.png, and none\n"
                           "                       with --quick or --json\n"
                           "  --help               this text\n"
                           "\n"
                           "Columns:\n"
                           "  ns/triangle     nanoseconds per triangle, median of the rounds, one thread\n"
                           "  Mtriangles/s    million triangles per second\n"
                           "  x paper         how many times as fast as the paper's algorithm\n"
                           "  overlapping     triangles found to overlap the box\n"
                           "  unlike exact    triangles on which it disagrees with the exact answer\n"
                           "\n"
                           "Exit codes: 0 success; 1 failure (memory, output); 2 wrong command line.\n"
                           "\n"
                           "Example:\n"
                           "  tribox demo --quick\n";

enum { OPTION_QUICK, OPTION_JSON, OPTION_PICTURE };

static const option_entry options[] = {[OPTION_QUICK] = {"quick", 0, false},
                                       [OPTION_JSON] = {"json", 'j', false},
                                       [OPTION_PICTURE] = {"picture", 0, true},
                                       {NULL, 0, false}};

enum { ROUNDS = TRIAL_ROUNDS_MAX, QUICK_ROUNDS = 3 };

typedef struct figures {
    const char *kernel, *accuracy;
    double ns, millions, times_paper;
} figures;

static figures figures_of(const scene *s, const trial *t, const contestant *c)
{
    const double count = (double)s->soup.count;
    return (figures){.kernel = c->kernel ? c->kernel : "paper",
                     .accuracy = c->kernel ? options_accuracy_word(c->accuracy) : "-",
                     .ns = 1e9 * c->median / count,
                     .millions = 1e-6 * count / c->median,
                     .times_paper = t->contestants[0].median / c->median};
}

static bool is_bold_wanted(void)
{
    const char *terminal = getenv("TERM");
    return isatty(STDOUT_FILENO) && !getenv("NO_COLOR") && terminal && strcmp(terminal, "dumb");
}

static void print_bold(const char *text)
{
    const bool is_bold = is_bold_wanted();
    printf("%s%s%s\n", is_bold ? "\x1b[1m" : "", text, is_bold ? "\x1b[0m" : "");
}

static void print_table(const scene *s, const trial *t)
{
    print_bold(s->title);
    printf("%zu triangles, box ", s->soup.count);
    output_box(&s->box);
    printf("\n\n");
    print_bold("kernel    accuracy        ns/triangle   Mtriangles/s   x paper   overlapping   unlike exact");
    for (int i = 0; i < t->count; i++) {
        const contestant *c = &t->contestants[i];
        const figures f = figures_of(s, t, c);
        printf("%-8s  %-12s  %13.2f %14.1f %9.2f %13zu %14zu\n", f.kernel, f.accuracy, f.ns, f.millions, f.times_paper,
               c->overlapping, c->differing);
    }
    putchar('\n');
}

static void print_json_scene(const scene *s, const trial *t)
{
    printf("{\"title\": ");
    output_json_string(s->title);
    printf(", \"triangles\": %zu, \"box\": ", s->soup.count);
    output_json_box(&s->box);
    printf(", \"rows\": [");
    for (int i = 0; i < t->count; i++) {
        const contestant *c = &t->contestants[i];
        const figures f = figures_of(s, t, c);
        printf("%s\n  {\"kernel\": \"%s\", \"accuracy\": ", i ? "," : "", f.kernel);
        printf(c->kernel ? "\"%s\"" : "null", f.accuracy);
        printf(", \"ns_per_triangle\": %.6g, \"million_triangles_per_second\": %.6g, \"times_paper\": %.6g, \"overlapping\": %zu, "
               "\"unlike_exact\": %zu}",
               f.ns, f.millions, f.times_paper, c->overlapping, c->differing);
    }
    printf("]}");
}

typedef struct request {
    int rounds;
    bool wants_json;
    const char *picture_path; /* NULL for none */
    file_out picture;
} request;

static int show_scene(const scene *s, const request *r, bool is_mesh)
{
    trial t;
    const int code = trial_run(s, r->rounds, &t);
    if (code)
        return code;
    if (r->wants_json)
        print_json_scene(s, &t);
    else
        print_table(s, &t);
    if (is_mesh && !r->wants_json) {
        picture_print(&s->soup, t.exact);
        printf("\nThe mesh along the z axis. # overlaps the box; . : - = + * do not, from dark to bright.\n\n");
    }
    trial_free(&t);
    return EXIT_CODE_OK;
}

static int show_random(const request *r)
{
    scene s;
    int code = scene_make_random(&s);
    if (code)
        return code;
    code = show_scene(&s, r, false);
    scene_free(&s);
    return code;
}

static int show_mesh(request *r)
{
    scene s;
    int code = scene_make_knot(&s);
    if (code)
        return code;
    code = show_scene(&s, r, true);
    if (r->wants_json)
        printf("\n], \"voxels\": ");
    if (!code)
        code = demo_voxels(&s.soup, &r->picture, r->wants_json);
    scene_free(&s);
    return code;
}

static void print_footer(int rounds)
{
    printf("x paper       times as fast as 'paper': the algorithm of Akenine-Moller (2001), a triangle at a\n"
           "              time, compiled with -O3 for any processor of this architecture, not for this one\n"
           "unlike exact  triangles on which the row disagrees with the exact answer\n"
           "layout        'paper' reads an array of structures, the kernels a structure of arrays\n"
           "measured      the median of %d rounds on one thread, a first round not counted; in a round all\n"
           "              take turns in a fresh random order; a turn tests the scene and writes its mask\n"
           "seed          %d, for the triangles and for the order of turns\n",
           rounds, SCENE_SEED);
}

static int show(request *r)
{
    if (r->wants_json)
        printf("{\"version\": \"%s\", \"rounds\": %d, \"seed\": %d, \"scenes\": [\n", CMD_VERSION, r->rounds, SCENE_SEED);
    int code = show_random(r);
    if (!code && r->wants_json)
        puts(",");
    if (!code)
        code = show_mesh(r);
    if (code)
        return code;
    if (r->wants_json)
        puts("}");
    else
        print_footer(r->rounds);
    return output_flush();
}

/* Where the picture goes that nobody has asked for: nowhere if it is no good place. */
static const char *usual_picture(void)
{
    if (!picture_png_is_there)
        return NULL;
    if (!access(".", W_OK))
        return "tribox-demo.png";
    message_say("note: no picture of the voxels, as this folder cannot be written; --picture says where it may go");
    return NULL;
}

static int take(void *context, int which, const char *value)
{
    request *const r = context;
    if (which == OPTION_OPERAND)
        return message_usage("'%s' is too much: demo takes no file", value);
    if (which == OPTION_QUICK)
        r->rounds = QUICK_ROUNDS;
    else if (which == OPTION_JSON)
        r->wants_json = true;
    else
        r->picture_path = value;
    return EXIT_CODE_OK;
}

int cmd_demo(int count, char **words)
{
    options_found found;
    request r = {.rounds = ROUNDS};
    int code = options_read(count, words, options, take, &r, &found);
    if (code)
        return code;
    if (found.wants_help)
        return output_text(help);
    code = preview_check(r.picture_path, "--picture");
    if (code)
        return code;
    if (!r.picture_path && r.rounds == ROUNDS && !r.wants_json)
        r.picture_path = usual_picture();
    code = file_out_open(&r.picture, r.picture_path);
    if (!code)
        code = show(&r);
    file_out_drop(&r.picture);
    return code;
}
