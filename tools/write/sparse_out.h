/* sparse_out.h - bytes into a stream, long runs of zeros as holes where it is a file of its own. */
#ifndef SPARSE_OUT_H
#define SPARSE_OUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { SPARSE_MOST = 1 << 16 };

/*
 * A file system without holes fills them with zeros itself. Whether the stream failed ferror tells, after the end for certain:
 * what is left out takes no place on the disk until then, nor later.
 */
typedef struct sparse_out {
    FILE *to;
    bool has_holes;
    uint64_t zeros; /* that come after the bytes */
    size_t filled;
    unsigned char bytes[SPARSE_MOST];
} sparse_out;

/* From where the stream is. Standard output gets its zeros. */
void sparse_start(sparse_out *s, FILE *to);

void sparse_zeros(sparse_out *s, uint64_t count);

/* Room for so many bytes, at most SPARSE_MOST, which the caller writes there. */
unsigned char *sparse_room(sparse_out *s, size_t count);

/* Writes what is pending; the stream is then behind the last byte. */
void sparse_end(sparse_out *s);

#endif
