/* materials.c - the materials of OBJ: what their files say, and which of them the faces have. */
#include "materials.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/memory.h"
#include "console/message.h"
#include "files/named_file.h"

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
    int code = whole_file_read(path, &file);
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

int materials_take(materials *m, words line)
{
    if (words_is(&line, "usemtl"))
        use_material(m, line);
    return words_is(&line, "mtllib") ? take_libraries(m, line) : EXIT_CODE_OK;
}

void materials_end(materials *m)
{
    if (m->missing > 1)
        message_say("warning: %s: in all %" PRIu64 " lines use materials without a colour", m->path, m->missing);
    for (size_t i = 0; i < m->count; i++)
        free(m->of[i].name);
    free(m->of);
}
