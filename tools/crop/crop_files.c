/* crop_files.c - refuses what cannot be written as it was, before a long mesh is read. */
#include "crop_files.h"

#include <errno.h>
#include <string.h>

#include "console/message.h"
#include "files/named_file.h"

static const char *const options[CROP_SIDES] = {"-o", "--rest"};

static const char *ending_of(const crop_files *f)
{
    static const char *const of_formats[] = {[TRIANGLES_STL] = ".stl", [TRIANGLES_F32] = ".f32", [TRIANGLES_F64] = ".f64"},
                             *const of_kinds[] = {".ply", ".off", ".stl", ".obj"};
    return f->format != TRIANGLES_OTHER ? of_formats[f->format] : of_kinds[f->kind];
}

/* Binary STL may have a name of any ending, and a name in .stl be of text. */
static int find_format(triangle_format given, crop_files *f)
{
    triangle_file triangles;
    const int code = triangle_file_open(f->mesh_path, given, &triangles);
    f->format = triangles.stream ? triangles.format : TRIANGLES_OTHER;
    triangle_file_close(&triangles);
    if (code)
        return code;
    f->kind = f->format == TRIANGLES_OTHER ? mesh_kind_of(f->mesh_path) : MESH_OTHER;
    if (f->format != TRIANGLES_OTHER || f->kind != MESH_OTHER)
        return EXIT_CODE_OK;
    return message_failure("%s: -o and --rest write PLY, OBJ, OFF, STL and raw triangles, each from a mesh of the same format; "
                           "convert it to one of these first",
                           f->mesh_path);
}

static int check_mesh(const char *path, file_about *about)
{
    if (!named_file_about(path, about))
        return message_failure("%s: cannot open the mesh file: %s", path, strerror(errno));
    if (about->kind == FILE_KIND_FOLDER)
        return message_failure("%s: is a directory; give a mesh file", path);
    if (about->kind != FILE_KIND_REGULAR)
        return message_failure("%s: is not a regular file, and -o and --rest read the mesh twice; save it as a file first", path);
    return about->size ? EXIT_CODE_OK : message_failure("%s: the file is empty", path);
}

static int check_path(const crop_files *f, crop_side side, const char *path)
{
    const char *const ending = ending_of(f);
    if (!path || file_out_is_stdout(path))
        return EXIT_CODE_OK;
    if (!mesh_kind_has_ending(path, ending))
        return message_usage("%s: '%s' does not end in %s, and faces are written in the format of the mesh, as they were; give it "
                             "that ending, or convert the mesh first",
                             options[side], path, ending);
    return EXIT_CODE_OK;
}

static int check_paths(const crop_files *f, const char *const paths[CROP_SIDES])
{
    for (crop_side s = CROP_PART; s < CROP_SIDES; s++) {
        const int code = check_path(f, s, paths[s]);
        if (code)
            return code;
    }
    const file_out_names names = {{options[CROP_PART], options[CROP_REST]}, {paths[CROP_PART], paths[CROP_REST]}};
    return file_out_check(&names, "mesh", &f->mesh_path, 1);
}

int crop_files_open(const char *mesh_path, triangle_format format, const char *const paths[CROP_SIDES], crop_files *f)
{
    *f = (crop_files){.mesh_path = mesh_path, .kind = MESH_OTHER};
    int code = check_mesh(mesh_path, &f->mesh);
    if (!code)
        code = find_format(format, f);
    if (!code)
        code = check_paths(f, paths);
    for (int s = 0; !code && s < CROP_SIDES; s++)
        code = file_out_open(&f->out[s], paths[s]);
    return code;
}

void crop_files_drop(crop_files *f)
{
    for (int s = 0; s < CROP_SIDES; s++)
        file_out_drop(&f->out[s]);
}
