/* deflate.h - a stream of bytes in the compression of .zip files, by zlib. */
#ifndef DEFLATE_H
#define DEFLATE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct deflater deflater;

/* NULL if there is no memory. */
deflater *deflater_new(void);

/* Writes what comes out of these bytes to the stream, and what is left at the end. Returns how many bytes that was. */
uint64_t deflater_add(deflater *d, const void *bytes, size_t count, FILE *to);
uint64_t deflater_end(deflater *d, FILE *to);

/* Makes it ready for another stream. */
void deflater_restart(deflater *d);

/* Takes NULL too. */
void deflater_free(deflater *d);

#endif
