/* crop.h - the faces of a mesh file that overlap a box, and the rest of them, as files of its format: all that a face has stays. */
#ifndef CROP_H
#define CROP_H

#include "crop_files.h"

/* Which triangles of the mesh go into the part. A polygon, which was cut into some, goes as a whole. */
typedef struct crop_choice {
    const uint64_t *bits; /* a bit per triangle */
    uint64_t triangles;
    bool needs_all; /* a polygon goes into the part if all of its triangles do; else if one does */
} crop_choice;

typedef struct crop_counts {
    uint64_t faces;
    uint64_t vertices;
    bool has_vertices; /* to which faces refer */
} crop_counts;

/* Reads the mesh file again, and writes and keeps what was opened. Returns an exit_code; on failure nothing is left. */
int crop_write(crop_files *files, const crop_choice *choice, crop_counts counts[CROP_SIDES]);

#endif
