/* ply_piece.h - a binary PLY file whose triangles are read by their number: its faces refer to vertices anywhere in it. */
#ifndef PLY_PIECE_H
#define PLY_PIECE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ply_piece {
    struct ply_faces *faces; /* NULL: it is to be read as a whole */
    uint64_t triangles;
    bool is_double;
    uint64_t miscut; /* polygons whose triangles cover more than they do */
} ply_piece;

/*
 * Opens a file and looks at all of its faces. It is left to the reader of whole files, which says what is wrong with it, unless it
 * is a sound one of vertices, all floats or all doubles, and then faces, and nothing else. is_wide: doubles stay what they are even
 * where floats would do.
 */
ply_piece ply_piece_open(const char *path, bool is_wide);
void ply_piece_close(ply_piece *p);

/*
 * Triangles first .. first + count - 1, nine numbers each, floats or doubles. False where there is no memory, or the file changed.
 */
bool ply_piece_read(const ply_piece *p, uint64_t first, size_t count, void *positions);

#endif
