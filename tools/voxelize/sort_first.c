/* sort_first.c - sorts a mesh that memory does not hold into a partition that passes; a pipe goes into a file before that. */
#define _POSIX_C_SOURCE 200809L
#include "sort_first.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/system.h"
#include "files/files.h"
#include "partition/partition_make.h"
#include "read/mesh_file.h"
#include "write/file_out.h"

/* Tiles have exact cells, and lack what is asked of the mesh itself. */
bool sort_first_can(const voxelize_request *r)
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

/* Regular files alone are looked at: a pipe would lose what is read of it. */
int sort_first_is_due(const voxelize_request *r, bool *is_due)
{
    const char *const path = r->from.mesh_path;
    file_about about;
    triangle_file file;
    *is_due = false;
    if (!sort_first_can(r) || file_out_is_stdout(path) || !named_file_about(path, &about) || about.kind != FILE_KIND_REGULAR)
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
    if (folder) {
        memcpy(folder, out, length);
        strcpy(folder + length, length ? "" : ".");
    }
    return folder;
}

static int name_place(sorted_place *p, const voxelize_request *r)
{
    static const char what[] = "the temporary partition in %s (TMPDIR names the folder)", name[] = "/tribox.tiles";
    char *const folder = choose_folder(r);
    const size_t length = folder ? strlen(folder) : 0;
    p->path = folder ? malloc(length + sizeof name) : NULL;
    p->told = folder ? malloc(length + sizeof what) : NULL;
    if (p->path && p->told) {
        strcat(strcpy(p->path, folder), name);
        snprintf(p->told, length + sizeof what, what, folder);
    }
    if (p->told && !r->result.is_quiet)
        message_say("note: %s: larger than the memory for it, so its triangles are sorted into a temporary partition in %s",
                    triangle_file_name(r->from.mesh_path), folder);
    free(folder);
    return p->path && p->told ? EXIT_CODE_OK : message_failure("out of memory");
}

/* Of a pipe. */
static int put(void *data, bool is_double, const void *bytes, size_t size)
{
    sorted_place *const p = data;
    int code = p->path ? EXIT_CODE_OK : name_place(p, p->r);
    if (!code && !p->pipe.beside)
        code = folder_out_open(&p->pipe, p->path, p->told,
                               (const char *const[FOLDER_FILES]){is_double ? "triangles.f64" : "triangles.f32"});
    errno = 0;
    return code || fwrite(bytes, 1, size, p->pipe.file[0]) == size ? code : folder_out_failure(&p->pipe, errno);
}

mesh_overflow sort_first_overflow(const voxelize_request *r, sorted_place *p)
{
    enum { OF_SHIFTED = 3 }; /* which become doubles */
    *p = (sorted_place){.r = r};
    return (mesh_overflow){.memory = memory_of(r) / (r->from.shift.is_wanted ? OF_SHIFTED : 1), .put = put, .data = p};
}

static int sort_pipe(sorted_place *p, partition_request *want)
{
    const int code = folder_out_finish(&p->pipe);
    want->from.mesh_path = p->pipe.name[0];
    want->from.format = TRIANGLES_OTHER; /* its name has it */
    return code;
}

int sort_first(sorted_place *p)
{
    const voxelize_request *const r = p->r;
    int code = p->path ? EXIT_CODE_OK : name_place(p, r);
    partition_request want = {.from = r->from,
                              .count = 1,
                              .threads = r->threads,
                              .memory = r->memory,
                              .out_path = p->path,
                              .told = p->told,
                              .name = triangle_file_name(r->from.mesh_path),
                              .has_ids = r->result.options.has_ids,
                              .is_quiet = r->result.is_quiet};
    if (!code && p->pipe.beside)
        code = sort_pipe(p, &want);
    want.paths = &want.from.mesh_path;
    p->made = (partition_answer){.r = &want};
    if (!code)
        code = partition_make(&p->made);
    p->made.r = NULL;
    folder_out_drop(&p->pipe);
    return code;
}

void sort_first_drop(sorted_place *p)
{
    folder_out_drop(&p->made.out);
    folder_out_drop(&p->pipe);
    free(p->path);
    free(p->told);
    *p = (sorted_place){.r = NULL};
}
