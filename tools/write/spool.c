/* spool.c - nameless files, and what is in memory as long as it is little. */
#define _POSIX_C_SOURCE 200809L
#include "spool.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "console/interrupt.h"
#include "console/memory.h"
#include "console/message.h"
#include "console/pages.h"
#include "files/new_file.h"

enum { KEPT = 1 << 22, CHUNK = 1 << 16 };

/* A name in the folder of the output, or in a place for such files. To be freed; NULL without memory. */
static char *name_within(const file_out *out)
{
    if (out->target)
        return file_out_beside(out->target, false);
    char *const folder = new_file_passing_folder(), *const name = folder ? malloc(strlen(folder) + sizeof "/x") : NULL;
    if (name)
        strcat(strcpy(name, folder), "/x");
    free(folder);
    char *const beside = name ? file_out_beside(name, false) : NULL;
    free(name);
    return beside;
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

waiting waiting_for(const file_out *out) { return (waiting){.out = out}; }

void waiting_free(waiting *w)
{
    if (w->rest)
        fclose(w->rest);
    pages_free(w->bytes, w->room);
    *w = (waiting){.count = 0};
}

int waiting_add(waiting *w, const void *bytes, size_t count)
{
    void *const grown = !w->rest && count <= KEPT - w->count ? memory_grow_pages(w->bytes, w->count + count, &w->room, 1) : NULL;
    if (grown) {
        w->bytes = grown;
        memcpy(w->bytes + w->count, bytes, count);
        w->count += count;
        return EXIT_CODE_OK;
    }
    if (!w->rest)
        w->rest = spool_open(w->out);
    if (!w->rest)
        return EXIT_CODE_FAILURE;
    return fwrite(bytes, 1, count, w->rest) == count ? EXIT_CODE_OK : file_out_failure(w->out);
}

int waiting_hand_on(waiting *w, void (*take)(void *data, const void *bytes, size_t count), void *data)
{
    unsigned char chunk[CHUNK];
    size_t length;
    if (w->count)
        take(data, w->bytes, w->count);
    if (!w->rest)
        return EXIT_CODE_OK;
    if (fflush(w->rest) || fseek(w->rest, 0, SEEK_SET))
        return file_out_failure(w->out);
    while ((length = fread(chunk, 1, sizeof chunk, w->rest)) > 0)
        take(data, chunk, length);
    return ferror(w->rest) ? file_out_failure(w->out) : EXIT_CODE_OK;
}
