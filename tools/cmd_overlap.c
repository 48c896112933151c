/* cmd_overlap.c - tribox overlap: the triangles of a mesh against one box, oriented or not, or the boxes of a file. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <string.h>

#include "read/boxes.h"
#include "read/mesh.h"
#include "console/message.h"
#include "console/numbers.h"
#include "console/option_reader.h"
#include "console/options.h"
#include "console/output.h"
#include "overlap/box_after_box.h"
#include "overlap/report.h"

static const char help[] =
    "tribox overlap - which triangles of a mesh overlap a box?\n"
    "\n"
    "Usage: tribox overlap MESH --box LX,LY,LZ,HX,HY,HZ [OPTION...]\n"
    "       tribox overlap MESH --boxes FILE [OPTION...]\n"
    "       tribox overlap MESH --oriented CX,CY,CZ,HX,HY,HZ,UX,UY,UZ,VX,VY,VZ,WX,WY,WZ [OPTION...]\n"
    "\n"
    "MESH is a mesh file (PLY, STL, OBJ, OFF, glTF, ...), raw triangles (NAME.f32, NAME.f64: nine numbers\n"
    "each), or - for standard input. Triangles and boxes are closed: touching is overlap.\n"
    "\n"
    "  -b, --box LX,...,HZ     lower and upper bounds, separated by commas or blanks\n"
    "      --boxes FILE        a box per line, answered line by line; - is standard input; very many\n"
    "                          are answered by an index, which is built along the way\n"
    "      --oriented CX,...   center C, half lengths H, and the directions U, V, W of the axes\n"
    "      --format WORD       stl, f32 or f64, whatever the name of the file; standard input needs it\n"
    "      --shift X,Y,Z|auto  subtract this from the mesh first, in double; auto: near its corner\n"
    "      --inside            also count the triangles inside the box, on its border and outside\n"
    "  -l, --list              print the numbers of the overlapping triangles, from 0, and nothing\n"
    "                          else; with --boxes it needs --json\n"
    "  -j, --json              print a JSON object, one per line with --boxes\n" OPTIONS_TEST_HELP
    "      --order NUMBER      order of the groups, 1 box, 2 plane, 3 edges; changes the time alone\n" OPTIONS_HELP_HELP "\n"
    "Exit codes: 0 success; 1 failure (a file, memory, the output); 2 wrong command line.\n"
    "\n"
    "Examples ('man tribox' has the details):\n"
    "  tribox overlap bunny.ply --box -0.05,0.05,-0.05,0.05,0.15,0.05\n"
    "  tribox overlap part.stl --box \"0 0 0 10 10 10\" --list > triangles.txt\n"
    "  tribox overlap part.stl --box 0,0,0,10,10,10 --inside\n"
    "  tribox overlap part.stl --oriented 5,5,5,4,2,1,0.8,0.6,0,-0.6,0.8,0,0,0,1\n"
    "  generate-boxes | tribox overlap bunny.ply --boxes - --json\n"
    "  generate-triangles | tribox overlap - --format f32 --box 0,0,0,1,1,1\n";

enum {
    OPTION_BOX,
    OPTION_BOXES,
    OPTION_ORIENTED,
    OPTION_FORMAT,
    OPTION_SHIFT,
    OPTION_ACCURACY,
    OPTION_KERNEL,
    OPTION_ORDER,
    OPTION_AXES,
    OPTION_INSIDE,
    OPTION_LIST,
    OPTION_JSON
};

static const option_entry options[] = {[OPTION_BOX] = {"box", 'b', true},
                                       [OPTION_BOXES] = {"boxes", 0, true},
                                       [OPTION_ORIENTED] = {"oriented", 0, true},
                                       [OPTION_SHIFT] = {"shift", 0, true},
                                       [OPTION_FORMAT] = {"format", 0, true},
                                       [OPTION_ACCURACY] = {"accuracy", 0, true},
                                       [OPTION_KERNEL] = {"kernel", 0, true},
                                       [OPTION_ORDER] = {"order", 0, true},
                                       [OPTION_AXES] = {"axes", 0, true},
                                       [OPTION_INSIDE] = {"inside", 0, false},
                                       [OPTION_LIST] = {"list", 'l', false},
                                       [OPTION_JSON] = {"json", 'j', false},
                                       {NULL, 0, false}};

static int read_oriented(const char *text, tribox_oriented_box *box, double center[3])
{
    static const char form[] = "CX,CY,CZ,HX,HY,HZ and three axes of three numbers";
    float n[15];
    double exact[15];
    if (!numbers_read_floats(text, "--oriented", form, 15, n) || !numbers_read(text, "--oriented", form, 15, exact, NULL))
        return EXIT_CODE_USAGE;
    memcpy(center, exact, sizeof(double[3]));
    memcpy(box->center, n, sizeof box->center);
    memcpy(box->half, n + 3, sizeof box->half);
    memcpy(box->axis, n + 6, sizeof box->axis);
    for (int k = 0; k < 3; k++)
        if (box->half[k] < 0)
            message_say("note: --oriented: half length %d is %.9g: a box of negative size is empty, and nothing overlaps it", k + 1,
                        (double)box->half[k]);
    return EXIT_CODE_OK;
}

static int take(void *context, int which, const char *value)
{
    request *const r = context;
    switch (which) {
    case OPTION_OPERAND:
        return options_take_mesh(value, &r->mesh_path);
    case OPTION_BOX:
        r->has_box = true;
        return box_read(value, "--box", &r->box) ? EXIT_CODE_OK : EXIT_CODE_USAGE;
    case OPTION_BOXES:
        r->boxes_path = value;
        return EXIT_CODE_OK;
    case OPTION_ORIENTED:
        r->has_oriented = true;
        return read_oriented(value, &r->oriented, r->center);
    case OPTION_FORMAT:
        return triangle_format_read(value, &r->format);
    case OPTION_SHIFT:
        return mesh_shift_read(value, &r->shift);
    case OPTION_INSIDE:
        r->wants_inside = true;
        return EXIT_CODE_OK;
    case OPTION_LIST:
        r->wants_list = true;
        return EXIT_CODE_OK;
    case OPTION_JSON:
        r->wants_json = true;
        return EXIT_CODE_OK;
    default:
        return options_read_test(options[which].name, value, &r->test);
    }
}

static int check_oriented(const request *r)
{
    const unsigned axes = r->test.axes;
    if (r->wants_inside)
        return message_usage("--inside goes with --box or --boxes, not with --oriented");
    if (r->test.accuracy == TRIBOX_EXACT && axes && axes != TRIBOX_AXES_ALL && axes != TRIBOX_AXES_BOX)
        return message_usage(
            "--oriented is exact with all axes or with --axes box; other axes need --accuracy conservative or fast");
    return EXIT_CODE_OK;
}

static int check_request(const request *r)
{
    const int boxes = r->has_box + r->has_oriented + (r->boxes_path != NULL);
    const bool is_stdin = r->mesh_path && !strcmp(r->mesh_path, "-");
    if (!r->mesh_path)
        return message_usage("no mesh file given");
    if (boxes != 1)
        return message_usage(boxes ? "--box, --boxes and --oriented exclude each other"
                                   : "no box given: --box, --boxes or --oriented is needed");
    if (triangle_format_check(r->mesh_path, r->format))
        return EXIT_CODE_USAGE;
    if (is_stdin && r->boxes_path)
        return message_usage("--boxes needs the mesh as a file, since each box is tested against it");
    if (r->boxes_path && r->wants_list && !r->wants_json)
        return message_usage("--list with --boxes needs --json");
    if (r->wants_list && r->wants_inside)
        return message_usage("--inside counts triangles and --list lists them: they exclude each other");
    return r->has_oriented ? check_oriented(r) : EXIT_CODE_OK;
}

/* Tests a mesh up to `runs` times, fewer when it is slow; the best time counts. */
static int run_test(const mesh *m, const request *r, const masks *bits, int runs, answer *a)
{
    const asked_triangles all = triangles_of_mesh(m);
    const double slow = 0.1;
    const answer none = *a;
    double total = 0;
    for (int run = 1; run <= runs && total < slow; run++) {
        answer once = none;
        const int code = overlap_ask(r, &all, bits, &once);
        if (code)
            return code;
        total += once.seconds;
        if (run > 1 && a->seconds < once.seconds)
            once.seconds = a->seconds;
        *a = once;
        a->runs = run;
    }
    return EXIT_CODE_OK;
}

static void tell_mesh(const mesh *m, answer *a)
{
    a->triangles = m->triangles;
    a->is_double = m->is_double;
    a->left_out = m->left_out;
    a->not_finite = m->not_finite;
    a->rounded = m->rounded;
    a->moved = m->moved;
}

static int answer_box(const mesh *m, const request *r)
{
    masks bits;
    answer a = {.box = box_for_mesh(&r->box, m->is_double)};
    tell_mesh(m, &a);
    int code = masks_make(m->triangles, r->wants_inside, &bits);
    if (!code)
        code = run_test(m, r, &bits, 5, &a);
    if (!code && r->wants_list)
        code = report_list(r, &a, 0, bits.overlap, m->triangles);
    masks_free(&bits);
    return code ? code : report_end(r, &a);
}

static int answer_next(box_after_box *b, answer *a)
{
    tell_mesh(b->m, a);
    int code = box_after_box_ask(b, a);
    if (!code && b->r->wants_list)
        code = box_after_box_list(b, a);
    return code ? code : report_end(b->r, a);
}

static int answer_lines(box_after_box *b, box_file *boxes)
{
    bool end = false;
    int code = EXIT_CODE_OK;
    size_t answered = 0;
    for (;; answered++) {
        answer a = {.runs = 1};
        written_box box;
        code = box_file_next(boxes, &box, &end);
        if (code || end)
            break;
        a.box = box_for_mesh(&box, b->m->is_double);
        a.line = boxes->line;
        code = answer_next(b, &a);
        if (code)
            break;
    }
    if (!code && !answered)
        message_say("note: %s: there is no box in it", boxes->name);
    return code;
}

static int answer_boxes(mesh *m, const request *r)
{
    box_file boxes;
    box_after_box b;
    int code = box_file_open(&boxes, r->boxes_path);
    if (code)
        return code;
    code = box_after_box_start(r, m, &b);
    if (!code)
        code = answer_lines(&b, &boxes);
    box_after_box_end(&b);
    box_file_close(&boxes);
    return code;
}

static void set_center(const double center[3], const float middle[3], request *own)
{
    memcpy(own->center, center, sizeof own->center);
    memcpy(own->oriented.center, middle, sizeof own->oriented.center);
}

/* Oriented boxes are tested in float, about their centre where the mesh is one of doubles. */
static int take_oriented(const request *r, mesh *m, request *own)
{
    if (m->is_double)
        set_center(r->center, (const float[3]){0, 0, 0}, own);
    return mesh_to_floats(r->mesh_path, own->center, m);
}

static int answer_mesh(const request *r, request *own)
{
    mesh m;
    int code = mesh_read_shifted(r->mesh_path, r->format, &own->shift, &m);
    if (code)
        return code;
    if (r->has_oriented)
        code = take_oriented(r, &m, own);
    mesh_warn(r->mesh_path, &m);
    if (!code)
        code = r->boxes_path ? answer_boxes(&m, own) : answer_box(&m, own);
    mesh_free(&m);
    return code;
}

/* A single box takes one pass over the triangles, for which a file of triangles need not be held in memory. */
static int answer_request(const request *r)
{
    triangle_file file = {.stream = NULL};
    const int code = r->boxes_path || r->shift.is_wanted ? EXIT_CODE_OK : triangle_file_open(r->mesh_path, r->format, &file);
    const bool is_whole = r->has_oriented && file.format == TRIANGLES_F64;
    const float *const middle = r->oriented.center;
    request own = *r;
    set_center((const double[3]){(double)middle[0], (double)middle[1], (double)middle[2]}, middle, &own);
    if (!code && file.stream && !is_whole)
        return overlap_stream(&own, &file);
    triangle_file_close(&file);
    return code ? code : answer_mesh(r, &own);
}

int cmd_overlap(int count, char **words)
{
    request r = {.mesh_path = NULL};
    options_found found;
    int code = options_read(count, words, options, take, &r, &found);
    if (!code && found.wants_help)
        return output_text(help);
    if (!code)
        code = check_request(&r);
    return code ? code : answer_request(&r);
}
