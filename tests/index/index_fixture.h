/* index_fixture.h - what most tests of an index have: a stored soup, and fences around what is written. */
#ifndef TRIBOX_TESTS_INDEX_FIXTURE_H
#define TRIBOX_TESTS_INDEX_FIXTURE_H

#include "forms.h"

extern stored_soup stored;
extern form_fences fences;

/* For so many triangles at most, and so many boxes at once. Returns 0, as a program wants of a set-up. */
int index_fixture_make(size_t triangles, size_t boxes);

#endif
