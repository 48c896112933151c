/*
 * grids.c - what do the answers about a grid cost, in time and memory: bits, cells, ids, lists, bricks, and filling?
 *
 * The ways take turns, round after round, each in a process of its own, whose peak of memory is its own: in memory that is new, and
 * then in the same memory. All have to find the same cells, and bricks that were kept are those of dense bits, or nothing is
 * said. CPU time, page faults included.
 */
#define _DEFAULT_SOURCE
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "common/box_scenes.h"
#include "console/pages.h"

enum { CHUNK = 8192, TILE = 128, TILE_OF_IDS = 64, WARM = 3 /* runs in memory that is not new */ };

/* Bricks are kept in chunks, so that none is copied. */
typedef struct brick {
    uint32_t at[3];
    uint64_t bits[8];
} brick;

typedef struct chunk {
    struct chunk *before;
    brick bricks[CHUNK];
} chunk;

/* A question, and what a process has for it. */
typedef struct work {
    const tribox_soup *soup;
    tribox_grid grid;
    tribox_options options;
    uint32_t tile; /* 0 for what is usual */
    size_t all, words;
    uint64_t *bits, *solid;
    uint32_t *ids, *list, (*cells)[3];
    size_t *starts;
    void *scratch;
    chunk *last;
    size_t in_last;
    double listing;         /* of `seconds`, for lists of triangles by tile */
    uint64_t found, bricks; /* cells and bricks that are set */
} work;

typedef struct found {
    double fresh, warm, listing, megabytes;
    uint64_t cells, bricks, sum; /* 0 where it is not known */
} found;

static double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* VmRSS or VmHWM of the process: now, or at the most. NAN where there is no /proc. */
static double megabytes_of(const char *name)
{
    FILE *const status = fopen("/proc/self/status", "r");
    char line[256];
    double kilobytes = (double)NAN;
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

/* The bricks of dense bits. */
static uint64_t sum_dense(const work *w)
{
    const size_t row = tribox_mask_words(w->grid.size[0]);
    const uint32_t *const size = w->grid.size;
    uint64_t sum = 0;
    uint32_t at[3];
    for (at[2] = 0; 8 * at[2] < size[2]; at[2]++)
        for (at[1] = 0; 8 * at[1] < size[1]; at[1]++)
            for (at[0] = 0; 8 * at[0] < size[0]; at[0]++) {
                uint64_t words[8] = {0}, any = 0;
                for (uint32_t n = 0; n < 64; n++) {
                    const uint32_t j = 8 * at[1] + n % 8, k = 8 * at[2] + n / 8;
                    const bool is_in = j < size[1] && k < size[2];
                    const uint64_t byte = is_in ? w->bits[((size_t)k * size[1] + j) * row + at[0] / 8] >> at[0] % 8 * 8 & 0xff : 0;
                    words[n / 8] |= byte << n % 8 * 8;
                    any |= byte;
                }
                sum += any ? sum_of(at, words) : 0;
            }
    return sum;
}

static uint64_t sum_kept(const work *w)
{
    uint64_t sum = 0;
    size_t count = w->in_last;
    for (const chunk *c = w->last; c; c = c->before, count = CHUNK)
        for (size_t i = 0; i < count; i++)
            sum += sum_of(c->bricks[i].at, c->bricks[i].bits);
    return sum;
}

/* ---- what takes bricks ----------------------------------------------------------------------------------------------------- */

static int keep(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    work *const w = data;
    if (!w->last || w->in_last == CHUNK) {
        chunk *const next = malloc(sizeof *next);
        if (!next)
            return 1;
        next->before = w->last;
        w->last = next;
        w->in_last = 0;
    }
    brick *const b = &w->last->bricks[w->in_last++];
    memcpy(b->at, at, sizeof b->at);
    memcpy(b->bits, bits, sizeof b->bits);
    w->bricks++;
    return 0;
}

static int look(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    (void)at, (void)bits;
    ((work *)data)->bricks++;
    return 0;
}

static int look_at_ids(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    (void)ids;
    return look(data, at, bits);
}

static int look_at_lists(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t starts[513], const uint32_t *list)
{
    (void)starts, (void)list;
    return look(data, at, bits);
}

/* ---- the ways -------------------------------------------------------------------------------------------------------------- */

static bool run_window(work *w)
{
    tribox_report report;
    const bool is = !tribox_voxelize(w->soup, &w->grid, NULL, &w->options, w->bits, &report);
    w->found = report.overlapping;
    return is;
}

static bool run_ids(work *w)
{
    tribox_report report;
    const bool is = !tribox_voxelize_ids(w->soup, 0, &w->grid, NULL, &w->options, w->bits, w->ids, &report);
    w->found = report.overlapping;
    return is;
}

/* Both passes. */
static bool run_lists(work *w)
{
    bool is = !tribox_cell_lists(w->soup, &w->grid, NULL, &w->options, w->starts, NULL);
    w->list = is && !w->list ? malloc((w->starts[w->all] + 1) * sizeof *w->list) : w->list;
    return is && w->list && !tribox_cell_lists(w->soup, &w->grid, NULL, &w->options, w->starts, w->list);
}

static bool run_cells(work *w)
{
    w->found = tribox_window_cells(w->bits, w->grid.size, w->cells);
    return true;
}

/* What anyone writes in place of tribox_window_cells. */
static bool run_loop(work *w)
{
    const uint32_t *const size = w->grid.size, words = (size[0] + 63) / 64;
    const uint64_t *at = w->bits;
    size_t count = 0;
    for (uint32_t k = 0; k < size[2]; k++)
        for (uint32_t j = 0; j < size[1]; j++)
            for (uint32_t word = 0; word < words; word++)
                for (uint64_t left = *at++; left; left &= left - 1) { /* no bit is set past the end of a row */
                    w->cells[count][0] = 64 * word + (uint32_t)__builtin_ctzll(left);
                    w->cells[count][1] = j;
                    w->cells[count++][2] = k;
                }
    w->found = count;
    return true;
}

static bool run_outside(work *w)
{
    size_t filled = 0;
    const bool is = !tribox_fill_outside(w->grid.size, w->bits, w->scratch, w->solid, &filled);
    w->found = filled;
    return is;
}

static bool run_parity(work *w)
{
    size_t filled = 0, odd_rows;
    const bool is = !tribox_fill_parity(w->soup, &w->grid, w->bits, w->scratch, w->solid, &filled, &odd_rows);
    w->found = filled;
    return is;
}

static size_t longest_list(const size_t *starts, size_t count)
{
    size_t longest = 0;
    for (size_t t = 0; t < count; t++)
        longest = starts[t + 1] - starts[t] > longest ? starts[t + 1] - starts[t] : longest;
    return longest;
}

/* Lists of triangles by tile, then the bricks of each. */
static bool run_bricks(work *w, const tribox_sink *sink, const tribox_ids_sink *ids, const tribox_lists_sink *lists)
{
    const uint32_t side = w->tile ? w->tile : sink ? TILE : TILE_OF_IDS;
    const tribox_tiles all = {side, 0, tribox_tile_count(w->grid.size, side)};
    const double begin = cpu_seconds();
    tribox_report report = {0, 0};
    size_t *const starts = malloc((all.count + 1) * sizeof *starts);
    bool is = starts && !tribox_tile_lists(w->soup, &w->grid, &all, &w->options, starts, NULL);
    const size_t bytes = !is     ? 0
                         : sink  ? tribox_bricks_bytes(side)
                         : lists ? tribox_bricks_lists_bytes(side, longest_list(starts, all.count))
                                 : tribox_bricks_ids_bytes(side);
    void *const scratch = malloc(bytes);
    uint32_t *const list = is ? malloc((starts[all.count] + 1) * sizeof *list) : NULL;
    is = list && scratch && !tribox_tile_lists(w->soup, &w->grid, &all, &w->options, starts, list);
    w->listing = cpu_seconds() - begin;
    is = is && !(sink    ? tribox_bricks(w->soup, &w->grid, &all, starts, list, &w->options, scratch, sink, &report)
                 : lists ? tribox_bricks_lists(w->soup, &w->grid, &all, starts, list, &w->options, scratch, lists, &report)
                         : tribox_bricks_ids(w->soup, &w->grid, &all, starts, list, &w->options, scratch, ids, &report));
    free(list);
    free(scratch);
    free(starts);
    w->found = report.overlapping;
    return is;
}

static bool run_kept(work *w) { return run_bricks(w, &(tribox_sink){keep, w}, NULL, NULL); }

static bool run_counted(work *w) { return run_bricks(w, &(tribox_sink){look, w}, NULL, NULL); }

static bool run_bricks_ids(work *w) { return run_bricks(w, NULL, &(tribox_ids_sink){look_at_ids, w}, NULL); }

static bool run_bricks_lists(work *w) { return run_bricks(w, NULL, NULL, &(tribox_lists_sink){look_at_lists, w}); }

/* What a way needs before the clock runs. Pages are taken when they are first touched. */
enum { NEEDS_BITS = 1, NEEDS_SURFACE = 2, NEEDS_CELLS = 4, NEEDS_SOLID = 8, NEEDS_IDS = 16, NEEDS_STARTS = 32, IS_LARGE = 64 };

static const struct way {
    const char *name;
    bool (*run)(work *w);
    int most; /* cells, as a power of two */
    unsigned needs;
} ways[] = {
    {"window", run_window, 37, NEEDS_BITS},
    {"window, large pages", run_window, 37, NEEDS_BITS | IS_LARGE},
    {"its cells", run_cells, 34, NEEDS_BITS | NEEDS_SURFACE | NEEDS_CELLS},
    {"its cells, plain loop", run_loop, 34, NEEDS_BITS | NEEDS_SURFACE | NEEDS_CELLS},
    {"its inside, from outside", run_outside, 34, NEEDS_BITS | NEEDS_SURFACE | NEEDS_SOLID},
    {"its inside, by parity", run_parity, 34, NEEDS_BITS | NEEDS_SURFACE | NEEDS_SOLID},
    {"window with ids", run_ids, 31, NEEDS_BITS | NEEDS_IDS},
    {"lists of all triangles", run_lists, 28, NEEDS_STARTS},
    {"bricks counted", run_counted, 63, 0},
    {"bricks kept", run_kept, 63, 0},
    {"bricks with ids", run_bricks_ids, 63, 0},
    {"bricks with lists", run_bricks_lists, 63, 0},
};
enum { WAYS = sizeof ways / sizeof ways[0] };

static bool make(const struct way *way, work *w)
{
    const unsigned needs = way->needs;
    const size_t bytes = w->words * sizeof *w->bits;
    bool is = true;
    if (needs & NEEDS_BITS)
        is = (w->bits = needs & IS_LARGE ? pages_take(bytes) : calloc(w->words, sizeof *w->bits)) != NULL;
    if (is && needs & NEEDS_SURFACE)
        is = run_window(w);
    if (needs & NEEDS_CELLS)
        is = is && (w->cells = malloc((w->found + 1) * sizeof *w->cells)) != NULL;
    if (needs & NEEDS_SOLID)
        is = is && (w->solid = malloc(bytes)) != NULL && (w->scratch = malloc(tribox_fill_bytes(w->grid.size))) != NULL;
    if (needs & NEEDS_IDS)
        is = is && (w->ids = malloc(w->all * sizeof *w->ids)) != NULL;
    if (needs & NEEDS_STARTS)
        is = is && (w->starts = malloc((w->all + 1) * sizeof *w->starts)) != NULL;
    return is;
}

static bool run_once(const struct way *way, work *w, double *seconds)
{
    if (w->bits && !(way->needs & NEEDS_SURFACE))
        memset(w->bits, 0, w->words * sizeof *w->bits);
    const double begin = cpu_seconds();
    const bool is = way->run(w);
    *seconds = cpu_seconds() - begin;
    return is;
}

/* Never frees: the process ends. */
static bool find(const struct way *way, work *w, found *f)
{
    const double before = megabytes_of("VmRSS");
    const bool is_first = make(way, w);
    const double begin = cpu_seconds();
    if (!is_first || !way->run(w))
        return false;
    *f = (found){.fresh = cpu_seconds() - begin, .listing = w->listing, .cells = w->found, .bricks = w->bricks};
    f->megabytes = megabytes_of("VmHWM") - before;
    f->sum = way->run == run_kept ? sum_kept(w) : way->run == run_window ? sum_dense(w) : 0;
    f->warm = INFINITY;
    for (int again = 0; again < WARM; again++) {
        double seconds;
        w->last = NULL;
        if (!run_once(way, w, &seconds))
            return false;
        f->warm = fmin(f->warm, seconds);
    }
    return true;
}

static bool find_apart(const struct way *way, const work *of, found *f)
{
    int ends[2], status = 0;
    if (pipe(ends))
        return message_failure("no pipe to a child process") == EXIT_CODE_OK;
    const pid_t child = fork();
    if (child == 0) {
        work w = *of;
        found own;
        const bool is_told = find(way, &w, &own) && write(ends[1], &own, sizeof own) == sizeof own;
        _exit(is_told ? 0 : 1);
    }
    close(ends[1]);
    const bool is_read = child > 0 && read(ends[0], f, sizeof *f) == sizeof *f;
    close(ends[0]);
    return child > 0 && waitpid(child, &status, 0) == child && is_read && status == 0;
}

/* ---- the table ------------------------------------------------------------------------------------------------------------- */

static bool is_asked(const asked *q, size_t way, size_t all)
{
    const char *const part = q->text[OPTION_FILTER];
    return all >> ways[way].most == 0 && (!part || strstr(ways[way].name, part));
}

/* Cells that are set are the same for all, and so are bricks. */
static bool are_alike(const asked *q, size_t all, const found least[WAYS])
{
    uint64_t cells = 0, bricks = 0, sum = 0;
    bool is = true;
    for (size_t k = 0; k < WAYS; k++) {
        const bool is_inside = ways[k].needs & NEEDS_SOLID;
        if (!is_asked(q, k, all))
            continue;
        is = is && (is_inside || !cells || !least[k].cells || cells == least[k].cells);
        is = is && (!sum || !least[k].sum || sum == least[k].sum);
        cells = !is_inside && least[k].cells ? least[k].cells : cells;
        is = is && (!bricks || !least[k].bricks || bricks == least[k].bricks);
        bricks = least[k].bricks ? least[k].bricks : bricks;
        sum = least[k].sum ? least[k].sum : sum;
    }
    return is || message_failure("the ways differ") == EXIT_CODE_OK;
}

static void tell(printout *out, const char *name, uint32_t resolution, const struct way *way, const found *f, const found *window)
{
    ROW(out, TEXT("way", way->name), TEXT_DATA("mesh", name), DATA("cells_along", resolution), NUMBER("ms", 2, 1e3 * f->warm),
        NUMBER("ms_in_new_memory", 2, 1e3 * f->fresh),
        NUMBER("times_window's_ms", 2, window ? f->warm / window->warm : (double)NAN),
        NUMBER("ms_to_list_by_tile", 2, f->listing > 0 ? 1e3 * f->listing : (double)NAN),
        NUMBER("cells", 0, f->cells ? (double)f->cells : (double)NAN), DATA("bricks", f->bricks ? (double)f->bricks : (double)NAN),
        NUMBER("ns_a_cell", 2, f->cells ? 1e9 * f->fresh / (double)f->cells : (double)NAN), NUMBER("MB", 1, f->megabytes));
}

static bool ask_grid(asked *q, const scene *at, uint32_t resolution)
{
    const uint64_t rounds = asked_number(q, OPTION_ROUNDS, asked_has(q, OPTION_QUICK) ? 1 : 5);
    work w = {.soup = &at->work.jobs[0].soup, .grid = scene_grid(at, resolution), .options = {.kernel = q->kernel}};
    found least[WAYS] = {{0}}, f;
    w.tile = (uint32_t)q->number[OPTION_TILE];
    w.all = (size_t)w.grid.size[0] * w.grid.size[1] * w.grid.size[2];
    w.words = tribox_window_words(w.grid.size);
    for (uint64_t round = 0; round < rounds; round++)
        for (size_t k = 0; k < WAYS; k++) {
            if (!is_asked(q, k, w.all))
                continue;
            if (!find_apart(&ways[k], &w, &f))
                return message_failure("%s in %u cells, %s: no answer; is there memory for it?", at->name, (unsigned)resolution,
                                       ways[k].name) == EXIT_CODE_OK;
            f.fresh = round ? fmin(f.fresh, least[k].fresh) : f.fresh;
            f.warm = round ? fmin(f.warm, least[k].warm) : f.warm;
            f.listing = round ? fmin(f.listing, least[k].listing) : f.listing;
            least[k] = f;
        }
    if (!are_alike(q, w.all, least))
        return false;
    printout_table(&q->out, "%s, %zu triangles, in %u x %u x %u cells; CPU time", at->name, w.soup->count, w.grid.size[0],
                   w.grid.size[1], w.grid.size[2]);
    for (size_t k = 0; k < WAYS; k++)
        if (is_asked(q, k, w.all))
            tell(&q->out, at->name, resolution, &ways[k], &least[k], is_asked(q, 0, w.all) ? &least[0] : NULL);
    return true;
}

static bool ask_scene(asked *q, scene *at, size_t number)
{
    bool is_right = true;
    (void)number;
    for (size_t n = 0; is_right && n < q->cell_counts; n++)
        is_right = ask_grid(q, at, q->cells[n]);
    return is_right;
}

static bool answer(asked *q)
{
    asked_cells(q, asked_has(q, OPTION_QUICK) ? (const uint32_t[]){64, 128, 128} : (const uint32_t[]){64, 256, 1024},
                asked_has(q, OPTION_QUICK) ? 2 : 3);
    return scenes_ask(q, 0, 0, ask_scene);
}

const bench_question question_grids = {.name = "grids",
                                       .asks = "What do bits, cells, ids, lists, bricks and filling cost, in time and memory?",
                                       .options = 1u << OPTION_CELLS | 1u << OPTION_TILE | 1u << OPTION_KERNEL |
                                                  1u << OPTION_FILTER | 1u << OPTION_QUICK,
                                       .takes_meshes = true,
                                       .needs_meshes = true,
                                       .answer = answer};
