/* overlap_stream.c - reads a block of triangles, tests it, lists it and forgets it. */
#define _POSIX_C_SOURCE 200809L
#include <unistd.h>

#include "console/clock.h"
#include "read/mesh.h"
#include "console/message.h"
#include "overlap.h"
#include "console/progress.h"
#include "report.h"

/* A block of the file as nine streams. */
typedef struct block {
    float coordinates[9][TRIANGLE_BLOCK];
    float *streams[9]; /* x of the three vertices, y, z */
    tribox_soup soup;
    uint64_t first_not_finite; /* among all triangles of the file */
    masks bits;
} block;

static void point_into(block *b)
{
    for (int k = 0; k < 9; k++)
        b->streams[k] = b->coordinates[k];
    for (int v = 0; v < 3; v++) {
        b->soup.x[v] = b->streams[v];
        b->soup.y[v] = b->streams[3 + v];
        b->soup.z[v] = b->streams[6 + v];
    }
}

static void count_not_finite(block *b, answer *a)
{
    size_t first;
    const size_t count = tribox_soup_not_finite(&b->soup, &first);
    if (count && !a->not_finite)
        b->first_not_finite = a->triangles + first;
    a->not_finite += count;
}

/* Fails early where the list cannot be written any more. */
static int answer_block(const request *r, block *b, answer *a)
{
    int code = overlap_ask(r, &b->soup, &b->bits, a);
    count_not_finite(b, a);
    if (!code && r->wants_list)
        code = report_list(r, a, a->triangles, b->bits.overlap, b->soup.count);
    a->triangles += b->soup.count;
    return code;
}

static int answer_blocks(const request *r, triangle_file *file, block *b, answer *a)
{
    /* Over a list on the same terminal a bar would only be in the way. */
    progress bar = progress_start("testing", file->promised != UINT64_MAX && !(r->wants_list && isatty(STDOUT_FILENO)));
    int code;
    for (;;) {
        code = triangle_file_next(file, b->streams, &b->soup.count);
        if (code || !b->soup.count)
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
    answer a = {.box = r->box, .runs = 1};
    int code = answer_blocks(r, file, b, &a);
    if (code)
        return code;
    if (!a.triangles)
        return message_failure("%s: no triangles in it", file->name);
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
