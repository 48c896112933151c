/* parts_npz.c - threads take a part each, check it, and write its bricks to their places. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "npz.h"
#include "read/little.h"

enum { AT_BYTES = 12, BITS_BYTES = 64, ID_BYTES = 4, BRICK_CELLS = 512, BLOCK = 4096, IDS_BLOCK = 1 << 18 };

typedef struct part_sums {
    uint32_t crc[NPZ_ARRAYS];
} part_sums;

/* What the threads share. */
typedef struct joining {
    file_out *out;
    part *parts;
    size_t count;
    int arrays;                 /* all, or those but for ids */
    uint64_t rows[NPZ_ARRAYS];  /* of all parts: bricks, and cells for ids */
    uint64_t start[NPZ_ARRAYS]; /* where in the file the rows begin */
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
    uint64_t place[NPZ_ARRAYS]; /* of the first waiting row among all */
    part_sums sums;
    size_t waiting[NPZ_ARRAYS];
    unsigned char at[BLOCK][AT_BYTES], bits[BLOCK][BITS_BYTES], ids[IDS_BLOCK][ID_BYTES];
} rows;

static uint64_t bytes_of(int array, uint64_t count) { return count * (uint64_t)npz_arrays[array].row_bytes; }

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
    const void *const bytes[NPZ_ARRAYS] = {r->bits, r->at, r->ids};
    for (int a = 0; a < j->arrays; a++)
        r->sums.crc[a] = zip_crc(r->sums.crc[a], bytes[a], (size_t)bytes_of(a, r->waiting[a]));
    pthread_mutex_lock(&j->lock);
    for (int a = 0; a < j->arrays; a++)
        write_at(j, j->start[a] + bytes_of(a, r->place[a]), bytes[a], (size_t)bytes_of(a, r->waiting[a]));
    j->done += r->waiting[NPZ_BITS];
    progress_tell(j->bar, (double)j->done / (double)j->rows[NPZ_BITS]);
    const int code = j->code;
    pthread_mutex_unlock(&j->lock);
    for (int a = 0; a < j->arrays; a++) {
        r->place[a] += r->waiting[a];
        r->waiting[a] = 0;
    }
    return code;
}

static int take_brick(void *data, const part_brick *brick, const uint32_t *ids)
{
    rows *const r = data;
    const size_t row = r->waiting[NPZ_BITS];
    for (int a = 0; a < 3; a++)
        little_put32(r->at[row] + 4 * a, brick->at[a]);
    for (int k = 0; k < 8; k++)
        little_put64(r->bits[row] + 8 * k, brick->bits[k]);
    for (uint32_t n = 0; ids && n < brick->cells; n++)
        little_put32(r->ids[r->waiting[NPZ_IDS]++], ids[n]);
    r->waiting[NPZ_BITS] = r->waiting[NPZ_AT] = row + 1;
    return row + 1 < BLOCK && r->waiting[NPZ_IDS] + BRICK_CELLS <= IDS_BLOCK ? EXIT_CODE_OK : write_waiting(r);
}

static void add_rows(const part *p, uint64_t to[NPZ_ARRAYS])
{
    to[NPZ_BITS] += p->bricks;
    to[NPZ_AT] += p->bricks;
    to[NPZ_IDS] += p->ids;
}

/* Which part is next, and its first places. False where none is left. */
static bool take_part(joining *j, size_t *number, uint64_t place[NPZ_ARRAYS])
{
    pthread_mutex_lock(&j->lock);
    const bool is_left = !j->code && j->next < j->count;
    *number = is_left ? j->next++ : j->next;
    pthread_mutex_unlock(&j->lock);
    memset(place, 0, NPZ_ARRAYS * sizeof *place);
    for (size_t i = 0; i < *number; i++)
        add_rows(&j->parts[i], place);
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
    while (r && take_part(j, &number, r->place)) {
        r->j = j;
        r->sums = (part_sums){{0}};
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
static void skip_rows(joining *j, zip_out *zip, int array)
{
    unsigned char header[NPY_HEADER];
    zip_begin_member(zip, npz_arrays[array].name);
    j->start[array] = zip->written;
    zip_skip(zip, bytes_of(array, j->rows[array]));
    npz_header(header, array, j->rows[array]);
    zip_end_member(zip, header);
}

static void set_sums(const joining *j, zip_out *zip, int array)
{
    uint32_t crc = 0;
    unsigned char header[NPY_HEADER];
    npz_header(header, array, j->rows[array]);
    for (size_t i = 0; i < j->count; i++) {
        uint64_t of_part[NPZ_ARRAYS] = {0};
        add_rows(&j->parts[i], of_part);
        crc = zip_crc_of_both(crc, j->sums[i].crc[array], bytes_of(array, of_part[array]));
    }
    zip_set_crc(zip, (unsigned)array, header, crc, bytes_of(array, j->rows[array]));
}

static int join(joining *j, unsigned threads)
{
    zip_out zip;
    setvbuf(j->out->stream, NULL, _IONBF, 0);
    zip_begin(&zip, j->out->stream, false);
    for (int a = 0; a < j->arrays; a++)
        skip_rows(j, &zip, a);
    crew_run(threads < j->count ? threads : (unsigned)j->count, work, j);
    if (j->code)
        return j->reason ? (errno = j->reason, file_out_failure(j->out)) : j->code;
    for (int a = 0; a < j->arrays; a++)
        set_sums(j, &zip, a);
    zip_skip(&zip, 0);
    npz_add_about(&zip, &j->parts[0].header.whole.cells, NULL);
    zip_end(&zip);
    return ferror(j->out->stream) ? file_out_failure(j->out) : EXIT_CODE_OK;
}

int parts_npz_write(file_out *out, part *parts, size_t count, unsigned threads, progress *bar)
{
    joining j = {.out = out, .parts = parts, .count = count, .bar = bar, .sums = calloc(count, sizeof *j.sums)};
    if (!j.sums)
        return message_failure("%s: out of memory", out->path);
    j.arrays = parts[0].header.whole.has_ids ? NPZ_ARRAYS : NPZ_IDS;
    for (size_t i = 0; i < count; i++)
        add_rows(&parts[i], j.rows);
    pthread_mutex_init(&j.lock, NULL);
    const int code = join(&j, threads);
    pthread_mutex_destroy(&j.lock);
    free(j.sums);
    return code;
}
