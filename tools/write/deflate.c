/* deflate.c - zlib's raw streams. */
#define ZLIB_CONST
#include "deflate.h"

#include <stdlib.h>
#include <zlib.h>

enum { CHUNK = 1 << 16, LEVEL = 4, WINDOW_BITS = 15, MEMORY_LEVEL = 9 };

struct deflater {
    z_stream stream;
    unsigned char out[CHUNK];
};

deflater *deflater_new(void)
{
    deflater *const d = calloc(1, sizeof *d);
    if (!d || !deflateInit2(&d->stream, LEVEL, Z_DEFLATED, -WINDOW_BITS, MEMORY_LEVEL, Z_DEFAULT_STRATEGY))
        return d;
    free(d);
    return NULL;
}

static uint64_t run(deflater *d, int flush, FILE *to)
{
    uint64_t written = 0;
    do {
        d->stream.next_out = d->out;
        d->stream.avail_out = CHUNK;
        deflate(&d->stream, flush);
        const size_t filled = CHUNK - d->stream.avail_out;
        fwrite(d->out, 1, filled, to);
        written += filled;
    } while (!d->stream.avail_out);
    return written;
}

uint64_t deflater_add(deflater *d, const void *bytes, size_t count, FILE *to)
{
    d->stream.next_in = bytes;
    d->stream.avail_in = (uInt)count;
    return run(d, Z_NO_FLUSH, to);
}

uint64_t deflater_end(deflater *d, FILE *to)
{
    d->stream.avail_in = 0;
    return run(d, Z_FINISH, to);
}

void deflater_restart(deflater *d) { deflateReset(&d->stream); }

void deflater_free(deflater *d)
{
    if (d)
        deflateEnd(&d->stream);
    free(d);
}
