/* mesh_colours.c - finds the reader of a file's colours, and refuses meshes that have none. */
#include "mesh_colours.h"

#include <math.h>
#include <stdlib.h>

#include "console/message.h"
#include "face_colours.h"
#include "read/assimp_part.h"
#include "read/mesh_kind.h"
#include "read/readers.h"

static const char advice[] =
    "colours are read of PLY with red, green and blue, of OFF, and of OBJ, glTF and others with materials or colours of vertices, "
    "not of textures; leave out --colours";

void face_colours_add(face_colours *f, uint64_t corners, const rgb *colour)
{
    const uint64_t triangles = corners > 2 ? corners - 2 : 0;
    f->is_changed |= triangles > f->to->triangles - f->next;
    if (f->is_changed)
        return;
    for (uint64_t t = 0; t < triangles; t++)
        f->to->of[f->next + t] = colour ? *colour : RGB_GREY;
    f->next += triangles;
    f->coloured += colour ? triangles : 0;
}

static int read_faces(face_colours *f, mesh_kind kind)
{
    static int (*const readers[])(face_colours *, const whole_file *) = {
        [MESH_PLY] = face_colours_ply, [MESH_OFF] = face_colours_off, [MESH_OBJ] = face_colours_obj};
    whole_file file;
    int code = whole_file_read(f->path, &file);
    if (!code)
        code = readers[kind](f, &file);
    whole_file_free(&file);
    if (!code && (f->is_changed || f->next != f->to->triangles))
        return message_failure("%s: has changed while it was read", f->path);
    return code || f->coloured ? code : message_failure("%s: has no colours: %s", f->path, advice);
}

/* Files that libassimp reads. What glTF has is light. */
static int read_others(face_colours *f)
{
    const bool is_light = mesh_kind_has_ending(f->path, ".glb") || mesh_kind_has_ending(f->path, ".gltf");
    float(*const of)[3] = malloc(f->to->triangles * sizeof *of);
    assimp_colours found = {0, 0, 0};
    if (!of)
        return message_failure("%s: out of memory for the colours of %zu triangles", f->path, f->to->triangles);
    const int code = read_colours_by_assimp(f->path, f->to->triangles, of, &found);
    for (size_t t = 0; t < f->to->triangles && !code; t++) {
        const double number[3] = {(double)of[t][0], (double)of[t][1], (double)of[t][2]};
        f->to->of[t] = isnan(of[t][0]) ? RGB_GREY : is_light ? rgb_of_light(number) : rgb_of(number, 1);
    }
    free(of);
    if (code)
        return code;
    if (!found.of_vertices && !found.of_materials)
        return message_failure("%s: has no colours: %s", f->path, advice);
    if (found.textured)
        message_say("%s: note: %zu of %zu triangles have a texture, which is not read: they are grey", f->path, found.textured,
                    f->to->triangles);
    f->to->from = found.of_vertices ? "vertices" : "materials";
    return EXIT_CODE_OK;
}

static bool has_no_colours(const char *path, mesh_kind kind)
{
    return kind == MESH_STL_TEXT || mesh_kind_has_ending(path, ".stl") || mesh_kind_has_ending(path, ".f32") ||
           mesh_kind_has_ending(path, ".f64");
}

int mesh_colours_read(const char *path, triangle_format format, size_t triangles, const file_out_names *outputs,
                      mesh_colours *colours)
{
    const mesh_kind kind = format == TRIANGLES_OTHER ? mesh_kind_of(path) : MESH_OTHER;
    *colours = (mesh_colours){.triangles = triangles, .from = "vertices"};
    if (format != TRIANGLES_OTHER || has_no_colours(path, kind))
        return message_failure("%s: no colours of its format are read: %s", triangle_file_name(path), advice);
    colours->of = malloc(triangles * sizeof *colours->of);
    if (!colours->of)
        return message_failure("%s: out of memory for the colours of %zu triangles", path, triangles);
    face_colours f = {.path = path, .outputs = outputs, .to = colours};
    const int code = kind == MESH_OTHER ? read_others(&f) : read_faces(&f, kind);
    if (code)
        mesh_colours_free(colours);
    return code;
}

void mesh_colours_free(mesh_colours *colours)
{
    free(colours->of);
    colours->of = NULL;
}
