/* preview.c - the picture of the cells as a PNG file, where there is libpng. */
#include "preview.h"

#include <stdlib.h>
#include <string.h>

#include "console/interrupt.h"
#include "console/known_word.h"
#include "console/message.h"
#include "console/numbers.h"

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

static const char *const up_words[] = {"x", "y", "z", "-x", "-y", "-z"};

const char *preview_up_word(picture_up up) { return up_words[up]; }

int preview_read_up(const char *text, picture_up *up)
{
    unsigned n;
    const int code = choice_read("--up", text, strlen(text), "x y z -x -y -z", NULL, &n);
    if (!code)
        *up = (picture_up)n;
    return code;
}

int preview_read_size(const char *text, picture_look *look)
{
    char width[8] = "";
    const char *cross = strchr(text, 'x');
    const size_t length = cross ? (size_t)(cross - text) : 0;
    if (!cross || length >= sizeof width)
        return message_usage("--picture-size: '%s' is not WIDTHxHEIGHT, as 1280x960", text);
    memcpy(width, text, length);
    const int code = numbers_read_whole(width, "--picture-size, its width", PREVIEW_SIDE_MAX, &look->size[0]);
    return code ? code : numbers_read_whole(cross + 1, "--picture-size, its height", PREVIEW_SIDE_MAX, &look->size[1]);
}

int preview_draw(file_out *out, const voxels *v, const picture_look *look, unsigned threads)
{
    if (!out->stream)
        return EXIT_CODE_OK;
    interrupt_advise("the cells are written, the picture is not; run it again");
    unsigned char *pixels = malloc((size_t)3 * look->size[0] * look->size[1]);
    progress bar = progress_start("drawing");
    const bool is_drawn = pixels && preview_pixels(v, look, threads, pixels, &bar);
    progress_end(&bar);
    int code = is_drawn ? EXIT_CODE_OK : message_failure("out of memory for the preview");
    if (!code && !picture_png_write(out->stream, pixels, look->size[0], look->size[1]))
        code = message_failure("%s: libpng cannot write the preview", out->path);
    free(pixels);
    return code ? code : file_out_keep(out);
}
