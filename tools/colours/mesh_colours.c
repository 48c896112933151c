/* mesh_colours.c - the colours of vertices and faces, and the materials of OBJ: what their files say, and which the faces have. */
#include "colours.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/system.h"
#include "console/message.h"
#include "files/files.h"
#include "read/assimp_plugin.h"
#include "read/mesh.h"
#include "read/scan.h"

typedef struct material {
    char *name;
    rgb colour;
    bool has_colour;
} material;

typedef struct materials {
    const char *path;              /* of the mesh */
    const file_out_names *outputs; /* none of which may be a file of materials */
    material *of;
    size_t count, room;
    const material *now; /* of the faces that follow; NULL for none */
    uint64_t missing;    /* lines that use a material that there is not */
} materials;

/* The first of that name; NULL where there is none. */
static const material *find(const materials *m, const char *name, size_t length)
{
    for (size_t i = 0; i < m->count; i++)
        if (strlen(m->of[i].name) == length && !memcmp(m->of[i].name, name, length))
            return &m->of[i];
    return NULL;
}

static bool add(materials *m, const char *name, size_t length)
{
    material *const of = memory_grow(m->of, m->count + 1, &m->room, sizeof *of);
    m->of = of ? of : m->of;
    char *const copy = of ? calloc(1, length + 1) : NULL;
    if (!copy)
        return false;
    of[m->count++] = (material){.name = memcpy(copy, name, length)};
    return true;
}

/* One number stands for all three. Spectra and other words are no colour. */
static void read_colour(material *to, words w)
{
    double number[3] = {0, 0, 0};
    int count = 0;
    while (count < 3 && words_next_on_line(&w) && words_number(&w, &number[count], &(float_fit){FLOAT_FIT_EXACT}))
        count++;
    for (int c = 1; count == 1 && c < 3; c++)
        number[c] = number[0];
    to->has_colour = count == 1 || count == 3;
    to->colour = to->has_colour ? rgb_of(number, 1) : RGB_GREY;
}

static bool read_lines(materials *m, const char *path, const whole_file *file)
{
    for (words w = words_of(path, file, '#'); words_next(&w); words_skip_line(&w)) {
        size_t length;
        const char *const rest = words_rest(w, &length);
        if (words_is(&w, "newmtl")) {
            if (!add(m, rest, length))
                return false;
        } else if (m->count && words_is(&w, "Kd")) {
            read_colour(&m->of[m->count - 1], w);
        }
    }
    return true;
}

/* Adds those of a file. Returns an exit_code. */
static int read_file(materials *m, const char *path)
{
    whole_file file;
    int code = whole_file_read(path, MESH_OTHER, &file);
    if (!code && !read_lines(m, path, &file))
        code = message_failure("%s: out of memory for its materials", path);
    whole_file_free(&file);
    return code;
}

static void use_material(materials *m, words line)
{
    size_t length;
    const char *const name = words_rest(line, &length);
    m->now = find(m, name, length);
    if (m->now && m->now->has_colour)
        return;
    if (!m->missing++)
        message_say("warning: %s: material '%.*s' %s: its faces are grey", m->path, (int)(length < 60 ? length : 60), name,
                    m->now ? "has no Kd that is a colour" : "is in none of its .mtl files");
}

static char *beside(const char *path, const char *name, size_t length)
{
    const size_t folder = named_file_folder(path);
    char *const joined = malloc(folder + length + 1);
    if (!joined)
        return NULL;
    memcpy(joined, path, folder);
    memcpy(joined + folder, name, length);
    joined[folder + length] = '\0';
    for (char *c = joined + folder; *c; c++)
        *c = (char)(*c == '\\' ? '/' : *c);
    return joined;
}

/* Returns whether there is such a file. A path that is whole stays as it is. */
static bool take_library(materials *m, const char *name, size_t length, bool has_to, int *code)
{
    file_about about;
    char *const path = beside(*name == '/' ? "" : m->path, name, length);
    if (!path) {
        *code = message_failure("%s: out of memory for its materials", m->path);
        return true;
    }
    const bool is_there = named_file_about(path, &about) && about.kind == FILE_KIND_REGULAR && about.size;
    if (is_there)
        *code = file_out_check(m->outputs, "file of its materials", (const char *const[]){path}, 1);
    if (is_there && !*code)
        *code = read_file(m, path);
    if (!is_there && has_to)
        message_say("warning: %s: its materials '%s' are no file that can be read: their faces are grey", m->path, path);
    free(path);
    return is_there;
}

/* One name, be it with blanks, or several. */
static int take_libraries(materials *m, words w)
{
    size_t length;
    const char *const all = words_rest(w, &length);
    int code = EXIT_CODE_OK;
    const bool is_one = !memchr(all, ' ', length);
    if (!length || take_library(m, all, length, is_one, &code) || is_one)
        return code;
    while (!code && words_next_on_line(&w))
        take_library(m, w.word, w.length, true, &code);
    return code;
}

/* Takes a line, of which `line` has the first word, for what it says of materials. Returns an exit_code; materials_end follows. */
static int materials_take(materials *m, words line)
{
    if (words_is(&line, "usemtl"))
        use_material(m, line);
    return words_is(&line, "mtllib") ? take_libraries(m, line) : EXIT_CODE_OK;
}

static void materials_end(materials *m)
{
    if (m->missing > 1)
        message_say("warning: %s: in all %" PRIu64 " lines use materials without a colour", m->path, m->missing);
    for (size_t i = 0; i < m->count; i++)
        free(m->of[i].name);
    free(m->of);
}

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
static int scan_items(colouring *c, bool are_vertices)
{
    const scan_item *const i = &c->s.item;
    int code = EXIT_CODE_OK;
    for (scan_again(&c->s); !code && !c->has_changed && !(code = scan_next(&c->s)) && i->kind != SCAN_END;) {
        if (are_vertices && i->kind == SCAN_FACE && i->has_colour)
            break;
        if (are_vertices && i->kind == SCAN_VERTEX && i->which == SCAN_POSITIONS)
            take_vertex(c);
        else if (!are_vertices && i->kind == SCAN_FACE)
            take_face(c);
        else if (!are_vertices && i->kind == SCAN_STRIP)
            take_strip(c);
        else if (!are_vertices && c->s.kind == MESH_OBJ && (i->kind == SCAN_STATE || i->kind == SCAN_OTHER))
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
    int code = scan_items(c, true);
    if (!code)
        code = scan_items(c, false);
    materials_end(&c->materials);
    if (!code && (c->has_changed || c->next != c->to->triangles))
        return message_failure("%s: has changed while it was read", path);
    if (!c->coloured)
        mesh_colours_free(c->to);
    return code;
}

static int read_faces(const char *path, mesh_kind kind, const file_out_names *outputs, mesh_colours *to)
{
    colouring *const c = calloc(1, sizeof *c);
    whole_file file;
    if (!c)
        return message_failure("%s: out of memory", path);
    c->to = to;
    c->materials = (materials){.path = path, .outputs = outputs};
    int code = whole_file_read(path, kind, &file);
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
        mesh_colours_free(to);
    else if (found.textured)
        message_say("%s: note: %zu of %zu triangles have a texture, which is not read: they are grey", path, found.textured,
                    to->triangles);
    to->from = found.of_vertices ? "vertices" : "materials";
    return EXIT_CODE_OK;
}

int mesh_colours_read(const char *path, triangle_format format, size_t triangles, const file_out_names *outputs, bool has_to,
                      mesh_colours *colours)
{
    if (!strcmp(path, "-") && format >= TRIANGLES_KINDS)
        return message_failure("stdin: its colours need the mesh as a file, since it is read twice");
    const mesh_kind kind = format == TRIANGLES_OTHER ? mesh_kind_of(path) : triangle_format_kind(format);
    const triangle_format listed = format == TRIANGLES_OTHER ? triangle_format_of(path) : format;
    const bool are_read = kind != MESH_STL_TEXT && (listed == TRIANGLES_OTHER || listed >= TRIANGLES_KINDS);
    *colours = (mesh_colours){.triangles = triangles, .from = "vertices"};
    if (are_read) {
        colours->of = malloc(triangles * sizeof *colours->of);
        if (!colours->of)
            return message_failure("%s: out of memory for the colours of %zu triangles", path, triangles);
        const int code = kind == MESH_OTHER ? read_others(path, colours) : read_faces(path, kind, outputs, colours);
        if (code) {
            mesh_colours_free(colours);
            return code;
        }
    }
    return colours->of || !has_to ? EXIT_CODE_OK
                                  : message_failure("%s: %s: %s", triangle_file_name(path),
                                                    are_read ? "has no colours" : "no colours of its format are read", advice);
}

void mesh_colours_free(mesh_colours *colours)
{
    free(colours->of);
    colours->of = NULL;
}
