/* index_fixture.h - what most tests of an index have: a stored soup, fences around what is written, the kernels that run here. */
#ifndef TRIBOX_TESTS_INDEX_FIXTURE_H
#define TRIBOX_TESTS_INDEX_FIXTURE_H

#include "common/kernels_here.h"
#include "forms.h"
#include "stored_soup.h"

extern stored_soup stored;
extern form_fences fences;
extern const char *names[KERNELS_MAX];
extern int kernels;

/* For so many triangles at most, and so many boxes at once. Returns 0, as cmocka wants of a set-up. */
int index_fixture_make(size_t triangles, size_t boxes);
int index_fixture_free(void **state);

#endif
