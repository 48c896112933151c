/* mesh_doubles.h - what is done to the doubles of a mesh in place. */
#ifndef MESH_DOUBLES_H
#define MESH_DOUBLES_H

#include "mesh.h"

/* Rounds the positions to floats, in place, after the origin is subtracted, and counts those that this has moved. */
void mesh_round(const double origin[3], mesh *m);

#endif
