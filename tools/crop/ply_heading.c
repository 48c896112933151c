/* ply_heading.c - the header of a PLY file as it is, comments included, but for two counts and elements that are left out. */
#include <inttypes.h>

#include "console/message.h"
#include "crop_ply.h"
#include "crop_text.h"
#include "read/words.h"

/* Moves to the name of a property: property TYPE NAME, or property list TYPE TYPE NAME. */
static bool find_name(words *w)
{
    bool is_there = words_next_on_line(w);
    for (int skipped = words_is(w, "list") ? 3 : 1; is_there && skipped > 0; skipped--)
        is_there = words_next_on_line(w);
    return is_there;
}

/* Whether a property is the number of a vertex, or a list of such. */
static bool is_reference(const words *name)
{
    static const char *const known[] = {"vertex1", "vertex2", "vertex_index", "vertex_indices"};
    bool is_known = false;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        is_known |= words_is(name, known[i]);
    return is_known;
}

/* Moves to the next line of an element or a property; false at the end of the header. */
static bool find_line(words *w, int *element)
{
    while (words_next(w) && !words_is(w, "end_header")) {
        if (words_is(w, "element"))
            ++*element;
        if (words_is(w, "element") || (words_is(w, "property") && *element >= 0))
            return *element < PLY_ELEMENTS_MAX;
        words_skip_line(w);
    }
    return false;
}

int crop_ply_check(crop_ply_file *f)
{
    words w = words_of(f->c->path, &f->head, ' ');
    for (int e = -1; find_line(&w, &e); words_skip_line(&w))
        if (words_is(&w, "property") && f->header.elements[e].kind == PLY_OTHER && find_name(&w))
            f->is_left_out[e] |= is_reference(&w);
    for (int e = 0; e < f->header.element_count; e++) {
        const ply_element *const element = &f->header.elements[e];
        if (element->kind == PLY_STRIPS && element->count)
            return message_failure("%s: has strips of triangles, which -o and --rest do not cut; save the mesh with faces",
                                   f->c->path);
        if (f->is_left_out[e] && element->count)
            message_say("note: %s: its %" PRIu64 " of '%.*s' refer to vertices, and are left out of what is written", f->c->path,
                        element->count, element->name_length, element->name);
    }
    return EXIT_CODE_OK;
}

/* The count of the last word's element. */
static void put_count(crop_copy *copy, words *w, uint64_t count)
{
    if (words_next_on_line(w) && words_next_on_line(w))
        crop_copy_number(copy, w->word, w->length, count);
}

static void put_head(crop_ply_file *f, crop_side side)
{
    words w = words_of(f->c->path, &f->head, ' ');
    crop_copy copy = {f->c, side, f->head.bytes};
    for (int e = -1; find_line(&w, &e);) {
        const ply_kind kind = f->header.elements[e].kind;
        if (f->is_left_out[e])
            crop_copy_to(&copy, w.word);
        else if (words_is(&w, "element") && kind <= PLY_FACES)
            put_count(&copy, &w, kind == PLY_FACES ? f->c->counts[side].faces : f->c->counts[side].vertices);
        words_skip_line(&w);
        if (f->is_left_out[e])
            copy.from = text_line_next(w.at, w.end);
    }
    crop_copy_to(&copy, f->head.bytes + f->header.size);
}

void crop_ply_heads(crop_ply_file *f)
{
    for (int s = 0; s < CROP_SIDES; s++)
        put_head(f, (crop_side)s);
}
