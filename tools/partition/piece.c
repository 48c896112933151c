/* piece.c - reads triangles by their number, shifts them, and brings floats and doubles to one width. */
#define _POSIX_C_SOURCE 200809L
#include "piece.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "files/named_file.h"
#include "read/little.h"

enum { NUMBERS = 9 };

/* Where triangles begin, how long each is, and where in it its numbers are. */
static const struct {
    unsigned start, record, at, bytes;
} layouts[] = {[TRIANGLES_STL] = {84, 50, 12, 4}, [TRIANGLES_F32] = {0, 36, 0, 4}, [TRIANGLES_F64] = {0, 72, 0, 8}};

/* Regular files of triangles stay where they are. */
static int open_piece(piece *p, triangle_format format, bool is_wide, unsigned threads)
{
    triangle_file file;
    int code = triangle_file_open(p->path, format, &file);
    const bool is_streamed = !code && file.stream && file.is_sized && file.promised;
    p->format = is_streamed ? file.format : TRIANGLES_OTHER;
    p->triangles = file.promised;
    triangle_file_close(&file);
    if (code)
        return code;
    if (is_streamed) {
        p->is_double = layouts[p->format].bytes == sizeof(double);
        return EXIT_CODE_OK;
    }
    p->ply = ply_piece_open(p->path, is_wide);
    if (p->ply.faces) {
        p->triangles = p->ply.triangles;
        p->is_double = p->ply.is_double;
        mesh_warn(p->path, &(mesh){.miscut = (size_t)p->ply.miscut});
        return EXIT_CODE_OK;
    }
    code = is_wide ? mesh_read_wide(p->path, format, threads, &p->whole) : mesh_read_as(p->path, format, threads, &p->whole);
    if (code)
        return code;
    p->triangles = p->whole.triangles;
    p->is_double = p->whole.is_double;
    const size_t not_finite = p->whole.not_finite;
    p->whole.not_finite = 0; /* which is told of all pieces together */
    mesh_warn(triangle_file_name(p->path), &p->whole);
    p->whole.not_finite = not_finite;
    return EXIT_CODE_OK;
}

int pieces_open(pieces *all, const char *const *paths, size_t count, triangle_format format, const mesh_shift *shift,
                unsigned threads)
{
    int code = EXIT_CODE_OK;
    *all = (pieces){.piece = calloc(count, sizeof *all->piece), .shift = *shift, .read_bytes = sizeof(float)};
    if (!all->piece)
        return message_failure("out of memory for %zu meshes", count);
    while (!code && all->count < count) {
        piece *const p = &all->piece[all->count++];
        p->path = paths[all->count - 1];
        code = open_piece(p, format, shift->is_wanted, threads);
        all->triangles += p->triangles;
        all->read_bytes = p->is_double || shift->is_wanted ? sizeof(double) : all->read_bytes;
    }
    all->write_bytes = all->read_bytes;
    return code;
}

void pieces_close(pieces *all)
{
    for (size_t i = 0; i < all->count; i++) {
        ply_piece_close(&all->piece[i].ply);
        mesh_free(&all->piece[i].whole);
    }
    free(all->piece);
    *all = (pieces){.count = 0};
}

static size_t blocks_of(const pieces *all, const piece *p) { return (size_t)((p->triangles + all->block - 1) / all->block); }

void pieces_divide(pieces *all, size_t block)
{
    all->block = block;
    all->blocks = 0;
    for (size_t i = 0; i < all->count; i++)
        all->blocks += blocks_of(all, &all->piece[i]);
}

piece_block pieces_block(const pieces *all, size_t number)
{
    piece_block b = {.from = all->piece};
    for (; number >= blocks_of(all, b.from); b.from++) {
        number -= blocks_of(all, b.from);
        b.number += b.from->triangles;
    }
    b.first = (uint64_t)number * all->block;
    b.number += b.first;
    const uint64_t left = b.from->triangles - b.first;
    b.count = left < all->block ? (size_t)left : all->block;
    return b;
}

size_t pieces_room(const pieces *all)
{
    enum { RECORD_MOST = 50 }; /* of floats */
    return all->read_bytes == sizeof(double) ? sizeof(double[NUMBERS]) : RECORD_MOST;
}

/* Turns records into numbers of this machine, in place: each ends before the next begins. */
static void unpack(unsigned char *bytes, triangle_format format, size_t count)
{
    const size_t record = layouts[format].record, at = layouts[format].at;
    for (size_t t = 0; layouts[format].bytes == sizeof(float) && t < count; t++)
        for (size_t k = 0; k < NUMBERS; k++) {
            const uint32_t bits = little_get32(bytes + t * record + at + 4 * k);
            memcpy(bytes + 4 * (t * NUMBERS + k), &bits, sizeof bits);
        }
    for (size_t k = 0; layouts[format].bytes == sizeof(double) && k < NUMBERS * count; k++) {
        const uint64_t bits = little_get64(bytes + 8 * k);
        memcpy(bytes + 8 * k, &bits, sizeof bits);
    }
}

static bool read_records(const piece_block *b, unsigned char *bytes)
{
    const size_t record = layouts[b->from->format].record, size = b->count * record;
    FILE *const file = named_file_open(b->from->path, "rb");
    if (!file)
        return false;
    setvbuf(file, NULL, _IONBF, 0);
    errno = 0;
    const uint64_t start = layouts[b->from->format].start + b->first * record;
    const bool is_read = !fseeko(file, (off_t)start, SEEK_SET) && fread(bytes, 1, size, file) == size;
    const int reason = errno;
    fclose(file);
    errno = reason;
    if (is_read)
        unpack(bytes, b->from->format, b->count);
    return is_read;
}

/* Floats of this machine at the end of the room become doubles from its beginning on. */
static void widen(unsigned char *bytes, size_t numbers)
{
    const unsigned char *const narrow = bytes + numbers * sizeof(float);
    for (size_t k = 0; k < numbers; k++) {
        float number;
        memcpy(&number, narrow + k * sizeof number, sizeof number);
        const double wide = (double)number;
        memcpy(bytes + k * sizeof wide, &wide, sizeof wide);
    }
}

static void put(const mesh *m, uint64_t first, size_t count, unsigned bytes, unsigned char *to)
{
    for (size_t t = 0; t < count; t++) {
        double u[NUMBERS];
        mesh_triangle(m, (size_t)first + t, u);
        for (size_t k = 0; k < NUMBERS; k++) {
            const float narrow = (float)u[k];
            memcpy(to + (t * NUMBERS + k) * bytes, bytes == sizeof narrow ? (const void *)&narrow : (const void *)&u[k], bytes);
        }
    }
}

/* In place, as number after number is handed on at most as wide as it was. */
static void subtract(const pieces *all, size_t numbers, unsigned char *bytes)
{
    for (size_t k = 0; k < numbers; k++) {
        double number;
        memcpy(&number, bytes + k * sizeof number, sizeof number);
        number -= all->shift.by[k % 3];
        const float narrow = (float)number;
        memcpy(bytes + k * all->write_bytes, all->write_bytes == sizeof narrow ? (const void *)&narrow : (const void *)&number,
               all->write_bytes);
    }
}

bool pieces_read(const pieces *all, const piece_block *block, void *positions)
{
    unsigned char *const bytes = positions;
    const size_t numbers = NUMBERS * block->count;
    const piece *const p = block->from;
    if (p->format == TRIANGLES_OTHER && !p->ply.faces) {
        put(&p->whole, block->first, block->count, all->read_bytes, bytes);
    } else {
        if (!(p->ply.faces ? ply_piece_read(&p->ply, block->first, block->count, bytes) : read_records(block, bytes)))
            return false;
        if (all->read_bytes == sizeof(double) && !p->is_double) {
            memmove(bytes + numbers * sizeof(float), bytes, numbers * sizeof(float));
            widen(bytes, numbers);
        }
    }
    if (all->shift.is_wanted)
        subtract(all, numbers, bytes);
    return true;
}

int pieces_refuse(const piece *p, int reason)
{
    return message_failure("%s: cannot read the mesh: %s", triangle_file_name(p->path),
                           reason ? strerror(reason) : "it became shorter while it was read");
}

void pieces_triangle(const pieces *all, const void *positions, size_t t, double u[9])
{
    if (all->write_bytes == sizeof(double)) {
        memcpy(u, (const unsigned char *)positions + t * sizeof(double[NUMBERS]), sizeof(double[NUMBERS]));
        return;
    }
    float narrow[NUMBERS];
    memcpy(narrow, (const unsigned char *)positions + t * sizeof narrow, sizeof narrow);
    for (int k = 0; k < NUMBERS; k++)
        u[k] = (double)narrow[k];
}
