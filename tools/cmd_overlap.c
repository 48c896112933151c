/* cmd_overlap.c - tribox overlap: the triangles of a mesh file against one box, or against the boxes of a file. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <stdlib.h>

#include "boxes.h"
#include "clock.h"
#include "message.h"
#include "options.h"
#include "output.h"
#include "report.h"

static const char help[] = "tribox overlap - which triangles of a mesh overlap an axis-aligned box?\n"
                           "\n"
                           "Usage: tribox overlap MESH --box LX,LY,LZ,HX,HY,HZ [OPTION...]\n"
                           "       tribox overlap MESH --boxes FILE [OPTION...]\n"
                           "\n"
                           "MESH is a file that libassimp reads: PLY, STL, OBJ, OFF, glTF and about 40 other formats.\n"
                           "Polygons are cut into triangles; scene transforms are applied; nothing is cleaned up.\n"
                           "Mesh and box share one length unit, whichever. Both are closed: touching is overlap.\n"
                           "Triangles are counted from 0 in the order of the file.\n"
                           "\n"
                           "The box:\n"
                           "  --box LX,LY,LZ,HX,HY,HZ   lower and upper bounds, separated by commas or blanks\n"
                           "  --boxes FILE              a box per line in the same form, '#' starts a comment;\n"
                           "                            - reads standard input. One line of output per box, at once\n"
                           "\n"
                           "The answer:\n"
                           "  --list                    the numbers of the overlapping triangles, one per line,\n"
                           "                            and nothing else (with --boxes it needs --json)\n"
                           "  --json                    a JSON object, one per line with --boxes; with --list it has\n"
                           "                            the numbers as 'indices'\n"
                           "\n"
                           "The test:\n"
                           "  --accuracy WORD           exact (default): the true answer for every float;\n"
                           "                            conservative: never misses, may report more;\n"
                           "                            fast: single precision, may err close to contact\n"
                           "  --axes WORD,...           only some axes: box (3), plane (1), edges (9). Fewer axes\n"
                           "                            never miss and report more. Default: all thirteen\n"
                           "  --order NUMBER            the order of the groups: 1 box, 2 plane, 3 edges, as in 312.\n"
                           "                            Changes the time, never the answer\n"
                           "  --kernel NAME             avx512, avx2, sse2, neon or scalar; default: the best here\n"
                           "  --help                    this text\n"
                           "\n"
                           "Times are of the test alone, without reading the file: the best of up to 5 runs with --box,\n"
                           "a single run per box with --boxes. 'undecided' counts the triangles that a slower, exact\n"
                           "stage had to settle.\n"
                           "\n"
                           "Exit codes: 0 success; 1 failure (a file, memory, a kernel that cannot run here);\n"
                           "2 wrong command line.\n"
                           "\n"
                           "Examples:\n"
                           "  tribox overlap bunny.ply --box -0.05,0.05,-0.05,0.05,0.15,0.05\n"
                           "  tribox overlap part.stl --box \"0 0 0 10 10 10\" --list > triangles.txt\n"
                           "  generate-boxes | tribox overlap bunny.ply --boxes - --json\n";

enum {
    OPTION_BOX,
    OPTION_BOXES,
    OPTION_ACCURACY,
    OPTION_KERNEL,
    OPTION_ORDER,
    OPTION_AXES,
    OPTION_LIST,
    OPTION_JSON,
    OPTION_HELP,
    OPTION_H
};

static const option options[] = {[OPTION_BOX] = {"--box", true},
                                 [OPTION_BOXES] = {"--boxes", true},
                                 [OPTION_ACCURACY] = {"--accuracy", true},
                                 [OPTION_KERNEL] = {"--kernel", true},
                                 [OPTION_ORDER] = {"--order", true},
                                 [OPTION_AXES] = {"--axes", true},
                                 [OPTION_LIST] = {"--list", false},
                                 [OPTION_JSON] = {"--json", false},
                                 [OPTION_HELP] = {"--help", false},
                                 [OPTION_H] = {"-h", false},
                                 {NULL, false}};

static int take_option(request *r, int which, const char *value)
{
    switch (which) {
    case OPTION_BOX:
        r->box_text = value;
        return EXIT_CODE_OK;
    case OPTION_BOXES:
        r->boxes_path = value;
        return EXIT_CODE_OK;
    case OPTION_ACCURACY:
        return options_read_accuracy(value, &r->test.accuracy);
    case OPTION_KERNEL:
        return options_read_kernel(value, &r->test.kernel);
    case OPTION_ORDER:
        return options_read_order(value, &r->test.order);
    case OPTION_AXES:
        return options_read_axes(value, &r->test.axes);
    case OPTION_LIST:
        r->wants_list = true;
        return EXIT_CODE_OK;
    case OPTION_JSON:
        r->wants_json = true;
        return EXIT_CODE_OK;
    default:
        r->wants_help = true;
        return EXIT_CODE_OK;
    }
}

static int read_request(int count, char **words, request *r)
{
    arguments walk = {.count = count, .next = words, .options = options};
    const char *value;
    for (int which; (which = arguments_next(&walk, &value)) != ARGUMENT_END;) {
        if (which == ARGUMENT_WRONG)
            return EXIT_CODE_USAGE;
        if (which == ARGUMENT_OPERAND && r->mesh_path)
            return message_usage("one mesh at a time: '%s' is one file too many", value);
        if (which == ARGUMENT_OPERAND)
            r->mesh_path = value;
        const int code = which == ARGUMENT_OPERAND ? EXIT_CODE_OK : take_option(r, which, value);
        if (code || r->wants_help)
            return code;
    }
    if (!r->mesh_path)
        return message_usage("no mesh file given");
    if (!r->box_text == !r->boxes_path)
        return message_usage(r->box_text ? "--box and --boxes exclude each other" : "no box given: --box or --boxes is needed");
    if (r->boxes_path && r->wants_list && !r->wants_json)
        return message_usage("--list with --boxes needs --json");
    return r->boxes_path || box_read(r->box_text, "--box", &r->box) ? EXIT_CODE_OK : EXIT_CODE_USAGE;
}

/* Runs the test `runs` times, fewer when it is slow, and keeps the best time. */
static int run_test(const mesh *m, const request *r, int runs, uint64_t *mask, answer *a)
{
    const double slow = 0.1;
    a->runs = 0;
    for (double total = 0; a->runs < runs && total < slow;) {
        const double start = clock_seconds();
        const tribox_status status = tribox_overlap(&m->soup, &a->box, &r->test, mask, &a->report);
        const double seconds = clock_seconds() - start;
        if (status)
            return message_failure("%s", tribox_status_text(status));
        if (!a->runs || seconds < a->seconds)
            a->seconds = seconds;
        a->runs++;
        total += seconds;
    }
    return EXIT_CODE_OK;
}

static int answer_boxes(const mesh *m, const request *r, uint64_t *mask)
{
    box_file boxes;
    answer a = {.runs = 0};
    size_t answered = 0;
    bool end;
    int code = box_file_open(&boxes, r->boxes_path);
    if (code)
        return code;
    for (;; answered++) {
        code = box_file_next(&boxes, &a.box, &end);
        if (code || end)
            break;
        a.line = boxes.line;
        code = run_test(m, r, 1, mask, &a);
        if (!code)
            code = report_print(m, r, &a, mask);
        if (code)
            break;
    }
    if (!code && !answered)
        message_say("note: %s: no box in it", boxes.name);
    box_file_close(&boxes);
    return code;
}

static int answer_box(const mesh *m, const request *r, uint64_t *mask)
{
    answer a = {.box = r->box};
    const int code = run_test(m, r, 5, mask, &a);
    return code ? code : report_print(m, r, &a, mask);
}

static int answer_request(const request *r)
{
    mesh m;
    const int code = mesh_read(r->mesh_path, &m);
    if (code)
        return code;
    mesh_warn(r->mesh_path, &m);
    uint64_t *mask = malloc(tribox_mask_words(m.soup.count) * sizeof *mask);
    const int answered = !mask           ? message_failure("out of memory for the answers of %zu triangles", m.soup.count)
                         : r->boxes_path ? answer_boxes(&m, r, mask)
                                         : answer_box(&m, r, mask);
    free(mask);
    mesh_free(&m);
    return answered;
}

int cmd_overlap(int count, char **words)
{
    request r = {.mesh_path = NULL};
    const int code = read_request(count, words, &r);
    if (code)
        return code;
    return r.wants_help ? output_text(help) : answer_request(&r);
}
