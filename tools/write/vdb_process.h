/* vdb_process.h - OpenVDB in a process of its own, which the program outlives however it ends. */
#ifndef VDB_PROCESS_H
#define VDB_PROCESS_H

#include <stdbool.h>
#include <stdio.h>

#include "vdb_part.h"

/*
 * Where memory is short, OpenVDB, the library of its threads and the C library under them may end the process that they are in,
 * without a chance to clean up or to say why. Here that becomes a failure like any other.
 */
typedef struct vdb_process vdb_process;

/* Where these fail they write why into `reason`, as the middle of a line, which has room for VDB_PROCESS_REASON bytes. */
enum { VDB_PROCESS_REASON = VDB_REASON + 40 };

/*
 * Starts it: it loads OpenVDB, while the program does something else. No thread may run besides the calling one. NULL if it fails.
 */
vdb_process *vdb_process_begin(char *reason);

/* Waits until it has an OpenVDB that takes this grid. False if it fails. */
bool vdb_process_try(vdb_process *p, const vdb_grid *grid, char *reason);

/* Makes an empty tree. to: where it goes, a stream at its start with nothing in its buffer. False if it fails. */
bool vdb_process_open(vdb_process *p, const vdb_grid *grid, FILE *to, bool can_seek, char *reason);

/*
 * A brick as a tribox_sink gets it; inside: which of its cells are, NULL but for a grid of labels; values: as for a vdb_part, of
 * its `cells` set cells, where the grid has colours or ids, else 0 of them. False if it fails.
 */
bool vdb_process_put(vdb_process *p, const uint32_t at[3], const uint64_t bits[8], const uint64_t *inside, const void *values,
                     uint32_t cells, char *reason);

/* Writes the tree. False if it fails; where the stream did, *error is its errno, and else 0. */
bool vdb_process_write(vdb_process *p, int *error, char *reason);

/* Ends it, at whatever it is. */
void vdb_process_free(vdb_process *p);

#endif
