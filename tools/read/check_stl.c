/* check_stl.c - refuses an STL file that is not of the size of a binary one, unless it is text up to its end. */
#include <string.h>

#include "mesh_file.h"
#include "console/message.h"

static const char *last_of(const char *text, const char *word)
{
    const char *last = NULL;
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word))
        last = at;
    return last;
}

int mesh_file_check_stl(const char *path, const mesh_file *file)
{
    if (strncmp(file->bytes, "solid", 5) || memchr(file->bytes, '\0', file->size))
        return message_failure("%s: truncated, or no STL file: it does not have the size that its header promises, nor is it text "
                               "from 'solid' to 'endsolid'; write it anew",
                               path);
    const char *last = last_of(file->bytes, "facet");
    if (last && !strstr(last, "endsolid"))
        return message_failure("%s: truncated: no 'endsolid' behind the last facet", path);
    return EXIT_CODE_OK;
}
