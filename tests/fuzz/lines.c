#include "lines.h"

#include <stdarg.h>
#include <stdio.h>

#include "ensure.h"
#include "console/message.h"

static int said, failed;

static void format_line(const char *format, va_list values)
{
    char line[4096];
    ensure(vsnprintf(line, sizeof line, format, values) > 0, "the line '%s' cannot be formatted", format);
}

void message_set_command(const char *command) { (void)command; }

void message_say(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    format_line(format, values);
    va_end(values);
    said++;
}

int message_failure(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    format_line(format, values);
    va_end(values);
    failed++;
    return EXIT_CODE_FAILURE;
}

int message_usage(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    format_line(format, values);
    va_end(values);
    failed++;
    return EXIT_CODE_USAGE;
}

void message_line(char *text, size_t size, const char *before, const char *what)
{
    ensure(snprintf(text, size, "%s%s", before, what) > 0, "the line '%s' cannot be formatted", what);
}

void lines_forget(void) { said = failed = 0; }

void lines_fit(const char *call, int code)
{
    ensure(code >= EXIT_CODE_OK && code <= EXIT_CODE_USAGE, "%s returns %d, which is not an exit code", call, code);
    ensure(code ? said + failed >= 1 && failed <= 1 : !failed, "%s returns %d after %d failures and %d other lines", call, code,
           failed, said);
}
