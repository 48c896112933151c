/* json.c - keeps, for each object and array that is open, how it ends and whether a comma is due. */
#include "json.h"

#include <assert.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "written_number.h"

json json_to(FILE *to) { return (json){.to = to}; }

/* How many bytes the UTF-8 character at text takes; 0 if there is none: a stray byte, a cut or overlong form, a surrogate. */
static int utf8_length(const unsigned char *text)
{
    static const unsigned long least[] = {0, 0, 0x80, 0x800, 0x10000};
    const int length = text[0] < 0x80 ? 1 : text[0] >> 5 == 6 ? 2 : text[0] >> 4 == 14 ? 3 : text[0] >> 3 == 30 ? 4 : 0;
    unsigned long code = length < 2 ? text[0] : text[0] & (0x7Fu >> length);
    for (int i = 1; i < length; i++) {
        if (text[i] >> 6 != 2)
            return 0;
        code = code << 6 | (text[i] & 0x3Fu);
    }
    return code < least[length] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000) ? 0 : length;
}

static void put_string(FILE *to, const char *text)
{
    putc('"', to);
    for (const unsigned char *at = (const unsigned char *)text; *at;) {
        const int length = utf8_length(at);
        if (!length)
            fprintf(to, "\\udc%02x", (unsigned)*at);
        else if (*at < 0x20)
            fprintf(to, "\\u%04x", (unsigned)*at);
        else
            fprintf(to, "%s%.*s", *at == '"' || *at == '\\' ? "\\" : "", length, (const char *)at);
        at += length ? length : 1;
    }
    putc('"', to);
}

static void start_line(const json *j) { fprintf(j->to, "\n%*s", j->depth, ""); }

/* What comes before a value: a comma, a new line, its key. */
static void start(json *j, const char *key)
{
    const bool is_rows = j->level[j->depth].is_rows;
    if (j->level[j->depth].is_filled)
        fputs(is_rows ? "," : ", ", j->to);
    if (is_rows)
        start_line(j);
    j->level[j->depth].is_filled = true;
    if (key) {
        put_string(j->to, key);
        fputs(": ", j->to);
    }
}

static void open_level(json *j, const char *key, const char brackets[2], bool is_rows)
{
    start(j, key);
    putc(brackets[0], j->to);
    assert(j->depth < JSON_DEPTH_MAX);
    j->depth++;
    j->level[j->depth].end = brackets[1];
    j->level[j->depth].is_filled = false;
    j->level[j->depth].is_rows = is_rows;
}

void json_open_object(json *j, const char *key) { open_level(j, key, "{}", false); }
void json_open_array(json *j, const char *key) { open_level(j, key, "[]", false); }
void json_open_rows(json *j, const char *key) { open_level(j, key, "[]", true); }

void json_close(json *j)
{
    const bool is_broken = j->level[j->depth].is_rows && j->level[j->depth].is_filled;
    const char end = j->level[j->depth].end;
    j->depth--;
    if (is_broken)
        start_line(j);
    putc(end, j->to);
    if (!j->depth) {
        putc('\n', j->to);
        j->level[0].is_filled = false;
    }
}

static void put_literal(json *j, const char *key, const char *text)
{
    start(j, key);
    fputs(text, j->to);
}

void json_bool(json *j, const char *key, bool value) { put_literal(j, key, value ? "true" : "false"); }

void json_string(json *j, const char *key, const char *value)
{
    start(j, key);
    if (value)
        put_string(j->to, value);
    else
        fputs("null", j->to);
}

void json_whole(json *j, const char *key, uint64_t value)
{
    start(j, key);
    fprintf(j->to, "%" PRIu64, value);
}

void json_number(json *j, const char *key, int digits, double value)
{
    start(j, key);
    if (isfinite(value))
        fprintf(j->to, "%.*g", digits, value);
    else
        fputs("null", j->to);
}

void json_doubles(json *j, const char *key, const double *values, size_t count, bool is_float)
{
    char text[DECIMAL_MAX];
    json_open_array(j, key);
    for (size_t i = 0; i < count; i++)
        put_literal(j, NULL, decimal_of(values[i], is_float, text));
    json_close(j);
}

void json_wholes(json *j, const char *key, const size_t *values, size_t count)
{
    json_open_array(j, key);
    for (size_t i = 0; i < count; i++)
        json_whole(j, NULL, values[i]);
    json_close(j);
}
