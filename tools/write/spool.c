/* spool.c - makes nameless files and copies them. */
#define _POSIX_C_SOURCE 200809L
#include "spool.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "console/interrupt.h"
#include "console/message.h"
#include "files/named_file.h"
#include "files/new_file.h"

enum { CHUNK = 1 << 16 };

/* A name in the folder of the output, or in a place for such files. To be freed; NULL without memory. */
static char *name_within(const file_out *out)
{
    static const char within[] = "/.tribox-XXXXXX";
    char *const folder = out->target ? NULL : new_file_passing_folder();
    const char *const from = out->target ? out->target : folder;
    const size_t length = !from ? 0 : folder ? strlen(folder) : named_file_folder(from);
    char *const name = from ? malloc(length + sizeof within) : NULL;
    if (name) {
        memcpy(name, from, length);
        strcpy(name + length, folder ? within : within + 1);
    }
    free(folder);
    return name;
}

FILE *spool_open(const file_out *out)
{
    char *const name = name_within(out);
    if (!name)
        return message_failure("%s: out of memory", out->path), NULL;
    interrupt_hold(); /* until it has no name */
    FILE *const spool = new_file_open_nameless(name);
    const int reason = errno;
    interrupt_release();
    if (!spool) {
        char *const slash = strrchr(name, '/');
        if (slash)
            *slash = '\0';
        message_failure("%s: cannot write there: %s", out->target ? out->path : name, strerror(reason));
    }
    free(name);
    return spool;
}

int spool_copy(FILE *spool, const file_out *out)
{
    unsigned char chunk[CHUNK];
    size_t length;
    if (ferror(spool) || fflush(spool) || fseeko(spool, 0, SEEK_SET))
        return file_out_failure(out);
    while (!ferror(out->stream) && (length = fread(chunk, 1, sizeof chunk, spool)) > 0)
        fwrite(chunk, 1, length, out->stream);
    return ferror(spool) || ferror(out->stream) ? file_out_failure(out) : EXIT_CODE_OK;
}
