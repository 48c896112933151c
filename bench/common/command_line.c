#include "command_line.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "soups.h"

int argument_fail(const char *program, const char *what, const char *which, const char *help)
{
    fprintf(stderr, "%s: %s '%s'; %s\n", program, what, which, help);
    return 2;
}

bool argument_number(const char *text, uint64_t least, uint64_t most, uint64_t *number)
{
    char *end;
    errno = 0;
    const unsigned long long read = strtoull(text, &end, 0);
    if (text[0] < '0' || text[0] > '9' || *end || errno || read < least || read > most)
        return false;
    *number = read;
    return true;
}

bool argument_scene(const char *program, const char *name, size_t *index)
{
    for (*index = 0; *index < scene_count(); ++*index)
        if (!strcmp(name, scene_name(*index)))
            return true;
    fprintf(stderr, "%s: unknown scene '%s'; the scenes are:\n", program, name);
    for (size_t s = 0; s < scene_count(); s++)
        fprintf(stderr, "  %-12s %s\n", scene_name(s), scene_what(s));
    return false;
}
