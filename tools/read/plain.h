/*
 * plain.h - files written as most programs write them, read by threads and fast. What is unusual is left to scan.h, which knows
 * every spelling and says what is wrong: both make the same mesh of what both read, bit for bit.
 */
#ifndef PLAIN_H
#define PLAIN_H

#include <stdio.h>

#include "mesh.h"
#include "scan.h"
#include "mesh_file.h"

/* Of a text, for each thread at a time: they stay in its cache. Tests take fewer. */
enum { PLAIN_CHUNK_BYTES = 1 << 18 };

typedef struct plain_file {
    FILE *stream;
    uint64_t size;
    whole_file head; /* as much as a header may have */
    unsigned threads;
    bool is_wide; /* numbers of a text stay doubles */
    size_t chunk_bytes;
} plain_file;

/* Opens a regular file; false, and silence, where that fails. plain_file_close may follow in any case. */
bool plain_file_open(const char *path, plain_file *file);
void plain_file_close(plain_file *file);

/* Each reads an empty mesh, or returns false and says nothing: then mesh_free may follow. */
typedef bool plain_reader(const plain_file *file, mesh *m);
plain_reader plain_ply, plain_obj, plain_stl;

/* PLY as text, of a file that has vertices, then faces, and nothing else. */
bool plain_ply_text(const plain_file *file, const ply_header *header, mesh *m);

#endif
