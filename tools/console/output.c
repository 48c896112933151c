/* output.c - prints boxes and axes, and checks that all output was written. */
#include "output.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "accuracy.h"
#include "message.h"
#include "options.h"
#include "written_number.h"

void output_point(const double point[3], bool is_float, const char *separator)
{
    for (int a = 0; a < 3; a++) {
        char text[DECIMAL_MAX];
        printf("%s%s", a ? separator : "", decimal_of(point[a], is_float, text));
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

void output_test(const tribox_options *test)
{
    const char *separator = "";
    printf("test         %s, axes ", accuracy_word(test->accuracy));
    for (int i = 0; i < OPTIONS_AXES_GROUPS; i++)
        if (axes_word(test->axes, i)) {
            printf("%s%s", separator, axes_word(test->axes, i));
            separator = ",";
        }
    printf(", kernel %s", tribox_kernel_name(test));
}

void output_json_test(json *j, const tribox_options *test)
{
    json_string(j, "accuracy", accuracy_word(test->accuracy));
    json_open_array(j, "axes");
    for (int i = 0; i < OPTIONS_AXES_GROUPS; i++)
        if (axes_word(test->axes, i))
            json_string(j, NULL, axes_word(test->axes, i));
    json_close(j);
    json_string(j, "kernel", tribox_kernel_name(test));
}

void output_shift(const double shift[3])
{
    printf("shift        ");
    output_point(shift, false, ",");
    putchar('\n');
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
