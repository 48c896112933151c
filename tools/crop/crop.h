/* crop.h - the faces of a mesh file that overlap a box, and the rest of them, as files of its format: all that a face has stays. */
#ifndef CROP_H
#define CROP_H

#include "files/files.h"
#include "read/mesh_file.h"
#include "read/triangle_file.h"
#include "write/file_out.h"

/* What overlaps, and what does not. */
typedef enum crop_side { CROP_PART, CROP_REST, CROP_SIDES } crop_side;

typedef struct crop_files {
    const char *mesh_path;
    file_about mesh;        /* as it was before it was read */
    triangle_format format; /* of the mesh, as it was found: OTHER where `kind` says it */
    mesh_kind kind;
    file_out out[CROP_SIDES]; /* without a stream where it is not wanted */
} crop_files;

/*
 * Opens the files; paths: NULL for one that is not wanted. Refuses a mesh that cannot be read twice or is of a format that is not
 * written, names of another ending, and a name for two of the three files. Returns an exit_code; crop_files_drop may follow in any
 * case.
 */
int crop_files_open(const char *mesh_path, triangle_format format, const char *const paths[CROP_SIDES], crop_files *files);

/* Removes what has been written, if it has not been kept. */
void crop_files_drop(crop_files *files);

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
