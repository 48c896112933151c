/* mesh_shift.h - what --shift subtracts from a mesh. */
#ifndef MESH_SHIFT_H
#define MESH_SHIFT_H

#include "mesh.h"

typedef struct mesh_shift {
    bool is_wanted;
    bool is_auto; /* `by` is chosen when the mesh is read */
    double by[3];
} mesh_shift;

/* Reads the value of --shift, X,Y,Z or "auto". Returns an exit_code. */
int mesh_shift_read(const char *text, mesh_shift *shift);

/*
 * mesh_read_as, and subtracts the shift from all positions, in double; the mesh is one of floats where float holds the differences.
 * auto: round numbers near the lower corner of the mesh, in units of a power of ten that its longest side does not exceed.
 */
int mesh_read_shifted(const char *path, triangle_format format, mesh_shift *shift, unsigned threads, mesh *m);

/* What auto chooses for a mesh of these bounds. */
void mesh_shift_choose(const tribox_box *bounds, double by[3]);

#endif
