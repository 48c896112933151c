/* file_map_posix.c - maps files by mmap. */
#define _XOPEN_SOURCE 700
#include "file_map.h"

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
