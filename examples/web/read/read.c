/*
 * read.c - the page's files by the readers of the program: a file is bytes in memory, and threads, bars and terminals there are
 * none. Calls go: read_room, whose bytes the page fills, then read_mesh; then read_triangles, or read_message where it failed.
 */
#define _POSIX_C_SOURCE 200809L
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/system.h"
#include "console/message.h"
#include "files/files.h"
#include "read/mesh.h"
#include "read/mesh_file.h"

__attribute__((import_module("page"), import_name("tell"))) void page_tell(double done);

static char *bytes;
static size_t size;
static char message[1024];
static mesh made;

#define EXPORTED(name) __attribute__((export_name(#name))) name
char *EXPORTED(read_room)(size_t bytes_wanted);
size_t EXPORTED(read_mesh)(const char *name);
float *EXPORTED(read_triangles)(void);
const char *EXPORTED(read_message)(void);

char *read_room(size_t bytes_wanted)
{
    size = bytes_wanted;
    bytes = malloc(size + 1);
    return bytes;
}

size_t read_mesh(const char *name)
{
    message[0] = '\0';
    return mesh_read(name, &made) ? 0 : made.soup.count;
}

float *read_triangles(void)
{
    float *const to = malloc(9 * made.soup.count * sizeof *to);
    for (size_t t = 0; to && t < made.soup.count; t++)
        for (int v = 0; v < 3; v++) {
            to[9 * t + 3 * v] = made.soup.x[v][t];
            to[9 * t + 3 * v + 1] = made.soup.y[v][t];
            to[9 * t + 3 * v + 2] = made.soup.z[v][t];
        }
    return to;
}

const char *read_message(void) { return message; }

/* Vertex `corner` of the triangles, if there is one. */
static bool find_vertex(const tribox_mesh *from, size_t corner, const char **at)
{
    const size_t number_bytes = from->position_bytes ? from->position_bytes : sizeof(float);
    uint32_t vertex = (uint32_t)corner;
    if (from->indices)
        memcpy(&vertex, (const char *)from->indices + sizeof vertex * corner, sizeof vertex);
    *at = (const char *)from->positions + (from->stride ? from->stride : 3 * number_bytes) * vertex;
    return vertex < from->vertices;
}

/* What the readers take of the library, without its kernels: for indices of 32 bits, or none, and no origin. */
tribox_status tribox_mesh_to_soup(const tribox_mesh *from, const double *origin, size_t first, size_t count,
                                  const tribox_options *options, float *const x[3], float *const y[3], float *const z[3])
{
    float *const *const to[3] = {x, y, z};
    (void)origin, (void)options;
    for (size_t corner = 0; corner < 3 * count; corner++) {
        const char *at;
        if (!find_vertex(from, 3 * first + corner, &at))
            return TRIBOX_BAD_VERTEX;
        for (int a = 0; a < 3; a++) {
            float single;
            double wide;
            memcpy(&single, at + sizeof single * (size_t)a, sizeof single);
            if (from->position_bytes == sizeof wide) {
                memcpy(&wide, at + sizeof wide * (size_t)a, sizeof wide);
                single = (float)wide;
            }
            to[a][corner % 3][corner / 3] = single;
        }
    }
    return TRIBOX_OK;
}

int message_failure(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    vsnprintf(message, sizeof message, format, values);
    va_end(values);
    return EXIT_CODE_FAILURE;
}

int message_status(tribox_status status) { return status ? message_failure("%s", tribox_status_text(status)) : EXIT_CODE_OK; }

void reading_begin(void) {}
void reading_tell(double done) { page_tell(done); }
void reading_end(void) {}

FILE *named_file_open(const char *path, const char *mode)
{
    (void)path;
    return fmemopen(bytes, size, mode);
}

bool named_file_about(const char *path, file_about *about)
{
    (void)path;
    *about = (file_about){.kind = FILE_KIND_REGULAR, .size = size};
    return true;
}

bool named_file_about_open(FILE *stream, file_about *about)
{
    (void)stream;
    return named_file_about(NULL, about);
}

bool named_file_read_at(FILE *stream, uint64_t offset, void *to, size_t wanted, size_t *got)
{
    (void)stream;
    const size_t at = offset < size ? (size_t)offset : size;
    *got = wanted < size - at ? wanted : size - at;
    memcpy(to, bytes + at, *got);
    return true;
}

uint64_t memory_available(void) { return UINT64_MAX; }

void *pages_take(size_t room)
{
    void *const taken = aligned_alloc(64, (room + 63) / 64 * 64);
    return taken ? memset(taken, 0, room) : NULL;
}

void pages_free(void *room, size_t taken)
{
    (void)taken;
    free(room);
}

int crew_do(const crew_work *work, void *data)
{
    void *const place = work->place_bytes ? calloc(1, work->place_bytes) : data;
    int code = place && (!work->begin || work->begin(data, place)) ? 0 : MESSAGE_NO_MEMORY;
    for (size_t n = 0; !code && (work->find ? work->find(data, place, n) : n < work->count); n++) {
        code = work->step(data, place, n);
        code = code || !work->tell ? code : work->tell(data, place, n);
    }
    if (place && work->end)
        work->end(place);
    if (work->place_bytes)
        free(place);
    return code;
}
