/* taken_cells.h - the cells of a mesh that is voxelized while it is read: a small grid that needs its triangles once. */
#ifndef TAKEN_CELLS_H
#define TAKEN_CELLS_H

#include <pthread.h>

#include "console/progress.h"
#include "own_words.h"
#include "read/mesh_taker.h"
#include "voxelize_report.h"
#include "voxelize_work.h"

typedef struct taken_cells {
    const voxelize_request *r;
    tribox_grid grid;
    size_t triangles;
    own_words words;             /* all: NULL where nothing is taken */
    double seconds[THREADS_MAX]; /* that each thread was at work */
    pthread_mutex_t lock;        /* of what follows */
    progress bar;
    size_t done; /* triangles */
    tribox_report report;
} taken_cells;

/*
 * Whether the request may do without a stored mesh: the taker may then be given to a reader. taken_cells_free is due in any case.
 */
bool taken_cells_start(const voxelize_request *r, taken_cells *t, mesh_taker *taker);

/*
 * When all are taken: puts them together, and says in the answer what was found, and how long it took. Returns the words of the
 * grid around the mesh, which are there until they are freed.
 */
uint64_t *taken_cells_end(taken_cells *t, voxelize_answer *a);

void taken_cells_free(taken_cells *t);

#endif
