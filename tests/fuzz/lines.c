#define _POSIX_C_SOURCE 200809L
#include "lines.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

enum { FILES_MAX = 8 };
static char folder[64], paths[FILES_MAX][80];

static void remove_files(void)
{
    for (int i = 0; i < FILES_MAX && paths[i][0]; i++)
        remove(paths[i]);
    rmdir(folder);
}

const char *lines_folder(void)
{
    const char *const parent = getenv("TMPDIR");
    if (!folder[0]) {
        snprintf(folder, sizeof folder, "%.40s/fuzz_XXXXXX", parent ? parent : "/tmp");
        ensure(mkdtemp(folder), "cannot make the folder %s", folder);
        atexit(remove_files);
    }
    return folder;
}

const char *lines_file(const char *name, const void *bytes, size_t size)
{
    char path[80];
    int i = 0;
    snprintf(path, sizeof path, "%.60s/%.15s", lines_folder(), name);
    while (i < FILES_MAX && paths[i][0] && strcmp(paths[i], path) != 0)
        i++;
    ensure(i < FILES_MAX, "more than %d files", FILES_MAX);
    memcpy(paths[i], path, sizeof path);
    FILE *const file = fopen(path, "wb");
    ensure(file && fwrite(bytes, 1, size, file) == size && !fclose(file), "cannot write %s", path);
    return paths[i];
}
