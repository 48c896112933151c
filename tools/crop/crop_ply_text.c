/* crop_ply_text.c - PLY as text: each vertex and face, and what else there is, on a line, in the words that it had. */
#include <string.h>

#include "crop_ply.h"
#include "crop_text.h"
#include "read/words.h"

typedef struct ply_text {
    crop_ply_file *f;
    words words;
    const char *line_end; /* as the header has it */
} ply_text;

/* The words of one vertex, face or whatever it is. */
typedef struct record {
    const char *begin, *end;
    words corners; /* before the first of them */
    uint64_t count;
} record;

static bool take_number(words *w, double *number)
{
    return words_next(w) && words_number(w, number, &(float_fit){FLOAT_FIT_EXACT});
}

/* How many values a property has. */
static bool take_count(words *w, const ply_property *p, uint64_t *count)
{
    double number = 1;
    if (p->count && (!take_number(w, &number) || !(number >= 0 && number <= (double)(w->end - w->text))))
        return false;
    *count = (uint64_t)number;
    return true;
}

static bool find_record(words *w, const ply_element *e, record *r)
{
    *r = (record){.begin = NULL};
    for (int i = 0; i < e->property_count; i++) {
        const ply_property *const p = &e->properties[i];
        const words before = *w;
        uint64_t count;
        if (!r->begin) {
            words first = before;
            words_next(&first);
            r->begin = first.word;
        }
        if (!take_count(w, p, &count))
            return false;
        if (p->role == PLY_CORNERS) {
            r->corners = *w;
            r->count = count;
        }
        while (count--)
            if (!words_next(w))
                return false;
    }
    r->end = w->at;
    return true;
}

static void put_line_end(const ply_text *t, crop_side side) { crop_put(t->f->c, side, t->line_end, strlen(t->line_end)); }

static void put_record(const ply_text *t, const record *r, crop_side side)
{
    crop_put(t->f->c, side, r->begin, (size_t)(r->end - r->begin));
    put_line_end(t, side);
}

static void mark_face(const ply_text *t, record *r)
{
    crop *const c = t->f->c;
    const crop_side side = crop_next(c, r->count);
    c->counts[side].faces++;
    for (uint64_t i = 0; i < r->count; i++) {
        double number;
        uint64_t vertex;
        if (take_number(&r->corners, &number) && crop_ply_vertex(t->f, number, &vertex))
            kept_numbers_add(&t->f->kept[side], vertex);
        else
            c->is_changed = true;
    }
}

static void put_face(const ply_text *t, record *r)
{
    crop_copy copy = {t->f->c, crop_next(t->f->c, r->count), r->begin};
    for (uint64_t i = 0; i < r->count; i++) {
        double number;
        uint64_t vertex;
        if (take_number(&r->corners, &number) && crop_ply_vertex(t->f, number, &vertex))
            crop_copy_number(&copy, r->corners.word, r->corners.length, kept_numbers_new(&t->f->kept[copy.side], vertex));
    }
    crop_copy_to(&copy, r->end);
    put_line_end(t, copy.side);
}

static void put_other(const ply_text *t, const ply_element *e, uint64_t number, const record *r)
{
    const bool is_left_out = t->f->is_left_out[e - t->f->header.elements];
    for (int s = 0; s < CROP_SIDES; s++)
        if (e->kind == PLY_VERTICES ? kept_numbers_has(&t->f->kept[s], number) : !is_left_out)
            put_record(t, r, (crop_side)s);
}

static void walk_element(ply_text *t, const ply_element *e, bool is_writing)
{
    for (uint64_t n = 0; n < e->count && !crop_is_over(t->f->c); n++) {
        record r;
        if (!find_record(&t->words, e, &r))
            t->f->c->is_changed = true;
        else if (e->kind == PLY_FACES && is_writing)
            put_face(t, &r);
        else if (e->kind == PLY_FACES)
            mark_face(t, &r);
        else if (is_writing)
            put_other(t, e, n, &r);
    }
}

static void walk(ply_text *t, bool is_writing)
{
    crop_begin(t->f->c);
    t->words = words_of(t->f->c->path, &t->f->head, ' ');
    t->words.at += t->f->header.size;
    for (int e = 0; e < t->f->header.element_count; e++)
        walk_element(t, &t->f->header.elements[e], is_writing);
}

void crop_ply_text(crop_ply_file *f)
{
    const char *const first = f->head.bytes + 3;
    ply_text t = {.f = f, .line_end = *first != '\r' ? "\n" : first[1] == '\n' ? "\r\n" : "\r"};
    walk(&t, false);
    crop_ply_count(f);
    if (f->c->is_changed)
        return;
    crop_ply_heads(f);
    walk(&t, true);
}
