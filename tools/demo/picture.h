/* picture.h - a soup as characters, lit from the upper left and seen along the z axis. */
#ifndef PICTURE_H
#define PICTURE_H

#include "tribox.h"

/*
 * Prints the soup to standard output, x to the right and y up. Each character shows the triangle that is nearest to the viewer
 * among those whose centre lies in its cell: '#' if its bit in the mask is set, else how bright it is, from '.' to '*'.
 */
void picture_print(const tribox_soup *soup, const uint64_t *mask);

#endif
