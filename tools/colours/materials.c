/* materials.c - reads MTL: newmtl NAME, and its colour, Kd R [G B]. */
#include "materials.h"

#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "read/obj_lines.h"

const material *materials_find(const materials *m, const char *name, size_t length)
{
    for (size_t i = 0; i < m->count; i++)
        if (strlen(m->of[i].name) == length && !memcmp(m->of[i].name, name, length))
            return &m->of[i];
    return NULL;
}

static bool make_room(materials *m)
{
    if (m->count < m->room)
        return true;
    const size_t room = m->room ? 2 * m->room : 16;
    material *const more = realloc(m->of, room * sizeof *more);
    if (!more)
        return false;
    m->of = more;
    m->room = room;
    return true;
}

static bool add(materials *m, const char *name, size_t length)
{
    char *const copy = make_room(m) ? malloc(length + 1) : NULL;
    if (!copy)
        return false;
    memcpy(copy, name, length);
    copy[length] = '\0';
    m->of[m->count++] = (material){.name = copy};
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
    words w = words_of(path, file, '#');
    obj_line line;
    for (const char *from = file->bytes; obj_line_next(&w, from, &line); from = line.end) {
        size_t length;
        const char *const rest = obj_line_rest(&line, &length);
        if (words_is(&line.words, "newmtl")) {
            if (!add(m, rest, length))
                return false;
        } else if (m->count && words_is(&line.words, "Kd")) {
            read_colour(&m->of[m->count - 1], line.words);
        }
    }
    return true;
}

int materials_read(materials *m, const char *path)
{
    whole_file file;
    int code = whole_file_read(path, &file);
    if (!code && !read_lines(m, path, &file))
        code = message_failure("%s: out of memory for its materials", path);
    whole_file_free(&file);
    return code;
}

void materials_free(materials *m)
{
    for (size_t i = 0; i < m->count; i++)
        free(m->of[i].name);
    free(m->of);
    *m = (materials){.count = 0};
}
