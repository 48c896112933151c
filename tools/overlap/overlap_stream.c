/* overlap_stream.c - threads read a block of triangles each, test it, list it in its turn and forget it. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "console/clock.h"
#include "console/crew.h"
#include "read/mesh.h"
#include "console/message.h"
#include "overlap.h"
#include "console/progress.h"
#include "console/terminal.h"
#include "report.h"

/* What a thread works on: as nine streams of floats, or as doubles. */
typedef struct block {
    triangle_block read;
    uint64_t number; /* of the file's blocks */
    unsigned char bytes[TRIANGLE_BLOCK_BYTES];
    float coordinates[9][TRIANGLE_BLOCK];
    float *streams[9]; /* x of the three vertices, y, z */
    double positions[9 * TRIANGLE_BLOCK];
    asked_triangles triangles;
    size_t not_finite, first_not_finite;
    masks bits;
    answer found;
} block;

typedef struct stream {
    const request *r;
    block *blocks;           /* of the threads */
    pthread_mutex_t reading; /* of what follows */
    triangle_file *file;
    uint64_t found;
    bool is_ended;
    int end_code;            /* of the file: what was found before is told all the same */
    pthread_mutex_t telling; /* of what follows */
    pthread_cond_t is_told;
    uint64_t told;
    int code;
    answer *a;
    uint64_t *first_not_finite; /* among all triangles of the file */
    progress *bar;
    masks all; /* of all triangles, where the mesh is written again */
} stream;

static int make_block(const request *r, block *b)
{
    tribox_soup *const soup = &b->triangles.soup;
    b->read.bytes = b->bytes;
    b->triangles.doubles = (tribox_mesh){.positions = b->positions, .position_bytes = sizeof *b->positions};
    for (int k = 0; k < 9; k++)
        b->streams[k] = b->coordinates[k];
    for (int v = 0; v < 3; v++) {
        soup->x[v] = b->streams[v];
        soup->y[v] = b->streams[3 + v];
        soup->z[v] = b->streams[6 + v];
    }
    return masks_make(TRIANGLE_BLOCK, r->wants_inside, &b->bits);
}

static int unpack_block(const triangle_file *file, block *b)
{
    asked_triangles *const t = &b->triangles;
    t->is_double = file->format == TRIANGLES_F64;
    t->count = b->read.count;
    t->soup.count = t->is_double ? 0 : t->count;
    t->doubles.count = t->is_double ? t->count : 0;
    t->doubles.vertices = 3 * t->doubles.count;
    return triangle_file_unpack(file, &b->read, b->streams, t->is_double ? b->positions : NULL);
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

/* Blocks are whole words. */
static void keep_bits(const masks *all, uint64_t first, const block *b)
{
    const size_t bytes = tribox_mask_words(b->triangles.count) * sizeof(uint64_t);
    if (all->overlap)
        memcpy(all->overlap + first / 64, b->bits.overlap, bytes);
    if (all->inside)
        memcpy(all->inside + first / 64, b->bits.inside, bytes);
}

/* Fails early where the list cannot be written any more. */
static int add_block(const stream *s, const block *b)
{
    answer *const a = s->a;
    int code = EXIT_CODE_OK;
    if (b->not_finite && !a->not_finite)
        *s->first_not_finite = a->triangles + b->first_not_finite;
    a->not_finite += b->not_finite;
    a->overlapping += b->found.overlapping;
    a->undecided += b->found.undecided;
    a->inside += b->found.inside;
    a->seconds += b->found.seconds;
    if (s->r->wants_list)
        code = report_list(s->r, a, a->triangles, b->bits.overlap, b->triangles.count);
    keep_bits(&s->all, a->triangles, b);
    a->triangles += b->triangles.count;
    progress_tell(s->bar, (double)a->triangles / (double)s->file->promised);
    return code;
}

/* One thread at a time reads what comes next of a stream, while others test and list. */
static bool find_block(stream *s, block *b)
{
    pthread_mutex_lock(&s->reading);
    if (!s->is_ended) {
        s->end_code = triangle_file_find(s->file, &b->read);
        s->is_ended = s->end_code || !b->read.count;
        b->number = s->found++;
    } else {
        b->read.count = 0;
    }
    const bool is_there = !s->is_ended && b->read.count;
    pthread_mutex_unlock(&s->reading);
    return is_there;
}

/* In the order of the file, so that the answer is the same for any number of threads. */
static bool tell_block(stream *s, const block *b, int code)
{
    pthread_mutex_lock(&s->telling);
    while (s->told < b->number)
        pthread_cond_wait(&s->is_told, &s->telling);
    if (!s->code)
        s->code = code ? code : add_block(s, b);
    s->told++;
    const bool goes_on = !s->code;
    pthread_cond_broadcast(&s->is_told);
    pthread_mutex_unlock(&s->telling);
    return goes_on;
}

static void end_early(stream *s)
{
    pthread_mutex_lock(&s->reading);
    s->is_ended = true;
    pthread_mutex_unlock(&s->reading);
}

static void answer_blocks(void *data, unsigned thread)
{
    stream *const s = data;
    block *const b = &s->blocks[thread];
    while (find_block(s, b)) {
        b->found = (answer){.box = s->a->box, .is_double = s->a->is_double};
        int code = unpack_block(s->file, b);
        if (!code)
            code = overlap_ask(s->r, &b->triangles, &b->bits, &b->found);
        if (!code)
            b->not_finite = find_not_finite(b, &b->first_not_finite);
        if (!tell_block(s, b, code))
            end_early(s);
    }
}

static int run_threads(stream *s, unsigned threads)
{
    /* Over a list on the same terminal a bar would only be in the way. */
    progress bar = progress_start("testing", s->file->promised != UINT64_MAX && !(s->r->wants_list && terminal_is(stdout)));
    s->bar = &bar;
    pthread_mutex_init(&s->reading, NULL);
    pthread_mutex_init(&s->telling, NULL);
    pthread_cond_init(&s->is_told, NULL);
    crew_run(threads, answer_blocks, s);
    pthread_cond_destroy(&s->is_told);
    pthread_mutex_destroy(&s->telling);
    pthread_mutex_destroy(&s->reading);
    progress_end(&bar);
    return s->code ? s->code : s->end_code;
}

static int tell(const request *r, const stream *s, crop_files *files)
{
    answer *const a = s->a;
    const int code = files ? overlap_crop(r, &s->all, files, a) : EXIT_CODE_OK;
    return code ? code : report_end(r, a);
}

static int answer_file(const request *r, triangle_file *file, block *blocks, unsigned threads, crop_files *files)
{
    const double start = clock_seconds();
    const bool is_double = file->format == TRIANGLES_F64;
    uint64_t first_not_finite = 0;
    answer a = {.box = box_for_mesh(&r->box, is_double), .is_double = is_double, .runs = 1};
    stream s = {.r = r, .file = file, .blocks = blocks, .a = &a, .first_not_finite = &first_not_finite};
    int code = files ? masks_make((size_t)file->promised, r->wants_inside, &s.all) : EXIT_CODE_OK;
    if (!code)
        code = run_threads(&s, threads);
    a.total_seconds = clock_seconds() - start;
    if (!code)
        code = a.triangles ? tell(r, &s, files) : message_failure("%s: contains no triangles", file->name);
    masks_free(&s.all);
    if (!code)
        mesh_warn_not_finite(file->name, a.not_finite, a.triangles, first_not_finite);
    return code;
}

/* No more threads than there are blocks. */
static unsigned threads_for(const request *r, const triangle_file *file)
{
    const uint64_t blocks = file->promised / TRIANGLE_BLOCK + 1;
    return r->threads < blocks ? r->threads : (unsigned)blocks;
}

int overlap_stream(const request *r, triangle_file *file, crop_files *files)
{
    const unsigned threads = threads_for(r, file);
    block *const blocks = calloc(threads, sizeof *blocks);
    int code = blocks ? EXIT_CODE_OK : message_failure("%s: out of memory", file->name);
    for (unsigned t = 0; !code && t < threads; t++)
        code = make_block(r, &blocks[t]);
    if (!code)
        code = answer_file(r, file, blocks, threads, files);
    for (unsigned t = 0; blocks && t < threads; t++)
        masks_free(&blocks[t].bits);
    free(blocks);
    triangle_file_close(file);
    return code;
}
