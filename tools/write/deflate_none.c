/* deflate_none.c - stands in for deflate.c where the program is built without zlib. */
#include "deflate.h"

const bool deflate_is_there = false;

deflater *deflater_new(void) { return NULL; }

uint64_t deflater_add(deflater *d, const void *bytes, size_t count, FILE *to)
{
    (void)d, (void)bytes, (void)count, (void)to;
    return 0;
}

uint64_t deflater_end(deflater *d, FILE *to)
{
    (void)d, (void)to;
    return 0;
}

void deflater_restart(deflater *d) { (void)d; }

void deflater_free(deflater *d) { (void)d; }
