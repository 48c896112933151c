/* picture_png_none.c - stands in for picture_png.c where there is no libpng. */
#include "preview.h"

const bool picture_png_is_there = false;

bool picture_png_write(FILE *to, const unsigned char *pixels, unsigned width, unsigned height)
{
    (void)to, (void)pixels, (void)width, (void)height;
    return false;
}
