/* message.h - messages of the program, one line each on standard error, and its exit codes. */
#ifndef MESSAGE_H
#define MESSAGE_H

#include <stddef.h>

#include "tribox.h"

#if defined(__MINGW32__) /* whose printf may be that of Windows, which does not know %zu */
#include <stdio.h>
#define MESSAGE_FORMAT __attribute__((format(__MINGW_PRINTF_FORMAT, 1, 2)))
#elif defined(__GNUC__)
#define MESSAGE_FORMAT __attribute__((format(printf, 1, 2)))
#else
#define MESSAGE_FORMAT
#endif

/* What the program returns to its caller; part of its documented interface. */
enum exit_code {
    EXIT_CODE_OK = 0,
    EXIT_CODE_FAILURE = 1, /* a file, memory or the output failed */
    EXIT_CODE_USAGE = 2    /* the command line itself is wrong */
};

/* Names the program, "tribox" by default. */
void message_set_program(const char *program);

/* Names the running command in every later message; NULL for the program itself. */
void message_set_command(const char *command);

/* A warning or a note, which leaves the exit code as it is. */
MESSAGE_FORMAT void message_say(const char *format, ...);

/* The line of a failure. Returns EXIT_CODE_FAILURE. */
MESSAGE_FORMAT int message_failure(const char *format, ...);

/* What the program says beside the statuses of the library, which allocates nothing: that there is no memory. */
#define MESSAGE_NO_MEMORY ((tribox_status)(TRIBOX_STOPPED + 1))

/* The line of a status, and EXIT_CODE_FAILURE; or EXIT_CODE_OK of TRIBOX_OK. */
int message_status(tribox_status status);

/* Writes such a line, with its line feed, into `text`, for a moment at which nothing can be formatted. */
void message_line(char *text, size_t size, const char *before, const char *what);

/* The line for a wrong command line, which ends with where to find help. Returns EXIT_CODE_USAGE. */
MESSAGE_FORMAT int message_usage(const char *format, ...);

#endif
