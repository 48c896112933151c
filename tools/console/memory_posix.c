/* memory_posix.c - the least of what Linux calls available and what the limits of the control group and of the process leave. */
#define _POSIX_C_SOURCE 200809L
#include "memory.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

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

uint64_t memory_available(void) { return least(left_by_system(), least(left_by_group(), left_by_process())); }
