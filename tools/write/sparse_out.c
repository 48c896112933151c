/* sparse_out.c - gathers bytes, and seeks over zeros. */
#define _POSIX_C_SOURCE 200809L
#include "sparse_out.h"

#include <string.h>

/* Fewer hardly leave out a block of a disk, and to seek takes two calls of the system. */
enum { HOLE = 1 << 13 };

void sparse_start(sparse_out *s, FILE *to)
{
    s->to = to;
    s->has_holes = to != stdout;
    s->zeros = 0;
    s->filled = 0;
}

void sparse_zeros(sparse_out *s, uint64_t count) { s->zeros += count; }

static void write_filled(sparse_out *s)
{
    fwrite(s->bytes, 1, s->filled, s->to);
    s->filled = 0;
}

/* Where the stream does not go there, it gets zeros, and says itself what is wrong. */
static bool leave_hole(sparse_out *s)
{
    write_filled(s);
    return !fseeko(s->to, (off_t)s->zeros, SEEK_CUR);
}

static void write_zeros(sparse_out *s)
{
    while (s->zeros && !ferror(s->to)) {
        const size_t room = SPARSE_MOST - s->filled, count = s->zeros < room ? (size_t)s->zeros : room;
        memset(s->bytes + s->filled, 0, count);
        s->filled += count;
        s->zeros -= count;
        if (s->filled == SPARSE_MOST)
            write_filled(s);
    }
}

static void end_zeros(sparse_out *s)
{
    if (s->has_holes && s->zeros >= HOLE && leave_hole(s))
        s->zeros = 0;
    write_zeros(s);
}

unsigned char *sparse_room(sparse_out *s, size_t count)
{
    if (s->zeros)
        end_zeros(s);
    if (s->filled + count > SPARSE_MOST)
        write_filled(s);
    s->filled += count;
    return s->bytes + s->filled - count;
}

/* The last byte is written, as the length of a file is where its bytes end. */
void sparse_end(sparse_out *s)
{
    if (s->zeros) {
        s->zeros--;
        *sparse_room(s, 1) = 0;
    }
    write_filled(s);
}
