/* voxelize_work.c - opens a mesh or a partition, lays the grid, chooses the way, and reports. */
#define _POSIX_C_SOURCE 200809L
#include "voxelize_work.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/clock.h"
#include "console/interrupt.h"
#include "console/message.h"
#include "console/system.h"
#include "files/files.h"
#include "partition/partition_make.h"
#include "read/mesh_file.h"

/*
 * Whether all cells at once take less time than tile by tile, and are the same: up to 2 MB of bits, which a core has at hand, and
 * with many triangles up to what the last cache holds (bench/findings.md).
 */
static bool is_grid_small(const voxelize_request *r, const tribox_grid *grid, size_t triangles)
{
    static const double at_hand = 0x1p21, cached = 0x1p25, per_triangle = 16;
    if (r->has_shard || r->result.options.has_ids || r->test.accuracy != TRIBOX_EXACT)
        return false;
    const double bytes = ceil(grid->size[0] / 64.0) * grid->size[1] * grid->size[2] * sizeof(uint64_t);
    const bool is_faster = bytes <= at_hand || bytes <= per_triangle * (double)triangles;
    return is_faster && bytes <= cached && bytes < (double)memory_available() / 2;
}

/* Formats of all cells take the whole grid, and so do small ones; all else goes tile by tile. */
static bool takes_whole(const voxelize_request *r, const voxelize_input *in)
{
    const bool is_dense = !r->is_count && volume_kind_of(r->result.format) == VOLUME_DENSE && !r->result.options.has_ids;
    const bool is_small = in->mesh && (is_dense || is_grid_small(r, &in->cells.grid, in->mesh->triangles));
    return r->has_colours || r->is_thin || is_small;
}

voxel_task voxelize_task(const voxelize_request *r, const voxelize_input *in)
{
    static const tribox_soup nothing = {.count = 0};
    voxel_task task = voxel_task_of_soup(in->mesh ? &in->mesh->soup : &nothing, &in->cells.grid, &r->test);
    if (in->mesh && in->mesh->is_double) {
        task.soup = NULL;
        task.mesh = &in->mesh->doubles;
        task.count = task.mesh->count;
    }
    return task;
}

void voxelize_note_rows(size_t odd_rows, voxelize_answer *a)
{
    a->odd_rows = odd_rows;
    if (odd_rows)
        message_say("warning: %s is not closed: %zu rows of cells cross it an odd number of times, and may be filled wrongly; "
                    "--fill outside does not depend on this",
                    triangle_file_name(a->r->from.mesh_path), odd_rows);
}

static int answer(const voxelize_request *r, const voxelize_input *in, voxelize_files *files, voxelize_answer *a)
{
    a->cells = in->cells;
    if (r->result.format && r->result.format->writer->check_grid) {
        const int code = r->result.format->writer->check_grid(r->result.out_path, &in->cells.grid);
        if (code)
            return code;
    }
    volume_note_shift(r->result.format, r->result.out_path, &in->cells);
    return takes_whole(r, in) ? voxelize_whole(r, in, files, a) : voxelize_by_tiles(r, in, files, a);
}

static int open_files(const voxelize_request *r, const voxelize_input *in, voxelize_answer *a)
{
    voxelize_files files = {.out = {.path = NULL}};
    int code = file_out_open(&files.out, r->result.out_path);
    if (!code)
        code = file_out_open(&files.picture, r->result.preview_path);
    if (!code)
        code = answer(r, in, &files, a);
    file_out_drop(&files.picture);
    file_out_drop(&files.out);
    return code;
}

static int work_on_colours(const voxelize_request *r, voxelize_input *in, voxelize_answer *a)
{
    mesh_colours colours;
    const file_out_names names = result_names(&r->result);
    int code = mesh_colours_read(r->from.mesh_path, r->from.format, in->mesh->triangles, &names, true, &colours);
    if (code)
        return code;
    in->colours = &colours;
    a->colours = colours.from;
    code = open_files(r, in, a);
    mesh_colours_free(&colours);
    return code;
}

/* The mesh itself, whose name is known, was checked before it was read. */
static int check_opened(const result_request *result, const char *opened)
{
    const file_out_names names = result_names(result);
    int code = EXIT_CODE_OK;
    for (const char *name = opened; !code && name && *name; name += strlen(name) + 1)
        code = file_out_check(&names, "file of its data", &name, 1);
    return code;
}

static int work_in_memory(const voxelize_request *r, const mesh *m, const mesh_shift *shift, voxelize_answer *a)
{
    const char *const name = triangle_file_name(r->from.mesh_path);
    voxelize_input in = {.mesh = m};
    int code = check_opened(&r->result, m->opened);
    if (code)
        return code;
    mesh_warn(name, m);
    a->triangles = m->triangles;
    a->not_finite = (size_t)m->seen.not_finite;
    a->is_double = m->is_double;
    a->is_shifted = shift->is_wanted;
    if (shift->is_wanted)
        memcpy(in.cells.shift, shift->by, sizeof shift->by);
    code = r->result.options.has_ids ? partition_check_numbers(name, m->triangles) : EXIT_CODE_OK;
    if (!code)
        code = grid_choose(&r->from.choice, name, m, &in.cells.grid);
    return code ? code : r->has_colours ? work_on_colours(r, &in, a) : open_files(r, &in, a);
}

static int work_on_partition(const voxelize_request *r, const char *const *paths, size_t count, voxelize_answer *a)
{
    partition p;
    int code = partition_open(&p, paths, count);
    if (code)
        return code;
    const voxelize_input in = {.partition = &p, .cells = partition_voxels(&p.header)};
    a->triangles = (size_t)p.header.triangles;
    a->not_finite = (size_t)p.header.not_finite;
    a->is_double = p.header.position_bytes == sizeof(double);
    a->is_shifted = r->from.shift.is_wanted || voxels_are_shifted(&in.cells);
    if (r->result.options.has_ids && !p.header.number_bytes)
        code = message_failure("%s: has no numbers of its triangles; make it with 'tribox partition --ids', or leave out --ids",
                               paths[0]);
    if (!code)
        code = open_files(r, &in, a);
    partition_close(&p);
    return code;
}

/* ----------------------------------------------------------------------------------------------------------------- sorted first */

/* Where the triangles of a mesh that is larger than memory are sorted into a partition that is gone when it was used. */
typedef struct sorted_place {
    const voxelize_request *r;
    char path[4096], told[4200];
    folder_out pipe; /* the triangles of a pipe, until they are sorted */
    partition_answer made;
} sorted_place;

/* Tiles have exact cells, and lack what is asked of the mesh itself. */
bool voxelize_can_sort(const voxelize_request *r)
{
    return !r->has_colours && !r->is_thin && (r->fill == FILL_NONE || r->fill == FILL_OUTSIDE) &&
           r->test.accuracy == TRIBOX_EXACT && (!r->test.axes || r->test.axes == TRIBOX_AXES_ALL);
}

/* Some of what is there is left to the cells. */
static uint64_t memory_of(const voxelize_request *r) { return r->memory ? r->memory : memory_available() / 4 * 3; }

/* The mesh and its lists. The two numbers for PLY, whose faces are as short as three bytes a vertex and a list, are bounds. */
static uint64_t bytes_of(const triangle_file *file, uint64_t size, bool is_shifted)
{
    enum { LISTS = 8, NUMBERS = 9, OF_PLY = 4, OF_SHIFTED_PLY = 10 };
    const uint64_t number = file->format == TRIANGLES_F64 ? sizeof(double) : sizeof(float);
    return file->stream ? file->promised * (NUMBERS * number + LISTS + (is_shifted ? NUMBERS * sizeof(double) : 0))
                        : size * (is_shifted ? OF_SHIFTED_PLY : OF_PLY);
}

/* Whether a file is larger than memory is to hold, and can be sorted. A pipe would lose what is looked at. Returns an exit_code. */
static int find_whether_due(const voxelize_request *r, bool *is_due)
{
    const char *const path = r->from.mesh_path;
    file_about about;
    triangle_file file;
    *is_due = false;
    if (!voxelize_can_sort(r) || file_out_is_stdout(path) || !named_file_about(path, &about) || about.kind != FILE_KIND_REGULAR)
        return EXIT_CODE_OK;
    const int code = triangle_file_open(path, r->from.format, &file);
    if (!code && (file.stream || mesh_is_binary_ply(path)))
        *is_due = bytes_of(&file, about.size, r->from.shift.is_wanted) > memory_of(r);
    triangle_file_close(&file);
    return code;
}

/* TMPDIR, or beside the file that is written, or where the system has such. To be freed; NULL without memory. */
static char *choose_folder(const voxelize_request *r)
{
    const char *const chosen = getenv("TMPDIR"), *const out = r->result.out_path;
    if ((chosen && *chosen) || !out || file_out_is_stdout(out))
        return new_file_passing_folder();
    const size_t length = named_file_folder(out);
    char *const folder = malloc(length + sizeof ".");
    if (folder)
        snprintf(folder, length + sizeof ".", "%.*s%s", (int)length, out, length ? "" : ".");
    return folder;
}

static int name_place(sorted_place *p, const voxelize_request *r)
{
    char *const folder = choose_folder(r);
    if (!folder)
        return message_failure("out of memory");
    const bool fits = snprintf(p->path, sizeof p->path, "%s/tribox.tiles", folder) < (int)sizeof p->path;
    snprintf(p->told, sizeof p->told, "the temporary partition in %s (TMPDIR names the folder)", folder);
    if (fits && !r->result.is_quiet)
        message_say("note: %s: larger than the memory for it, so its triangles are sorted into a temporary partition in %s",
                    triangle_file_name(r->from.mesh_path), folder);
    free(folder);
    return fits ? EXIT_CODE_OK : message_failure("%s: its name is too long", p->told);
}

/* Of a pipe. */
static int put(void *data, bool is_double, const void *bytes, size_t size)
{
    sorted_place *const p = data;
    int code = *p->path ? EXIT_CODE_OK : name_place(p, p->r);
    if (!code && !p->pipe.beside)
        code = folder_out_open(&p->pipe, p->path, p->told,
                               (const char *const[FOLDER_FILES]){is_double ? "triangles.f64" : "triangles.f32"});
    errno = 0;
    return code || fwrite(bytes, 1, size, p->pipe.file[0]) == size ? code : folder_out_failure(&p->pipe, errno);
}

/* Of a pipe this is found while it is read. The place is made, and to be dropped. */
static mesh_overflow overflow_into(const voxelize_request *r, sorted_place *p)
{
    enum { OF_SHIFTED = 3 }; /* which become doubles */
    *p = (sorted_place){.r = r};
    return (mesh_overflow){.memory = memory_of(r) / (r->from.shift.is_wanted ? OF_SHIFTED : 1), .put = put, .data = p};
}

/* Sorts the file, or what came of the pipe: the partition is made.out.beside. Returns an exit_code; dropping is due in any case. */
static int sort_mesh(sorted_place *p)
{
    const voxelize_request *const r = p->r;
    int code = *p->path ? EXIT_CODE_OK : name_place(p, r);
    partition_request want = {.from = r->from,
                              .count = 1,
                              .threads = r->threads,
                              .memory = r->memory,
                              .out_path = p->path,
                              .told = p->told,
                              .name = triangle_file_name(r->from.mesh_path),
                              .has_ids = r->result.options.has_ids};
    if (!code && p->pipe.beside) {
        code = folder_out_finish(&p->pipe);
        want.from.mesh_path = p->pipe.name[0];
        want.from.format = TRIANGLES_OTHER; /* its name has it */
    }
    want.paths = &want.from.mesh_path;
    p->made = (partition_answer){.r = &want};
    if (!code)
        code = partition_make(&p->made);
    p->made.r = NULL;
    folder_out_drop(&p->pipe);
    return code;
}

/* -------------------------------------------------------------------------------------------------------------------------- all */

static int work_sorted(const voxelize_request *r, sorted_place *place, voxelize_answer *a)
{
    const int code = sort_mesh(place);
    return code ? code : work_on_partition(r, (const char *const[]){place->made.out.beside}, 1, a);
}

static int work_on_mesh(const voxelize_request *r, voxelize_answer *a)
{
    mesh m;
    mesh_shift shift = r->from.shift;
    sorted_place place;
    mesh_overflow over = overflow_into(r, &place);
    const mesh_request from = {.path = r->from.mesh_path,
                               .format = r->from.format,
                               .may_be_empty = grid_is_fixed(&r->from.choice),
                               .threads = r->threads,
                               .over = voxelize_can_sort(r) ? &over : NULL};
    int code = find_whether_due(r, &over.is_used);
    if (!code && !over.is_used)
        code = mesh_read_shifted(&from, &shift, &m);
    if (!code && over.is_used) {
        code = work_sorted(r, &place, a);
    } else if (!code) {
        code = work_in_memory(r, &m, &shift, a);
        mesh_free(&m);
    }
    folder_out_drop(&place.made.out);
    folder_out_drop(&place.pipe);
    return code;
}

/* What a run that is interrupted says, while it reads and sorts, too. */
static void advise(const voxelize_request *r)
{
    char advice[128] = "nothing was written; run it again";
    if (r->has_shard)
        snprintf(advice, sizeof advice, "nothing was written; run shard %u of %u again, parts that are there stay good", r->shard,
                 r->shards);
    interrupt_advise(file_out_is_stdout(r->result.out_path) ? "the output is not whole; run it again" : advice);
}

int voxelize_work(const voxelize_request *r)
{
    voxelize_answer a = {.r = r};
    const double start = clock_seconds();
    advise(r);
    if (r->result.format && r->result.format->writer->begin)
        r->result.format->writer->begin();
    const int code = partition_is_folder(r->from.mesh_path) ? work_on_partition(r, r->paths, r->count, &a) : work_on_mesh(r, &a);
    a.total_seconds = clock_seconds() - start;
    return code || !r->result.has_summary ? code : voxelize_report(&a);
}
