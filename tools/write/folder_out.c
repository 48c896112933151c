/* folder_out.c - writes a folder beside its name and renames it, so that nobody finds half of it. */
#include "folder_out.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "console/interrupt.h"
#include "console/message.h"
#include "files/named_file.h"
#include "files/new_file.h"

/* The folder in which `folder` is, and then `name`. NULL without memory. */
static char *beside(const char *folder, const char *name)
{
    char *const path = malloc(strlen(folder) + strlen(name) + 1);
    if (path) {
        strcpy(path, folder);
        for (size_t end = strlen(path); end > 1 && named_file_folder(path) == end; end--)
            path[end - 1] = '\0'; /* separators at the end */
        strcpy(path + named_file_folder(path), name);
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

int folder_out_failure(const folder_out *out, int reason)
{
    return message_failure("%s: cannot write all of it: %s; nothing of it was kept", out->path, strerror(reason ? reason : EIO));
}

static int make_files(folder_out *out, const char *const names[FOLDER_FILES])
{
    for (int i = 0; i < FOLDER_FILES && names[i]; i++) {
        out->name[i] = within(out->beside, names[i]);
        if (!out->name[i])
            return message_failure("%s: out of memory", out->path);
        interrupt_hold();
        interrupt_watch(out->name[i]);
        out->file[i] = named_file_open(out->name[i], "wb");
        const int reason = errno;
        interrupt_release();
        if (!out->file[i])
            return folder_out_failure(out, reason);
    }
    return EXIT_CODE_OK;
}

FILE *folder_out_spill(const folder_out *out)
{
    char *const name = within(out->beside, "runs-XXXXXX");
    if (!name) {
        errno = ENOMEM;
        return NULL;
    }
    interrupt_hold(); /* until it has no name */
    FILE *const spill = new_file_open_nameless(name);
    const int reason = errno;
    interrupt_release();
    free(name);
    errno = reason;
    return spill;
}

int folder_out_open(folder_out *out, const char *path, const char *const names[FOLDER_FILES])
{
    *out = (folder_out){.path = path};
    if (named_file_is_there(path))
        return message_failure("%s: is there already; remove it, or give another name", path);
    out->beside = beside(path, ".tribox-XXXXXX");
    if (!out->beside)
        return message_failure("%s: out of memory", path);
    interrupt_hold();
    const bool is_made = new_file_make_folder(out->beside);
    const int reason = errno;
    if (is_made)
        interrupt_watch(out->beside);
    interrupt_release();
    if (!is_made) {
        free(out->beside);
        out->beside = NULL;
        return message_failure("%s: cannot write there: %s", path, strerror(reason));
    }
    new_file_fail_quietly(false);
    const int code = make_files(out, names);
    if (code)
        folder_out_drop(out);
    return code;
}

static void forget(folder_out *out)
{
    for (int i = 0; i < FOLDER_FILES && out->name[i]; i++) {
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
    for (int i = 0; i < FOLDER_FILES && out->file[i]; i++) {
        errno = ferror(out->file[i]) ? errno : 0; /* that of the write that failed */
        const bool is_lost = ferror(out->file[i]) || fflush(out->file[i]);
        reason = reason || !is_lost ? reason : errno ? errno : EIO;
        if (fclose(out->file[i]) && !reason)
            reason = errno;
        out->file[i] = NULL;
    }
    if (!reason && !new_file_rename_folder(out->beside, out->path))
        reason = errno;
    const int code = reason ? folder_out_failure(out, reason) : EXIT_CODE_OK;
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
            new_file_remove(out->name[i]);
    }
    new_file_remove_folder(out->beside);
    forget(out);
}
