/* mesh_colours.c - finds the reader of a file's colours, and refuses meshes that have none. */
#include "mesh_colours.h"

#include <stdlib.h>

#include "console/message.h"
#include "face_colours.h"
#include "read/mesh_kind.h"

static const char advice[] =
    "colours are read of PLY with red, green and blue, of OBJ with materials or colours of vertices, and of OFF; "
    "leave out --colours";

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

int mesh_colours_read(const char *path, triangle_format format, size_t triangles, mesh_colours *colours)
{
    const mesh_kind kind = format == TRIANGLES_OTHER ? mesh_kind_of(path) : MESH_OTHER;
    *colours = (mesh_colours){.triangles = triangles, .from = "vertices"};
    if (kind == MESH_OTHER || kind == MESH_STL_TEXT)
        return message_failure("%s: no colours of its format are read: %s", triangle_file_name(path), advice);
    colours->of = malloc(triangles * sizeof *colours->of);
    if (!colours->of)
        return message_failure("%s: out of memory for the colours of %zu triangles", path, triangles);
    face_colours f = {.path = path, .to = colours};
    const int code = read_faces(&f, kind);
    if (code)
        mesh_colours_free(colours);
    return code;
}

void mesh_colours_free(mesh_colours *colours)
{
    free(colours->of);
    colours->of = NULL;
}
