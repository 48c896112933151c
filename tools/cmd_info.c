/* cmd_info.c - tribox info: what this library is and what this processor runs; or what a mesh file holds, also as arrays. */
#include "cmd.h"

#include <stdio.h>
#include <string.h>

#include "colours/colours.h"
#include "console/json.h"
#include "console/message.h"
#include "console/options.h"
#include "console/output.h"
#include "console/system.h"
#include "read/mesh.h"
#include "read/mesh_file.h"
#include "write/file_out.h"
#include "write/mesh_npz.h"
#include "write/volume.h"

static const char help[] = "tribox info - version, processor and kernels; or what a mesh file holds\n"
                           "\n"
                           "Usage: tribox info [--json]\n"
                           "       tribox info MESH [-o FILE.npz] [--json]\n"
                           "\n"
                           "  -o, --out FILE.npz    write the mesh for NumPy: vertices, faces and, if it has any, colours\n"
                           "  -j, --json            print a JSON object\n"
                           "  -q, --quiet           print no progress, and with -o no summary\n"
                           "  -h, --help            print this text\n"
                           "\n"
                           "A kernel is the test compiled for one instruction set. EXACT answers are the same with every\n"
                           "kernel; 'tribox overlap --kernel NAME' selects one.\n"
                           "\n"
                           "Exit codes: 0 success; 1 failure (a file, memory); 2 wrong command line.\n"
                           "\n"
                           "Example:\n"
                           "  tribox info bunny.ply\n";

typedef struct request {
    const char *mesh_path, *out_path;
    bool wants_json, is_quiet;
} request;

static const option_entry options[] = {{"out", 'o', OPTION_NAMES(request, out_path)},
                                       {"json", 'j', OPTION_SETS(request, wants_json)},
                                       {"quiet", 'q', OPTION_SETS(request, is_quiet)},
                                       {NULL, 0, false}};

/* What the manual page is made of, too. */
static void print_format(json *j, const volume_format *format)
{
    static const char *const kinds[] = {[VOLUME_SPARSE] = "sparse", [VOLUME_DENSE] = "dense", [VOLUME_FACES] = "faces"};
    json_open_object(j, NULL);
    json_string(j, "word", format->word);
    json_string(j, "ending", format->ending);
    json_string(j, "kind", kinds[volume_kind_of(format)]);
    json_string(j, "about", format->about);
    json_string(j, "holds", format->holds);
    json_close(j);
}

static int print_json(const char *processor)
{
    json j = json_to(stdout);
    json_open_object(&j, NULL);
    json_string(&j, "version", CMD_VERSION);
    json_string(&j, "processor", processor);
    json_open_array(&j, "kernels");
    for (size_t i = 0; tribox_kernel_list(i); i++)
        json_string(&j, NULL, tribox_kernel_list(i));
    json_close(&j);
    json_string(&j, "default_kernel", tribox_kernel_name(NULL));
    json_open_array(&j, "positions");
    json_string(&j, NULL, "float32");
    json_string(&j, NULL, "float64");
    json_close(&j);
    json_open_rows(&j, "formats");
    for (size_t i = 0; volume_format_at(i); i++)
        print_format(&j, volume_format_at(i));
    json_close(&j);
    json_close(&j);
    return output_flush();
}

static int print_text(const char *processor)
{
    printf("version         %s\n", CMD_VERSION);
    printf("processor       %s\n", processor);
    printf("kernels        ");
    for (size_t i = 0; tribox_kernel_list(i); i++)
        printf(" %s", tribox_kernel_list(i));
    printf("\ndefault kernel  %s\n", tribox_kernel_name(NULL));
    printf("positions       float32, float64\nformats        ");
    for (size_t i = 0; volume_format_at(i); i++)
        printf(" %s", volume_format_at(i)->word);
    putchar('\n');
    return output_flush();
}

static int print_mesh(const request *r, const mesh *m, const mesh_colours *colours)
{
    const char *const type = m->is_double ? "float64" : "float32", *const of = colours->of ? colours->from : NULL;
    const tribox_box *const b = &m->seen.bounds;
    const bool has_bounds = m->seen.not_finite < m->triangles;
    if (r->is_quiet && r->out_path && !r->wants_json)
        return EXIT_CODE_OK;
    if (!r->wants_json) {
        printf("mesh         %s\ntriangles    %zu\npositions    %s\ncolours      %s%s\n", r->mesh_path, m->triangles, type,
               of ? "of its " : "none", of ? of : "");
        if (has_bounds)
            printf("lo           %.6g, %.6g, %.6g\nhi           %.6g, %.6g, %.6g\n", b->lo[0], b->lo[1], b->lo[2], b->hi[0],
                   b->hi[1], b->hi[2]);
        return output_flush();
    }
    json j = json_to(stdout);
    json_open_object(&j, NULL);
    json_string(&j, "mesh", r->mesh_path);
    json_whole(&j, "triangles", m->triangles);
    json_string(&j, "positions", type);
    if (of)
        json_string(&j, "colours", of);
    if (has_bounds) {
        json_doubles(&j, "lo", b->lo, 3, !m->is_double);
        json_doubles(&j, "hi", b->hi, 3, !m->is_double);
    }
    json_close(&j);
    return output_flush();
}

static int write_mesh(const request *r, const mesh *m, const mesh_colours *colours)
{
    file_out out;
    int code = file_out_open(&out, r->out_path);
    if (!code && r->out_path)
        code = mesh_npz_write(&out, m, colours->of);
    if (!code)
        code = file_out_keep(&out);
    file_out_drop(&out);
    return code;
}

static int tell_mesh(const request *r, const file_out_names *names, const mesh *m)
{
    mesh_colours colours;
    int code = EXIT_CODE_OK;
    for (const char *name = m->opened; !code && name && *name; name += strlen(name) + 1)
        code = file_out_check(names, "file of its data", &name, 1);
    mesh_warn(r->mesh_path, m);
    if (!code)
        code = mesh_colours_read(r->mesh_path, TRIANGLES_OTHER, m->triangles, names, false, &colours);
    if (code)
        return code;
    code = write_mesh(r, m, &colours);
    if (!code)
        code = print_mesh(r, m, &colours);
    mesh_colours_free(&colours);
    return code;
}

static int answer_mesh(const request *r)
{
    mesh m;
    const file_out_names names = {{"--out"}, {r->out_path}};
    if (r->out_path && (file_out_is_stdout(r->out_path) || !mesh_kind_has_ending(r->out_path, ".npz")))
        return message_usage("--out: '%s' is no name that ends in .npz", r->out_path);
    int code = file_out_check(&names, "mesh", &r->mesh_path, 1);
    if (!code)
        code = mesh_read_over(&(mesh_request){.path = r->mesh_path, .threads = processors_here()}, &m);
    if (code)
        return code;
    code = tell_mesh(r, &names, &m);
    mesh_free(&m);
    return code;
}

static int take(void *asked, int which, const char *value)
{
    return which == OPTION_OPERAND ? options_take_mesh(value, &((request *)asked)->mesh_path) : EXIT_CODE_OK;
}

static int answer(void *asked, const options_found *found)
{
    const request *const r = asked;
    char processor[200];
    (void)found;
    if (r->mesh_path)
        return answer_mesh(r);
    if (r->out_path)
        return message_usage("--out is of a mesh: give one");
    processors_name(processor, sizeof processor);
    return r->wants_json ? print_json(processor) : print_text(processor);
}

int cmd_info(int count, char **words)
{
    return options_answer(&(options_command){help, options, take, answer}, count, words, &(request){.wants_json = false});
}
