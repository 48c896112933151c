/* check_ply.c - walks a PLY file from its header to its last value, and refuses one that ends too soon. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_file.h"
#include "console/message.h"

enum { PROPERTIES_MAX = 256, LINE_SHOWN = 60 };

enum ply_format { PLY_ASCII, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN };

/* A property of an element: a value of `size` bytes, or a list of them behind a count of `count_size` bytes. */
typedef struct property {
    size_t count_size; /* 0: no list */
    size_t size;
    bool is_index; /* the vertices of a face */
} property;

typedef struct element {
    char name[32];
    uint64_t count;
    property properties[PROPERTIES_MAX];
    int property_count;
} element;

/* The values behind the header, from `at` on. */
typedef struct values {
    const char *at;
    const char *end;
    enum ply_format format;
    const char *word; /* the last one, in an ASCII file */
} values;

typedef enum outcome { TAKEN, CUT_OFF, FAR_INDEX } outcome;

static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

static bool is_blank(char c) { return c == ' ' || c == '\t' || is_line_end(c); }

static const char *next_line(const char *line)
{
    while (*line && !is_line_end(*line))
        line++;
    while (is_line_end(*line))
        line++;
    return line;
}

static bool starts_with(const char *line, const char *word)
{
    const size_t length = strlen(word);
    return !strncmp(line, word, length) && (!line[length] || is_blank(line[length]));
}

bool mesh_file_is_ply(const mesh_file *file) { return starts_with(file->bytes, "ply") || starts_with(file->bytes, "PLY"); }

/* Behind the word end_header; NULL if the header does not end. */
static const char *find_header_end(const mesh_file *file)
{
    const char *line = file->bytes;
    while (*line && !starts_with(line, "end_header"))
        line = next_line(line);
    return *line ? line + strlen("end_header") : NULL;
}

/* How many bytes end a line of the header: a file in CR alone may have a first value that begins with the byte of LF. */
static size_t line_end_size(const mesh_file *file) { return file->bytes[3] == '\r' && file->bytes[4] == '\n' ? 2 : 1; }

static size_t type_size(const char *type)
{
    static const struct {
        const char *name;
        size_t size;
    } types[] = {{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
                 {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
                 {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        if (!strcmp(type, types[i].name))
            return types[i].size;
    return 0;
}

static bool read_property(const char *line, property *p)
{
    char type[16] = "", count_type[16] = "", name[32] = "";
    if (sscanf(line, "property list %15s %15s %31s", count_type, type, name) >= 2) {
        p->is_index = !strcmp(name, "vertex_indices") || !strcmp(name, "vertex_index");
        p->count_size = type_size(count_type);
        p->size = type_size(type);
        return p->count_size && p->size;
    }
    p->is_index = false;
    p->count_size = 0;
    p->size = sscanf(line, "property %15s", type) == 1 ? type_size(type) : 0;
    return p->size;
}

/* Moves past one ASCII value or `size` bytes. *value receives it as a count; what is none counts as 0. */
static bool take_value(values *v, size_t size, uint64_t *value)
{
    *value = 0;
    if (v->format == PLY_ASCII) {
        while (v->at < v->end && is_blank(*v->at))
            v->at++;
        v->word = v->at;
        while (v->at < v->end && !is_blank(*v->at))
            v->at++;
        *value = strtoull(v->word, NULL, 10);
        return v->at > v->word;
    }
    if ((size_t)(v->end - v->at) < size)
        return false;
    for (size_t i = 0; i < size; i++)
        *value = *value << 8 | (unsigned char)v->at[v->format == PLY_BIG_ENDIAN ? i : size - 1 - i];
    v->at += size;
    return true;
}

/* An index of 2^32 or more libassimp would take for a small one; others it keeps as they are. */
static outcome take_values(values *v, const property *p, uint64_t count)
{
    if (v->format != PLY_ASCII) {
        if (count > (size_t)(v->end - v->at) / p->size)
            return CUT_OFF;
        v->at += count * p->size;
        return TAKEN;
    }
    for (uint64_t value; count; count--) {
        if (!take_value(v, p->size, &value))
            return CUT_OFF;
        if (p->is_index && value > UINT32_MAX)
            return FAR_INDEX;
    }
    return TAKEN;
}

static outcome take_instance(values *v, const element *e)
{
    outcome taken = TAKEN;
    for (int i = 0; taken == TAKEN && i < e->property_count; i++) {
        const property *p = &e->properties[i];
        uint64_t count = 1;
        if (p->count_size && !take_value(v, p->count_size, &count))
            return CUT_OFF;
        taken = take_values(v, p, count);
    }
    return taken;
}

static int take_element(const char *path, values *v, const element *e)
{
    if (e->count && !e->property_count)
        return message_failure("%s: not a sound PLY file: the header promises %llu of '%s' without a property", path,
                               (unsigned long long)e->count, e->name);
    for (uint64_t i = 0; i < e->count; i++) {
        const outcome taken = take_instance(v, e);
        if (taken == CUT_OFF)
            return message_failure("%s: truncated: the header promises %llu of '%s', the file ends in number %llu", path,
                                   (unsigned long long)e->count, e->name, (unsigned long long)i + 1);
        if (taken == FAR_INDEX)
            return message_failure("%s: damaged: face %llu refers to vertex %.*s, which no file has", path, (unsigned long long)i,
                                   LINE_SHOWN < v->at - v->word ? LINE_SHOWN : (int)(v->at - v->word), v->word);
    }
    return EXIT_CODE_OK;
}

static int refuse_line(const char *path, const char *line)
{
    return message_failure("%s: not a sound PLY file: '%.*s' in its header makes no sense", path,
                           (int)strcspn(line, "\r\n") < LINE_SHOWN ? (int)strcspn(line, "\r\n") : LINE_SHOWN, line);
}

/* Reads the element on this line of the header, and its properties on the following. */
static int read_element(const char *path, const char *line, element *e)
{
    char count[24];
    if (sscanf(line, "element %31s %23[0-9]", e->name, count) != 2)
        return refuse_line(path, line);
    e->count = strtoull(count, NULL, 10);
    e->property_count = 0;
    /* libassimp drops the first triangle of each strip. */
    if (!strcmp(e->name, "tristrips") && e->count)
        return message_failure("%s: has triangle strips, which libassimp misreads; save the mesh with faces", path);
    for (line = next_line(line); !starts_with(line, "element") && !starts_with(line, "end_header"); line = next_line(line))
        if (starts_with(line, "property") &&
            (e->property_count == PROPERTIES_MAX || !read_property(line, &e->properties[e->property_count++])))
            return refuse_line(path, line);
    return EXIT_CODE_OK;
}

static bool read_format(const char *line, enum ply_format *format)
{
    static const char *const words[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    char word[24] = "";
    sscanf(line, "format %23s", word);
    for (int i = 0; i < 3; i++)
        if (!strcmp(word, words[i])) {
            *format = (enum ply_format)i;
            return true;
        }
    return false;
}

/* Walks the elements that the header lists over the values behind it. */
static int take_elements(const char *path, const mesh_file *file, const char *header_end)
{
    const char *file_end = file->bytes + file->size;
    const size_t behind = (size_t)(file_end - header_end), line_end = line_end_size(file);
    values v = {.at = header_end + (behind < line_end ? behind : line_end), .end = file_end, .format = PLY_ASCII};
    for (const char *line = file->bytes; line < header_end; line = next_line(line)) {
        element e;
        if (starts_with(line, "format") && !read_format(line, &v.format))
            return refuse_line(path, line);
        if (!starts_with(line, "element"))
            continue;
        int code = read_element(path, line, &e);
        if (!code)
            code = take_element(path, &v, &e);
        if (code)
            return code;
    }
    return EXIT_CODE_OK;
}

static int end_header_in_cr_lf(const char *path, mesh_file *file, size_t header_size)
{
    char *bytes = realloc(file->bytes, file->size + 2);
    if (!bytes)
        return message_failure("%s: out of memory", path);
    memmove(bytes + header_size + 2, bytes + header_size + 1, file->size - header_size);
    memcpy(bytes + header_size, "\r\n", 2);
    file->bytes = bytes;
    file->size++;
    return EXIT_CODE_OK;
}

int mesh_file_check_ply(const char *path, mesh_file *file)
{
    const char *header_end = find_header_end(file);
    if (!header_end)
        return message_failure("%s: truncated: the PLY header does not end", path);
    if (file->size >= UINT32_MAX)
        return message_failure("%s: libassimp reads PLY files below 4 GiB only; split the mesh", path);
    const int code = take_elements(path, file, header_end);
    if (code || !*header_end || line_end_size(file) == 2)
        return code;
    return end_header_in_cr_lf(path, file, (size_t)(header_end - file->bytes));
}
