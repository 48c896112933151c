/* scan_obj.c - OBJ: its lines, which a backslash joins, in upper case or lower case. */
#include <inttypes.h>
#include <string.h>

#include "console/message.h"
#include "scan.h"

/* Kinds of lines by their first words; `which` counts along. Curves and surfaces refer to vertices in ways of their own. */
static const struct {
    scan_kind kind;
    const char *words[18];
} known[] = {
    {SCAN_VERTEX, {"v", "vt", "vn"}},
    {SCAN_FACE, {"f"}},
    {SCAN_LINE, {"l", "p"}},
    {SCAN_STATE, {"g", "o", "s", "mg", "usemtl", "usemap", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"}},
    {SCAN_LEFT_OUT,
     {"vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con", "ctech",
      "stech", "fo"}}};

static void find_kind(const words *w, scan_item *i)
{
    i->kind = SCAN_OTHER;
    for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
        for (int n = 0; n < 18 && known[k].words[n]; n++)
            if (words_is(w, known[k].words[n])) {
                i->kind = known[k].kind;
                i->which = n;
                return;
            }
}

static int take_vertex(scan *s)
{
    words w = s->item.words;
    for (int a = 0; a < 3; a++)
        if (!words_next_on_line(&w) || !words_number(&w, &s->item.position[a], &s->fit))
            return words_refuse(&w, "a coordinate of a vertex");
    int count = 0;
    while (s->has_colours && count < 3 && words_next_on_line(&w) &&
           words_number(&w, &s->item.colour[count], &(float_fit){FLOAT_FIT_EXACT}))
        count++;
    s->item.has_colour = count == 3;
    s->item.most = 1;
    return EXIT_CODE_OK;
}

/* One of the numbers of a corner. False where it is none of a vertex, texture or normal that there is. */
static bool resolve(const scan *s, scan_reference *r, bool *is_negative)
{
    *is_negative = r->length && *r->at == '-';
    const words digits = {.word = r->at + *is_negative, .length = r->length - *is_negative};
    if (!words_whole(&digits, &r->number) || *digits.word == '-' || !r->number || r->number == UINT64_MAX)
        return false;
    r->number = *is_negative ? s->here[r->which] - r->number : r->number - 1;
    return r->number < s->all[r->which];
}

/* The number of a vertex, before the first slash; of what follows the characters alone are looked at. */
static bool is_corner(const words *w)
{
    const size_t sign = w->length && *w->word == '-', end = sign + strspn(w->word + sign, "0123456789");
    return end > sign && (end == w->length || w->word[end] == '/') && end + strspn(w->word + end, "/-0123456789") >= w->length;
}

static int refuse_corner(const scan *s, const words *w, bool is_negative)
{
    return SCAN_REFUSE(s, "%s: damaged: line %" PRIu64 " refers to vertex %.*s, the file has %" PRIu64 ", counted from 1", w->path,
                       words_line(w), words_shown(w), w->word, is_negative ? s->here[SCAN_POSITIONS] : s->all[SCAN_POSITIONS]);
}

/* The numbers of the word, between slashes. Those of textures and normals that are not there are passed over. */
static int take_corner(scan *s, const words *w, bool is_checked)
{
    const char *at = w->word;
    const char *const end = at + w->length;
    int code = EXIT_CODE_OK;
    for (int which = 0; !code && which < SCAN_NUMBERED && at <= end; which++) {
        const char *const slash = memchr(at, '/', (size_t)(end - at));
        scan_reference r = {.at = at, .length = (size_t)((slash ? slash : end) - at), .which = which};
        bool is_negative;
        if (resolve(s, &r, &is_negative))
            code = scan_refer(s, r);
        else if (is_checked && which == SCAN_POSITIONS)
            return refuse_corner(s, w, is_negative);
        at += r.length + 1;
    }
    return code;
}

static int take_corners(scan *s, bool is_checked)
{
    words w = s->item.words;
    int code = EXIT_CODE_OK;
    bool is_there = false;
    for (; !code && words_next_on_line(&w); is_there = true)
        code = is_checked && !is_corner(&w) ? words_refuse(&w, "the number of a vertex") : take_corner(s, &w, is_checked);
    return code || is_there || !is_checked ? code : words_refuse(&w, "the number of a vertex");
}

int scan_next_obj(scan *s)
{
    words *const w = &s->words;
    scan_item *const i = &s->item;
    if (!words_next(w)) {
        i->kind = SCAN_END;
        i->begin = i->end = w->at == w->end ? w->end : i->gap;
        return EXIT_CODE_OK;
    }
    find_kind(w, i);
    i->begin = words_line_begin(w, s->from);
    i->words = *w;
    words_skip_line(w);
    i->end = words_line_next(w);
    if (i->kind == SCAN_VERTEX)
        s->here[i->which]++;
    if (i->kind == SCAN_VERTEX && i->which == SCAN_POSITIONS)
        return take_vertex(s);
    return i->kind == SCAN_FACE || i->kind == SCAN_LINE ? take_corners(s, i->kind == SCAN_FACE) : EXIT_CODE_OK;
}

/* Faces refer to lines before and after them. */
int scan_open_obj(scan *s, const whole_file *file)
{
    (void)file;
    words w = s->words;
    w.is_continued = s->words.is_continued = true;
    for (; words_next(&w); words_skip_line(&w)) {
        find_kind(&w, &s->item);
        if (s->item.kind == SCAN_VERTEX)
            s->all[s->item.which]++;
    }
    return EXIT_CODE_OK;
}
