/* crop_off.c - OFF: a line for each vertex and each face, with all that follows on it, colours and normals. */
#include <string.h>

#include "console/message.h"
#include "crop_text.h"
#include "kept_numbers.h"
#include "read/whole_file.h"
#include "read/words.h"

typedef struct off {
    crop *c;
    words words;
    const char *from; /* what is not copied yet */
    uint64_t vertices, faces;
    const char *counts[3]; /* of vertices, faces and edges; NULL: no edges are counted */
    size_t length[3];
    kept_numbers kept[CROP_SIDES];
} off;

/* What follows the word of the format, as in OFF8. */
static bool skip_keyword(words *w)
{
    const bool is_there = words_next(w);
    const char *const name = w->word + strspn(w->word, "STCN");
    if (!is_there || strncmp(name, "OFF", 3))
        return false;
    w->at = name + 3;
    return true;
}

static bool find_counts(off *o)
{
    uint64_t *const numbers[2] = {&o->vertices, &o->faces};
    words *const w = &o->words;
    bool is_sound = skip_keyword(w);
    for (int i = 0; is_sound && i < 3; i++) {
        const bool is_there = i < 2 ? words_next(w) : words_next_on_line(w);
        o->counts[i] = is_there ? w->word : NULL;
        o->length[i] = w->length;
        is_sound = i == 2 || (is_there && words_whole(w, numbers[i]));
    }
    words_skip_line(w);
    return is_sound;
}

/* The edges are those of all faces, and are not counted anew: programs take 0 for that. */
static void put_head(off *o)
{
    crop *const c = o->c;
    const char *const end = text_line_next(o->words.at, o->words.end);
    for (int s = 0; s < CROP_SIDES; s++) {
        crop_copy copy = {c, (crop_side)s, o->from};
        crop_copy_number(&copy, o->counts[0], o->length[0], o->kept[s].kept);
        crop_copy_number(&copy, o->counts[1], o->length[1], c->counts[s].faces);
        if (o->counts[2])
            crop_copy_number(&copy, o->counts[2], o->length[2], 0);
        crop_copy_to(&copy, end);
    }
    o->from = end;
}

/* Finds a line, and copies the lines before it, which are empty or comments, to both sides. */
static bool find_line(off *o, const char **line)
{
    if (!words_next(&o->words)) {
        o->c->is_changed = true;
        return false;
    }
    *line = text_line_begin(o->from, o->words.word);
    return true;
}

static bool take_corner(off *o, uint64_t *corner)
{
    if (words_next_on_line(&o->words) && words_whole(&o->words, corner) && *corner < o->vertices)
        return true;
    o->c->is_changed = true;
    return false;
}

static bool take_size(off *o, uint64_t *corners)
{
    const bool is_sound = words_whole(&o->words, corners);
    o->c->is_changed |= !is_sound;
    return is_sound;
}

static void mark_face(off *o)
{
    const char *line;
    uint64_t corners, corner;
    if (!find_line(o, &line) || !take_size(o, &corners))
        return;
    const crop_side side = crop_next(o->c, corners);
    o->c->counts[side].faces++;
    for (uint64_t i = 0; !o->c->is_changed && i < corners; i++)
        if (take_corner(o, &corner))
            kept_numbers_add(&o->kept[side], corner);
    words_skip_line(&o->words);
}

static void put_gap(off *o, const char *line)
{
    crop_put_both(o->c, o->from, (size_t)(line - o->from));
    o->from = line;
}

static void put_vertex(off *o, uint64_t number)
{
    const char *line;
    if (!find_line(o, &line))
        return;
    put_gap(o, line);
    words_skip_line(&o->words);
    const char *const next = text_line_next(o->words.at, o->words.end);
    for (int s = 0; s < CROP_SIDES; s++)
        if (kept_numbers_has(&o->kept[s], number))
            crop_put(o->c, (crop_side)s, line, (size_t)(next - line));
    o->from = next;
}

static void put_face(off *o)
{
    const char *line;
    uint64_t corners, corner;
    if (!find_line(o, &line) || !take_size(o, &corners))
        return;
    put_gap(o, line);
    crop_copy copy = {o->c, crop_next(o->c, corners), line};
    for (uint64_t i = 0; !o->c->is_changed && i < corners; i++)
        if (take_corner(o, &corner))
            crop_copy_number(&copy, o->words.word, o->words.length, kept_numbers_new(&o->kept[copy.side], corner));
    words_skip_line(&o->words);
    o->from = text_line_next(o->words.at, o->words.end);
    crop_copy_to(&copy, o->from);
}

static void mark(off *o)
{
    crop_begin(o->c);
    for (uint64_t v = 0; v < o->vertices && words_next(&o->words); v++)
        words_skip_line(&o->words);
    for (uint64_t f = 0; f < o->faces && !o->c->is_changed; f++)
        mark_face(o);
    for (int s = 0; s < CROP_SIDES; s++) {
        kept_numbers_count(&o->kept[s]);
        o->c->counts[s].vertices = o->kept[s].kept;
    }
}

static void put(off *o)
{
    crop_begin(o->c);
    put_head(o);
    for (uint64_t v = 0; v < o->vertices && !crop_is_over(o->c); v++)
        put_vertex(o, v);
    for (uint64_t f = 0; f < o->faces && !crop_is_over(o->c); f++)
        put_face(o);
    put_gap(o, o->words.end);
}

static int crop_text(off *o)
{
    int code = EXIT_CODE_OK;
    o->c->is_changed = !find_counts(o);
    if (o->c->is_changed)
        return code;
    const words head = o->words;
    for (int s = 0; !code && s < CROP_SIDES; s++)
        code = kept_numbers_make(o->c->path, o->vertices, &o->kept[s]);
    if (code)
        return code;
    mark(o);
    o->words = head;
    if (!o->c->is_changed)
        put(o);
    return code;
}

int crop_off(crop *c)
{
    whole_file file;
    off o = {.c = c};
    int code = whole_file_read(c->path, &file);
    if (!code) {
        o.words = words_of(c->path, &file, '#');
        o.from = file.bytes;
        code = crop_text(&o);
    }
    whole_file_free(&file);
    for (int s = 0; s < CROP_SIDES; s++)
        kept_numbers_free(&o.kept[s]);
    return code;
}
