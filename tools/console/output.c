/* output.c - prints numbers and strings so that programs can read them back. */
#include "output.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "message.h"
#include "options.h"

void output_float(float number)
{
    char text[32];
    int digits = 1;
    do
        snprintf(text, sizeof text, "%.*g", digits, (double)number);
    while (strtof(text, NULL) != number && ++digits <= 9);
    fputs(text, stdout);
}

void output_point(const float point[3], const char *separator)
{
    for (int a = 0; a < 3; a++) {
        fputs(a ? separator : "", stdout);
        output_float(point[a]);
    }
}

void output_box(const tribox_box *box)
{
    output_point(box->lo, ",");
    putchar(',');
    output_point(box->hi, ",");
}

void output_json_box(const tribox_box *box)
{
    fputs("{\"lo\": [", stdout);
    output_point(box->lo, ", ");
    fputs("], \"hi\": [", stdout);
    output_point(box->hi, ", ");
    fputs("]}", stdout);
}

/* How many bytes the UTF-8 character at text takes; 0 if there is none: a stray byte, a cut or an overlong form, a surrogate. */
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

void output_json_string(const char *text)
{
    putchar('"');
    for (const unsigned char *at = (const unsigned char *)text; *at;) {
        const int length = utf8_length(at);
        if (!length)
            fputs("\\ufffd", stdout);
        else if (*at < 0x20)
            printf("\\u%04x", (unsigned)*at);
        else
            printf("%s%.*s", *at == '"' || *at == '\\' ? "\\" : "", length, (const char *)at);
        at += length ? length : 1;
    }
    putchar('"');
}

void output_axes(unsigned axes, const char *quote, const char *between)
{
    const char *separator = "";
    for (int i = 0; i < OPTIONS_AXES_GROUPS; i++) {
        unsigned bit;
        const char *word = options_axes_word(i, &bit);
        if (axes && !(axes & bit))
            continue;
        printf("%s%s%s%s", separator, quote, word, quote);
        separator = between;
    }
}

int output_flush(void)
{
    errno = 0;
    if (!fflush(stdout) && !ferror(stdout))
        return EXIT_CODE_OK;
    return message_failure("cannot write the output: %s", errno ? strerror(errno) : "standard output refused it");
}

int output_text(const char *text)
{
    fputs(text, stdout);
    return output_flush();
}
