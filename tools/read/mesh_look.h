/* mesh_look.h - what one look at all triangles finds: those that are not finite, and the box around the others. */
#ifndef MESH_LOOK_H
#define MESH_LOOK_H

#include "mesh.h"

typedef struct mesh_look {
    size_t not_finite, first; /* the first that is not, or SIZE_MAX */
    tribox_box bounds;        /* lo > hi where none is finite */
} mesh_look;

mesh_look mesh_look_none(void);

/* Adds triangles first .. first + count - 1. Small blocks are looked at best just after they were written. */
void mesh_look_at(const mesh *m, size_t first, size_t count, mesh_look *look);

/* The same of threads that look at parts of a mesh at once. */
void mesh_look_add(const mesh *m, size_t first, size_t count, mesh_look *all);

/* Puts so many triangles of `from`, from `begin` on, in the streams, from `first` on, and adds them. False where it fails. */
bool mesh_look_put(const tribox_mesh *from, size_t begin, size_t count, size_t first, mesh *m, mesh_look *all);

/* Keeps what was found in the mesh. */
void mesh_look_keep(const mesh_look *all, mesh *m);

/* All of it, by threads. */
void mesh_look_all(unsigned threads, mesh *m);

#endif
