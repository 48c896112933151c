/* new_file_posix.c - new files as POSIX has them. */
#define _XOPEN_SOURCE 700
#include "new_file.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static mode_t usual_rights(mode_t all)
{
    const mode_t mask = umask(0);
    umask(mask);
    return all & ~mask;
}

/* Closes and removes what cannot become a stream. */
static FILE *stream_of(int file, const char *mode, const char *name)
{
    FILE *const stream = fdopen(file, mode);
    const int reason = errno;
    if (!stream) {
        unlink(name);
        close(file);
        errno = reason;
    }
    return stream;
}

FILE *new_file_open(char *name)
{
    const int file = mkstemp(name);
    if (file < 0)
        return NULL;
    fchmod(file, usual_rights(0666)); /* mkstemp gives its file to the owner alone */
    return stream_of(file, "wb", name);
}

FILE *new_file_open_nameless(char *name)
{
    const int file = mkstemp(name);
    if (file < 0)
        return NULL;
    unlink(name);
    return stream_of(file, "w+b", name);
}

bool new_file_make_folder(char *name)
{
    if (!mkdtemp(name))
        return false;
    chmod(name, usual_rights(0777)); /* mkdtemp gives its folder to the owner alone */
    return true;
}

bool new_file_rename(const char *from, const char *to) { return !rename(from, to); }

bool new_file_rename_folder(const char *from, const char *to) { return !rename(from, to); }

void new_file_remove(const char *name) { unlink(name); }

void new_file_remove_folder(const char *name) { rmdir(name); }

char *new_file_target(const char *path)
{
    struct stat about;
    const bool is_link = !lstat(path, &about) && S_ISLNK(about.st_mode);
    return is_link ? realpath(path, NULL) : strdup(path);
}

char *new_file_passing_folder(void)
{
    const char *const chosen = getenv("TMPDIR");
    return strdup(chosen && *chosen ? chosen : "/tmp");
}

void new_file_fail_quietly(bool is_stdout)
{
    signal(SIGXFSZ, SIG_IGN);
    if (is_stdout)
        signal(SIGPIPE, SIG_IGN);
}
