/* spool.c - makes nameless files and copies them. */
#define _XOPEN_SOURCE 700
#include "spool.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "console/interrupt.h"
#include "console/message.h"

enum { CHUNK = 1 << 16 };

/* The folder of the output with its last slash, or a place for such files. Returns how many of its characters count. */
static int folder_of(const file_out *out, const char **folder)
{
    const char *const chosen = getenv("TMPDIR"), *const slash = out->target ? strrchr(out->target, '/') : NULL;
    *folder = out->target ? out->target : chosen && *chosen ? chosen : "/tmp";
    return out->target ? (int)(slash ? slash - out->target + 1 : 0) : (int)strlen(*folder);
}

static FILE *open_nameless(const char *pattern, char *name)
{
    interrupt_hold(); /* until it has no name */
    const int file = mkstemp(name), reason = errno;
    if (file >= 0)
        unlink(name);
    interrupt_release();
    if (file < 0)
        return message_failure("%s: cannot write there: %s", pattern, strerror(reason)), NULL;
    FILE *const spool = fdopen(file, "w+b");
    if (!spool)
        close(file);
    return spool ? spool : (message_failure("%s: cannot write there: %s", pattern, strerror(errno)), NULL);
}

FILE *spool_open(const file_out *out)
{
    static const char beside[] = ".tribox-XXXXXX", within[] = "/.tribox-XXXXXX";
    const char *folder;
    const int length = folder_of(out, &folder);
    const char *const last = out->target ? beside : within;
    const size_t size = (size_t)length + sizeof within;
    char *const name = malloc(size);
    if (!name)
        return message_failure("%s: out of memory", out->path), NULL;
    snprintf(name, size, "%.*s%s", length, folder, last);
    FILE *const spool = open_nameless(out->target ? out->path : folder, name);
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
