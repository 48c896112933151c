/* ply_records.h - vertices of floats and faces of three corners in a binary PLY file, where each stands at a place known before. */
#ifndef PLY_RECORDS_H
#define PLY_RECORDS_H

#include <stdbool.h>
#include <stdio.h>

#include "ply_header.h"

typedef struct ply_records {
    bool is_big;
    uint64_t vertices_at, faces_at; /* in the file */
    size_t vertices, vertex_bytes, axis_at[3];
    size_t faces, face_bytes, count_at, count_bytes; /* if all faces are triangles */
} ply_records;

/*
 * Finds the two elements of a binary file of `size` bytes. False where it lacks bytes that the header promises, or vertices or
 * faces, or has others than those.
 */
bool ply_records_of(const ply_header *header, uint64_t size, ply_records *records);

/* Reads a block of vertices to where all positions are; or of faces, of which none may have other than three corners. */
bool ply_records_vertices(const ply_records *r, FILE *stream, size_t first, size_t count, float *positions);
bool ply_records_faces(const ply_records *r, FILE *stream, size_t first, size_t count, uint32_t *corners);

#endif
