/* scale_ways.c - the three ways, each in a child process, whose peak of memory is its own. */
#define _DEFAULT_SOURCE
#include "scale_ways.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "console/message.h"
#include "console/pages.h"

typedef struct brick {
    uint32_t at[3];
    uint64_t bits[8];
} brick;

/* Bricks are kept in chunks, so that none is copied. */
enum { CHUNK = 8192 };
typedef struct chunk {
    struct chunk *before;
    brick bricks[CHUNK];
} chunk;

/* What a sink has. */
typedef struct taken {
    chunk *last;
    size_t in_last;
    uint64_t bricks;
} taken;

static double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* VmRSS or VmHWM of the process: "now", or at the most. */
static double megabytes_of(const char *name)
{
    FILE *const status = fopen("/proc/self/status", "r");
    char line[256];
    double kilobytes = 0;
    while (status && fgets(line, sizeof line, status))
        if (!strncmp(line, name, strlen(name)))
            kilobytes = strtod(line + strlen(name) + 1, NULL);
    if (status)
        fclose(status);
    return kilobytes / 1024;
}

static uint64_t mixed(uint64_t h)
{
    h ^= h >> 33;
    h *= UINT64_C(0xff51afd7ed558ccd);
    h ^= h >> 33;
    h *= UINT64_C(0xc4ceb9fe1a85ec53);
    return h ^ h >> 33;
}

static uint64_t sum_of(const uint32_t at[3], const uint64_t bits[8])
{
    uint64_t h = mixed(at[0] + ((uint64_t)at[1] << 21) + ((uint64_t)at[2] << 42));
    for (uint64_t k = 0; k < 8; k++)
        h = mixed(h ^ bits[k]) + k;
    return h;
}

static int keep(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    taken *const t = data;
    if (!t->last || t->in_last == CHUNK) {
        chunk *const next = malloc(sizeof *next);
        if (!next)
            return 1;
        next->before = t->last;
        t->last = next;
        t->in_last = 0;
    }
    brick *const b = &t->last->bricks[t->in_last++];
    memcpy(b->at, at, sizeof b->at);
    memcpy(b->bits, bits, sizeof b->bits);
    t->bricks++;
    return 0;
}

static int only_count(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    (void)at, (void)bits;
    ((taken *)data)->bricks++;
    return 0;
}

/* What was kept is summed up when the clock has stopped. */
static uint64_t sum_kept(const taken *t)
{
    uint64_t sum = 0;
    size_t count = t->in_last;
    for (const chunk *c = t->last; c; c = c->before, count = CHUNK)
        for (size_t i = 0; i < count; i++)
            sum += sum_of(c->bricks[i].at, c->bricks[i].bits);
    return sum;
}

static bool find_bricks(scale_way way, const scale_question *q, scale_answer *answer)
{
    const size_t tiles = tribox_tile_count(q->grid.size, q->tile);
    const tribox_tiles all = {q->tile, 0, tiles};
    taken t = {.last = NULL};
    const tribox_sink sink = {way == WAY_KEPT ? keep : only_count, &t};
    tribox_report report = {0, 0};
    const double begin = cpu_seconds();
    size_t *const starts = malloc((tiles + 1) * sizeof *starts);
    if (!starts || tribox_tile_lists(q->soup, &q->grid, &all, &q->options, starts, NULL))
        return false;
    uint32_t *const list = malloc(starts[tiles] * sizeof *list + 1);
    void *const scratch = malloc(tribox_bricks_bytes(q->tile));
    if (!list || !scratch || tribox_tile_lists(q->soup, &q->grid, &all, &q->options, starts, list))
        return false;
    answer->listing = cpu_seconds() - begin;
    if (tribox_bricks(q->soup, &q->grid, &all, starts, list, &q->options, scratch, &sink, &report))
        return false;
    answer->seconds = cpu_seconds() - begin;
    answer->pairs = starts[tiles];
    answer->cells = report.overlapping;
    answer->bricks = t.bricks;
    answer->sum = sum_kept(&t);
    return true;
}

/* The bricks of dense bits, for the sum. */
static void sum_dense(const scale_question *q, const uint64_t *bits, scale_answer *answer)
{
    const size_t row = tribox_mask_words(q->grid.size[0]);
    const uint32_t *const size = q->grid.size;
    uint32_t at[3];
    for (at[2] = 0; 8 * at[2] < size[2]; at[2]++)
        for (at[1] = 0; 8 * at[1] < size[1]; at[1]++)
            for (at[0] = 0; 8 * at[0] < size[0]; at[0]++) {
                uint64_t words[8] = {0}, any = 0;
                for (uint32_t n = 0; n < 64; n++) {
                    const uint32_t j = 8 * at[1] + n % 8, k = 8 * at[2] + n / 8;
                    const bool is_in = j < size[1] && k < size[2];
                    const uint64_t byte = is_in ? bits[((size_t)k * size[1] + j) * row + at[0] / 8] >> at[0] % 8 * 8 & 0xff : 0;
                    words[n / 8] |= byte << n % 8 * 8;
                    any |= byte;
                }
                answer->bricks += any != 0;
                answer->sum += any ? sum_of(at, words) : 0;
            }
}

static bool find_dense(scale_way way, const scale_question *q, scale_answer *answer, double megabytes_before)
{
    tribox_report report;
    const size_t words = tribox_window_words(q->grid.size);
    const double begin = cpu_seconds();
    uint64_t *const bits = way == WAY_LARGE ? pages_take(words * sizeof *bits) : calloc(words, sizeof *bits);
    if (!bits || tribox_voxelize(q->soup, &q->grid, NULL, &q->options, bits, &report))
        return false;
    answer->seconds = cpu_seconds() - begin;
    answer->megabytes = megabytes_of("VmHWM") - megabytes_before;
    answer->cells = report.overlapping;
    sum_dense(q, bits, answer);
    return true;
}

static bool find(scale_way way, const scale_question *q, scale_answer *answer)
{
    const double before = megabytes_of("VmRSS");
    *answer = (scale_answer){.seconds = 0};
    if (way < WAY_KEPT)
        return find_dense(way, q, answer, before);
    const bool is_found = find_bricks(way, q, answer);
    answer->megabytes = megabytes_of("VmHWM") - before;
    return is_found;
}

bool scale_answer_find(scale_way way, const scale_question *question, scale_answer *answer)
{
    int ends[2], status = 0;
    if (pipe(ends))
        return message_failure("no pipe to a child process") == 0;
    const pid_t child = fork();
    if (child == 0) {
        scale_answer own;
        const bool is_told = find(way, question, &own) && write(ends[1], &own, sizeof own) == sizeof own;
        _exit(is_told ? 0 : 1);
    }
    close(ends[1]);
    const bool is_read = child > 0 && read(ends[0], answer, sizeof *answer) == sizeof *answer;
    close(ends[0]);
    return child > 0 && waitpid(child, &status, 0) == child && is_read && status == 0;
}
