/* crop_stl_text.c - STL as text: its facets, each with the space before it; the lines of its solids stay in both files. */
#include "crop_text.h"
#include "read/whole_file.h"
#include "read/words.h"

/* The facet that begins with the last word. False where it does not end. */
static bool skip_facet(words *w)
{
    while (words_next(w))
        if (words_is(w, "endfacet"))
            return true;
    return false;
}

static void put_facets(crop *c, const whole_file *file)
{
    words w = words_of(c->path, file, ' ');
    const char *from = file->bytes;
    while (!crop_is_over(c) && words_next(&w)) {
        if (!words_is(&w, "facet")) {
            words_skip_line(&w);
            crop_put_both(c, from, (size_t)(w.at - from));
        } else if (skip_facet(&w)) {
            const crop_side side = crop_next(c, 3);
            c->counts[side].faces++;
            crop_put(c, side, from, (size_t)(w.at - from));
        } else {
            c->is_changed = true;
        }
        from = w.at;
    }
    crop_put_both(c, from, (size_t)(w.end - from));
}

int crop_stl_text(crop *c)
{
    whole_file file;
    const int code = whole_file_read(c->path, &file);
    crop_begin(c);
    if (!code)
        put_facets(c, &file);
    whole_file_free(&file);
    return code;
}
