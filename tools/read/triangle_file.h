/* triangle_file.h - files that list one triangle after another and are read in blocks: binary STL, raw floats and raw doubles. */
#ifndef TRIANGLE_FILE_H
#define TRIANGLE_FILE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "mesh_file.h"

/* How triangles lie in a file. Its name decides where nothing else does: .stl, .f32, .f64, or OTHER. */
typedef enum triangle_format {
    TRIANGLES_OTHER, /* in neither of these ways */
    TRIANGLES_STL,   /* binary STL: a header of 84 bytes that ends in their number, then 50 bytes each */
    TRIANGLES_F32,   /* nine little-endian float32 each and nothing else */
    TRIANGLES_F64,   /* nine little-endian float64 each and nothing else */
    TRIANGLES_KINDS  /* and what follows, a mesh_kind each: as OTHER, but read as that, whatever the name */
} triangle_format;

enum { STL_HEADER = 84, STL_COUNT_AT = 80 };

mesh_kind triangle_format_kind(triangle_format format); /* OTHER where it is none of these */

/* Triangles of a block: whole words of a mask, in streams that fit the cache. */
enum { TRIANGLE_BLOCK = 4096 };

typedef struct triangle_file {
    const char *name; /* for messages */
    FILE *stream;     /* NULL: nothing is open */
    triangle_format format;
    bool is_sized;     /* a regular file, so that its size confirms `promised` */
    uint64_t size;     /* bytes; UINT64_MAX where it is unknown */
    uint64_t promised; /* triangles that should follow; UINT64_MAX where it is unknown */
    uint64_t taken;    /* triangles read so far */
} triangle_file;

/* Triangles that follow each other in a file. */
typedef struct triangle_block {
    uint64_t first;
    size_t count;
    unsigned char *bytes; /* TRIANGLE_BLOCK_BYTES of them */
} triangle_block;

enum { TRIANGLE_BLOCK_BYTES = TRIANGLE_BLOCK * 72 };

/* Each of them: a triangle has `record` bytes, from `start` on, and its numbers, of `number_bytes`, begin at `numbers_at`. */
typedef struct triangle_layout {
    const char *word, *ending;
    unsigned start, record, numbers_at, number_bytes;
} triangle_layout;
extern const triangle_layout triangle_layouts[];

/* Turns so many records into the floats or doubles of this machine, in place. */
void triangles_unpack(triangle_format format, size_t count, unsigned char *bytes);

/* By the ending of a name; or by its own name, which returns an exit_code. */
triangle_format triangle_format_of(const char *path);
int triangle_format_read(const char *text, triangle_format *format);

/* Refuses standard input of no given format. Returns an exit_code. */
int triangle_format_check(const char *path, triangle_format format);

/* The name of a mesh in messages. */
const char *triangle_file_name(const char *path);

/*
 * Opens a file, "-" for standard input, and refuses sizes that do not fit together. format: OTHER to go by the name; where that has
 * another ending, or the file is STL as text, nothing is opened and file->stream is NULL.
 * Returns an exit_code; triangle_file_close may follow in any case.
 */
int triangle_file_open(const char *path, triangle_format format, triangle_file *file);

/*
 * What is next is found by one thread at a time, up to TRIANGLE_BLOCK triangles; block->count is 0 after the last. A file that ends
 * too soon or too late is a failure. Then it is read from a regular file, and unpacked into streams, x of the three vertices, then
 * y, then z, or positions where they are not NULL, x, y, z of the three vertices of each, by all threads at once. Return an
 * exit_code.
 */
int triangle_file_find(triangle_file *file, triangle_block *block);
int triangle_file_unpack(const triangle_file *file, triangle_block *block, float *const streams[9], double *positions);

void triangle_file_close(triangle_file *file);

#endif
