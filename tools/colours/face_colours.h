/* face_colours.h - colours of triangles as the faces of a file come, for the readers of its formats. */
#ifndef FACE_COLOURS_H
#define FACE_COLOURS_H

#include "mesh_colours.h"
#include "read/whole_file.h"

typedef struct face_colours {
    const char *path; /* of the mesh */
    const file_out_names *outputs;
    mesh_colours *to;
    size_t next;     /* triangle */
    size_t coloured; /* of those before it: not grey for want of a colour */
    bool is_changed; /* the file has more triangles than it had */
} face_colours;

/* The next face, of so many corners: of fewer than three it has no triangle. colour: NULL where it has none. */
void face_colours_add(face_colours *f, uint64_t corners, const rgb *colour);

/* Each takes all faces of a file, until it is found to have changed. Returns an exit_code. */
int face_colours_ply(face_colours *f, const whole_file *file);
int face_colours_off(face_colours *f, const whole_file *file);
int face_colours_obj(face_colours *f, const whole_file *file);

#endif
