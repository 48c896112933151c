/* boxes.h - boxes as text: six numbers LX,LY,LZ,HX,HY,HZ, separated by commas or blanks. */
#ifndef BOXES_H
#define BOXES_H

#include <stdbool.h>
#include <stdio.h>

#include "tribox.h"

/* A box as it is written. */
typedef struct written_box {
    tribox_box bounds; /* the nearest doubles */
    unsigned decimals; /* those that are decimals, as numbers_read says it: bits 0 to 2 of lo, 3 to 5 of hi */
} written_box;

/*
 * Reads a box from text. Returns false after a message on standard error that says where it is, what is wrong and what to do.
 * where: what to call the text in messages, as "--box" or "boxes.txt:12". A box with lo > hi is empty, which only earns a note.
 */
bool box_read(const char *text, const char *where, written_box *box);

/*
 * The box for a mesh: as it is for one of doubles. For one of floats a decimal that a float gives back is that float, so that a
 * float which another program has written is the same here.
 */
tribox_box box_for_mesh(const written_box *box, bool is_double);

/* Whether all bounds are floats. */
bool box_is_float(const tribox_box *box);

/* A file with a box on each line; '#' starts a comment, empty lines are skipped. Memory does not grow with the file. */
typedef struct box_file {
    FILE *file;
    const char *name;
    size_t line; /* the last line that was read, counted from 1 */
} box_file;

/* Opens a file, "-" for standard input; and reads the next box: *end receives whether there is none. Return an exit_code. */
int box_file_open(box_file *boxes, const char *path);
int box_file_next(box_file *boxes, written_box *box, bool *end);
void box_file_close(box_file *boxes);

#endif
