/*
 * grids.c - what do the answers about a grid cost, in time and memory: bits, cells, ids, lists, bricks, and filling? And the bits
 * beside the paper's test for each cell, Schwarz and Seidel (rivals.h), and reading the soup?
 *
 * The ways take turns, round after round, each in a process of its own, whose peak of memory is its own: in memory that is new, and
 * then in the same memory. Bits have to be those of the scalar kernel on every kernel, CONSERVATIVE a superset; all others have to
 * find the same cells, and bricks that were kept are those of dense bits, or nothing is said. CPU time, page faults included.
 */
#define _DEFAULT_SOURCE
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/box_scenes.h"
#include "common/rivals.h"
#include "common/counting.h"
#include "console/system.h"
#include "voxelize/voxel_task.h"

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
    const float (*triangles)[3][3];
    const uint64_t *truth; /* NULL where bits are not compared with it */
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
    volatile uint32_t seen; /* of what is read alone */
} work;

typedef struct found {
    double fresh, warm, listing, megabytes;
    uint64_t cells, bricks, sum; /* 0 where it is not known */
    uint64_t missed, untrue;     /* cells, compared with the truth */
} found;

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

/* Of eight cells that begin at cell 8 x of row j of layer k. */
static uint64_t sum_of(uint64_t x, uint64_t j, uint64_t k, uint64_t byte)
{
    return byte ? mixed(byte + (x << 8) + (j << 26) + (k << 45)) : 0;
}

static uint64_t sum_dense(const work *w)
{
    const uint32_t *const size = w->grid.size;
    const size_t row = tribox_mask_words(size[0]);
    uint64_t sum = 0;
    for (size_t k = 0; k < size[2]; k++)
        for (size_t j = 0; j < size[1]; j++)
            for (size_t x = 0; x < 8 * row; x++)
                sum += sum_of(x, j, k, w->bits[(k * size[1] + j) * row + x / 8] >> x % 8 * 8 & 0xff);
    return sum;
}

static uint64_t sum_kept(const work *w)
{
    uint64_t sum = 0;
    size_t count = w->in_last;
    for (const chunk *c = w->last; c; c = c->before, count = CHUNK)
        for (size_t i = 0; i < 64 * count; i++) {
            const brick *const b = &c->bricks[i / 64];
            sum += sum_of(b->at[0], 8 * b->at[1] + i % 8, 8 * b->at[2] + i / 8 % 8, b->bits[i / 8 % 8] >> i % 8 * 8 & 0xff);
        }
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

/* ---- the ways -------------------------------------------------------------------------------------------------------------- */

static bool run_window(work *w)
{
    tribox_report report;
    const bool is = !tribox_voxelize(w->soup, &w->grid, NULL, &w->options, w->bits, &report);
    w->found = report.overlapping;
    return is;
}

static bool run_threads(work *w)
{
    const voxel_task task = voxel_task_of_soup(w->soup, &w->grid, &w->options);
    return !voxelize_in_threads(&task, 2, w->bits, NULL, NULL);
}

static bool run_seidel(work *w)
{
    voxelize_schwarz_seidel(&w->grid, w->triangles, w->soup->count, w->bits);
    return true;
}

static bool run_cell_by_cell(work *w)
{
    voxelize_cell_by_cell(&w->grid, w->triangles, w->soup->count, w->bits);
    return true;
}

static bool run_reading(work *w)
{
    w->seen = loads_all(w->soup);
    return true;
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
    const double begin = timing_seconds(false);
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
    w->listing = timing_seconds(false) - begin;
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

static bool run_counted(work *w) { return run_bricks(w, &(tribox_sink){count_brick, &w->bricks}, NULL, NULL); }

static bool run_bricks_ids(work *w) { return run_bricks(w, NULL, &(tribox_ids_sink){count_ids, &w->bricks}, NULL); }

static bool run_bricks_lists(work *w) { return run_bricks(w, NULL, NULL, &(tribox_lists_sink){count_lists, &w->bricks}); }

/* What a way needs before the clock runs, and what it is. Pages are taken when they are first touched. */
enum {
    NEEDS_BITS = 1,
    NEEDS_SURFACE = 2,
    NEEDS_CELLS = 4,
    NEEDS_SOLID = 8,
    NEEDS_IDS = 16,
    NEEDS_STARTS = 32,
    IS_LARGE = 64,
    IS_CONSERVATIVE = 128,
    IS_ROUNDED = 256,
    IS_FAST = 512,
    HAS_THREADS = 1024 /* timed by the clock */
};

typedef struct way {
    const char *name;
    bool (*run)(work *w);
    int most; /* cells, as a power of two */
    unsigned needs;
} way;

static const way list_to_bits[] = {
    {"exact", run_window, 37, NEEDS_BITS},
    {"conservative", run_window, 37, NEEDS_BITS | IS_CONSERVATIVE},
    {"fast", run_window, 37, NEEDS_BITS | IS_FAST | IS_ROUNDED},
    {"exact, 2 threads", run_threads, 37, NEEDS_BITS | HAS_THREADS},
    {"Schwarz-Seidel", run_seidel, 37, NEEDS_BITS | IS_ROUNDED},
    {"cell by cell", run_cell_by_cell, 37, NEEDS_BITS | IS_ROUNDED},
    {"reading", run_reading, 63, 0},
};

static const way list_to_answers[] = {
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
enum { WAYS_MOST = 12 };

typedef struct ways {
    const way *list;
    size_t count;
    bool has_truth; /* bits are compared with it */
} ways;
static const ways to_bits = {list_to_bits, sizeof list_to_bits / sizeof list_to_bits[0], true},
                  to_answers = {list_to_answers, sizeof list_to_answers / sizeof list_to_answers[0], false};

static bool make(const way *as, work *w)
{
    const unsigned needs = as->needs;
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

/* A rival that takes longer than so many seconds is ended, and nobody who takes longer than TIMED_ONCE is timed again. */
enum { TIMED_ONCE = 2 };

static bool run_once(const way *as, work *w, unsigned limit, double *seconds)
{
    if (w->bits && !(as->needs & NEEDS_SURFACE))
        memset(w->bits, 0, w->words * sizeof *w->bits);
    alarm(as->needs & IS_ROUNDED && !(as->needs & IS_FAST) ? limit : 0);
    const double begin = timing_seconds(as->needs & HAS_THREADS);
    const bool is = as->run(w);
    *seconds = timing_seconds(as->needs & HAS_THREADS) - begin;
    alarm(0);
    return is;
}

/* Never frees: the process ends. */
static bool find(const way *as, work *w, unsigned limit, found *f)
{
    const double before = megabytes_of("VmRSS");
    w->options.accuracy = as->needs & IS_FAST ? TRIBOX_FAST : as->needs & IS_CONSERVATIVE ? TRIBOX_CONSERVATIVE : TRIBOX_EXACT;
    *f = (found){.warm = INFINITY};
    if (!make(as, w) || !run_once(as, w, limit, &f->fresh))
        return false;
    f->listing = w->listing;
    f->cells = w->found;
    f->bricks = w->bricks;
    f->megabytes = megabytes_of("VmHWM") - before;
    f->sum = as->run == run_kept ? sum_kept(w) : as->run == run_window && !w->truth ? sum_dense(w) : 0;
    for (size_t k = 0; w->truth && w->bits && k < w->words; k++) {
        f->missed += (uint64_t)__builtin_popcountll(w->truth[k] & ~w->bits[k]);
        f->untrue += (uint64_t)__builtin_popcountll(w->bits[k] & ~w->truth[k]);
    }
    for (int again = 0; again < WARM && (!again || f->fresh < TIMED_ONCE); again++) {
        double seconds;
        w->last = NULL;
        if (!run_once(as, w, limit, &seconds))
            return false;
        f->warm = fmin(f->warm, seconds);
    }
    return true;
}

static bool find_apart(const way *as, const work *of, unsigned limit, found *f)
{
    int ends[2], status = 0;
    if (pipe(ends))
        return message_failure("no pipe to a child process") == EXIT_CODE_OK;
    const pid_t child = fork();
    if (child == 0) {
        work w = *of;
        found own;
        const bool is_told = find(as, &w, limit, &own) && write(ends[1], &own, sizeof own) == sizeof own;
        _exit(is_told ? 0 : 1);
    }
    close(ends[1]);
    const bool is_read = child > 0 && read(ends[0], f, sizeof *f) == sizeof *f;
    close(ends[0]);
    if (child < 0 || waitpid(child, &status, 0) != child)
        return false;
    const bool is_over = WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM;
    if (is_over)
        *f = (found){.fresh = (double)NAN, .warm = (double)NAN, .megabytes = (double)NAN};
    return is_over || (is_read && !status);
}

/* ---- the table ------------------------------------------------------------------------------------------------------------- */

static bool is_asked(const asked *q, const way *as, size_t all)
{
    const char *const part = q->text[OPTION_FILTER];
    return all >> as->most == 0 && (!part || strstr(as->name, part));
}

/* Bits are true, or cells that are set are the same for all, and so are bricks. */
static bool are_right(const asked *q, ways of, const work *w, const found least[WAYS_MOST])
{
    uint64_t cells = 0, bricks = 0, sum = 0;
    bool is = true;
    for (size_t k = 0; k < of.count; k++) {
        const unsigned needs = of.list[k].needs;
        const bool is_inside = needs & NEEDS_SOLID;
        if (!is_asked(q, &of.list[k], w->all))
            continue;
        if (w->truth) {
            is = is && (needs & IS_ROUNDED || (!least[k].missed && (needs & IS_CONSERVATIVE || !least[k].untrue)));
            continue;
        }
        is = is && (is_inside || !cells || !least[k].cells || cells == least[k].cells);
        is = is && (!sum || !least[k].sum || sum == least[k].sum);
        cells = !is_inside && least[k].cells ? least[k].cells : cells;
        is = is && (!bricks || !least[k].bricks || bricks == least[k].bricks);
        bricks = least[k].bricks ? least[k].bricks : bricks;
        sum = least[k].sum ? least[k].sum : sum;
    }
    return is || message_failure("the ways differ") == EXIT_CODE_OK;
}

static void tell(printout *out, const char *name, uint32_t resolution, const work *w, const way *as, const found *f,
                 const found *first)
{
    const double cells = (double)(w->truth ? first->cells : f->cells), triangles = (double)w->soup->count;
    ROW(out, TEXT("way", as->name), TEXT_DATA("mesh", name), DATA("cells_along", resolution), DATA("triangles", triangles),
        NUMBER("ms", 2, 1e3 * f->warm), NUMBER("ms_in_new_memory", 2, 1e3 * f->fresh),
        NUMBER_IF(first->warm > 0, "times_the_first's_ms", 2, f->warm / first->warm),
        NUMBER_IF(f->listing > 0, "ms_to_list_by_tile", 2, 1e3 * f->listing), NUMBER_IF(f->cells, "cells", 0, f->cells),
        DATA("bricks", f->bricks ? (double)f->bricks : (double)NAN), NUMBER("ns_a_triangle", 1, 1e9 * f->warm / triangles),
        NUMBER_IF(cells > 0, "ns_a_cell", 2, 1e9 * f->fresh / cells),
        NUMBER_IF(w->truth && as->needs & NEEDS_BITS && !isnan(f->warm), "cells_unlike", 0, f->missed + f->untrue),
        NUMBER("MB", 1, f->megabytes));
}

/* The bits of the scalar kernel, if every kernel says the same. NULL, with a message, if not. */
static uint64_t *find_truth(const work *w)
{
    uint64_t *const first = asked_allocate(w->words, sizeof *first), *const other = asked_allocate(w->words, sizeof *other);
    const char *kernel;
    bool is = !tribox_voxelize(w->soup, &w->grid, NULL, &(tribox_options){.kernel = "scalar"}, first, NULL);
    for (size_t k = 0; is && (kernel = tribox_kernel_list(k)) != NULL; k++) {
        memset(other, 0, w->words * sizeof *other);
        is = !tribox_voxelize(w->soup, &w->grid, NULL, &(tribox_options){.kernel = kernel}, other, NULL) &&
             !memcmp(first, other, w->words * sizeof *other);
    }
    return is || message_failure("the kernels differ; nothing is timed") == EXIT_CODE_OK ? first : NULL;
}

/* Logarithms of the ratios to the first way, over scenes, for each number of cells. */
static double logarithm[ASKED_CELLS][WAYS_MOST];

static bool ask_grid(asked *q, const scene *at, ways of, size_t n)
{
    const uint32_t along = q->cells[n];
    const uint64_t rounds = asked_number(q, OPTION_ROUNDS, asked_has(q, OPTION_QUICK) ? 1 : 5);
    const unsigned limit = (unsigned)asked_number(q, OPTION_LIMIT, 5);
    const timing_job *const job = at->work.jobs;
    work w = {.soup = &job->soup, .triangles = job->triangles, .grid = scene_grid(at, along), .options = {.kernel = q->kernel}};
    found least[WAYS_MOST] = {{0}}, f;
    w.tile = (uint32_t)q->number[OPTION_TILE];
    w.all = (size_t)w.grid.size[0] * w.grid.size[1] * w.grid.size[2];
    w.words = tribox_window_words(w.grid.size);
    if (of.has_truth && (w.truth = find_truth(&w)) == NULL)
        return false;
    for (uint64_t round = 0; round < rounds; round++)
        for (size_t k = 0; k < of.count; k++) {
            if (!is_asked(q, &of.list[k], w.all) || (round && !(least[k].fresh < TIMED_ONCE)))
                continue;
            if (!find_apart(&of.list[k], &w, limit, &f))
                return message_failure("%s in %u cells, %s: no answer; is there memory for it?", at->name, (unsigned)along,
                                       of.list[k].name) == EXIT_CODE_OK;
            f.fresh = round ? fmin(f.fresh, least[k].fresh) : f.fresh;
            f.warm = round ? fmin(f.warm, least[k].warm) : f.warm;
            f.listing = round ? fmin(f.listing, least[k].listing) : f.listing;
            least[k] = f;
        }
    if (!are_right(q, of, &w, least))
        return false;
    printout_table(&q->out, "%s, %zu triangles, in %u x %u x %u cells; CPU time", at->name, w.soup->count, w.grid.size[0],
                   w.grid.size[1], w.grid.size[2]);
    for (size_t k = 0; k < of.count; k++) {
        if (is_asked(q, &of.list[k], w.all))
            tell(&q->out, at->name, along, &w, &of.list[k], &least[k], &least[0]);
        logarithm[n][k] += least[0].warm > 0 && least[k].warm > 0 ? log(least[k].warm / least[0].warm) : (double)NAN;
    }
    return true;
}

static bool ask_scene(asked *q, const scene *at, ways of)
{
    bool is_right = true;
    for (size_t n = 0; is_right && n < q->cell_counts; n++) {
        void *const mark = asked_mark();
        is_right = ask_grid(q, at, of, n);
        asked_release(mark);
    }
    return is_right;
}

static bool ask_bits(asked *q, scene *at) { return ask_scene(q, at, to_bits); }

static bool ask_answers(asked *q, scene *at) { return ask_scene(q, at, to_answers); }

static void tell_means(asked *q, ways of)
{
    char cells[ASKED_CELLS][16];
    if (q->text[OPTION_FILTER])
        return;
    printout_table(&q->out, "geometric means over %zu scenes, times %s, by cells", q->scenes, of.list[0].name);
    for (size_t k = 1; k < of.count; k++) {
        ADD(&q->out, TEXT("way", of.list[k].name));
        for (size_t n = 0; n < q->cell_counts; n++) {
            snprintf(cells[n], sizeof cells[n], "%u", q->cells[n]);
            ADD(&q->out, NUMBER(cells[n], 3, exp(logarithm[n][k] / (double)q->scenes)));
        }
        printout_row(&q->out);
    }
}

/* cells: what there is to choose from, without --quick and with it. */
static bool answer(asked *q, const char *const cells[2], unsigned kinds, scene_answer *ask, ways of)
{
    if (!q->cell_counts)
        asked_cells(q, cells[asked_has(q, OPTION_QUICK)]);
    if (!scenes_ask(q, kinds, 0, ask))
        return false;
    tell_means(q, of);
    return true;
}

static bool answer_voxels(asked *q) { return answer(q, (const char *const[]){"256,1024", "128"}, SCENES_MADE, ask_bits, to_bits); }

static bool answer_grids(asked *q) { return answer(q, (const char *const[]){"64,256,1024", "64,128"}, 0, ask_answers, to_answers); }

const bench_question question_voxels = {
    .name = "voxels",
    .asks = "How fast are soups voxelized, beside the paper's test for each cell, Schwarz and Seidel 2010, and reading them?",
    .options = 1u << OPTION_CELLS | 1u << OPTION_KERNEL | 1u << OPTION_FILTER | 1u << OPTION_LIMIT | 1u << OPTION_NO_SCENES |
               1u << OPTION_QUICK,
    .takes_meshes = true,
    .answer = answer_voxels};
const bench_question question_grids = {.name = "grids",
                                       .asks = "What do bits, cells, ids, lists, bricks and filling cost, in time and memory?",
                                       .options = 1u << OPTION_CELLS | 1u << OPTION_TILE | 1u << OPTION_KERNEL |
                                                  1u << OPTION_FILTER | 1u << OPTION_QUICK,
                                       .takes_meshes = true,
                                       .needs_meshes = true,
                                       .answer = answer_grids};
