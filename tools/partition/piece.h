/*
 * piece.h - meshes that are read in pieces, one after the other as one mesh: files of triangles and PLY from the disk, others from
 * memory.
 */
#ifndef PIECE_H
#define PIECE_H

#include "read/mesh.h"

/* A binary PLY file whose triangles are read by their number: its faces refer to vertices anywhere in it. */
typedef struct ply_piece {
    struct ply_faces *faces; /* NULL: it is to be read as a whole */
    uint64_t triangles;
    bool is_double;
    uint64_t miscut; /* polygons whose triangles cover more than they do */
} ply_piece;

typedef struct piece {
    const char *path;
    triangle_format format; /* of a file that is read in pieces; OTHER: it is in memory */
    ply_piece ply;          /* or mapped, if it has faces */
    mesh whole;             /* then */
    uint64_t triangles;
    bool is_double;
} piece;

typedef struct pieces {
    piece *piece;
    size_t count;
    uint64_t triangles;
    size_t block;         /* triangles that are read at once, within one piece */
    size_t blocks;        /* in all pieces */
    mesh_shift shift;     /* `by` is subtracted from all positions, if one is wanted */
    unsigned read_bytes;  /* of a coordinate: the widest as they are read; with a shift doubles */
    unsigned write_bytes; /* as they are handed on: at first the same */
} pieces;

/* A run of triangles of one piece. */
typedef struct piece_block {
    piece *from;
    uint64_t first, number; /* in the piece, and in the whole */
    size_t count;
} piece_block;

/* Opens them all. Returns an exit_code; pieces_close may follow in any case. */
int pieces_open(pieces *all, const char *const *paths, size_t count, triangle_format format, const mesh_shift *shift,
                unsigned threads);
void pieces_close(pieces *all);

/* Divides them into blocks of at most so many triangles. */
void pieces_divide(pieces *all, size_t block);

/* Block number `number`. */
piece_block pieces_block(const pieces *all, size_t number);

/* The bytes that reading a block takes for each of its triangles. */
size_t pieces_room(const pieces *all);

/*
 * Reads a block as nine numbers a triangle of all->write_bytes each, shifted, into such a room. False with errno where the file
 * cannot be read; pieces_refuse then says so.
 */
bool pieces_read(const pieces *all, const piece_block *block, void *positions);
int pieces_refuse(const piece *p, int reason);

/* The coordinates of triangle t of a block: x, y, z of each vertex. */
void pieces_triangle(const pieces *all, const void *positions, size_t t, double u[9]);

#endif
