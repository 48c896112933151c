/* guard.h - memory with a page before and a page after it that cannot be touched. */
#ifndef TRIBOX_TESTS_GUARD_H
#define TRIBOX_TESTS_GUARD_H

#include <stdbool.h>
#include <stddef.h>

typedef struct guarded {
    unsigned char *first; /* the first byte that may be touched */
    size_t size;          /* whole pages, at least as many bytes as were asked for */
} guarded;

/* Fails the test if there is no memory. */
guarded guarded_make(size_t bytes);
void guarded_free(guarded g);

/* The place from which `bytes` end at the page after. */
void *guarded_tail(guarded g, size_t bytes);

/* The same, of pages that are kept from call to call: others are made where they are too few. They can be written. */
void *guarded_room(guarded *g, size_t bytes);

/* From now on a write faults, or no longer does. */
void guarded_read_only(guarded g, bool is_read_only);

/* What a test is doing, for the message when a page of a guard is touched. */
enum { DOING_TEXT = 200 };
extern char doing[DOING_TEXT];

/* Ends the program with a message that says what it was doing, on a fault, an illegal instruction and a floating-point trap. */
void catch_faults(void);

#endif
