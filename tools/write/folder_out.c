/* folder_out.c - writes a folder beside its name and renames it, so that nobody finds half of it. */
#define _XOPEN_SOURCE 700
#include "folder_out.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console/interrupt.h"
#include "console/message.h"

/* `folder` up to its last slash, if it has one, and then `name`. NULL without memory. */
static char *beside(const char *folder, const char *name)
{
    size_t length = strlen(folder);
    while (length > 1 && folder[length - 1] == '/')
        length--;
    while (length && folder[length - 1] != '/')
        length--;
    char *const path = malloc(length + strlen(name) + 1);
    if (path) {
        memcpy(path, folder, length);
        strcpy(path + length, name);
    }
    return path;
}

static char *within(const char *folder, const char *name)
{
    char *const path = malloc(strlen(folder) + strlen(name) + 2);
    if (path) {
        strcpy(path, folder);
        strcat(path, "/");
        strcat(path, name);
    }
    return path;
}

static int fail(const folder_out *out, int reason)
{
    return message_failure("%s: cannot write all of it: %s; nothing was kept", out->path, strerror(reason ? reason : EIO));
}

static int make_files(folder_out *out, const char *const names[FOLDER_FILES])
{
    for (int i = 0; i < FOLDER_FILES; i++) {
        out->name[i] = within(out->beside, names[i]);
        if (!out->name[i])
            return message_failure("%s: out of memory", out->path);
        interrupt_watch(out->name[i]);
        out->file[i] = fopen(out->name[i], "wb");
        if (!out->file[i])
            return fail(out, errno);
    }
    return EXIT_CODE_OK;
}

/* mkdtemp gives its folder to the owner alone; this one gets the rights of any new folder. */
static void allow_usual(const char *folder)
{
    const mode_t mask = umask(0);
    umask(mask);
    chmod(folder, 0777 & ~mask);
}

int folder_out_open(folder_out *out, const char *path, const char *const names[FOLDER_FILES])
{
    struct stat about;
    *out = (folder_out){.path = path};
    if (!lstat(path, &about))
        return message_failure("%s: is there already; remove it, or give another name", path);
    out->beside = beside(path, ".tribox-XXXXXX");
    if (!out->beside)
        return message_failure("%s: out of memory", path);
    interrupt_hold();
    const bool is_made = mkdtemp(out->beside);
    const int reason = errno;
    if (is_made)
        interrupt_watch(out->beside);
    interrupt_release();
    if (!is_made) {
        free(out->beside);
        out->beside = NULL;
        return message_failure("%s: cannot write there: %s", path, strerror(reason));
    }
    signal(SIGXFSZ, SIG_IGN); /* beyond a limit on file sizes, writing then fails and is reported as on a full disk */
    allow_usual(out->beside);
    const int code = make_files(out, names);
    if (code)
        folder_out_drop(out);
    return code;
}

static void forget(folder_out *out)
{
    for (int i = 0; i < FOLDER_FILES; i++) {
        interrupt_forget(out->name[i]);
        free(out->name[i]);
    }
    interrupt_forget(out->beside);
    free(out->beside);
    *out = (folder_out){.path = NULL};
}

int folder_out_keep(folder_out *out)
{
    int reason = 0;
    for (int i = 0; i < FOLDER_FILES; i++) {
        errno = ferror(out->file[i]) ? errno : 0; /* that of the write that failed */
        const bool is_lost = ferror(out->file[i]) || fflush(out->file[i]);
        reason = reason || !is_lost ? reason : errno ? errno : EIO;
        if (fclose(out->file[i]) && !reason)
            reason = errno;
        out->file[i] = NULL;
    }
    if (!reason && rename(out->beside, out->path))
        reason = errno;
    const int code = reason ? fail(out, reason) : EXIT_CODE_OK;
    if (code)
        folder_out_drop(out);
    else
        forget(out);
    return code;
}

void folder_out_drop(folder_out *out)
{
    if (!out->beside)
        return;
    for (int i = 0; i < FOLDER_FILES; i++) {
        if (out->file[i])
            fclose(out->file[i]);
        if (out->name[i])
            unlink(out->name[i]);
    }
    rmdir(out->beside);
    forget(out);
}
