/* file_out.c - writes beside the name and renames, so that nobody finds half a file. */
#define _XOPEN_SOURCE 700
#include "file_out.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console/interrupt.h"
#include "console/message.h"

bool file_out_is_stdout(const char *path) { return !strcmp(path, "-"); }

/* Replaces a link by what it leads to, so that the link stays and the file behind it is the one that is written. */
static int find_target(file_out *out)
{
    struct stat about;
    const bool is_link = !lstat(out->path, &about) && S_ISLNK(about.st_mode);
    out->target = is_link ? realpath(out->path, NULL) : strdup(out->path);
    if (!out->target)
        return message_failure("%s: cannot follow this link: %s", out->path, strerror(errno));
    if (stat(out->target, &about) || S_ISREG(about.st_mode))
        return EXIT_CODE_OK;
    return message_failure("%s: %s; give the name of a file", out->path,
                           S_ISDIR(about.st_mode) ? "is a directory" : "is not a regular file");
}

/* A name of its own in the target's folder: one made from the target's name could be too long. */
static int name_beside(file_out *out)
{
    static const char name[] = ".tribox-XXXXXX";
    const char *slash = strrchr(out->target, '/');
    const size_t folder = slash ? (size_t)(slash - out->target) + 1 : 0;
    out->beside = malloc(folder + sizeof name);
    if (!out->beside)
        return message_failure("%s: out of memory", out->path);
    memcpy(out->beside, out->target, folder);
    memcpy(out->beside + folder, name, sizeof name);
    return EXIT_CODE_OK;
}

/* mkstemp gives its file to the owner alone; this one gets the rights of any new file. */
static void allow_usual(int file)
{
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(file, 0666 & ~mask);
}

static int make_beside(file_out *out)
{
    interrupt_hold();
    const int file = mkstemp(out->beside);
    if (file >= 0)
        interrupt_watch(out->beside);
    interrupt_release();
    if (file < 0)
        return message_failure("%s: cannot write there: %s", out->path, strerror(errno));
    allow_usual(file);
    out->stream = fdopen(file, "wb");
    if (out->stream)
        return EXIT_CODE_OK;
    unlink(out->beside);
    close(file);
    return message_failure("%s: cannot write there: %s", out->path, strerror(errno));
}

static void forget(file_out *out)
{
    interrupt_forget(out->beside);
    free(out->target);
    free(out->beside);
    *out = (file_out){.stream = NULL};
}

int file_out_open(file_out *out, const char *path)
{
    *out = (file_out){.path = path};
    if (!path)
        return EXIT_CODE_OK;
    signal(SIGXFSZ, SIG_IGN); /* beyond a limit on file sizes, writing then fails and is reported as on a full disk */
    if (file_out_is_stdout(path)) {
        signal(SIGPIPE, SIG_IGN); /* the same where nobody reads on */
        out->stream = stdout;
        return EXIT_CODE_OK;
    }
    int code = find_target(out);
    if (!code)
        code = name_beside(out);
    if (!code)
        code = make_beside(out);
    if (code)
        forget(out);
    return code;
}

static int fail(const file_out *out, int reason)
{
    const char *const why = strerror(reason ? reason : EIO);
    if (file_out_is_stdout(out->path))
        return message_failure("cannot write the output: %s", why);
    return message_failure("%s: cannot write all of it: %s; nothing was kept", out->path, why);
}

int file_out_failure(const file_out *out) { return fail(out, errno); }

int file_out_keep(file_out *out)
{
    if (!out->stream)
        return EXIT_CODE_OK;
    errno = ferror(out->stream) ? errno : 0; /* that of the write that failed */
    const bool is_lost = ferror(out->stream) || fflush(out->stream);
    int reason = is_lost ? errno : 0;
    if (out->stream == stdout) {
        const int code = is_lost ? fail(out, reason) : EXIT_CODE_OK;
        forget(out);
        return code;
    }
    if ((fclose(out->stream) || (!is_lost && rename(out->beside, out->target))) && !reason)
        reason = errno;
    int code = EXIT_CODE_OK;
    if (is_lost || reason) {
        unlink(out->beside);
        code = fail(out, reason);
    }
    forget(out);
    return code;
}

void file_out_drop(file_out *out)
{
    if (!out->stream)
        return;
    if (out->stream != stdout) {
        fclose(out->stream);
        unlink(out->beside);
    }
    forget(out);
}
