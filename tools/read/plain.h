/*
 * plain.h - files written as most programs write them, read by threads and fast. What is unusual is left to scan.h, which knows
 * every spelling and says what is wrong: both make the same mesh of what both read, bit for bit.
 */
#ifndef PLAIN_H
#define PLAIN_H

#include <stdio.h>

#include "console/digits.h"
#include "mesh.h"
#include "scan.h"
#include "mesh_file.h"

/* Of a text, for each thread at a time: they stay in its cache. Tests take fewer. */
enum { PLAIN_CHUNK_BYTES = 1 << 18 };

typedef struct plain_file {
    const char *path; /* for messages that memory fails */
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

/* A text as a mesh: threads read its lines in chunks, whose vertices and faces are joined in the order of the file. */

/* A corner whose vertex is counted from the chunk's first: a place in `corners`, and the vertex, which may be before that. */
typedef struct text_relative {
    size_t corner;
    int64_t vertex;
} text_relative;

/*
 * The lines that begin between two places of the file: chunk 0 begins where the text does. After the file's last line, which a line
 * end is put to, come zeros: TEXT_AHEAD bytes may be looked at from anywhere before `end`.
 */
typedef struct text_chunk {
    size_t number;
    const char *begin, *limit; /* of the lines; begin == limit where none begins here */
    const char *end;           /* of what is there of the next chunks' lines */
    bool is_last;              /* the file ends at `end` */
    uint64_t offset;           /* of begin in the file */
    uint64_t first_line;       /* counted from 0, where they are counted */

    /* What is found there, in lists with room for all that a chunk may have. */
    double *positions;
    uint32_t *corners; /* of all faces, one after another */
    uint32_t *sizes;   /* how many each face has */
    text_relative *relatives;
    size_t vertices, corner_count, faces, relative_count;
    float_fit fit;
    uint32_t highest; /* of the corners that are not relative; 0 without one */
    size_t left_out;
    uint64_t facets_begin, facets_end; /* of STL: where in the file they do; 0: none begins here */
    bool is_inside;                    /* of STL: a solid, where they end */
    char bytes[];
} text_chunk;

enum { TEXT_AHEAD = 64, TEXT_OVERLAP = 8192 /* bytes of the chunks after it that a chunk has, so that no line may be longer */ };

typedef struct text {
    const plain_file *file;
    uint64_t from;                                         /* where its lines begin */
    bool are_counted;                                      /* the lines */
    bool (*read)(const struct text *t, text_chunk *chunk); /* of threads at once; false: not plain */
    bool (*join)(struct text *t, const text_chunk *chunk); /* of the chunks in their order; may be NULL */
    bool (*is_whole)(const struct text *t);                /* whether nothing lacks at the end; may be NULL */
    const ply_element *of_vertices, *of_faces;             /* of PLY */
    uint64_t facets_end;                                   /* of STL, of the chunks that are joined, as theirs */
    bool is_inside;
    indexed_mesh all;
    uint32_t highest; /* as theirs */
} text;

/* Reads a text, and makes a mesh of it. False where it is not plain. */
bool text_read(text *t, mesh *m);

/* Adds a face of the last `size` corners. */
static inline void text_add_face(uint32_t size, text_chunk *chunk) { chunk->sizes[chunk->faces++] = size; }

static inline bool text_is_blank(char c) { return c == ' ' || c == '\t'; }

static inline bool text_ends_word(char c) { return text_is_blank(c) || c == '\r' || c == '\n'; }

static inline const char *text_skip_blanks(const char *c)
{
    while (text_is_blank(*c))
        c++;
    return c;
}

/* What follows a line's last word: its end, which a '\r' may precede; NULL where there is something else. */
static inline const char *text_end_line(const char *c)
{
    c = text_skip_blanks(c);
    c += *c == '\r';
    return *c == '\n' ? c + 1 : NULL;
}

#endif
