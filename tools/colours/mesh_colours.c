/* mesh_colours.c - finds the reader of a file's colours, and refuses meshes that have none. */
#include "mesh_colours.h"

#include <math.h>
#include <stdlib.h>

#include "console/message.h"
#include "materials.h"
#include "read/assimp_part.h"
#include "read/mesh.h"
#include "read/scan.h"

static const char advice[] =
    "colours are read of PLY with red, green and blue, of OFF, and of OBJ, glTF and others with materials or colours of vertices, "
    "not of textures; leave out --colours";

typedef struct vertex_colour {
    rgb colour;
    bool is_there;
} vertex_colour;

typedef struct colouring {
    scan s;
    mesh_colours *to;
    vertex_colour *vertices;
    materials materials;
    size_t next;     /* triangle */
    size_t coloured; /* of those before it: not grey for want of a colour */
    bool has_changed;
} colouring;

/* The next triangles; colour: NULL where they have none. */
static void colour_triangles(colouring *c, size_t triangles, const rgb *colour)
{
    c->has_changed |= triangles > c->to->triangles - c->next;
    for (size_t t = 0; t < triangles && !c->has_changed; t++)
        c->to->of[c->next++] = colour ? *colour : RGB_GREY;
    c->coloured += colour ? triangles : 0;
}

/* The mean of vertices, if all that are there of them have a colour. */
static bool find_mean(const colouring *c, const scan_reference *of, size_t count, rgb *mean)
{
    rgb_sum sum = {.count = 0};
    size_t corners = 0;
    for (size_t n = 0; n < count; n++)
        if (of[n].which == SCAN_POSITIONS && of[n].number != SCAN_BREAK) {
            corners++;
            if (c->vertices[of[n].number].is_there)
                rgb_add(&sum, c->vertices[of[n].number].colour);
        }
    *mean = rgb_mean(&sum);
    return corners && sum.count == corners;
}

static void take_face(colouring *c)
{
    const scan_item *const i = &c->s.item;
    const material *const m = c->materials.now;
    rgb colour;
    const bool has_mean = !i->has_colour && find_mean(c, i->references, i->count, &colour);
    if (i->has_colour)
        colour = rgb_of(i->colour, i->most);
    if (i->corners > 2)
        c->to->from = i->has_colour ? "faces" : has_mean || c->s.kind != MESH_OBJ ? "vertices" : "materials";
    colour_triangles(c, i->corners > 2 ? i->corners - 2 : 0,
                     i->has_colour || has_mean ? &colour
                     : m && m->has_colour      ? &m->colour
                                               : NULL);
}

static void take_strip(colouring *c)
{
    const scan_reference *of = c->s.item.references;
    for (size_t n = 2; n < c->s.item.count; n++, of++) {
        rgb mean;
        if (of[0].number != SCAN_BREAK && of[1].number != SCAN_BREAK && of[2].number != SCAN_BREAK)
            colour_triangles(c, 1, find_mean(c, of, 3, &mean) ? &mean : NULL);
    }
}

/* COFF has a colour for each vertex; grey where the line lacks it. */
static void take_vertex(colouring *c)
{
    const scan_item *const i = &c->s.item;
    vertex_colour *const v = &c->vertices[c->s.here[SCAN_POSITIONS] - 1];
    v->colour = i->has_colour ? rgb_of(i->colour, i->most) : RGB_GREY;
    v->is_there = i->has_colour || c->s.has_coloured_vertices;
}

/* Vertices come first, wherever they are in the file, unless faces have colours. */
static int scan_vertices(colouring *c)
{
    const scan_item *const i = &c->s.item;
    int code = EXIT_CODE_OK;
    for (scan_again(&c->s); !code && !(code = scan_next(&c->s)) && i->kind != SCAN_END;) {
        if (i->kind == SCAN_FACE && i->has_colour)
            break;
        if (i->kind == SCAN_VERTEX && i->which == SCAN_POSITIONS)
            take_vertex(c);
    }
    return code;
}

static int scan_faces(colouring *c)
{
    const scan_item *const i = &c->s.item;
    int code = EXIT_CODE_OK;
    for (scan_again(&c->s); !code && !c->has_changed && !(code = scan_next(&c->s)) && i->kind != SCAN_END;) {
        if (i->kind == SCAN_FACE)
            take_face(c);
        else if (i->kind == SCAN_STRIP)
            take_strip(c);
        else if (c->s.kind == MESH_OBJ && (i->kind == SCAN_STATE || i->kind == SCAN_OTHER))
            code = materials_take(&c->materials, i->words);
    }
    return code;
}

static int scan_colours(const char *path, colouring *c)
{
    c->s.has_colours = true;
    c->vertices = calloc((size_t)c->s.all[SCAN_POSITIONS] + 1, sizeof *c->vertices);
    if (!c->vertices)
        return message_failure("%s: out of memory for the colours of its vertices", path);
    int code = scan_vertices(c);
    if (!code)
        code = scan_faces(c);
    materials_end(&c->materials);
    if (!code && (c->has_changed || c->next != c->to->triangles))
        return message_failure("%s: has changed while it was read", path);
    return code || c->coloured ? code : message_failure("%s: has no colours: %s", path, advice);
}

static int read_faces(const char *path, mesh_kind kind, const file_out_names *outputs, mesh_colours *to)
{
    colouring *const c = calloc(1, sizeof *c);
    whole_file file;
    if (!c)
        return message_failure("%s: out of memory", path);
    c->to = to;
    c->materials = (materials){.path = path, .outputs = outputs};
    int code = whole_file_read(path, &file);
    if (!code) {
        code = scan_open(path, kind, &file, &c->s);
        code = code ? code : scan_colours(path, c);
        scan_close(&c->s);
    }
    whole_file_free(&file);
    free(c->vertices);
    free(c);
    return code;
}

/* Files that libassimp reads. What glTF has is light. */
static int read_others(const char *path, mesh_colours *to)
{
    const bool is_light = mesh_kind_has_ending(path, ".glb") || mesh_kind_has_ending(path, ".gltf");
    float(*const of)[3] = malloc(to->triangles * sizeof *of);
    assimp_colours found = {0, 0, 0};
    if (!of)
        return message_failure("%s: out of memory for the colours of %zu triangles", path, to->triangles);
    const int code = read_colours_by_assimp(path, to->triangles, of, &found);
    for (size_t t = 0; t < to->triangles && !code; t++) {
        const double number[3] = {(double)of[t][0], (double)of[t][1], (double)of[t][2]};
        to->of[t] = isnan(of[t][0]) ? RGB_GREY : is_light ? rgb_of_light(number) : rgb_of(number, 1);
    }
    free(of);
    if (code)
        return code;
    if (!found.of_vertices && !found.of_materials)
        return message_failure("%s: has no colours: %s", path, advice);
    if (found.textured)
        message_say("%s: note: %zu of %zu triangles have a texture, which is not read: they are grey", path, found.textured,
                    to->triangles);
    to->from = found.of_vertices ? "vertices" : "materials";
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
    const int code = kind == MESH_OTHER ? read_others(path, colours) : read_faces(path, kind, outputs, colours);
    if (code)
        mesh_colours_free(colours);
    return code;
}

void mesh_colours_free(mesh_colours *colours)
{
    free(colours->of);
    colours->of = NULL;
}
