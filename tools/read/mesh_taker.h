/* mesh_taker.h - what takes the triangles of a mesh block after block while they are read, so that nobody stores them. */
#ifndef MESH_TAKER_H
#define MESH_TAKER_H

#include <stdbool.h>

#include "tribox.h"

typedef struct mesh_taker {
    /* Whether it wants a mesh of so many triangles, all of them finite, whose least box this is. Called once at most. */
    bool (*begin)(void *data, const tribox_box *bounds, size_t triangles);

    /* Takes some of them: several threads at once do, each with its number, below THREADS_MAX. False where it cannot. */
    bool (*take)(void *data, unsigned thread, const tribox_mesh *block);

    /* What was taken does not count: it cannot, the file is damaged, or the box was too large. The mesh is read in another way. */
    void (*drop)(void *data);

    void *data;
} mesh_taker;

#endif
