/* text_pieces.h - what threads find in the parts of a text, and the mesh that it makes together. */
#ifndef TEXT_PIECES_H
#define TEXT_PIECES_H

#include "plain.h"

/* A corner whose vertex is counted from the piece's first: a place in `corners`, and the vertex, which may be before that. */
typedef struct text_relative {
    size_t corner;
    int64_t vertex;
} text_relative;

/* As lists that grow while a part is read; `room` of each is in entries. */
typedef struct text_piece {
    double *positions;
    uint32_t *corners; /* of all faces, one after another */
    uint32_t *sizes;   /* how many each face has; NULL: three each */
    text_relative *relatives;
    size_t vertices, corner_count, faces, relative_count;
    size_t triangles;
    float_fit fit;
    uint32_t highest; /* of the corners that are not relative; 0 without one */
    size_t left_out, miscut;
    size_t first_vertex, first_triangle; /* of the mesh */
} text_piece;

typedef struct text_pieces {
    const plain_file *file;
    text_piece *pieces;    /* of the parts, by their numbers */
    text_piece *scratches; /* of the threads: what they are reading */
    size_t count;
} text_pieces;

/* False where there is no memory; text_pieces_free may follow in any case. */
bool text_pieces_make(const plain_file *file, size_t count, text_pieces *p);
void text_pieces_free(text_pieces *p);

/* An empty piece with room for all that a part may have. NULL: no memory. */
text_piece *text_pieces_begin(const text_pieces *p, unsigned thread);

/* Keeps what it has. False: no memory. */
bool text_pieces_keep(const text_pieces *p, size_t part, const text_piece *scratch);

/* Adds a face of the last `size` corners. */
static inline void text_piece_add_face(uint32_t size, text_piece *piece) { piece->sizes[piece->faces++] = size; }

/* Makes the mesh. False where a face has a corner that is no vertex, or there is no triangle or no memory. */
bool text_pieces_join(const text_pieces *p, mesh *m);

#endif
