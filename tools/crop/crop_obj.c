/* crop_obj.c - OBJ: lines as they are, but for the numbers of vertices, textures and normals, which are those that are used. */
#include <inttypes.h>

#include "console/message.h"
#include "crop_text.h"
#include "kept_numbers.h"
#include "read/obj_lines.h"

/* Lines that wait for a face, so that no empty groups are written. */
typedef struct obj_states {
    const char *begin[OBJ_STATES], *end[OBJ_STATES]; /* NULL: none waits */
    int waiting;
} obj_states;

typedef struct obj {
    crop *c;
    const whole_file *file;
    obj_numbers numbers;
    kept_numbers kept[CROP_SIDES][OBJ_NUMBERED];
    obj_states states[CROP_SIDES];
    uint64_t curved; /* lines that are left out */
} obj;

/* Faces refer to lines before and after them. */
static void count(obj *o, const obj_line *line)
{
    if (line->kind == OBJ_VERTEX)
        o->numbers.all[line->which]++;
    o->curved += line->kind == OBJ_CURVED;
}

static uint64_t corners_of(const obj_line *line)
{
    words w = line->words;
    uint64_t corners = 0;
    while (words_next_on_line(&w))
        corners++;
    return corners;
}

/* Points and lines overlap nothing, as they are not asked about. */
static crop_side side_of(const obj *o, const obj_line *line)
{
    return line->kind == OBJ_FACE ? crop_next(o->c, corners_of(line)) : CROP_REST;
}

static void mark(obj *o, const obj_line *line)
{
    if (line->kind == OBJ_VERTEX)
        o->numbers.here[line->which]++;
    if (line->kind != OBJ_FACE && line->kind != OBJ_ELEMENT)
        return;
    const crop_side side = side_of(o, line);
    obj_corners corners = obj_corners_of(line);
    obj_reference r;
    o->c->counts[side].faces += line->kind == OBJ_FACE;
    while (obj_corners_next(&corners, &o->numbers, &r))
        kept_numbers_add(&o->kept[side][r.which], r.number);
}

static void set_state(obj_states *states, const obj_line *line)
{
    states->waiting += !states->begin[line->which];
    states->begin[line->which] = line->begin;
    states->end[line->which] = line->end;
}

/* In their order in the file. */
static void put_states(obj *o, crop_side side)
{
    obj_states *const s = &o->states[side];
    for (; s->waiting; s->waiting--) {
        int first = 0;
        while (!s->begin[first])
            first++;
        for (int i = first + 1; i < OBJ_STATES; i++)
            if (s->begin[i] && s->begin[i] < s->begin[first])
                first = i;
        crop_put(o->c, side, s->begin[first], (size_t)(s->end[first] - s->begin[first]));
        s->begin[first] = NULL;
    }
}

static void put_face(obj *o, const obj_line *line)
{
    crop_copy copy = {o->c, side_of(o, line), line->begin};
    obj_corners corners = obj_corners_of(line);
    obj_reference r;
    put_states(o, copy.side);
    while (obj_corners_next(&corners, &o->numbers, &r))
        crop_copy_number(&copy, r.text, r.length, kept_numbers_new(&o->kept[copy.side][r.which], r.number) + 1);
    crop_copy_to(&copy, line->end);
}

static void put_vertex(obj *o, const obj_line *line)
{
    const uint64_t number = o->numbers.here[line->which]++;
    for (int s = 0; s < CROP_SIDES; s++)
        if (kept_numbers_has(&o->kept[s][line->which], number))
            crop_put(o->c, (crop_side)s, line->begin, (size_t)(line->end - line->begin));
}

static void put(obj *o, const obj_line *line)
{
    if (line->kind == OBJ_VERTEX)
        put_vertex(o, line);
    else if (line->kind == OBJ_FACE || line->kind == OBJ_ELEMENT)
        put_face(o, line);
    else if (line->kind == OBJ_OTHER)
        crop_put_both(o->c, line->begin, (size_t)(line->end - line->begin));
    for (int s = 0; line->kind == OBJ_STATE && s < CROP_SIDES; s++)
        set_state(&o->states[s], line);
}

/* Empty lines and comments go to both sides with `put`. */
static void walk(obj *o, void (*take)(obj *o, const obj_line *line))
{
    words w = words_of(o->c->path, o->file, '#');
    const char *from = o->file->bytes;
    w.is_continued = true;
    for (obj_line line; !crop_is_over(o->c) && obj_line_next(&w, from, &line); from = line.end) {
        if (take == put)
            crop_put_both(o->c, from, (size_t)(line.begin - from));
        take(o, &line);
    }
    if (take == put && w.at == w.end)
        crop_put_both(o->c, from, (size_t)(w.end - from));
}

static void begin(obj *o)
{
    crop_begin(o->c);
    for (int k = 0; k < OBJ_NUMBERED; k++)
        o->numbers.here[k] = 0;
}

static int crop_lines(obj *o)
{
    int code = EXIT_CODE_OK;
    walk(o, count);
    for (int i = 0; !code && i < CROP_SIDES * OBJ_NUMBERED; i++)
        code = kept_numbers_make(o->c->path, o->numbers.all[i % OBJ_NUMBERED], &o->kept[i / OBJ_NUMBERED][i % OBJ_NUMBERED]);
    if (code)
        return code;
    begin(o);
    walk(o, mark);
    for (int i = 0; i < CROP_SIDES * OBJ_NUMBERED; i++)
        kept_numbers_count(&o->kept[i / OBJ_NUMBERED][i % OBJ_NUMBERED]);
    for (int s = 0; s < CROP_SIDES; s++)
        o->c->counts[s].vertices = o->kept[s][OBJ_POSITIONS].kept;
    begin(o);
    walk(o, put);
    if (o->curved)
        message_say("note: %s: %" PRIu64 " lines of curves and surfaces are left out of what is written", o->c->path, o->curved);
    return code;
}

int crop_obj(crop *c)
{
    whole_file file;
    obj o = {.c = c, .file = &file};
    int code = whole_file_read(c->path, &file);
    if (!code)
        code = crop_lines(&o);
    whole_file_free(&file);
    for (int i = 0; i < CROP_SIDES * OBJ_NUMBERED; i++)
        kept_numbers_free(&o.kept[i / OBJ_NUMBERED][i % OBJ_NUMBERED]);
    return code;
}
