/* preview.h - the option --preview of tribox voxelize and merge: a picture of the cells as a PNG file. */
#ifndef PREVIEW_H
#define PREVIEW_H

#include "console/progress.h"
#include "write/file_out.h"
#include "write/voxels.h"

/* The axis of the grid that is up in the picture, or its opposite. */
typedef enum picture_up { PICTURE_UP_X, PICTURE_UP_Y, PICTURE_UP_Z, PICTURE_DOWN_X, PICTURE_DOWN_Y, PICTURE_DOWN_Z } picture_up;

typedef struct picture_look {
    picture_up up;
    uint32_t size[2]; /* pixels: width and height */
} picture_look;

/* With z up. */
#define PREVIEW_LOOK_DEFAULT ((picture_look){PICTURE_UP_Z, {1280, 960}})

/*
 * Refuses a preview where the program was built without libpng, or a name that does not end in .png. Returns an exit_code. path:
 * may be NULL.
 */
int preview_check(const char *path, const char *option);

/* Whether the program was built with libpng. */
extern const bool picture_png_is_there;

/* Writes rows of red, green, blue bytes, by libpng. False where it lacks memory; the stream itself knows of its own failure. */
bool picture_png_write(FILE *to, const unsigned char *pixels, unsigned width, unsigned height);

enum { PREVIEW_SIDE_MAX = 4096 }; /* pixels */

/* Read the values of --up and --picture-size. Return an exit_code, but the word its text. */
int preview_read_up(const char *text, picture_up *up);
const char *preview_up_word(picture_up up);
int preview_read_size(const char *text, picture_look *look);

/* Memory for drawing besides the cells, in bytes. */
uint64_t preview_memory(const picture_look *look);

/*
 * Draws rows of red, green, blue bytes. Returns false where memory does not suffice. The picture is the same for every number of
 * threads.
 */
bool preview_pixels(const voxels *v, const picture_look *look, unsigned threads, unsigned char *pixels, progress *bar);

/* Draws into a file and keeps it; does nothing where none is open. Returns an exit_code. */
int preview_draw(file_out *out, const voxels *v, const picture_look *look, unsigned threads);

#endif
