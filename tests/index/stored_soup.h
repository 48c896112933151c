/* stored_soup.h - a soup, its index and the caller's numbers of its triangles, each between pages that cannot be touched. */
#ifndef TRIBOX_TESTS_STORED_SOUP_H
#define TRIBOX_TESTS_STORED_SOUP_H

#include <stdint.h>

#include "common/guard.h"
#include "tribox.h"

enum { STORED_STREAMS = 9 };

typedef struct stored_soup {
    guarded stream_fence[STORED_STREAMS], ids_fence, nodes_fence;
    float *stream[STORED_STREAMS]; /* stream[3 * a + v]: axis a of vertex v */
    uint32_t *ids;                 /* no two alike, in no order */
    unsigned char *nodes;
    tribox_soup soup;
    tribox_index index, with_ids; /* over the soup, until a test sets something else; with ids too */
} stored_soup;

/* Fences for so many triangles at most, with room to shift all in. */
stored_soup stored_soup_make(size_t room);

/*
 * A soup of so many triangles, whose numbers are to be written. All ends at the pages after it; or else begins after those before
 * it, the index as many bytes beside an aligned place as `shift` says, the streams as many floats.
 */
enum { STORED_AT_END = -1, STORED_SHIFTS = 16 };
void stored_soup_lay(stored_soup *s, size_t count, int shift);

/* Fills the index's memory with poison, then builds the index of what it is over, as that is now. */
void stored_soup_build(stored_soup *s, const char *kernel);

static inline size_t stored_index_bytes(const stored_soup *s) { return tribox_index_bytes(s->soup.count); }

/* From now on reading a stream faults, or no longer does. */
void stored_soup_hide(const stored_soup *s, bool is_hidden);

#endif
