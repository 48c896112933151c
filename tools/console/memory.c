/* memory.c - the least of what Linux calls available, what the control group leaves, and what the limit of the process leaves. */
#define _POSIX_C_SOURCE 200809L
#include "memory.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static uint64_t least(uint64_t a, uint64_t b) { return a < b ? a : b; }

static uint64_t rest(uint64_t limit, uint64_t used) { return used < limit ? limit - used : 0; }

/* The number behind `key` in a file of lines; without a key the first one. Returns whether there is one. */
static int read_number(const char *path, const char *key, uint64_t *number)
{
    char line[256];
    int found = 0;
    FILE *file = fopen(path, "r");
    while (file && !found && fgets(line, sizeof line, file))
        if (!strncmp(line, key, strlen(key)))
            found = sscanf(line + strlen(key), "%" SCNu64, number) == 1;
    if (file)
        fclose(file);
    return found;
}

static uint64_t of_system(void)
{
    uint64_t kib;
    return read_number("/proc/meminfo", "MemAvailable:", &kib) ? 1024 * kib : UINT64_MAX;
}

/* Of the group that a container sees as the topmost. Pages of files count as used there, but can be had. */
static uint64_t of_group(void)
{
    static const char *const files[][4] = {
        {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current", "/sys/fs/cgroup/memory.stat", "inactive_file"},
        {"/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes",
         "/sys/fs/cgroup/memory/memory.stat", "total_inactive_file"}}; /* versions 2 and 1 */
    for (int i = 0; i < 2; i++) {
        uint64_t limit, used, pages = 0;
        if (!read_number(files[i][0], "", &limit) || !read_number(files[i][1], "", &used))
            continue;
        read_number(files[i][2], files[i][3], &pages);
        return rest(limit, rest(used, pages));
    }
    return UINT64_MAX;
}

static uint64_t of_process(void)
{
    struct rlimit limit;
    uint64_t pages;
    if (getrlimit(RLIMIT_AS, &limit) || limit.rlim_cur == RLIM_INFINITY || !read_number("/proc/self/statm", "", &pages))
        return UINT64_MAX;
    return rest(limit.rlim_cur, pages * (uint64_t)sysconf(_SC_PAGESIZE));
}

uint64_t memory_available(void) { return least(of_system(), least(of_group(), of_process())); }

const char *memory_text(uint64_t bytes, char text[16])
{
    static const char *const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    int unit = 0;
    double size = (double)bytes;
    for (; size >= 1024; unit++)
        size /= 1024;
    snprintf(text, 16, unit && size < 100 ? "%.1f %s" : "%.0f %s", size, units[unit]);
    return text;
}
