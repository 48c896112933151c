/* system_posix.c - what the program asks Linux and its like about streams, processors and memory. */
#define _DEFAULT_SOURCE
#include "system.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

/* --------------------------------------------------------------------------------------------------------------------- terminal */

/* Bytes are bytes. Many partitions are many open files, of which systems often allow more to who asks. */
char **terminal_begin(int *count, char **words)
{
    struct rlimit files;
    (void)count;
    if (!getrlimit(RLIMIT_NOFILE, &files)) {
        files.rlim_cur = files.rlim_max;
        setrlimit(RLIMIT_NOFILE, &files);
    }
    return words;
}

void terminal_end(void) {}

bool terminal_is(FILE *stream) { return isatty(fileno(stream)); }

/* ------------------------------------------------------------------------------------------------------------------- processors */

unsigned processors_here(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count < THREADS_MAX ? (unsigned)count : THREADS_MAX;
}

void processors_name(char *name, size_t size)
{
    char line[8192], model_name[160] = "unknown";
    bool is_virtual = false;
    int family = 0, model = 0; /* which tell apart what shares a name, and stand before it */
    FILE *const file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(line, sizeof line, file)) {
        const char *const colon = strchr(line, ':');
        line[strcspn(line, "\n")] = 0;
        if (colon && !strncmp(line, "cpu family", strlen("cpu family")))
            family = atoi(colon + 1);
        if (colon && !strncmp(line, "model\t", strlen("model\t")))
            model = atoi(colon + 1);
        if (colon && !strncmp(line, "model name", strlen("model name")))
            snprintf(model_name, sizeof model_name, "%s (family %d, model %d)", colon + 1 + strspn(colon + 1, " "), family, model);
        is_virtual = is_virtual || (!strncmp(line, "flags", strlen("flags")) && strstr(line, "hypervisor"));
    }
    if (file)
        fclose(file);
    snprintf(name, size, "%s%s", model_name, is_virtual ? ", virtual" : "");
}

/* ----------------------------------------------------------------------------------------------------------------------- memory */

static uint64_t least(uint64_t a, uint64_t b) { return a < b ? a : b; }

static uint64_t left(uint64_t limit, uint64_t used) { return used < limit ? limit - used : 0; }

/* The number after `key` at the start of a line; with an empty key the first number. False where the file has none. */
static bool read_number(const char *path, const char *key, uint64_t *number)
{
    char line[256];
    bool is_found = false;
    FILE *file = fopen(path, "r");
    while (file && !is_found && fgets(line, sizeof line, file))
        is_found = !strncmp(line, key, strlen(key)) && sscanf(line + strlen(key), "%" SCNu64, number) == 1;
    if (file)
        fclose(file);
    return is_found;
}

static uint64_t left_by_system(void)
{
    uint64_t kib;
    return read_number("/proc/meminfo", "MemAvailable:", &kib) ? 1024 * kib : UINT64_MAX;
}

/* The topmost control group (version 2) that a container sees. Cached pages of files count as used, but are given up on demand. */
static uint64_t left_by_group(void)
{
    uint64_t limit, used, cached = 0;
    if (!read_number("/sys/fs/cgroup/memory.max", "", &limit) || !read_number("/sys/fs/cgroup/memory.current", "", &used))
        return UINT64_MAX;
    read_number("/sys/fs/cgroup/memory.stat", "inactive_file", &cached);
    return left(limit, left(used, cached));
}

static uint64_t left_by_process(void)
{
    struct rlimit limit;
    uint64_t pages;
    if (getrlimit(RLIMIT_AS, &limit) || limit.rlim_cur == RLIM_INFINITY || !read_number("/proc/self/statm", "", &pages))
        return UINT64_MAX;
    return left(limit.rlim_cur, pages * (uint64_t)sysconf(_SC_PAGESIZE));
}

/* The least of what Linux calls available and what the limits of the control group and of the process leave. */
uint64_t memory_available(void) { return least(left_by_system(), least(left_by_group(), left_by_process())); }

/* ------------------------------------------------------------------------------------------------------------------------ pages */

/*
 * Rooms are mapped on the border of a large page, and the system is asked for such, but for small rooms: to take a large page costs
 * as much as 32 small ones do, and many threads that take small ones wait for each other.
 */
enum { LARGE_PAGE = 1 << 21, SMALL_PAGE = 1 << 12, SMALL_ROOM = 32 * SMALL_PAGE };

static size_t whole_pages(size_t bytes)
{
    const size_t page = bytes < SMALL_ROOM ? SMALL_PAGE : LARGE_PAGE;
    return bytes ? (bytes + page - 1) / page * page : page;
}

static void *map(size_t bytes)
{
    void *const room = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return room == MAP_FAILED ? NULL : room;
}

/*
 * The system maps where it likes: what stands before the border and after the end is given back, or not asked for where it is
 * scarce.
 */
static void *map_on_border(size_t bytes)
{
    unsigned char *const start = map(bytes + LARGE_PAGE);
    if (!start)
        return map(bytes);
    const size_t before = (LARGE_PAGE - (uintptr_t)start % LARGE_PAGE) % LARGE_PAGE;
    if (before)
        munmap(start, before);
    munmap(start + before + bytes, LARGE_PAGE - before);
#ifdef MADV_HUGEPAGE
    madvise(start + before, bytes, MADV_HUGEPAGE); /* a wish: without them it is slower and no other */
#endif
    return start + before;
}

void *pages_take(size_t bytes)
{
    if (bytes > SIZE_MAX / 2)
        return NULL;
    const size_t whole = whole_pages(bytes);
    return bytes < SMALL_ROOM ? map(whole) : map_on_border(whole);
}

void pages_free(void *room, size_t bytes)
{
    if (room)
        munmap(room, whole_pages(bytes));
}
