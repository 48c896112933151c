/* message.c - messages of the program, each one line on standard error after the names of program and command. */
#include "message.h"

#include <stdarg.h>
#include <stdio.h>

static const char *program_name = "tribox", *command_name;

void message_set_program(const char *program) { program_name = program; }

void message_set_command(const char *command) { command_name = command; }

static void print_program(FILE *file)
{
    fprintf(file, "%s%s%s", program_name, command_name ? " " : "", command_name ? command_name : "");
}

#if defined(__GNUC__)
__attribute__((nonnull)) /* or gcc, with sanitizers, warns that the format may be NULL */
#endif
static void
print_line(const char *format, va_list values, const char *end)
{
    print_program(stderr);
    fputs(": ", stderr);
    vfprintf(stderr, format, values);
    fputs(end, stderr);
    fflush(stderr);
}

void message_say(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    print_line(format, values, "\n");
    va_end(values);
}

int message_failure(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    print_line(format, values, "\n");
    va_end(values);
    return EXIT_CODE_FAILURE;
}

void message_line(char *text, size_t size, const char *before, const char *what)
{
    snprintf(text, size, "%s%s%s: %s%s\n", program_name, command_name ? " " : "", command_name ? command_name : "", before, what);
}

int message_usage(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    print_line(format, values, "; see '");
    va_end(values);
    print_program(stderr);
    fputs(" --help'\n", stderr);
    fflush(stderr);
    return EXIT_CODE_USAGE;
}
