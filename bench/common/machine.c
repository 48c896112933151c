/* machine.c - asks Linux about the processor. */
#include "machine.h"

#include <stdio.h>
#include <string.h>

#include "build.h"
#include "commit.h"

/* The value of a "key : value" line, or NULL. */
static const char *value_of(char *line, const char *key)
{
    char *const colon = strchr(line, ':');
    if (!colon || strncmp(line, key, strlen(key)) != 0)
        return NULL;
    line[strcspn(line, "\n")] = 0;
    return colon + 1 + strspn(colon + 1, " ");
}

/* Linux only; elsewhere nothing is found, and said. */
static void read_processor(machine *m)
{
    char line[8192];
    FILE *const file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(line, sizeof line, file)) {
        const char *const name = value_of(line, "model name");
        if (name)
            snprintf(m->processor, sizeof m->processor, "%s", name);
        const char *const features = value_of(line, "flags");
        if (features && strstr(features, "hypervisor"))
            m->is_virtual = true;
    }
    if (file)
        fclose(file);
}

static double read_load(void)
{
    double load = -1;
    FILE *const file = fopen("/proc/loadavg", "r");
    if (file && fscanf(file, "%lf", &load) != 1)
        load = -1;
    if (file)
        fclose(file);
    return load;
}

machine machine_here(void)
{
    machine m = {.processor = "unknown processor", .compiler = BENCH_COMPILER, .flags = BENCH_FLAGS, .commit = BENCH_COMMIT};
    read_processor(&m);
    m.load = read_load();
    return m;
}
