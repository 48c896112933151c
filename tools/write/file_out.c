/* file_out.c - writes beside the name and renames, so that nobody finds half a file. */
#include "file_out.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "console/interrupt.h"
#include "console/message.h"
#include "files/named_file.h"
#include "files/new_file.h"

bool file_out_is_stdout(const char *path) { return !strcmp(path, "-"); }

static int find_target(file_out *out)
{
    file_about about;
    out->target = new_file_target(out->path);
    if (!out->target)
        return message_failure("%s: cannot follow this link: %s", out->path, strerror(errno));
    if (!named_file_about(out->target, &about) || about.kind == FILE_KIND_REGULAR)
        return EXIT_CODE_OK;
    return message_failure("%s: %s; give the name of a file", out->path,
                           about.kind == FILE_KIND_FOLDER ? "is a directory" : "is not a regular file");
}

/* A name of its own in the target's folder: one made from the target's name could be too long. */
static int name_beside(file_out *out)
{
    static const char name[] = ".tribox-XXXXXX";
    const size_t folder = named_file_folder(out->target);
    out->beside = malloc(folder + sizeof name);
    if (!out->beside)
        return message_failure("%s: out of memory", out->path);
    memcpy(out->beside, out->target, folder);
    memcpy(out->beside + folder, name, sizeof name);
    return EXIT_CODE_OK;
}

static int make_beside(file_out *out)
{
    interrupt_hold();
    out->stream = new_file_open(out->beside);
    const int reason = errno;
    if (out->stream)
        interrupt_watch(out->beside);
    interrupt_release();
    return out->stream ? EXIT_CODE_OK : message_failure("%s: cannot write there: %s", out->path, strerror(reason));
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
    new_file_fail_quietly(file_out_is_stdout(path));
    if (file_out_is_stdout(path)) {
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
    return message_failure("%s: cannot write all of it: %s; nothing of it was kept", out->path, why);
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
    if ((fclose(out->stream) || (!is_lost && !new_file_rename(out->beside, out->target))) && !reason)
        reason = errno;
    int code = EXIT_CODE_OK;
    if (is_lost || reason) {
        new_file_remove(out->beside);
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
        new_file_remove(out->beside);
    }
    forget(out);
}
