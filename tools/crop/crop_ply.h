/* crop_ply.h - a PLY file whose faces are sorted, binary or text. */
#ifndef CROP_PLY_H
#define CROP_PLY_H

#include "crop_faces.h"
#include "kept_numbers.h"
#include "read/ply_header.h"

typedef struct crop_ply_file {
    crop *c;
    whole_file head; /* at least the header; of a text all of it */
    ply_header header;
    bool is_left_out[PLY_ELEMENTS_MAX]; /* it refers to vertices, and is no face */
    uint64_t vertices;
    kept_numbers kept[CROP_SIDES];
} crop_ply_file;

/* Finds out which elements are left out. Returns an exit_code. */
int crop_ply_check(crop_ply_file *f);

/* Writes the headers, when it is known how many vertices and faces go where. */
void crop_ply_heads(crop_ply_file *f);

/* Each marks the vertices of faces, ends with crop_ply_heads, and writes what follows. Returns an exit_code. */
int crop_ply_binary(crop_ply_file *f);
void crop_ply_text(crop_ply_file *f);

/* Between the two passes. */
void crop_ply_count(crop_ply_file *f);

/* A number in a list of corners as that of a vertex. False where there is none. */
static inline bool crop_ply_vertex(const crop_ply_file *f, double corner, uint64_t *vertex)
{
    if (!(corner >= 0 && corner < (double)f->vertices))
        return false;
    *vertex = (uint64_t)corner;
    return (double)*vertex == corner;
}

#endif
