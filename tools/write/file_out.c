/* file_out.c - writes beside the name and renames, so that nobody finds a part of a file. */
#define _POSIX_C_SOURCE 200809L
#include "file_out.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console/message.h"

/* What a signal has to remove. */
enum { OPEN_MOST = 4 };
static char *volatile open_files[OPEN_MOST];

static void remove_and_end(int signal_number)
{
    for (int i = 0; i < OPEN_MOST; i++)
        if (open_files[i])
            unlink(open_files[i]);
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
enum { SIGNALS = sizeof signals / sizeof signals[0] };

static void watch_signals(void)
{
    signal(SIGXFSZ, SIG_IGN); /* beyond the limit of a file's size write() then fails, and says so */
    for (int i = 0; i < SIGNALS; i++) {
        struct sigaction action;
        if (sigaction(signals[i], NULL, &action) || action.sa_handler != SIG_DFL)
            continue; /* nohup, or set before */
        action = (struct sigaction){.sa_handler = remove_and_end};
        sigaction(signals[i], &action, NULL);
    }
}

static void remember(char *was, char *is)
{
    for (int i = 0; i < OPEN_MOST; i++)
        if (open_files[i] == was) {
            open_files[i] = is;
            return;
        }
}

static void forget(file_out *out)
{
    remember(out->beside, NULL);
    free(out->beside);
    *out = (file_out){.stream = NULL};
}

/* Makes the file and remembers it, with no signal in between. Returns what mkstemp returns. */
static int make_file(char *beside)
{
    sigset_t held, before;
    sigemptyset(&held);
    for (int i = 0; i < SIGNALS; i++)
        sigaddset(&held, signals[i]);
    watch_signals();
    sigprocmask(SIG_BLOCK, &held, &before);
    const int file = mkstemp(beside);
    const int reason = errno;
    if (file >= 0)
        remember(NULL, beside);
    sigprocmask(SIG_SETMASK, &before, NULL);
    errno = reason;
    return file;
}

/* The rights that a new file gets, as mkstemp gives its own. */
static mode_t usual_mode(void)
{
    const mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

static int refuse_place(const char *path)
{
    struct stat about;
    if (stat(path, &about) || S_ISREG(about.st_mode))
        return EXIT_CODE_OK;
    return message_failure("%s: is %s; give the name of a file", path, S_ISDIR(about.st_mode) ? "a directory" : "no regular file");
}

int file_out_open(file_out *out, const char *path)
{
    static const char ending[] = ".XXXXXX";
    *out = (file_out){.path = path};
    if (!path)
        return EXIT_CODE_OK;
    int code = refuse_place(path);
    if (code)
        return code;
    const size_t length = strlen(path);
    out->beside = malloc(length + sizeof ending);
    if (!out->beside)
        return message_failure("%s: out of memory", path);
    memcpy(out->beside, path, length);
    memcpy(out->beside + length, ending, sizeof ending);
    const int file = make_file(out->beside);
    out->stream = file < 0 || fchmod(file, usual_mode()) ? NULL : fdopen(file, "wb");
    if (out->stream)
        return EXIT_CODE_OK;
    code = message_failure("%s: cannot write there: %s", path, strerror(errno));
    if (file >= 0) {
        unlink(out->beside);
        close(file);
    }
    forget(out);
    return code;
}

int file_out_keep(file_out *out)
{
    if (!out->beside)
        return EXIT_CODE_OK;
    const char *path = out->path;
    errno = ferror(out->stream) ? errno : 0;
    const int is_lost = ferror(out->stream) | fflush(out->stream);
    const int reason = errno;
    if (!fclose(out->stream) && !is_lost && !rename(out->beside, path)) {
        forget(out);
        return EXIT_CODE_OK;
    }
    const int code = message_failure("%s: cannot write all of it: %s; nothing is left of it", path,
                                     strerror(is_lost && reason ? reason
                                              : errno           ? errno
                                                                : EIO));
    unlink(out->beside);
    forget(out);
    return code;
}

void file_out_drop(file_out *out)
{
    if (!out->beside)
        return;
    fclose(out->stream);
    unlink(out->beside);
    forget(out);
}
