/* crop_files.h - the two files that the faces of a mesh go into. */
#ifndef CROP_FILES_H
#define CROP_FILES_H

#include "files/named_file.h"
#include "read/mesh_kind.h"
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

#endif
