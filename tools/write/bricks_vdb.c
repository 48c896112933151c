/* bricks_vdb.c - bricks as a file of OpenVDB's, by a program that knows it: tribox-vdb, of vdb_filter.cc. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "brick_out.h"
#include "colours/colours.h"
#include "console/interrupt.h"
#include "console/message.h"
#include "files/files.h"
#include "vdb_filter.h"

extern char **environ;

/*
 * OpenVDB takes no cells whose volume is below 3e-15: its lengths then are `unit` times those of the mesh, a power of ten. Infinite
 * where none would do.
 */
static double unit_of(const tribox_grid *grid)
{
    static const double volume_min = 1e-14, unit_max = 1e15;
    const double *const cell = grid->cell;
    double unit = 1;
    while (cell[0] * unit * (cell[1] * unit) * (cell[2] * unit) < volume_min)
        unit *= 10;
    return unit <= unit_max ? unit : INFINITY;
}

static vdb_grid grid_of(const voxels *v, const volume_options *options)
{
    vdb_grid grid = {.unit = unit_of(&v->grid),
                     .is_mask = options->is_mask,
                     .has_labels = options->has_labels,
                     .has_colours = v->colours != NULL,
                     .has_ids = options->has_ids};
    for (int a = 0; a < 3; a++)
        grid.origin[a] = v->grid.origin[a] + v->shift[a];
    memcpy(grid.cell, v->grid.cell, sizeof grid.cell);
    memcpy(grid.shift, v->shift, sizeof grid.shift);
    memcpy(grid.size, v->grid.size, sizeof grid.size);
    return grid;
}

static int fail(const char *path, const char *reason) { return message_failure("%s: %s; write .npz", path, reason); }

/* What the program says, and why something failed, as the middle of a line. */
enum { LINE = 256, REASON = FILENAME_MAX + LINE };

typedef struct filter {
    pid_t child; /* 0: it has ended */
    FILE *to, *from;
    char line[LINE]; /* the last that it said, but for that it is ready */
    vdb_grid grid;
} filter;

/* Begun while the mesh is read, tried when there is a grid, and then at work for one file. */
static filter *begun;

static rgb_curve curve;

static bool find_in(const char *self, int folder, const char *name, char path[FILENAME_MAX])
{
    snprintf(path, FILENAME_MAX, "%.*s%s", name[0] == '/' ? 0 : folder, self, name);
    return !access(path, X_OK);
}

/* In a build it is beside the program, and VDB_FILTER says where it is installed, as seen from the program. */
static void find_filter(char path[FILENAME_MAX])
{
    char self[FILENAME_MAX] = "";
    const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    const char *const slash = length > 0 ? strrchr(self, '/') : NULL;
    const int folder = slash ? (int)(slash + 1 - self) : 0;
    if (!find_in(self, folder, "tribox-vdb", path))
        find_in(self, folder, VDB_FILTER, path);
}

/* A pipe whose ends are open in this process alone, but for copies that a child is given. */
static bool make_pipe(int ends[2])
{
    return !pipe(ends) && fcntl(ends[0], F_SETFD, FD_CLOEXEC) >= 0 && fcntl(ends[1], F_SETFD, FD_CLOEXEC) >= 0;
}

/* Returns 0, or errno. */
static int start(filter *f, const char *path)
{
    int to[2] = {-1, -1}, from[2] = {-1, -1};
    char name[] = "tribox-vdb", *words[] = {name, NULL};
    posix_spawn_file_actions_t actions;
    if (!make_pipe(to) || !make_pipe(from) || (errno = posix_spawn_file_actions_init(&actions)))
        return errno; /* the program goes on to its end */
    posix_spawn_file_actions_adddup2(&actions, to[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, from[1], STDERR_FILENO);
    new_file_fail_quietly(true); /* here where it has ended, and there, which inherits it */
    interrupt_hold();            /* from here on who interrupts it hears a line */
    const int reason = posix_spawn(&f->child, path, &actions, NULL, words, environ);
    interrupt_release();
    f->child = reason ? 0 : f->child;
    posix_spawn_file_actions_destroy(&actions);
    close(to[0]);
    close(from[1]);
    f->to = fdopen(to[1], "wb");
    f->from = fdopen(from[0], "r");
    if (f->to)
        setvbuf(f->to, NULL, _IOFBF, 1 << 16); /* what a pipe holds */
    return reason ? reason : f->to && f->from ? 0 : ENOMEM;
}

/* Returns how it ended, as waitpid tells it. */
static int wait_for(filter *f)
{
    int status = 0;
    while (f->child && waitpid(f->child, &status, 0) < 0 && errno == EINTR)
        continue;
    f->child = 0;
    return status;
}

static void end(filter *f)
{
    if (f->to)
        fclose(f->to);
    if (f->from)
        fclose(f->from);
    wait_for(f);
    free(f);
}

static filter *begin(char reason[REASON])
{
    char path[FILENAME_MAX];
    filter *const f = calloc(1, sizeof *f);
    find_filter(path);
    const int why = f ? start(f, path) : ENOMEM;
    if (!why)
        return f;
    snprintf(reason, REASON, "cannot start %s, which writes .vdb: %s", path, strerror(why));
    if (f)
        end(f);
    return NULL;
}

/* Reads what it says until it is ready or ends. */
static bool hear_ready(filter *f)
{
    char line[LINE];
    while (fgets(line, LINE, f->from)) {
        if (!strcmp(line, VDB_READY))
            return true;
        memcpy(f->line, line, LINE);
    }
    return false;
}

/* After all has been sent, or where nobody takes it. Returns whether the file is whole; *error: of the file, or 0. */
static bool hear_end(filter *f, int *error, char reason[REASON])
{
    char *const line = f->line;
    fclose(f->to);
    f->to = NULL;
    hear_ready(f);
    const int status = wait_for(f);
    line[strcspn(line, "\n")] = '\0';
    *error = 0;
    if (!WIFEXITED(status) || !line[0])
        snprintf(reason, REASON, "OpenVDB failed: it broke off, most likely for lack of memory");
    else if (!strncmp(line, VDB_ERRNO, strlen(VDB_ERRNO)))
        *error = atoi(line + strlen(VDB_ERRNO));
    else
        snprintf(reason, REASON, "%s%s", WEXITSTATUS(status) == 127 ? "cannot load what writes .vdb: " : "", line);
    return !status;
}

static bool open_grid(filter *f, const vdb_grid *grid, const char *path, int *error, char reason[REASON])
{
    f->grid = *grid;
    f->grid.path_bytes = (uint32_t)strlen(path);
    fwrite(&f->grid, sizeof f->grid, 1, f->to);
    fwrite(path, 1, f->grid.path_bytes, f->to);
    fflush(f->to); /* whether it arrives the answer says */
    if (hear_ready(f))
        return true;
    hear_end(f, error, reason);
    return false;
}

static void begin_early(void)
{
    char reason[REASON];
    if (!begun)
        begun = begin(reason); /* the check says why not */
}

/* With what has begun. */
static bool begin_grid(const vdb_grid *grid, const char *path, int *error, char reason[REASON])
{
    *error = 0;
    if (!begun)
        begun = begin(reason);
    if (begun && open_grid(begun, grid, path, error, reason))
        return true;
    if (begun)
        end(begun);
    begun = NULL;
    return false;
}

/* Before the work that what cannot be written would waste. */
static int check_grid(const char *path, const tribox_grid *grid)
{
    int error;
    char reason[REASON];
    const vdb_grid tried = grid_of(&(voxels){.grid = *grid}, &(volume_options){.is_mask = false});
    if (isinf(tried.unit))
        return message_failure("%s: cells of %.9g x %.9g x %.9g are too small for .vdb; write .npz", path, grid->cell[0],
                               grid->cell[1], grid->cell[2]);
    if (!begin_grid(&tried, "", &error, reason))
        return fail(path, reason);
    if (tried.unit > 1)
        message_say("note: %s has lengths of the mesh times %.0f, as OpenVDB takes no cells as small as these", path, tried.unit);
    return EXIT_CODE_OK;
}

static int fail_out(const brick_out *out, int error, const char *reason)
{
    errno = error;
    return error ? file_out_failure(out->file) : fail(out->file->path, reason);
}

static int open_vdb(brick_out *out)
{
    int error;
    char reason[REASON];
    curve = rgb_curve_make();
    const vdb_grid grid = grid_of(&out->cells, &out->options);
    if (!begin_grid(&grid, out->file->beside ? out->file->beside : out->file->path, &error, reason))
        return fail_out(out, error, reason);
    out->state = begun;
    begun = NULL;
    return EXIT_CODE_OK;
}

/* As light. Returns how many. */
static uint32_t find_colours(const cell_colours *c, const uint32_t at[3], const uint64_t bits[8], float (*to)[3])
{
    const rgb *const from = cell_colours_of_brick(c, at);
    const uint32_t cells = (uint32_t)voxels_count(bits, 8);
    for (uint32_t n = 0; n < cells; n++)
        for (int a = 0; a < 3; a++)
            to[n][a] = curve.light[from[n].at[a]];
    return cells;
}

static int put_vdb(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    enum { CELLS = 512 };
    int error;
    char reason[REASON];
    float colours[CELLS][3];
    filter *const f = out->state;
    vdb_brick brick = {.at = {at[0], at[1], at[2]}};
    memcpy(brick.bits, bits, sizeof brick.bits);
    if (f->grid.has_colours)
        brick.values = find_colours(out->cells.colours, at, bits, colours);
    else if (f->grid.has_ids)
        brick.values = (uint32_t)voxels_count(bits, 8);
    fwrite(&brick, sizeof brick, 1, f->to);
    if (f->grid.has_labels)
        fwrite(out->inside, sizeof *bits, 8, f->to);
    if (f->grid.has_colours)
        fwrite(colours, sizeof colours[0], brick.values, f->to);
    else if (f->grid.has_ids)
        fwrite(out->ids, sizeof out->ids[0], brick.values, f->to);
    if (!ferror(f->to))
        return EXIT_CODE_OK;
    hear_end(f, &error, reason);
    return fail_out(out, error, reason);
}

static int end_vdb(brick_out *out, progress *bar)
{
    int error;
    char reason[REASON];
    filter *const f = out->state;
    (void)bar;
    fwrite(&(vdb_brick){.values = VDB_LAST}, sizeof(vdb_brick), 1, f->to);
    return hear_end(f, &error, reason) ? EXIT_CODE_OK : fail_out(out, error, reason);
}

static void drop_vdb(brick_out *out) { end(out->state); }

static const brick_writer bricks = {.open = open_vdb, .put = put_vdb, .end = end_vdb, .drop = drop_vdb};

const volume_writer volume_vdb = {.begin = begin_early, .check_grid = check_grid, .bricks = &bricks};
