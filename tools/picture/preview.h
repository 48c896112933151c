/* preview.h - the option --preview of tribox voxelize and merge: a picture of the cells as a PNG file. */
#ifndef PREVIEW_H
#define PREVIEW_H

#include "picture_voxels.h"
#include "write/file_out.h"

/* With z up. */
#define PREVIEW_LOOK_DEFAULT ((picture_look){PICTURE_UP_Z, {1280, 960}})

/*
 * Refuses a preview where the program was built without libpng, or a name that does not end in .png. Returns an exit_code. path:
 * may be NULL.
 */
int preview_check(const char *path, const char *option);

enum { PREVIEW_SIDE_MAX = 4096 }; /* pixels */

/* Read the values of --up and --picture-size. Return an exit_code, but the word its text. */
int preview_read_up(const char *text, picture_up *up);
const char *preview_up_word(picture_up up);
int preview_read_size(const char *text, picture_look *look);

/* Memory for drawing besides the cells, in bytes. */
uint64_t preview_memory(const picture_look *look);

/* Draws into a file and keeps it; does nothing where none is open. Returns an exit_code. */
int preview_draw(file_out *out, const voxels *v, const picture_look *look, unsigned threads, bool wants_progress);

#endif
