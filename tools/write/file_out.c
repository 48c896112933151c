/* file_out.c - writes beside the name and renames, so that nobody finds half a file, or half of a folder. */
#include "file_out.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "console/interrupt.h"
#include "console/message.h"
#include "files/files.h"

bool file_out_is_stdout(const char *path) { return path && !strcmp(path, "-"); }

static bool is_file(const char *path) { return path && !file_out_is_stdout(path); }

/* Whether the file that is written over is one of this folder. */
static bool is_within(const char *path, const char *folder)
{
    char *const target = new_file_target(path);
    const size_t length = target ? named_file_folder(target) : 0;
    if (length)
        target[length] = '\0';
    const bool is_in = target && named_file_is_same(length ? target : ".", folder);
    free(target);
    return is_in;
}

static int check_name(const char *option, const char *path, const char *what, const char *read)
{
    file_about about;
    const char *const from = file_out_is_stdout(read) ? "/dev/stdin" : read;
    if (!named_file_about(from, &about))
        return EXIT_CODE_OK; /* which its reader says */
    if (about.kind == FILE_KIND_FOLDER && named_file_is_there(path) && is_within(path, from))
        return message_usage("%s: '%s' is in %s, which is read; give another name", option, path, read);
    return about.kind == FILE_KIND_REGULAR && named_file_is_same(path, from)
               ? message_usage("%s: '%s' is the %s itself; give another name", option, path, what)
               : EXIT_CODE_OK;
}

int file_out_check(const file_out_names *names, const char *what, const char *const *read, size_t count)
{
    const char *const one = names->path[0], *const other = names->path[1];
    for (int n = 0; n < FILE_OUT_NAMES; n++)
        for (size_t r = 0; r < count && is_file(names->path[n]); r++)
            if (check_name(names->option[n], names->path[n], what, read[r]))
                return EXIT_CODE_USAGE;
    return is_file(one) && is_file(other) && named_file_is_same(one, other)
               ? message_usage("%s and %s are one file, '%s'; give two names", names->option[0], names->option[1], other)
               : EXIT_CODE_OK;
}

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

static const char passing_name[] = ".tribox-XXXXXX";

/* A name for what is on its way to this one, in the same folder: one made from it could be too long. NULL without memory. */
static char *name_beside(const char *path, bool is_folder)
{
    char *const beside = malloc(strlen(path) + sizeof passing_name);
    if (beside) {
        strcpy(beside, path);
        for (size_t end = strlen(path); is_folder && end > 1 && named_file_folder(beside) == end; end--)
            beside[end - 1] = '\0'; /* separators at the end */
        strcpy(beside + named_file_folder(beside), passing_name);
    }
    return beside;
}

static char *name_within(const char *folder, const char *name)
{
    char *const path = malloc(strlen(folder) + strlen(name) + 2);
    if (path)
        sprintf(path, "%s/%s", folder, name);
    return path;
}

static FILE *open_named(char *name) { return named_file_open(name, "wb"); }

/* A signal waits until the file is watched, or has no name. NULL with errno. */
static FILE *open_held(FILE *(*open)(char *name), char *name, bool is_watched)
{
    interrupt_hold();
    FILE *const file = open(name);
    const int reason = errno;
    if (file && is_watched)
        interrupt_watch(name);
    interrupt_release();
    errno = reason;
    return file;
}

static int make_beside(file_out *out)
{
    out->beside = name_beside(out->target, false);
    if (!out->beside)
        return message_failure("%s: out of memory", out->path);
    out->stream = open_held(new_file_open, out->beside, true);
    if (!out->stream)
        return message_failure("%s: cannot write there: %s", out->path, strerror(errno));
    new_file_take_rights(out->stream, out->target);
    return EXIT_CODE_OK;
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
        code = make_beside(out);
    if (code)
        forget(out);
    return code;
}

static int fail_to_write(const char *path, int reason)
{
    return message_failure("%s: cannot write all of it: %s; nothing of it was kept", path, strerror(reason ? reason : EIO));
}

int file_out_failure(const file_out *out)
{
    return file_out_is_stdout(out->path) ? message_failure("cannot write the output: %s", strerror(errno ? errno : EIO))
                                         : fail_to_write(out->path, errno);
}

/* Writes out all that is pending and closes what is not standard output. Returns whether all of it went well; else with errno. */
static bool close_stream(FILE *stream)
{
    errno = ferror(stream) ? errno : 0; /* that of the write that failed */
    const bool is_lost = ferror(stream) || fflush(stream);
    const int reason = errno;
    const bool is_closed = stream == stdout || !fclose(stream);
    if (is_lost)
        errno = reason;
    return !is_lost && is_closed;
}

/* On failure nothing is left. */
static int complete(file_out *out)
{
    if (!out->stream)
        return EXIT_CODE_OK;
    const bool is_whole = close_stream(out->stream);
    out->stream = NULL;
    const int code = is_whole ? EXIT_CODE_OK : file_out_failure(out);
    if (code)
        file_out_drop(out);
    return code;
}

/* What has been completed. */
static bool give_name(const file_out *out) { return !out->beside || new_file_rename(out->beside, out->target); }

int file_out_keep(file_out *out)
{
    int code = complete(out);
    if (!code && !give_name(out))
        code = file_out_failure(out);
    file_out_drop(out); /* what has its name is no longer beside it */
    return code;
}

/* Gives what has the name of `out` another. False with errno. */
static bool set_aside(const file_out *out, char *aside)
{
    FILE *const place = new_file_open(aside);
    if (!place)
        return false;
    fclose(place);
    if (new_file_rename(out->target, aside))
        return true;
    const int reason = errno;
    new_file_remove(aside);
    errno = reason;
    return false;
}

/* aside: a name for what has that of `one`; NULL where nothing has it. */
static int name_both(const file_out *one, const file_out *other, char *aside)
{
    if (aside && !set_aside(one, aside))
        return file_out_failure(one);
    const bool is_named = give_name(one);
    if (is_named && give_name(other)) {
        if (aside)
            new_file_remove(aside);
        return EXIT_CODE_OK;
    }
    const int code = file_out_failure(is_named ? other : one);
    if (aside)
        new_file_rename(aside, one->target);
    else if (is_named)
        new_file_remove(one->target);
    return code;
}

int file_out_keep_both(file_out *one, file_out *other)
{
    int code = complete(one);
    if (!code)
        code = complete(other);
    const bool is_over = one->beside && other->beside && named_file_is_there(one->target);
    char *const aside = !code && is_over ? name_beside(one->target, false) : NULL;
    if (!code && is_over && !aside)
        code = message_failure("%s: out of memory", one->path);
    if (!code)
        code = name_both(one, other, aside);
    free(aside);
    file_out_drop(one); /* what has its name is no longer beside it */
    file_out_drop(other);
    return code;
}

void file_out_drop(file_out *out)
{
    if (out->stream && out->stream != stdout)
        fclose(out->stream);
    if (out->beside)
        new_file_remove(out->beside);
    forget(out);
}

/* Takes the name, and NULL as one for which there was no memory. NULL with errno. */
static FILE *open_nameless(char *name)
{
    errno = ENOMEM;
    FILE *const file = name ? open_held(new_file_open_nameless, name, false) : NULL;
    const int reason = errno;
    free(name);
    errno = reason;
    return file;
}

enum { SPOOL_CHUNK = 1 << 16 };

FILE *spool_open(const file_out *out)
{
    char *const folder = out->target ? NULL : new_file_passing_folder();
    FILE *const spool = open_nameless(folder        ? name_within(folder, passing_name)
                                      : out->target ? name_beside(out->target, false)
                                                    : NULL);
    if (spool)
        setvbuf(spool, NULL, _IOFBF, SPOOL_CHUNK);
    else
        message_failure("%s: cannot write there: %s", folder ? folder : out->path, strerror(errno));
    free(folder);
    return spool;
}

int spool_read(FILE *spool, const file_out *out, bool (*take)(void *data, const void *bytes, size_t count), void *data)
{
    unsigned char chunk[SPOOL_CHUNK];
    size_t length;
    bool is_taken = !ferror(spool) && !fflush(spool) && !fseek(spool, 0, SEEK_SET);
    while (is_taken && (length = fread(chunk, 1, sizeof chunk, spool)) > 0)
        is_taken = take(data, chunk, length);
    return !is_taken || ferror(spool) ? file_out_failure(out) : EXIT_CODE_OK;
}

int folder_out_failure(const folder_out *out, int reason) { return fail_to_write(out->told, reason); }

static int make_files(folder_out *out, const char *const names[FOLDER_FILES])
{
    for (int i = 0; i < FOLDER_FILES && names[i]; i++) {
        out->name[i] = name_within(out->beside, names[i]);
        if (!out->name[i])
            return message_failure("%s: out of memory", out->told);
        out->file[i] = open_held(open_named, out->name[i], true);
        if (!out->file[i])
            return folder_out_failure(out, errno);
    }
    return EXIT_CODE_OK;
}

FILE *folder_out_spill(const folder_out *out) { return open_nameless(name_within(out->beside, "runs-XXXXXX")); }

int folder_out_open(folder_out *out, const char *path, const char *told, const char *const names[FOLDER_FILES])
{
    *out = (folder_out){.path = path, .told = told ? told : path};
    if (!told && named_file_is_there(path))
        return message_failure("%s: is there already; remove it, or give another name", path);
    out->beside = name_beside(path, true);
    if (!out->beside)
        return message_failure("%s: out of memory", out->told);
    interrupt_hold();
    const bool is_made = new_file_make_folder(out->beside);
    const int reason = errno;
    if (is_made)
        interrupt_watch(out->beside);
    interrupt_release();
    if (!is_made) {
        free(out->beside);
        out->beside = NULL;
        return message_failure("%s: cannot write there: %s", out->told, strerror(reason));
    }
    new_file_fail_quietly(false);
    const int code = make_files(out, names);
    if (code)
        folder_out_drop(out);
    return code;
}

static void forget_folder(folder_out *out)
{
    for (int i = 0; i < FOLDER_FILES && out->name[i]; i++) {
        interrupt_forget(out->name[i]);
        free(out->name[i]);
    }
    interrupt_forget(out->beside);
    free(out->beside);
    *out = (folder_out){.path = NULL};
}

/* Returns an errno, or 0. */
static int close_files(folder_out *out)
{
    int reason = 0;
    for (int i = 0; i < FOLDER_FILES && out->file[i]; i++) {
        if (!close_stream(out->file[i]) && !reason)
            reason = errno ? errno : EIO;
        out->file[i] = NULL;
    }
    return reason;
}

int folder_out_finish(folder_out *out)
{
    const int reason = close_files(out);
    return reason ? folder_out_failure(out, reason) : EXIT_CODE_OK;
}

int folder_out_keep(folder_out *out)
{
    int reason = close_files(out);
    if (!reason && !new_file_rename_folder(out->beside, out->path))
        reason = errno;
    const int code = reason ? folder_out_failure(out, reason) : EXIT_CODE_OK;
    if (code)
        folder_out_drop(out);
    else
        forget_folder(out);
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
    forget_folder(out);
}
