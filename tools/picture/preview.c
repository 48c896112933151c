/* preview.c - the picture of the cells as a PNG file, where there is libpng. */
#include "preview.h"

#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "picture_png.h"

enum { PIXEL_BYTES = 3 * PICTURE_WIDTH * PICTURE_HEIGHT };

int preview_check(const char *path, const char *option)
{
    const size_t length = path ? strlen(path) : 0;
    if (!path)
        return EXIT_CODE_OK;
    if (length < 5 || strcmp(path + length - 4, ".png"))
        return message_usage("%s: '%s' does not end in .png", option, path);
    return picture_png_is_there
               ? EXIT_CODE_OK
               : message_failure("%s: this program was built without libpng; leave the option out, or build it with libpng",
                                 option);
}

int preview_read_up(const char *text, picture_up *up)
{
    static const char *const words[] = {"x", "y", "z", "-x", "-y", "-z"};
    for (int i = 0; i < 6; i++)
        if (!strcmp(text, words[i])) {
            *up = (picture_up)i;
            return EXIT_CODE_OK;
        }
    return message_usage("--up: '%s' is none of x, y, z, -x, -y, -z", text);
}

uint64_t preview_memory(const tribox_grid *grid) { return PIXEL_BYTES + picture_memory(grid); }

int preview_draw(file_out *out, const voxels *v, picture_up up, unsigned threads, bool wants_progress)
{
    if (!out->stream)
        return EXIT_CODE_OK;
    unsigned char *pixels = malloc(PIXEL_BYTES);
    progress bar = progress_start("drawing", wants_progress);
    const bool is_drawn = pixels && picture_draw(v, up, threads, pixels, &bar);
    progress_end(&bar);
    int code = is_drawn ? EXIT_CODE_OK : message_failure("out of memory for the preview");
    if (!code && !picture_png_write(out->stream, pixels, PICTURE_WIDTH, PICTURE_HEIGHT))
        code = message_failure("%s: libpng cannot write the preview", out->path);
    free(pixels);
    return code ? code : file_out_keep(out);
}
