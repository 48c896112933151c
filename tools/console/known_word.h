/* known_word.h - words to choose from, and which of them was meant by one that is none of them. */
#ifndef KNOWN_WORD_H
#define KNOWN_WORD_H

#include <stddef.h>

/* The word in question, and what comes closest to it so far. */
typedef struct guess {
    const char *word;
    size_t length;
    const char *best; /* NULL: nothing comes close */
    size_t best_length;
    unsigned least;
} guess;

guess guess_at(const char *word, size_t length);
void guess_try(guess *g, const char *choice, size_t length);

/* " (did you mean '--thin'?)", with dashes before the word, or nothing. Returns text. */
enum { GUESS_TEXT = 64 };
const char *guess_text(const guess *g, const char *dashes, char text[GUESS_TEXT]);

/*
 * Which of the words, with a blank between two, the value of an option is, counted from 0. note: NULL, or what to say of them.
 * Returns an exit_code. The completion of shells asks for the words by an empty value.
 */
int choice_read(const char *option, const char *value, size_t length, const char *words, const char *note, unsigned *which);

#endif
