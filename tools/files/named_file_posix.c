/* named_file_posix.c - files by their names, as POSIX has them. */
#define _POSIX_C_SOURCE 200809L
#include "named_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

FILE *named_file_open(const char *path, const char *mode) { return fopen(path, mode); }

static void tell(const struct stat *found, file_about *about)
{
#ifdef __APPLE__
    const long fraction = found->st_mtimespec.tv_nsec;
#else
    const long fraction = found->st_mtim.tv_nsec;
#endif
    about->changed = (uint64_t)found->st_mtime * 1000000000 + (uint64_t)fraction;
    about->kind = S_ISREG(found->st_mode) ? FILE_KIND_REGULAR : S_ISDIR(found->st_mode) ? FILE_KIND_FOLDER : FILE_KIND_OTHER;
    about->size = about->kind == FILE_KIND_REGULAR ? (uint64_t)found->st_size : 0;
}

bool named_file_about(const char *path, file_about *about)
{
    struct stat found;
    if (stat(path, &found))
        return false;
    tell(&found, about);
    return true;
}

bool named_file_about_open(FILE *stream, file_about *about)
{
    struct stat found;
    if (fstat(fileno(stream), &found))
        return false;
    tell(&found, about);
    return true;
}

bool named_file_read_at(FILE *stream, uint64_t offset, void *to, size_t bytes, size_t *got)
{
    for (*got = 0; *got < bytes;) {
        const ssize_t now = pread(fileno(stream), (char *)to + *got, bytes - *got, (off_t)(offset + *got));
        if (now < 0 && errno == EINTR)
            continue;
        if (now <= 0)
            return !now;
        *got += (size_t)now;
    }
    return true;
}

bool named_file_write_at(FILE *stream, uint64_t offset, const void *from, size_t bytes)
{
    for (size_t done = 0; done < bytes;) {
        const ssize_t now = pwrite(fileno(stream), (const char *)from + done, bytes - done, (off_t)(offset + done));
        if (now < 0 && errno != EINTR)
            return false;
        done += now > 0 ? (size_t)now : 0;
    }
    return true;
}

bool named_file_is_there(const char *path)
{
    struct stat found;
    return !lstat(path, &found);
}

static bool find_folder(const char *path, struct stat *found)
{
    const size_t length = named_file_folder(path);
    char *const folder = length ? strndup(path, length) : strdup(".");
    const bool is_found = folder && !stat(folder, found);
    free(folder);
    return is_found;
}

bool named_file_is_same(const char *a, const char *b)
{
    struct stat of_a, of_b;
    const bool has_a = !stat(a, &of_a), has_b = !stat(b, &of_b);
    if (has_a != has_b)
        return false;
    if (!has_a && (strcmp(a + named_file_folder(a), b + named_file_folder(b)) || !find_folder(a, &of_a) || !find_folder(b, &of_b)))
        return false;
    return of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
}

size_t named_file_folder(const char *path)
{
    const char *const slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

bool named_file_is_writable_here(void) { return !access(".", W_OK); }
