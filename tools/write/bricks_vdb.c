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

#include "colours/colours.h"
#include "console/message.h"
#include "files/files.h"
#include "vdb_filter.h"
#include "volume.h"

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

/* Begun while the mesh is read, tried when there is a grid, and then at work for one file. */
static struct {
    pid_t child; /* 0: it has ended */
    FILE *to, *from;
    char line[256]; /* the last that it said, but for that it is ready */
    vdb_grid grid;
} filter;

static rgb_curve curve;

/* In a build it is beside the program, and VDB_FILTER says where it is installed, as seen from the program. */
static void find_filter(char path[FILENAME_MAX])
{
    static const char *const places[] = {"tribox-vdb", VDB_FILTER};
    char self[FILENAME_MAX] = "";
    const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    const char *const slash = length > 0 ? strrchr(self, '/') : NULL;
    const int folder = slash ? (int)(slash + 1 - self) : 0;
    for (int n = 0; n < 2; n++) {
        snprintf(path, FILENAME_MAX, "%.*s%s", places[n][0] == '/' ? 0 : folder, self, places[n]);
        if (!access(path, X_OK))
            return;
    }
}

/* A pipe whose ends are open in this process alone, but for copies that a child is given. */
static bool make_pipe(int ends[2])
{
    return !pipe(ends) && fcntl(ends[0], F_SETFD, FD_CLOEXEC) >= 0 && fcntl(ends[1], F_SETFD, FD_CLOEXEC) >= 0;
}

/* Returns 0, or errno. */
static int start(const char *path)
{
    int to[2] = {-1, -1}, from[2] = {-1, -1};
    char name[] = "tribox-vdb", *words[] = {name, NULL};
    posix_spawn_file_actions_t actions;
    if (!make_pipe(to) || !make_pipe(from) || (errno = posix_spawn_file_actions_init(&actions)))
        return errno; /* the program goes on to its end */
    posix_spawn_file_actions_adddup2(&actions, to[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, from[1], STDERR_FILENO);
    new_file_fail_quietly(true); /* here where it has ended, and there, which inherits it */
    const int reason = posix_spawn(&filter.child, path, &actions, NULL, words, environ);
    filter.child = reason ? 0 : filter.child;
    posix_spawn_file_actions_destroy(&actions);
    close(to[0]);
    close(from[1]);
    filter.to = fdopen(to[1], "wb");
    filter.from = fdopen(from[0], "r");
    if (filter.to)
        setvbuf(filter.to, NULL, _IOFBF, 1 << 16); /* what a pipe holds */
    return reason ? reason : filter.to && filter.from ? 0 : ENOMEM;
}

/* Returns how it ended, as waitpid tells it. */
static int end(void)
{
    int status = 0;
    while (filter.child && waitpid(filter.child, &status, 0) < 0 && errno == EINTR)
        continue;
    filter.child = 0;
    return status;
}

static void drop_vdb(brick_out *out)
{
    (void)out;
    if (filter.to)
        fclose(filter.to);
    if (filter.from)
        fclose(filter.from);
    end();
    filter.to = filter.from = NULL;
}

static void begin_early(void)
{
    char path[FILENAME_MAX];
    find_filter(path);
    if (!filter.to && start(path))
        drop_vdb(NULL); /* the check says why not */
}

/* Reads what it says until it is ready or ends. */
static bool hear_ready(void)
{
    char line[sizeof filter.line];
    while (fgets(line, sizeof line, filter.from)) {
        if (!strcmp(line, VDB_READY))
            return true;
        memcpy(filter.line, line, sizeof line);
    }
    return false;
}

/* After all has been sent, or where nobody takes it. file: NULL where none is written. Returns an exit_code. */
static int hear_end(bool is_all, const char *path, const file_out *file)
{
    char *const line = filter.line;
    fclose(filter.to);
    filter.to = NULL;
    hear_ready();
    const int status = end();
    line[strcspn(line, "\n")] = '\0';
    if (is_all && !status)
        return EXIT_CODE_OK;
    if (!WIFEXITED(status) || !line[0])
        return message_failure("%s: OpenVDB failed: it broke off, most likely for lack of memory; write .npz", path);
    if (file && !strncmp(line, VDB_ERRNO, strlen(VDB_ERRNO))) {
        errno = atoi(line + strlen(VDB_ERRNO));
        return file_out_failure(file);
    }
    return message_failure("%s: %s%s; write .npz", path, WEXITSTATUS(status) == 127 ? "cannot load what writes .vdb: " : "", line);
}

/* target: the file's name until it is kept; "" to try the grid alone. Returns an exit_code. */
static int begin_grid(const vdb_grid *grid, const char *target, const char *path, const file_out *file)
{
    char program[FILENAME_MAX];
    find_filter(program);
    const int reason = filter.to ? 0 : start(program);
    int code = reason ? message_failure("%s: cannot start %s, which writes .vdb: %s; write .npz", path, program, strerror(reason))
                      : EXIT_CODE_OK;
    if (!code) {
        filter.grid = *grid;
        filter.grid.path_bytes = (uint32_t)strlen(target);
        fwrite(&filter.grid, sizeof filter.grid, 1, filter.to);
        fwrite(target, 1, filter.grid.path_bytes, filter.to);
        fflush(filter.to); /* whether it arrives the answer says */
        code = hear_ready() ? EXIT_CODE_OK : hear_end(false, path, file);
    }
    if (code)
        drop_vdb(NULL);
    return code;
}

/* Before the work that what cannot be written would waste. */
static int check_grid(const char *path, const tribox_grid *grid)
{
    const vdb_grid tried = grid_of(&(voxels){.grid = *grid}, &(volume_options){.is_mask = false});
    if (isinf(tried.unit))
        return message_failure("%s: cells of %.9g x %.9g x %.9g are too small for .vdb; write .npz", path, grid->cell[0],
                               grid->cell[1], grid->cell[2]);
    const int code = begin_grid(&tried, "", path, NULL);
    if (!code && tried.unit > 1)
        message_say("note: %s has lengths of the mesh times %.0f, as OpenVDB takes no cells as small as these", path, tried.unit);
    return code;
}

static int open_vdb(brick_out *out)
{
    const file_out *const file = out->file;
    const vdb_grid grid = grid_of(&out->cells, &out->options);
    curve = rgb_curve_make();
    return begin_grid(&grid, file->beside ? file->beside : file->path, file->path, file);
}

static int put_vdb(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    FILE *const to = filter.to;
    float light[512][3];
    vdb_brick brick = {.at = {at[0], at[1], at[2]}};
    memcpy(brick.bits, bits, sizeof brick.bits);
    if (filter.grid.has_colours || filter.grid.has_ids)
        brick.values = (uint32_t)voxels_count(bits, 8);
    fwrite(&brick, sizeof brick, 1, to);
    if (filter.grid.has_labels)
        fwrite(out->inside, sizeof *bits, 8, to);
    if (filter.grid.has_colours) {
        const rgb *const colours = cell_colours_of_brick(out->cells.colours, at);
        for (uint32_t n = 0; n < brick.values; n++)
            for (int c = 0; c < 3; c++)
                light[n][c] = curve.light[colours[n].at[c]];
        fwrite(light, sizeof *light, brick.values, to);
    } else if (filter.grid.has_ids) {
        fwrite(out->ids, sizeof *out->ids, brick.values, to);
    }
    return ferror(to) ? hear_end(false, out->file->path, out->file) : EXIT_CODE_OK;
}

static int end_vdb(brick_out *out, progress *bar)
{
    (void)bar;
    fwrite(&(vdb_brick){.values = VDB_LAST}, sizeof(vdb_brick), 1, filter.to);
    return hear_end(true, out->file->path, out->file);
}

const volume_writer volume_vdb = {
    .begin = begin_early, .check_grid = check_grid, .open = open_vdb, .put = put_vdb, .end = end_vdb, .drop = drop_vdb};
