/* output.c - prints boxes and axes, and checks that all output was written. */
#include "output.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "written_number.h"
#include "message.h"
#include "options.h"

void output_point(const double point[3], bool is_float, const char *separator)
{
    for (int a = 0; a < 3; a++) {
        char text[DECIMAL_MAX];
        const char *const number = is_float ? decimal_of((float)point[a], text) : decimal_of_double(point[a], text);
        printf("%s%s", a ? separator : "", number);
    }
}

void output_box(const tribox_box *box, bool is_float)
{
    output_point(box->lo, is_float, ",");
    putchar(',');
    output_point(box->hi, is_float, ",");
}

/* The word of group i where `axes` has it; 0 for axes stands for all groups. */
static const char *axes_word(unsigned axes, int i)
{
    unsigned bit;
    const char *word = options_axes_word(i, &bit);
    return !axes || axes & bit ? word : NULL;
}

void output_axes(unsigned axes)
{
    const char *separator = "";
    for (int i = 0; i < OPTIONS_AXES_GROUPS; i++)
        if (axes_word(axes, i)) {
            printf("%s%s", separator, axes_word(axes, i));
            separator = ",";
        }
}

void output_json_axes(json *j, unsigned axes)
{
    json_open_array(j, "axes");
    for (int i = 0; i < OPTIONS_AXES_GROUPS; i++)
        if (axes_word(axes, i))
            json_string(j, NULL, axes_word(axes, i));
    json_close(j);
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
    enum { WIDTH = 100, INDENT = 12 };
    size_t column = 0;
    for (const char *c = text; *c; c++) {
        const bool is_full = *c == '\t' && column + 1 + strcspn(c + 1, "\t\n") > WIDTH;
        if (is_full)
            printf("\n%*s", INDENT, "");
        else
            putchar(*c == '\t' ? ' ' : *c);
        column = is_full ? INDENT : *c == '\n' ? 0 : column + 1;
    }
    return output_flush();
}
