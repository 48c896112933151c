/*
 * piece.c - reads triangles by their number, shifts them, and brings floats and doubles to one width. A PLY file is mapped, every
 * so many of its faces are found where they begin, and polygons are cut as the reader of whole files does.
 */
#define _POSIX_C_SOURCE 200809L
#include "piece.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "files/files.h"
#include "read/mesh.h"
#include "read/scan.h"

/* -------------------------------------------------------------------------------------------------------------------------- PLY */

enum { FACES_A_MARK = 4096, CORNERS_MOST = 1 << 20 };

/* Where a face begins, and which triangle is its first. */
typedef struct face_mark {
    uint64_t at, triangle;
} face_mark;

struct ply_faces {
    file_map map;
    ply_layout in;
    face_mark *marks;
};

/*
 * A walk over faces: the last one, and where the next begins. The scanner of scan.h would find them as well, but it notes where
 * each corner stands: a partition took 1.3 times the instructions, and half as long again.
 */
typedef struct ply_walk {
    const struct ply_faces *f;
    uint64_t at, count, triangles, miscut;
    const unsigned char *corners;
    indexed_mesh polygon;
} ply_walk;

static uint64_t corner_at(const ply_walk *w, uint64_t i)
{
    const ply_layout *const in = &w->f->in;
    return ply_bits(w->corners + i * in->corner_bytes, in->corner_bytes, in->is_big);
}

/* False where the file ends before it, it has more corners than anyone means, or it refers to a vertex that is not there. */
static bool next_face(ply_walk *w)
{
    const ply_layout *const in = &w->f->in;
    const unsigned char *const bytes = (const unsigned char *)w->f->map.bytes + w->at;
    const uint64_t left = w->f->map.size - w->at, before = in->before + in->count_bytes;
    bool is_sound = true;
    if (left < before)
        return false;
    w->count = ply_bits(bytes + in->before, in->count_bytes, in->is_big);
    if (w->count > CORNERS_MOST || left < before + w->count * in->corner_bytes + in->after)
        return false;
    w->triangles = w->count > 2 ? w->count - 2 : 0;
    w->corners = bytes + before;
    w->at += before + w->count * in->corner_bytes + in->after;
    for (uint64_t i = 0; i < w->count; i++)
        is_sound &= corner_at(w, i) < in->vertices;
    return is_sound;
}

static double number_at(const struct ply_faces *f, uint64_t vertex, size_t axis)
{
    const ply_layout *const in = &f->in;
    const unsigned char *const at = (const unsigned char *)f->map.bytes + in->vertices_at + vertex * in->vertex + in->axes[axis];
    return ply_number(ply_bits(at, in->number_bytes, in->is_big), in->number);
}

/* The last face as triangles of its corners, counted from 0; NULL where there is no memory. */
static const uint32_t *cut(ply_walk *w)
{
    static const uint32_t triangle[] = {0, 1, 2};
    if (w->count <= 3)
        return triangle;
    w->polygon.position_bytes = sizeof(double);
    w->polygon.positions.count = w->polygon.corners.count = 0;
    double *const positions = page_list_add(w->count, sizeof(double[3]), &w->polygon.positions);
    uint32_t *const face = page_list_add(w->count + 3 * w->triangles, sizeof *face, &w->polygon.corners);
    if (!positions || !face)
        return NULL;
    for (size_t k = 0; k < 3 * w->count; k++) {
        positions[k] = number_at(w->f, corner_at(w, k / 3), k % 3);
        face[k / 3] = (uint32_t)(k / 3);
    }
    w->miscut += !polygon_cut(&w->polygon, face, w->count, face + w->count);
    return face + w->count;
}

/* Looks at all faces once. */
static bool mark_faces(const struct ply_faces *f, ply_piece *p)
{
    ply_walk w = {.f = f, .at = f->in.faces_at};
    bool is_sound = true;
    for (uint64_t n = 0; n < f->in.faces && is_sound; n++) {
        if (n % FACES_A_MARK == 0)
            f->marks[n / FACES_A_MARK] = (face_mark){w.at, p->triangles};
        is_sound = next_face(&w) && cut(&w);
        p->triangles += w.triangles;
    }
    p->miscut = w.miscut;
    indexed_mesh_free(&w.polygon);
    return is_sound;
}

static bool holds_floats(const struct ply_faces *f)
{
    bool is_float = true;
    for (uint64_t v = 0; v < f->in.vertices && is_float; v++)
        for (size_t a = 0; a < 3; a++)
            is_float &= float_fit_of(number_at(f, v, a)) == FLOAT_FIT_EXACT;
    return is_float;
}

/* Floats or doubles; negative corners are too large, and those of signed types of few bytes are not sorted out here. */
static bool lay_out(struct ply_faces *f)
{
    static const bool is_corner[PLY_DOUBLE + 1] = {
        [PLY_UINT8] = true, [PLY_UINT16] = true, [PLY_INT32] = true, [PLY_UINT32] = true};
    ply_layout *const in = &f->in;
    ply_header *const header = malloc(sizeof *header);
    const whole_file file = {f->map.bytes, f->map.size}; /* of which the header's reader looks at no more than it has */
    const bool is_read = header && file.size && !ply_header_read(NULL, &file, header) && header->format != PLY_ASCII &&
                         header->element_count == 2 && ply_layout_of(header, f->map.size, in);
    free(header);
    if (!is_read || !is_corner[in->corner] || (in->number != PLY_FLOAT && in->number != PLY_DOUBLE))
        return false;
    f->marks = malloc((size_t)((f->in.faces + FACES_A_MARK - 1) / FACES_A_MARK) * sizeof *f->marks);
    return f->marks;
}

static void ply_piece_close(ply_piece *p)
{
    if (p->faces) {
        file_map_close(&p->faces->map);
        free(p->faces->marks);
        free(p->faces);
    }
    *p = (ply_piece){.faces = NULL};
}

/*
 * Opens a file and looks at all of its faces. It is left to the reader of whole files, which says what is wrong with it, unless it
 * is a sound one of vertices, all floats or all doubles, and then faces, and nothing else. is_wide: doubles stay what they are even
 * where floats would do.
 */
static void ply_piece_open(const char *path, bool is_wide, ply_piece *p)
{
    struct ply_faces *const f = p->faces = calloc(1, sizeof *f);
    if (f && !file_map_open(&f->map, path) && lay_out(f) && mark_faces(f, p) && p->triangles)
        p->is_double = f->in.number == PLY_DOUBLE && (is_wide || !holds_floats(f));
    else
        ply_piece_close(p);
}

/* As a double, or a float. Returns where the next goes. */
static unsigned char *put_number(double wide, bool is_double, unsigned char *to)
{
    const float narrow = (float)wide;
    const size_t bytes = is_double ? sizeof wide : sizeof narrow;
    memcpy(to, is_double ? (const void *)&wide : (const void *)&narrow, bytes);
    return to + bytes;
}

static uint64_t find_mark(const struct ply_faces *f, uint64_t triangle)
{
    uint64_t lo = 0, hi = (f->in.faces + FACES_A_MARK - 1) / FACES_A_MARK;
    while (hi - lo > 1) {
        const uint64_t middle = lo + (hi - lo) / 2;
        if (f->marks[middle].triangle <= triangle)
            lo = middle;
        else
            hi = middle;
    }
    return lo;
}

/*
 * Triangles first .. first + count - 1, nine numbers each, floats or doubles. False where there is no memory, or the file changed.
 */
static bool ply_piece_read(const ply_piece *p, uint64_t first, size_t count, unsigned char *to)
{
    const face_mark *const mark = &p->faces->marks[find_mark(p->faces, first)];
    ply_walk w = {.f = p->faces, .at = mark->at};
    uint64_t skip = first - mark->triangle;
    bool is_sound = true;
    while (count && is_sound && (is_sound = next_face(&w))) {
        if (skip >= w.triangles) {
            skip -= w.triangles;
            continue;
        }
        const uint32_t *corners = cut(&w);
        is_sound = corners;
        for (uint64_t t = skip; is_sound && t < w.triangles && count; t++, count--)
            for (size_t k = 0; k < 9; k++)
                to = put_number(number_at(w.f, corner_at(&w, corners[3 * t + k / 3]), k % 3), p->is_double, to);
        skip = 0;
    }
    indexed_mesh_free(&w.polygon);
    return is_sound;
}

/* ----------------------------------------------------------------------------------------------------------------------- pieces */

enum { NUMBERS = 9 };

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
        p->is_double = triangle_layouts[p->format].number_bytes == sizeof(double);
        return EXIT_CODE_OK;
    }
    if (strcmp(p->path, "-"))
        ply_piece_open(p->path, is_wide, &p->ply);
    if (p->ply.faces) {
        p->triangles = p->ply.triangles;
        p->is_double = p->ply.is_double;
        mesh_warn(p->path, &(mesh){.miscut = (size_t)p->ply.miscut});
        return EXIT_CODE_OK;
    }
    code = mesh_read_over(&(mesh_request){.path = p->path, .format = format, .is_wide = is_wide, .threads = threads}, &p->whole);
    if (code)
        return code;
    p->triangles = p->whole.triangles;
    p->is_double = p->whole.is_double;
    p->whole.seen.not_finite = 0; /* which is told of all pieces together */
    mesh_warn(triangle_file_name(p->path), &p->whole);
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

static bool read_records(const piece_block *b, unsigned char *bytes)
{
    const triangle_layout *const layout = &triangle_layouts[b->from->format];
    const size_t size = b->count * layout->record;
    FILE *const file = named_file_open(b->from->path, "rb");
    if (!file)
        return false;
    errno = 0;
    size_t got;
    const bool is_read = named_file_read_at(file, layout->start + b->first * layout->record, bytes, size, &got) && got == size;
    const int reason = errno;
    fclose(file);
    errno = reason;
    if (is_read)
        triangles_unpack(b->from->format, b->count, bytes);
    return is_read;
}

/* Floats of this machine at the end of the room become doubles from its beginning on. */
static void widen(unsigned char *bytes, size_t numbers)
{
    const unsigned char *narrow = bytes + numbers * sizeof(float);
    for (float number; numbers; numbers--, narrow += sizeof number) {
        memcpy(&number, narrow, sizeof number);
        bytes = put_number((double)number, true, bytes);
    }
}

static void put(const mesh *m, uint64_t first, size_t count, bool is_double, unsigned char *to)
{
    for (size_t t = 0; t < count; t++) {
        double u[NUMBERS];
        mesh_triangle(m, (size_t)first + t, u);
        for (size_t k = 0; k < NUMBERS; k++)
            to = put_number(u[k], is_double, to);
    }
}

/* In place, as number after number is handed on at most as wide as it was. */
static void subtract(const pieces *all, size_t numbers, const unsigned char *bytes, unsigned char *to)
{
    for (size_t k = 0; k < numbers; k++) {
        double number;
        memcpy(&number, bytes + k * sizeof number, sizeof number);
        to = put_number(number - all->shift.by[k % 3], all->write_bytes == sizeof number, to);
    }
}

bool pieces_read(const pieces *all, const piece_block *block, void *positions)
{
    unsigned char *const bytes = positions;
    const size_t numbers = NUMBERS * block->count;
    const piece *const p = block->from;
    const bool is_wide = all->read_bytes == sizeof(double), is_listed = p->format != TRIANGLES_OTHER;
    if (is_listed ? !read_records(block, bytes) : p->ply.faces && !ply_piece_read(&p->ply, block->first, block->count, bytes))
        return false;
    if (!is_listed && !p->ply.faces) {
        put(&p->whole, block->first, block->count, is_wide, bytes);
    } else if (is_wide && !p->is_double) {
        memmove(bytes + numbers * sizeof(float), bytes, numbers * sizeof(float));
        widen(bytes, numbers);
    }
    if (all->shift.is_wanted)
        subtract(all, numbers, bytes, bytes);
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
