/* waiting.c - keeps the first bytes in memory, which takes less than a file where they are few, and the others in a file. */
#include "waiting.h"

#include <string.h>

#include "console/memory.h"
#include "console/message.h"
#include "console/pages.h"
#include "spool.h"

enum { KEPT = 1 << 22, CHUNK = 1 << 16 };

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
