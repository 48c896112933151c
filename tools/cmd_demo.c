/* cmd_demo.c - tribox demo: every kernel and the paper's algorithm on two generated scenes. */
#include "cmd.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/option_reader.h"
#include "console/options.h"
#include "console/output.h"
#include "demo/comparison.h"
#include "demo/demo_voxels.h"
#include "files/named_file.h"
#include "paper/paper.h"
#include "picture/picture_png.h"
#include "picture/preview.h"

static const char help[] = "tribox demo - speed and answers on two built-in scenes; needs no file\n"
                           "\n"
                           "Usage: tribox demo [--quick] [--json] [--picture FILE.png]\n"
                           "\n"
                           "Tests 100,000 random triangles (the paper's experiment) and a mesh of 200,000 triangles, each\n"
                           "against a box: with the paper's own algorithm, one triangle at a time, and with every\n"
                           "kernel that this processor runs, fast, conservative and exact, all from nine arrays of floats;\n"
                           "'mesh' reads vertices by 32-bit indices, and is exact. Then voxelizes the mesh and draws the\n"
                           "voxels. Takes a few seconds.\n"
                           "\n"
                           "  --quick              3 rounds instead of 15: for a first look\n"
                           "  --json               the tables as a JSON object\n"
                           "  --picture FILE.png   where the picture of the voxels goes; default: tribox-demo.png, or no\n"
                           "                       picture with --quick or --json\n"
                           "  --help               this text\n"
                           "\n"
                           "Columns:\n"
                           "  ns/triangle     nanoseconds per triangle, median of the rounds, one thread\n"
                           "  x paper         how many times as fast as the paper's algorithm: the median of the ratios\n"
                           "                  within a round\n"
                           "  unlike exact    triangles for which the answer is not the exact one\n"
                           "\n"
                           "All take turns in a fresh random order each round; a first round is not counted. 'paper' reads\n"
                           "an array of structures and is compiled for the widest instruction set that this processor has,\n"
                           "as in the benchmark ratios, so both give the same factors.\n"
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

enum { ROUNDS = 15, QUICK_ROUNDS = 3 };

typedef struct request {
    size_t rounds;
    bool wants_json;
    const char *picture_path; /* NULL for none */
    file_out picture;
} request;

static void print_footer(size_t rounds)
{
    printf("\nMedians of %zu rounds on one thread, interleaved. 'paper' is the algorithm of Akenine-Moller (2001),\n"
           "a triangle at a time, compiled with -O3 -ffp-contract=fast for %s; see tribox demo --help.\n",
           rounds, strcmp(paper_instruction_set(), "any") != 0 ? paper_instruction_set() : "any processor of this architecture");
}

static const tribox_soup *mesh_of(const comparison c[2]) { return &c[1].at->work.jobs[0].soup; }

static int print(request *r, const comparison c[2])
{
    comparison_print(c);
    print_footer(r->rounds);
    const int code = demo_voxels(mesh_of(c), &r->picture, NULL);
    return code ? code : output_flush();
}

static int print_json(request *r, const comparison c[2])
{
    json to = json_to(stdout);
    json_open_object(&to, NULL);
    json_string(&to, "version", CMD_VERSION);
    json_whole(&to, "rounds", r->rounds);
    json_whole(&to, "seed", SCENE_SEED);
    json_open_array(&to, "scenes");
    comparison_print_json(&to, &c[0]);
    comparison_print_json(&to, &c[1]);
    json_close(&to);
    const int code = demo_voxels(mesh_of(c), &r->picture, &to);
    json_close(&to);
    return code ? code : output_flush();
}

/* What is timed, on both scenes: the random one, and the mesh. */
static int show(request *r, const scene scenes[2])
{
    static comparison c[2];
    int code = comparison_make(&scenes[0], r->rounds, &c[0]);
    if (!code)
        code = comparison_make(&scenes[1], r->rounds, &c[1]);
    if (code)
        return code;
    return r->wants_json ? print_json(r, c) : print(r, c);
}

static int make_and_show(request *r)
{
    scene scenes[2];
    int code = scene_make_random(&scenes[0]);
    if (code)
        return code;
    code = scene_make_knot(&scenes[1]);
    if (!code) {
        code = show(r, scenes);
        timing_work_free(&scenes[1].work);
    }
    timing_work_free(&scenes[0].work);
    return code;
}

/* Path of the default picture, or NULL if it cannot be written. */
static const char *usual_picture(void)
{
    if (!picture_png_is_there)
        return NULL;
    if (named_file_is_writable_here())
        return "tribox-demo.png";
    message_say("note: no picture of the voxels: this folder is not writable; choose another place with --picture");
    return NULL;
}

static int take(void *context, int which, const char *value)
{
    request *const r = context;
    if (which == OPTION_OPERAND)
        return message_usage("unexpected '%s': demo takes no file", value);
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
        code = make_and_show(&r);
    file_out_drop(&r.picture);
    return code;
}
