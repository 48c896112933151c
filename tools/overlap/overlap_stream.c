/* overlap_stream.c - threads read a block of triangles each, test it, list it in its turn and forget it. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <string.h>

#include "console/clock.h"
#include "console/crew.h"
#include "read/mesh.h"
#include "console/message.h"
#include "overlap.h"
#include "console/progress.h"

/* What a thread works on: as nine streams of floats, or as doubles. */
typedef struct block {
    triangle_block read;
    unsigned char bytes[TRIANGLE_BLOCK_BYTES];
    float coordinates[9][TRIANGLE_BLOCK];
    float *streams[9]; /* x of the three vertices, y, z */
    double positions[9 * TRIANGLE_BLOCK];
    asked_triangles triangles;
    size_t not_finite, first_not_finite;
    uint64_t words[2][TRIANGLE_BLOCK / 64];
    masks bits; /* which these are */
    answer found;
} block;

typedef struct stream {
    const request *r;
    triangle_file *file;
    int end_code;              /* of the file: what was found before is told all the same */
    uint64_t first_not_finite; /* among all triangles of the file */
    answer a;
    progress bar;
    masks all; /* of all triangles, where the mesh is written again */
} stream;

static bool begin_block(void *data, void *place)
{
    const stream *const s = data;
    block *const b = place;
    b->read.bytes = b->bytes;
    b->triangles.soup = soup_of_streams(b->coordinates[0], TRIANGLE_BLOCK, 0);
    b->triangles.doubles = (tribox_mesh){.positions = b->positions, .position_bytes = sizeof *b->positions};
    for (int k = 0; k < 9; k++)
        b->streams[k] = b->coordinates[k];
    b->bits = (masks){b->words[0], s->r->wants_inside ? b->words[1] : NULL};
    return true;
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

/* Blocks are whole words. */
static void keep_bits(const masks *all, uint64_t first, const block *b)
{
    const size_t bytes = tribox_mask_words(b->triangles.count) * sizeof(uint64_t);
    if (all->overlap)
        memcpy(all->overlap + first / 64, b->bits.overlap, bytes);
    if (all->inside)
        memcpy(all->inside + first / 64, b->bits.inside, bytes);
}

/* One thread at a time reads what comes next of a stream, while others test and list. */
static bool find_block(void *data, void *place, size_t n)
{
    stream *const s = data;
    block *const b = place;
    (void)n;
    s->end_code = triangle_file_find(s->file, &b->read);
    return !s->end_code && b->read.count;
}

static int ask_block(void *data, void *place, size_t n)
{
    const stream *const s = data;
    block *const b = place;
    (void)n;
    b->found = (answer){.box = s->a.box, .is_double = s->a.is_double};
    int code = unpack_block(s->file, b);
    if (!code)
        code = overlap_ask(s->r, &b->triangles, &b->bits, &b->found);
    if (!code)
        b->not_finite = b->triangles.is_double ? tribox_mesh_not_finite(&b->triangles.doubles, &b->first_not_finite)
                                               : tribox_soup_not_finite(&b->triangles.soup, &b->first_not_finite);
    return code;
}

/* In the order of the file: the answer is the same for any number of threads. Fails early if the list cannot be written. */
static int tell_block(void *data, void *place, size_t n)
{
    stream *const s = data;
    answer *const a = &s->a;
    const block *const b = place;
    int code = EXIT_CODE_OK;
    (void)n;
    if (b->not_finite && !a->not_finite)
        s->first_not_finite = a->triangles + b->first_not_finite;
    a->not_finite += b->not_finite;
    a->overlapping += b->found.overlapping;
    a->undecided += b->found.undecided;
    a->inside += b->found.inside;
    a->seconds += b->found.seconds;
    if (s->r->wants_list)
        code = report_list(s->r, a, a->triangles, b->bits.overlap, b->triangles.count);
    keep_bits(&s->all, a->triangles, b);
    a->triangles += b->triangles.count;
    progress_tell(&s->bar, (double)a->triangles / (double)s->file->promised);
    return code;
}

static int ask_blocks(stream *s)
{
    const uint64_t blocks = s->file->promised / TRIANGLE_BLOCK + 1;
    const crew_work work = {.threads = s->r->threads < blocks ? s->r->threads : (unsigned)blocks,
                            .is_told_in_order = true,
                            .place_bytes = sizeof(block),
                            .begin = begin_block,
                            .find = find_block,
                            .step = ask_block,
                            .tell = tell_block};
    if (s->file->promised != UINT64_MAX)
        s->bar = progress_start("testing");
    const int code = crew_do(&work, s);
    progress_end(&s->bar);
    return code == (int)MESSAGE_NO_MEMORY ? message_failure("%s: out of memory", s->file->name) : code ? code : s->end_code;
}

static int tell(stream *s, crop_files *files)
{
    if (!s->a.triangles)
        return message_failure("%s: contains no triangles", s->file->name);
    const int code = files ? overlap_crop(s->r, &s->all, files, &s->a) : EXIT_CODE_OK;
    return code ? code : report_end(s->r, &s->a);
}

int overlap_stream(const request *r, triangle_file *file, crop_files *files)
{
    const double start = clock_seconds();
    const bool is_double = file->format == TRIANGLES_F64;
    stream s = {.r = r, .file = file, .a = {.box = box_for_mesh(&r->box, is_double), .is_double = is_double, .runs = 1}};
    int code = files ? masks_make((size_t)file->promised, r->wants_inside, &s.all) : EXIT_CODE_OK;
    if (!code)
        code = ask_blocks(&s);
    s.a.total_seconds = clock_seconds() - start;
    if (!code)
        code = tell(&s, files);
    masks_free(&s.all);
    if (!code)
        mesh_warn_not_finite(file->name, s.a.not_finite, s.a.triangles, s.first_not_finite);
    triangle_file_close(file);
    return code;
}
