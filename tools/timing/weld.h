/* weld.h - an indexed mesh of a soup: vertices that are the same are one. */
#ifndef TIMING_WELD_H
#define TIMING_WELD_H

#include "tribox.h"

/*
 * Numbers vertices as they come first. positions: room for three a triangle; corners: three numbers a triangle. Returns how many
 * vertices there are; 0 where memory fails.
 */
size_t weld_soup(const tribox_soup *soup, float (*positions)[3], uint32_t (*corners)[3]);

#endif
