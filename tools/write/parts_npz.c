/* parts_npz.c - threads take a part each, check it, and write its bricks to their places. */
#define _POSIX_C_SOURCE 200809L
#include "parts_npz.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/message.h"
#include "npz_members.h"
#include "read/little.h"

enum { AT_BYTES = 12, BITS_BYTES = 64, BLOCK = 4096 };
enum { BITS, AT, ARRAYS };
static const int row_bytes[ARRAYS] = {BITS_BYTES, AT_BYTES};

typedef struct part_sums {
    uint32_t crc[ARRAYS];
} part_sums;

/* What the threads share. */
typedef struct joining {
    file_out *out;
    const part *parts;
    size_t count;
    uint64_t bricks;        /* of all parts */
    uint64_t start[ARRAYS]; /* where in the file the rows begin */
    part_sums *sums;
    progress *bar;
    pthread_mutex_t lock; /* of what follows, and of the stream */
    size_t next;          /* part */
    uint64_t done;        /* bricks */
    int code, reason;     /* of the first failure; reason: errno of a write */
} joining;

/* A part that is being read. */
typedef struct rows {
    joining *j;
    uint64_t place; /* of the first waiting brick among all */
    part_sums sums;
    size_t waiting;
    unsigned char at[BLOCK][AT_BYTES], bits[BLOCK][BITS_BYTES];
} rows;

/* The lock is held. */
static void write_at(joining *j, uint64_t at, const void *bytes, size_t size)
{
    errno = 0;
    if (j->code || (!fseeko(j->out->stream, (off_t)at, SEEK_SET) && fwrite(bytes, 1, size, j->out->stream) == size))
        return;
    j->reason = errno ? errno : EIO;
    j->code = EXIT_CODE_FAILURE;
}

static int write_waiting(rows *r)
{
    joining *const j = r->j;
    const void *const bytes[ARRAYS] = {r->bits, r->at};
    for (int a = 0; a < ARRAYS; a++)
        r->sums.crc[a] = zip_crc(r->sums.crc[a], bytes[a], r->waiting * (size_t)row_bytes[a]);
    pthread_mutex_lock(&j->lock);
    for (int a = 0; a < ARRAYS; a++)
        write_at(j, j->start[a] + r->place * (uint64_t)row_bytes[a], bytes[a], r->waiting * (size_t)row_bytes[a]);
    j->done += r->waiting;
    progress_tell(j->bar, (double)j->done / (double)j->bricks);
    const int code = j->code;
    pthread_mutex_unlock(&j->lock);
    r->place += r->waiting;
    r->waiting = 0;
    return code;
}

static int take_brick(void *data, const part_brick *brick)
{
    rows *const r = data;
    for (int a = 0; a < 3; a++)
        little_put32(r->at[r->waiting] + 4 * a, brick->at[a]);
    for (int k = 0; k < 8; k++)
        little_put64(r->bits[r->waiting] + 8 * k, brick->bits[k]);
    return ++r->waiting < BLOCK ? EXIT_CODE_OK : write_waiting(r);
}

/* Which part is next, and its first place. False where none is left. */
static bool take_part(joining *j, size_t *number, uint64_t *place)
{
    pthread_mutex_lock(&j->lock);
    const bool is_left = !j->code && j->next < j->count;
    *number = is_left ? j->next++ : j->next;
    pthread_mutex_unlock(&j->lock);
    *place = 0;
    for (size_t i = 0; i < *number; i++)
        *place += j->parts[i].end.bricks;
    return is_left;
}

static void fail(joining *j, int code)
{
    pthread_mutex_lock(&j->lock);
    j->code = j->code ? j->code : code;
    pthread_mutex_unlock(&j->lock);
}

static void work(void *data, unsigned thread)
{
    joining *const j = data;
    rows *const r = calloc(1, sizeof *r);
    size_t number;
    (void)thread;
    if (!r)
        fail(j, message_failure("out of memory to read the parts"));
    for (uint64_t place; take_part(j, &number, &place);) {
        r->j = j;
        r->place = place;
        r->sums = (part_sums){{0, 0}};
        int code = part_read(&j->parts[number], take_brick, r);
        if (!code)
            code = write_waiting(r);
        if (code)
            fail(j, code);
        j->sums[number] = r->sums;
    }
    free(r);
}

/* Leaves room for an array whose rows come later. */
static void skip_rows(joining *j, zip_out *zip, int array, const char *name, const char *type)
{
    unsigned char header[NPY_HEADER];
    zip_begin_member(zip, name);
    j->start[array] = zip->written;
    zip_skip(zip, j->bricks * (uint64_t)row_bytes[array]);
    npz_rows(header, type, j->bricks, array == AT ? 3 : 8);
    zip_end_member(zip, header);
}

static void set_sums(const joining *j, zip_out *zip, int array)
{
    uint32_t crc = 0;
    unsigned char header[NPY_HEADER];
    npz_rows(header, array == AT ? "<u4" : "<u8", j->bricks, array == AT ? 3 : 8);
    for (size_t i = 0; i < j->count; i++)
        crc = zip_crc_of_both(crc, j->sums[i].crc[array], j->parts[i].end.bricks * (uint64_t)row_bytes[array]);
    zip_set_crc(zip, (unsigned)array, header, crc, j->bricks * (uint64_t)row_bytes[array]);
}

static int join(joining *j, const voxels *v, unsigned threads)
{
    zip_out zip;
    setvbuf(j->out->stream, NULL, _IONBF, 0);
    zip_begin(&zip, j->out->stream, NULL);
    skip_rows(j, &zip, BITS, "bits.npy", "<u8");
    skip_rows(j, &zip, AT, "at.npy", "<u4");
    crew_run(threads < j->count ? threads : (unsigned)j->count, work, j);
    if (j->code)
        return j->reason ? (errno = j->reason, file_out_failure(j->out)) : j->code;
    set_sums(j, &zip, BITS);
    set_sums(j, &zip, AT);
    zip_skip(&zip, 0);
    npz_add_grid(&zip, v);
    zip_end(&zip);
    return ferror(j->out->stream) ? file_out_failure(j->out) : EXIT_CODE_OK;
}

int parts_npz_write(file_out *out, const part *parts, size_t count, const voxels *v, unsigned threads, progress *bar)
{
    joining j = {.out = out, .parts = parts, .count = count, .bar = bar, .sums = calloc(count, sizeof *j.sums)};
    if (!j.sums)
        return message_failure("%s: out of memory", out->path);
    for (size_t i = 0; i < count; i++)
        j.bricks += parts[i].end.bricks;
    pthread_mutex_init(&j.lock, NULL);
    const int code = join(&j, v, threads);
    pthread_mutex_destroy(&j.lock);
    free(j.sums);
    return code;
}
