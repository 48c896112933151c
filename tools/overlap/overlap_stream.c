/* overlap_stream.c - reads a block of triangles, tests it, lists it and forgets it. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>

#include "console/clock.h"
#include "read/mesh.h"
#include "console/message.h"
#include "overlap.h"
#include "console/progress.h"
#include "console/terminal.h"
#include "report.h"

/* A block of the file: as nine streams of floats, or as doubles. */
typedef struct block {
    float coordinates[9][TRIANGLE_BLOCK];
    float *streams[9]; /* x of the three vertices, y, z */
    double positions[9 * TRIANGLE_BLOCK];
    asked_triangles triangles;
    uint64_t first_not_finite; /* among all triangles of the file */
    masks bits;
} block;

static void point_into(block *b)
{
    tribox_soup *const soup = &b->triangles.soup;
    b->triangles.doubles = (tribox_mesh){.positions = b->positions, .position_bytes = sizeof *b->positions};
    for (int k = 0; k < 9; k++)
        b->streams[k] = b->coordinates[k];
    for (int v = 0; v < 3; v++) {
        soup->x[v] = b->streams[v];
        soup->y[v] = b->streams[3 + v];
        soup->z[v] = b->streams[6 + v];
    }
}

static int read_block(triangle_file *file, block *b, size_t *count)
{
    asked_triangles *const t = &b->triangles;
    t->is_double = file->format == TRIANGLES_F64;
    const int code =
        t->is_double ? triangle_file_next_doubles(file, b->positions, count) : triangle_file_next(file, b->streams, count);
    t->count = *count;
    if (t->is_double) {
        t->doubles.count = *count;
        t->doubles.vertices = 3 * *count;
    } else {
        t->soup.count = *count;
    }
    return code;
}

static bool is_finite_triangle(const double *numbers)
{
    bool is_finite = true;
    for (int k = 0; k < 9; k++)
        is_finite &= isfinite(numbers[k]) != 0;
    return is_finite;
}

static size_t find_not_finite(const block *b, size_t *first)
{
    size_t count = 0;
    if (!b->triangles.is_double)
        return tribox_soup_not_finite(&b->triangles.soup, first);
    for (size_t t = b->triangles.count; t > 0; t--)
        if (!is_finite_triangle(b->positions + 9 * (t - 1))) {
            count++;
            *first = t - 1;
        }
    return count;
}

static void count_not_finite(block *b, answer *a)
{
    size_t first;
    const size_t count = find_not_finite(b, &first);
    if (count && !a->not_finite)
        b->first_not_finite = a->triangles + first;
    a->not_finite += count;
}

/* Fails early where the list cannot be written any more. */
static int answer_block(const request *r, block *b, answer *a)
{
    int code = overlap_ask(r, &b->triangles, &b->bits, a);
    count_not_finite(b, a);
    if (!code && r->wants_list)
        code = report_list(r, a, a->triangles, b->bits.overlap, b->triangles.count);
    a->triangles += b->triangles.count;
    return code;
}

static int answer_blocks(const request *r, triangle_file *file, block *b, answer *a)
{
    /* Over a list on the same terminal a bar would only be in the way. */
    progress bar = progress_start("testing", file->promised != UINT64_MAX && !(r->wants_list && terminal_is(stdout)));
    int code;
    for (size_t count;;) {
        code = read_block(file, b, &count);
        if (code || !count)
            break;
        code = answer_block(r, b, a);
        if (code)
            break;
        progress_tell(&bar, (double)file->taken / (double)file->promised);
    }
    progress_end(&bar);
    return code;
}

static int answer_file(const request *r, triangle_file *file, block *b)
{
    const double start = clock_seconds();
    const bool is_double = file->format == TRIANGLES_F64;
    answer a = {.box = box_for_mesh(&r->box, is_double), .is_double = is_double, .runs = 1};
    int code = answer_blocks(r, file, b, &a);
    if (code)
        return code;
    if (!a.triangles)
        return message_failure("%s: contains no triangles", file->name);
    a.total_seconds = clock_seconds() - start;
    code = report_end(r, &a);
    if (!code)
        mesh_warn_not_finite(file->name, a.not_finite, a.triangles, b->first_not_finite);
    return code;
}

int overlap_stream(const request *r, triangle_file *file)
{
    static block b;
    point_into(&b);
    int code = masks_make(TRIANGLE_BLOCK, r->wants_inside, &b.bits);
    if (!code)
        code = answer_file(r, file, &b);
    masks_free(&b.bits);
    triangle_file_close(file);
    return code;
}
