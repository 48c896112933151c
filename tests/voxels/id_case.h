/* id_case.h - a window of a grid with ids: what is expected of each cell, and whether a call wrote that and nothing else. */
#ifndef TRIBOX_TESTS_ID_CASE_H
#define TRIBOX_TESTS_ID_CASE_H

#include "common/ask.h"
#include "common/random_draws.h"

enum { ID_CELLS = 20000, ID_NONE = -1 };

typedef struct id_case {
    tribox_window at;
    int64_t expected[ID_CELLS]; /* by z, y, x: the lowest number of a triangle, or ID_NONE */
} id_case;

/* No cell has a triangle. */
void id_case_open(id_case *c, const tribox_window *at);

size_t id_case_words(const id_case *c);

/* Triangle t, if no lower one was expected, in the cells whose bits are set. Triangles come by their numbers. */
void id_case_expect(id_case *c, const uint64_t *occupied, int64_t t);

/* A call: triangles from .. to - 1, of which `from` has the number `first`. */
typedef tribox_status id_call(void *data, size_t from, size_t to, uint32_t first, uint64_t *occupied, uint32_t *ids,
                              tribox_report *report);

/*
 * Asks for `count` triangles in parts, in any order, with numbers from anywhere, into memory that had anything and ends with a
 * page. Fails where bits, ids or the report are not as expected, or an id was written where no bit is.
 */
void id_case_check(const id_case *c, random_source *r, size_t count, id_call *ask, void *data);

#endif
