/* words.c - finds the words of a text, and says where one is wrong. */
#include "scan.h"

#include <inttypes.h>
#include <string.h>
#include <strings.h>

#include "console/message.h"

enum { SHOWN_MAX = 40 };

static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

words words_of(const char *path, const whole_file *file, char comment)
{
    const char *const end = file->bytes + file->size;
    return (words){.path = path, .text = file->bytes, .end = end, .at = file->bytes, .word = end, .comment = comment};
}

/* The bytes of a backslash and the line end after it, where they join two lines; else 0. The file ends with a NUL byte. */
static size_t joint(const words *w)
{
    if (!w->is_continued || *w->at != '\\' || !is_line_end(w->at[1]))
        return 0;
    return w->at[1] == '\r' && w->at[2] == '\n' ? 3 : 2;
}

void words_skip_line(words *w)
{
    while (w->at < w->end && !is_line_end(*w->at))
        w->at += joint(w) ? joint(w) : 1;
}

static bool take_word(words *w)
{
    w->word = w->at;
    while (w->at < w->end && !is_blank(*w->at) && *w->at != w->comment && !joint(w))
        w->at++;
    w->length = (size_t)(w->at - w->word);
    return w->length;
}

bool words_next(words *w)
{
    for (;;) {
        while (w->at < w->end && is_blank(*w->at))
            w->at++;
        if (w->at == w->end || *w->at != w->comment)
            return take_word(w);
        words_skip_line(w);
    }
}

bool words_next_on_line(words *w)
{
    while (w->at < w->end && ((is_blank(*w->at) && !is_line_end(*w->at)) || joint(w)))
        w->at += joint(w) ? joint(w) : 1;
    if (w->at < w->end && (is_line_end(*w->at) || *w->at == w->comment)) {
        w->length = 0;
        return false;
    }
    return take_word(w);
}

const char *words_line_begin(const words *w, const char *from)
{
    const char *at = w->word;
    while (at > from && !is_line_end(at[-1]))
        at--;
    return at;
}

const char *words_line_next(const words *w)
{
    const bool is_pair = w->end - w->at > 1 && w->at[0] == '\r' && w->at[1] == '\n';
    return w->at + (is_pair ? 2 : w->at < w->end);
}

const char *words_rest(words w, size_t *length)
{
    const char *begin = w.at;
    words_skip_line(&w);
    while (begin < w.at && strchr(" \t", *begin))
        begin++;
    while (w.at > begin && strchr(" \t", w.at[-1]))
        w.at--;
    *length = (size_t)(w.at - begin);
    return begin;
}

bool words_is(const words *w, const char *expected)
{
    return w->length == strlen(expected) && !strncasecmp(w->word, expected, w->length);
}

bool words_whole(const words *w, uint64_t *number)
{
    const bool is_negative = w->length && *w->word == '-';
    *number = 0;
    for (size_t i = is_negative; i < w->length; i++) {
        const unsigned digit = (unsigned char)(w->word[i] - '0');
        if (digit > 9)
            return false;
        *number = *number > (UINT64_MAX - digit) / 10 ? UINT64_MAX : 10 * *number + digit;
    }
    if (is_negative && *number)
        *number = UINT64_MAX;
    return w->length > is_negative;
}

bool words_number(const words *w, double *number, float_fit *fit)
{
    float_fit own;
    if (!written_number_read(w->word, w->length, number, &own))
        return false;
    *fit = own > *fit ? own : *fit;
    return true;
}

bool words_is_cut(const words *w) { return w->at == w->end; }

uint64_t words_line(const words *w)
{
    uint64_t line = 1;
    for (const char *c = w->text; c < w->word; c++)
        line += *c == '\n' || (*c == '\r' && c[1] != '\n');
    return line;
}

int words_shown(const words *w) { return w->length < SHOWN_MAX ? (int)w->length : SHOWN_MAX; }

int words_refuse(const words *w, const char *due)
{
    if (!w->path)
        return EXIT_CODE_FAILURE;
    if (words_is_cut(w))
        return message_failure("%s: truncated: the file ends where %s should follow; write it again", w->path, due);
    if (!w->length)
        return message_failure("%s: damaged: line %" PRIu64 " ends where %s should follow", w->path, words_line(w), due);
    return message_failure("%s: damaged: line %" PRIu64 " has '%.*s' where %s should be", w->path, words_line(w), words_shown(w),
                           w->word, due);
}
