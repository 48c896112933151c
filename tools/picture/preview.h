/* preview.h - the option --preview of tribox voxelize and merge: a picture of the cells as a PNG file. */
#ifndef PREVIEW_H
#define PREVIEW_H

#include "write/file_out.h"
#include "picture_voxels.h"

/* Refuses a preview where the program was built without libpng, or a name that is none. Returns an exit_code. path: may be NULL. */
int preview_check(const char *path, const char *option);

/* Reads the value of --up. Returns an exit_code. */
int preview_read_up(const char *text, picture_up *up);

/* The bytes that drawing takes beside the cells. */
uint64_t preview_memory(const tribox_grid *grid);

/* Draws into a file and keeps it; does nothing where none is open. Returns an exit_code. */
int preview_draw(file_out *out, const voxels *v, picture_up up, unsigned threads, bool wants_progress);

#endif
