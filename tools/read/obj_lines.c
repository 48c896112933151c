/* obj_lines.c - tells the lines of OBJ apart, as read_obj.c does: a backslash joins two, in upper case or lower case. */
#include "obj_lines.h"

#include <string.h>

#include "text_lines.h"

static const struct {
    const char *word;
    obj_kind kind;
    int which;
} known[] = {{"v", OBJ_VERTEX, OBJ_POSITIONS},
             {"vt", OBJ_VERTEX, OBJ_TEXTURE},
             {"vn", OBJ_VERTEX, OBJ_NORMALS},
             {"f", OBJ_FACE, 0},
             {"l", OBJ_ELEMENT, 0},
             {"p", OBJ_ELEMENT, 0},
             {"g", OBJ_STATE, 0},
             {"o", OBJ_STATE, 1},
             {"s", OBJ_STATE, 2},
             {"mg", OBJ_STATE, 3},
             {"usemtl", OBJ_STATE, 4},
             {"usemap", OBJ_STATE, 5},
             {"lod", OBJ_STATE, 6},
             {"bevel", OBJ_STATE, 7},
             {"c_interp", OBJ_STATE, 8},
             {"d_interp", OBJ_STATE, 9},
             {"shadow_obj", OBJ_STATE, 10},
             {"trace_obj", OBJ_STATE, 11},
             {"vp", OBJ_CURVED, 0},
             {"cstype", OBJ_CURVED, 0},
             {"deg", OBJ_CURVED, 0},
             {"bmat", OBJ_CURVED, 0},
             {"step", OBJ_CURVED, 0},
             {"curv", OBJ_CURVED, 0},
             {"curv2", OBJ_CURVED, 0},
             {"surf", OBJ_CURVED, 0},
             {"parm", OBJ_CURVED, 0},
             {"trim", OBJ_CURVED, 0},
             {"hole", OBJ_CURVED, 0},
             {"scrv", OBJ_CURVED, 0},
             {"sp", OBJ_CURVED, 0},
             {"end", OBJ_CURVED, 0},
             {"con", OBJ_CURVED, 0},
             {"ctech", OBJ_CURVED, 0},
             {"stech", OBJ_CURVED, 0},
             {"fo", OBJ_CURVED, 0}};

bool obj_line_next(words *w, const char *from, obj_line *line)
{
    if (!words_next(w))
        return false;
    *line = (obj_line){.kind = OBJ_OTHER, .begin = text_line_begin(from, w->word), .words = *w};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (words_is(w, known[i].word)) {
            line->kind = known[i].kind;
            line->which = known[i].which;
            break;
        }
    words_skip_line(w);
    line->end = text_line_next(w->at, w->end);
    return true;
}

const char *obj_line_rest(const obj_line *line, size_t *length)
{
    const char *begin = line->words.at, *end = line->end;
    while (begin < end && strchr(" \t", *begin))
        begin++;
    while (end > begin && strchr(" \t\r\n", end[-1]))
        end--;
    *length = (size_t)(end - begin);
    return begin;
}

obj_corners obj_corners_of(const obj_line *line) { return (obj_corners){.words = line->words, .which = OBJ_NUMBERED}; }

/* The digits up to the next slash or the end of the word. */
static obj_reference take_digits(obj_corners *c, const char *end, bool *is_negative)
{
    *is_negative = c->at < end && *c->at == '-';
    obj_reference r = {.text = c->at, .which = c->which++};
    words digits = {.word = c->at + *is_negative};
    while (c->at < end && *c->at != '/')
        c->at++;
    r.length = (size_t)(c->at - r.text);
    digits.length = (size_t)(c->at - digits.word);
    c->at++;
    if (!words_whole(&digits, &r.number))
        r.number = UINT64_MAX;
    return r;
}

/* Counted from 0. */
static bool resolve(const obj_numbers *numbers, bool is_negative, obj_reference *r)
{
    const uint64_t number = r->number;
    if (!number || number == UINT64_MAX)
        return false;
    r->number = is_negative ? numbers->here[r->which] - number : number - 1;
    return r->number < numbers->all[r->which];
}

bool obj_corners_next(obj_corners *c, const obj_numbers *numbers, obj_reference *r)
{
    for (;;) {
        const char *const end = c->words.word + c->words.length;
        bool is_negative;
        if (c->which == OBJ_NUMBERED || c->at > end) {
            if (!words_next_on_line(&c->words))
                return false;
            c->at = c->words.word;
            c->which = OBJ_POSITIONS;
            continue;
        }
        *r = take_digits(c, end, &is_negative);
        if (resolve(numbers, is_negative, r))
            return true;
    }
}
