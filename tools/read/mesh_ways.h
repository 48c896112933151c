/* mesh_ways.h - the two ways to read a whole file, which tests compare. */
#ifndef MESH_WAYS_H
#define MESH_WAYS_H

#include "mesh.h"

/* Into an empty mesh: false, with nothing said and nothing to be freed, where the file is not plain (plain.h). */
bool mesh_read_plain(const char *path, bool is_wide, unsigned threads, size_t part_bytes, mesh *m);

/* Knows every spelling, and says what is wrong with a file. Returns an exit_code; mesh_free may follow in any case. */
int mesh_read_slowly(const char *path, bool is_wide, unsigned threads, mesh *m);

#endif
