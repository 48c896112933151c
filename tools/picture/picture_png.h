/* picture_png.h - pixels as a PNG file, by libpng. */
#ifndef PICTURE_PNG_H
#define PICTURE_PNG_H

#include <stdbool.h>
#include <stdio.h>

/* Whether the program was built with libpng. */
extern const bool picture_png_is_there;

/* Writes rows of red, green, blue bytes. Returns false where libpng lacks memory; the stream itself knows of its own failure. */
bool picture_png_write(FILE *to, const unsigned char *pixels, unsigned width, unsigned height);

#endif
