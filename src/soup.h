/* soup.h - what every call asks of a soup before it reads it. */
#ifndef TRIBOX_SOUP_H
#define TRIBOX_SOUP_H

#include <stdbool.h>

#include "tribox.h"

/* Whether streams of so many floats fit the address space. */
static inline bool tribox_is_addressable(size_t count) { return count <= PTRDIFF_MAX / sizeof(float); }

/* Whether the soup can be read: no NULL where triangles are, and a count that fits. */
bool tribox_soup_is_readable(const tribox_soup *soup);

/* The last count % 64 triangles in a word of their own: the numbers after them stay what scratch holds, which should be zeros. */
tribox_soup tribox_soup_tail(const tribox_soup *soup, float scratch[9][64]);

#endif
