/* read_by_assimp.h - the formats that libassimp knows. */
#ifndef READ_BY_ASSIMP_H
#define READ_BY_ASSIMP_H

#include "mesh.h"

/* Scene transforms are applied. Returns an exit_code; mesh_free may follow in any case. */
int read_by_assimp(const char *path, mesh *m);

/* The colours of such a file's triangles, so many, as assimp_part.h has them. Returns an exit_code. */
struct assimp_colours;
int read_colours_by_assimp(const char *path, size_t triangles, float (*of)[3], struct assimp_colours *found);

#endif
