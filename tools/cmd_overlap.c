/* cmd_overlap.c - tribox overlap: the triangles of a mesh against one box, oriented or not, or the boxes of a file. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <string.h>

#include "console/message.h"
#include "console/numbers.h"
#include "console/options.h"
#include "console/output.h"
#include "console/system.h"
#include "overlap/overlap.h"
#include "read/mesh_file.h"

static const char help[] =
    "tribox overlap - which triangles of a mesh overlap a box?\n"
    "\n"
    "Usage: tribox overlap MESH --box LX,LY,LZ,HX,HY,HZ [OPTION...]\n"
    "       tribox overlap MESH --boxes FILE [OPTION...]\n"
    "       tribox overlap MESH --oriented CX,CY,CZ,HX,HY,HZ,UX,UY,UZ,VX,VY,VZ,WX,WY,WZ [OPTION...]\n"
    "\n"
    "MESH is a mesh file (PLY, STL, OBJ, OFF, glTF, ...), raw triangles (NAME.f32, NAME.f64: nine numbers\n"
    "each), or - for standard input. Triangles and boxes contain their borders: touching is overlap.\n"
    "\n"
    "  -b, --box LX,...,HZ     lower and upper bounds, separated by commas or blanks\n"
    "      --boxes FILE        a box per line, answered line by line; - is standard input; if there\n"
    "                          are many, an index is built along the way\n"
    "      --oriented CX,...   center C, half lengths H, and the directions U, V, W of the axes\n"
    "      --format WORD       " MESH_FORMATS ", whatever the name of the file;\n"
    "                          standard input needs it\n"
    "      --shift X,Y,Z|auto  subtract this from MESH first, in double; auto: a point near its corner\n"
    "      --inside            also count the triangles inside the box, on its border and outside\n"
    "  -o, --out FILE          write the faces that overlap, with --inside those inside, as a mesh in the\n"
    "                          format of MESH with all attributes: " MESH_ENDINGS "\n"
    "      --rest FILE         write all other faces, with -o or alone; - is standard output\n"
    "  -l, --list              print the numbers of the overlapping triangles, from 0, and nothing\n"
    "                          else; with --boxes it needs --json\n"
    "  -j, --json              print a JSON object, one per line with --boxes\n"
    "  -q, --quiet             print no progress, and with -o or --rest no summary\n"
    "  -t, --threads T         1 to 256; default: one for each processor. The answer is the same\n" OPTIONS_TEST_HELP
    "      --order NUMBER      order of the groups, 1 box, 2 plane, 3 edges; changes only the time\n" OPTIONS_HELP_HELP "\n"
    "Exit codes: 0 success; 1 failure (a file, memory, the output); 2 wrong command line.\n"
    "\n"
    "Examples ('man tribox' has the details):\n"
    "  tribox overlap bunny.ply --box -0.05,0.05,-0.05,0.05,0.15,0.05\n"
    "  tribox overlap part.stl --box \"0 0 0 10 10 10\" --list > triangles.txt\n"
    "  tribox overlap part.stl --box 0,0,0,10,10,10 --inside\n"
    "  tribox overlap part.stl --oriented 5,5,5,4,2,1,0.8,0.6,0,-0.6,0.8,0,0,0,1\n"
    "  tribox overlap scan.ply --box 0,0,0,10,10,10 -o part.ply --rest rest.ply\n"
    "  generate-boxes | tribox overlap bunny.ply --boxes - --json\n"
    "  generate-triangles | tribox overlap - --format f32 --box 0,0,0,1,1,1\n";

enum { OPTION_BOX, OPTION_ORIENTED, OPTION_SHIFT, OPTION_FORMAT, OPTION_ACCURACY, OPTION_KERNEL, OPTION_ORDER, OPTION_AXES };

static const option_entry options[] = {[OPTION_BOX] = {"box", 'b', true},
                                       [OPTION_ORIENTED] = {"oriented", 0, true},
                                       [OPTION_SHIFT] = {"shift", 0, true},
                                       [OPTION_FORMAT] = {"format", 0, true},
                                       [OPTION_ACCURACY] = {"accuracy", 0, true},
                                       [OPTION_KERNEL] = {"kernel", 0, true},
                                       [OPTION_ORDER] = {"order", 0, true},
                                       [OPTION_AXES] = {"axes", 0, true},
                                       {"threads", 't', OPTION_COUNTS_THREADS(request, threads)},
                                       {"boxes", 0, OPTION_NAMES(request, boxes_path)},
                                       {"inside", 0, OPTION_SETS(request, wants_inside)},
                                       {"list", 'l', OPTION_SETS(request, wants_list)},
                                       {"json", 'j', OPTION_SETS(request, wants_json)},
                                       {"quiet", 'q', OPTION_SETS(request, is_quiet)},
                                       {"out", 'o', OPTION_NAMES(request, crop_paths[CROP_PART])},
                                       {"rest", 0, OPTION_NAMES(request, crop_paths[CROP_REST])},
                                       {NULL, 0, false}};

static int read_oriented(const char *text, tribox_oriented_box *box)
{
    static const char form[] = "CX,CY,CZ,HX,HY,HZ and three axes of three numbers";
    double n[15];
    if (!numbers_read(text, "--oriented", form, 15, n, NULL))
        return EXIT_CODE_USAGE;
    memcpy(box->center, n, sizeof box->center);
    memcpy(box->half, n + 3, sizeof box->half);
    memcpy(box->axis, n + 6, sizeof box->axis);
    for (int k = 0; k < 3; k++)
        if (box->half[k] < 0)
            message_say("note: --oriented: half length %d is %.9g: a box of negative size is empty, and nothing overlaps it", k + 1,
                        box->half[k]);
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
    case OPTION_ORIENTED:
        r->has_oriented = true;
        return read_oriented(value, &r->oriented);
    case OPTION_FORMAT:
        return triangle_format_read(value, &r->format);
    case OPTION_SHIFT:
        return mesh_shift_read(value, &r->shift);
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

/* Both may go elsewhere than the report does. */
static int check_crop(request *r)
{
    const bool is_part = file_out_is_stdout(r->crop_paths[CROP_PART]), is_rest = file_out_is_stdout(r->crop_paths[CROP_REST]);
    const bool is_free = !is_part && !is_rest, is_crop = r->crop_paths[CROP_PART] || r->crop_paths[CROP_REST];
    r->has_report = is_free && (r->wants_json || !(is_crop && r->is_quiet));
    if (!is_crop)
        return EXIT_CODE_OK;
    if (r->boxes_path)
        return message_usage("-o and --rest write the faces about one box: give --box or --oriented in place of --boxes");
    if (!strcmp(r->mesh_path, "-"))
        return message_usage("-o and --rest need the mesh as a file, since it is read twice");
    if (is_free)
        return EXIT_CODE_OK;
    const char *const option = is_part ? "-o" : "--rest";
    if (is_part && is_rest)
        return message_usage("-o and --rest cannot both go to standard output; give one of them a name");
    if (r->wants_json || r->wants_list)
        return message_usage("%s and %s - exclude each other, since both go to standard output",
                             r->wants_json ? "--json" : "--list", option);
    return terminal_is(stdout) ? message_usage("%s -: standard output is a terminal; send it to a program or a file", option)
                               : EXIT_CODE_OK;
}

static int check_request(request *r)
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
    const int code = r->has_oriented ? check_oriented(r) : EXIT_CODE_OK;
    return code ? code : check_crop(r);
}

static int answer_request(void *asked, const options_found *found)
{
    const int code = check_request(asked);
    (void)found;
    return code ? code : overlap_work(asked);
}

int cmd_overlap(int count, char **words)
{
    const options_command about = {help, options, take, answer_request};
    return options_answer(&about, count, words, &(request){.threads = processors_here()});
}
