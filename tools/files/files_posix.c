/* files_posix.c - files as POSIX has them: by their names, new ones, and mapped. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console/interrupt.h"
#include "console/message.h"
#include "files.h"

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

void new_file_take_rights(FILE *to, const char *of)
{
    struct stat old;
    if (!stat(of, &old))
        fchmod(fileno(to), old.st_mode & 0777);
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

/* A map of a file with a name, and what is said where the file ends before it. */
typedef struct file_map_watch {
    struct file_map_watch *next;
    file_map map;
    char line[];
} file_map_watch;

static _Atomic(file_map_watch *) watches;

/* Of a bus error elsewhere the program ends as it would have. */
static void find_cut(int number, siginfo_t *about, void *unused)
{
    (void)unused;
    for (const file_map_watch *w = atomic_load(&watches); w; w = w->next)
        if ((uintptr_t)about->si_addr - (uintptr_t)w->map.bytes < w->map.size)
            interrupt_fail(w->line);
    signal(number, SIG_DFL);
}

static bool watch(file_map *map, const char *path)
{
    static const char changed[] = ": has changed while it was read; nothing was kept";
    const size_t room = strlen(path) + sizeof changed + 64; /* with the name of the command */
    file_map_watch *const own = malloc(sizeof *own + room);
    if (!own)
        return false;
    struct sigaction action = {.sa_sigaction = find_cut, .sa_flags = SA_SIGINFO};
    message_line(own->line, room, path, changed);
    map->watch = own;
    own->map = *map;
    own->next = atomic_load(&watches);
    atomic_store(&watches, own);
    sigemptyset(&action.sa_mask);
    sigaction(SIGBUS, &action, NULL);
    return true;
}

static void unwatch(const file_map_watch *gone)
{
    file_map_watch *w = atomic_load(&watches);
    if (w == gone)
        atomic_store(&watches, w->next);
    for (; w; w = w->next)
        if (w->next == gone)
            w->next = gone->next;
}

static bool map_open(file_map *map, int file)
{
    struct stat about;
    if (fstat(file, &about) || !S_ISREG(about.st_mode))
        return false;
    if (!about.st_size)
        return true;
    void *const bytes = mmap(NULL, (size_t)about.st_size, PROT_READ, MAP_PRIVATE, file, 0);
    if (bytes == MAP_FAILED)
        return false;
    *map = (file_map){bytes, (size_t)about.st_size, NULL};
    return true;
}

file_map_result file_map_open(file_map *map, const char *path)
{
    *map = (file_map){.bytes = NULL};
    const int file = open(path, O_RDONLY);
    if (file < 0)
        return FILE_MAP_NOT_OPENED;
    const bool is_mapped = map_open(map, file);
    close(file);
    if (is_mapped && map->bytes && !watch(map, path)) {
        file_map_close(map);
        return FILE_MAP_REFUSED;
    }
    return is_mapped ? FILE_MAP_OK : FILE_MAP_REFUSED;
}

bool file_map_of_stream(file_map *map, FILE *stream)
{
    *map = (file_map){.bytes = NULL};
    return map_open(map, fileno(stream));
}

void file_map_close(file_map *map)
{
    if (map->bytes)
        munmap(map->bytes, map->size);
    if (map->watch)
        unwatch(map->watch);
    free(map->watch);
    *map = (file_map){.bytes = NULL};
}
