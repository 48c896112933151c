/* picture_png.c - hands rows to libpng. */
#include "preview.h"

#include <png.h>
#include <stddef.h>

const bool picture_png_is_there = true;

static void write_bytes(png_structp png, png_bytep bytes, png_size_t count)
{
    fwrite(bytes, 1, count, (FILE *)png_get_io_ptr(png)); /* ferror tells of a failure */
}

static void flush_nothing(png_structp png) { (void)png; }

static void write_image(png_structp png, png_infop info, FILE *to, const unsigned char *pixels, unsigned width, unsigned height)
{
    png_set_write_fn(png, to, write_bytes, flush_nothing);
    png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (unsigned y = 0; y < height; y++)
        png_write_row(png, pixels + (size_t)y * 3 * width);
    png_write_end(png, info);
}

bool picture_png_write(FILE *to, const unsigned char *pixels, unsigned width, unsigned height)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    const bool is_ready = info && !setjmp(png_jmpbuf(png)); /* libpng jumps here on an error */
    if (is_ready)
        write_image(png, info, to, pixels, width, height);
    png_destroy_write_struct(&png, &info);
    return is_ready;
}
