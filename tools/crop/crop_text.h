/* crop_text.h - text that is copied to a side as it stands, but for some words. */
#ifndef CROP_TEXT_H
#define CROP_TEXT_H

#include "crop_faces.h"
#include "read/text_lines.h"

typedef struct crop_copy {
    crop *c;
    crop_side side;
    const char *from; /* what comes next of the text */
} crop_copy;

/* Copies up to here. */
void crop_copy_to(crop_copy *copy, const char *end);

/* Copies up to these `length` bytes, and has a number in their place. */
void crop_copy_number(crop_copy *copy, const char *word, size_t length, uint64_t number);

#endif
