/* boxes.h - boxes as text: six numbers LX,LY,LZ,HX,HY,HZ, separated by commas or blanks. */
#ifndef BOXES_H
#define BOXES_H

#include <stdbool.h>
#include <stdio.h>

#include "tribox.h"

/*
 * Reads a box from text. Returns false after a message on standard error that says where it is, what is wrong and what to do.
 * where: what to call the text in messages, as "--box" or "boxes.txt:12". A box with lo > hi is empty, which only earns a note.
 */
bool box_read(const char *text, const char *where, tribox_box *box);

/* A file with a box on each line; '#' starts a comment, empty lines are skipped. Memory does not grow with the file. */
typedef struct box_file {
    FILE *file;
    const char *name;
    size_t line; /* the last line that was read, counted from 1 */
} box_file;

/* Opens a file, "-" for standard input. Returns an exit_code. */
int box_file_open(box_file *boxes, const char *path);

/* Reads the next box; *end receives whether there is none. Returns an exit_code. */
int box_file_next(box_file *boxes, tribox_box *box, bool *end);

void box_file_close(box_file *boxes);

#endif
