/* words.h - the words of a text, one after another, and the numbers that they spell; independent of the locale. */
#ifndef WORDS_H
#define WORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "console/written_number.h"
#include "mesh_file.h"

typedef struct words {
    const char *path; /* for messages; NULL to say nothing */
    const char *text, *end;
    const char *at;   /* what follows the last word */
    const char *word; /* the last word, `length` bytes; none at the end of the text */
    size_t length;
    char comment;      /* starts a comment that ends with its line; ' ': there are no comments */
    bool is_continued; /* a backslash at the end of a line joins it with the next */
} words;

words words_of(const char *path, const whole_file *file, char comment);

/* Moves to the next word. Returns false at the end of the text. */
bool words_next(words *w);

/* Moves to the next word of this line. Returns false, and stays on the line, where there is none. */
bool words_next_on_line(words *w);

void words_skip_line(words *w);

/*
 * Where the line of the last word begins, unless that is before `from`; where the line after the one that was skipped does; and
 * what follows the last word on its line, without the blanks around it: a name, which may have blanks within.
 */
const char *words_line_begin(const words *w, const char *from);
const char *words_line_next(const words *w);
const char *words_rest(words w, size_t *length);

/* Whether the last word is this one; upper case and lower case are the same. */
bool words_is(const words *w, const char *expected);

/* Reads a whole number; negative ones, and those beyond 64 bits, become UINT64_MAX. Returns false where the word is not one. */
bool words_whole(const words *w, uint64_t *number);

/* Reads the double nearest to a number. fit: raised to how well float holds that, if it holds it worse. */
bool words_number(const words *w, double *number, float_fit *fit);

/* Says that the text ends too soon, or has another word, where `due` should be. Returns EXIT_CODE_FAILURE. */
int words_refuse(const words *w, const char *due);

/* Whether the text ends with the last word, which may then be part of a longer one. */
bool words_is_cut(const words *w);

/* The line of the last word, counted from 1. */
uint64_t words_line(const words *w);

/* What to show of the last word in a message, with %.*s. */
int words_shown(const words *w);

/* By the first word of a text, which may be none: what a file says of itself counts for more than its name. */
mesh_kind mesh_kind_by(const char *path, const words *first);

#endif
