/* spool.h - a nameless file for what cannot go where it belongs yet: it vanishes with the program, however that ends. */
#ifndef SPOOL_H
#define SPOOL_H

#include "file_out.h"

/* Opens one on the disk of the output; for standard output where TMPDIR says, or in /tmp. NULL after a line. */
FILE *spool_open(const file_out *out);

/* Appends all of it to the output. Returns an exit_code. */
int spool_copy(FILE *spool, const file_out *out);

/* Bytes that cannot go where they belong yet: in memory, which takes less than a file, as long as they are few. */
typedef struct waiting {
    const file_out *out;  /* where they will go, for the place of the file and for messages */
    unsigned char *bytes; /* NULL for none */
    size_t count, room;   /* of these, and for how many there is memory */
    FILE *rest;           /* NULL as long as there is none */
} waiting;

waiting waiting_for(const file_out *out);

/* Returns an exit_code, on failure after its line. */
int waiting_add(waiting *w, const void *bytes, size_t count);

/* Hands on all of them, in order. Returns as above. */
int waiting_hand_on(waiting *w, void (*take)(void *data, const void *bytes, size_t count), void *data);

void waiting_free(waiting *w);

#endif
