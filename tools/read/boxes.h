/* boxes.h - boxes as text: six numbers LX,LY,LZ,HX,HY,HZ, separated by commas or blanks. */
#ifndef BOXES_H
#define BOXES_H

#include <stdbool.h>
#include <stdio.h>

#include "tribox.h"

/*
 * Reads a box from text. On an error says on standard error where it is, what is wrong and what to do, and returns false.
 * where: names the text in messages, "--box" or "boxes.txt:12". A box with lo > hi is only noted there: it is the empty box.
 */
bool box_read(const char *text, const char *where, tribox_box *box);

/* A file with a box on each line; '#' starts a comment, empty lines are skipped. Memory does not grow with the file. */
typedef struct box_file {
    FILE *file;
    const char *name;
    size_t line; /* the number of the line last read */
} box_file;

/* Opens a file, "-" for standard input. Returns an exit_code. */
int box_file_open(box_file *boxes, const char *path);

/* Reads the next box; *end tells that there is none. Returns an exit_code. */
int box_file_next(box_file *boxes, tribox_box *box, bool *end);

void box_file_close(box_file *boxes);

#endif
