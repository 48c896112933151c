/* triangle_file.h - files with one triangle behind the other, which are read in blocks: binary STL, and raw floats. */
#ifndef TRIANGLE_FILE_H
#define TRIANGLE_FILE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* How triangles lie in a file; by its name: STL where that ends in .stl, F32 for .f32, OTHER for all else. */
typedef enum triangle_format {
    TRIANGLES_OTHER, /* in none of these ways */
    TRIANGLES_STL,   /* binary STL: a header of 84 bytes with their number, then 50 bytes each */
    TRIANGLES_F32    /* nine little-endian float32 each, and nothing else */
} triangle_format;

/* Triangles of a block: whole words of a mask, and streams that fit the cache. */
enum { TRIANGLE_BLOCK = 4096 };

typedef struct triangle_file {
    const char *name; /* for messages */
    FILE *stream;     /* NULL: nothing is open */
    triangle_format format;
    bool is_sized;        /* a regular file: its size vouches for `promised` */
    uint64_t size;        /* bytes; UINT64_MAX where nobody knows */
    uint64_t promised;    /* triangles that there are to be; UINT64_MAX where nothing tells */
    uint64_t taken;       /* triangles read so far */
    unsigned char *bytes; /* of a block, as they come */
} triangle_file;

/* The format that is asked for by its word, "stl" or "f32". Returns an exit_code. */
int triangle_format_read(const char *text, triangle_format *format);

/*
 * Opens a file, "-" for standard input, whose sizes fit together as far as can be known. format: OTHER to go by its name; then
 * nothing is opened, and file->stream is NULL, where the name has another ending or the file is STL as text.
 * Returns an exit_code; triangle_file_close may follow in any case.
 */
int triangle_file_open(const char *path, triangle_format format, triangle_file *file);

/*
 * Reads up to TRIANGLE_BLOCK triangles; *count is 0 behind the last. A file that ends before it should, or does not end, is a
 * failure. streams: x of the three vertices, then y, then z. Returns an exit_code.
 */
int triangle_file_next(triangle_file *file, float *const streams[9], size_t *count);

void triangle_file_close(triangle_file *file);

#endif
