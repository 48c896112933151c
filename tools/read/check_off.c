/* check_off.c - refuses an OFF file with fewer vertices or faces than it promises, or faces that refer to none of its vertices. */
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_file.h"
#include "console/message.h"

/* The first word of the next line that has one, comments left out; NULL at the end. */
static const char *next_content(const char *at)
{
    for (;;) {
        at += strspn(at, " \t\r\n");
        if (*at != '#')
            return *at ? at : NULL;
        at += strcspn(at, "\r\n");
    }
}

static bool read_count(const char **at, uint64_t *count)
{
    char *end;
    *at = next_content(*at);
    if (!*at || !strchr("0123456789", **at))
        return false;
    *count = strtoull(*at, &end, 10);
    *at = end;
    return true;
}

/* How many numbers follow on the line, up to `most`. */
static uint64_t count_numbers(const char *line, uint64_t most)
{
    uint64_t count = 0;
    for (; count < most; count++) {
        char *end;
        line += strspn(line, " \t");
        if (strchr("\r\n#", *line))
            break;
        strtod(line, &end);
        if (end == line)
            break;
        line = end;
    }
    return count;
}

static int check_face(const char *path, const char *line, uint64_t vertices, uint64_t number)
{
    char *at;
    const uint64_t corners = strtoull(line, &at, 10);
    if (count_numbers(at, corners) < corners)
        return message_failure("%s: truncated: face %llu has fewer than its %llu vertices on its line", path,
                               (unsigned long long)number, (unsigned long long)corners);
    for (uint64_t i = 0; i < corners; i++) {
        const long long index = strtoll(at, &at, 10);
        if ((uint64_t)index >= vertices) /* a negative one is far above */
            return message_failure("%s: damaged: face %llu refers to vertex %lld, the file has %llu, counted from 0", path,
                                   (unsigned long long)number, index, (unsigned long long)vertices);
    }
    return EXIT_CODE_OK;
}

int mesh_file_check_off(const char *path, const mesh_file *file)
{
    uint64_t vertices, faces;
    const char *at = next_content(file->bytes);
    if (at)
        at += strspn(at, "STCN"); /* texture coordinates, colours, normals behind the coordinates */
    if (!at || strncmp(at, "OFF", 3))
        return EXIT_CODE_OK;
    at += 3;
    if (!read_count(&at, &vertices) || !read_count(&at, &faces))
        return message_failure("%s: truncated, or no text: no counts of vertices and faces behind 'OFF'", path);
    if (vertices > file->size || faces > file->size) /* their sum may overflow */
        return message_failure("%s: truncated: %llu vertices and %llu faces promised, more than the file has bytes", path,
                               (unsigned long long)vertices, (unsigned long long)faces);
    for (uint64_t i = 0; i < vertices + faces; i++) {
        at += strcspn(at, "\r\n");
        at = next_content(at);
        if (!at)
            return message_failure("%s: truncated: %llu vertices and %llu faces promised, a line each, but only %llu lines follow",
                                   path, (unsigned long long)vertices, (unsigned long long)faces, (unsigned long long)i);
        if (i < vertices && count_numbers(at, 3) < 3)
            return message_failure("%s: truncated: vertex %llu has fewer than 3 coordinates", path, (unsigned long long)i);
        const int code = i < vertices ? EXIT_CODE_OK : check_face(path, at, vertices, i - vertices);
        if (code)
            return code;
    }
    return EXIT_CODE_OK;
}
