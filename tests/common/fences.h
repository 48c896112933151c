/* fences.h - outputs between pages that cannot be touched, poisoned before a call; what is written outside them shows. */
#ifndef TRIBOX_TESTS_FENCES_H
#define TRIBOX_TESTS_FENCES_H

#include <stddef.h>

#include "common/guard.h"
#include "tribox.h"

enum { POISON = 0xa5 };

/* A place of `bytes` bytes at the end of a fence, or `offset` bytes after its start; the whole fence is poisoned. */
typedef struct fenced {
    guarded fence;
    unsigned char *at;
    size_t bytes;
} fenced;

enum { AT_END = -1 };
fenced fenced_place(guarded fence, size_t bytes, int offset);

/* Fails, with what the test is doing, if a byte beside the place is no longer poisoned. */
void assert_nothing_beside(const fenced *place);

/* The same, and in the place as well. */
void assert_nothing_written(const fenced *place);

/* Fails, with what the test is doing, if a report is not that of a mask; FAST leaves nothing undecided. */
void assert_report(const tribox_report *report, const uint64_t *mask, size_t count, tribox_accuracy accuracy);

/* Fences for the nine streams of a soup, by axis, then by vertex, each with room for so many floats and for a shift. */
enum { STREAM_SHIFTS = 16 };
void stream_fences_make(size_t most, guarded fence[9]);

/* Streams at the ends of their fences, or `shift` floats after the starts; and those of triangles, of which numbers are rounded. */
tribox_soup streams_lay(const guarded fence[9], size_t count, int shift, float *to[9]);
tribox_soup streams_of_triangles(const guarded fence[9], int shift, const double (*u)[3][3], size_t count);

/* Poisoned, where a call is to write them; beside an aligned place each its own way. */
void streams_place(const guarded fence[9], size_t count, int shift, fenced place[9], float *to[9]);

#endif
