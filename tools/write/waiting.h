/* waiting.h - bytes that cannot go where they belong yet: in memory as long as they are few, and then in a nameless file. */
#ifndef WAITING_H
#define WAITING_H

#include "file_out.h"

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
