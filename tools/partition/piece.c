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
    const char *path;
    ply_layout in;
    size_t number, count, corner; /* bytes of a coordinate, of the length of a list, and of a corner */
    face_mark *marks;
};

/* A face: where its corners are, and how many. */
typedef struct face {
    uint64_t corners_at, count, end;
} face;

static uint64_t bits_at(const struct ply_faces *f, uint64_t at, size_t size)
{
    return ply_bits((const unsigned char *)f->map.bytes + at, size, f->in.is_big);
}

/* False where the file ends before it, or it has more corners than anyone means. */
static bool find_face(const struct ply_faces *f, uint64_t at, face *found)
{
    if (f->map.size - at < f->in.before + f->count)
        return false;
    found->count = bits_at(f, at + f->in.before, f->count);
    found->corners_at = at + f->in.before + f->count;
    if (found->count > CORNERS_MOST || (f->map.size - found->corners_at) < found->count * f->corner + f->in.after)
        return false;
    found->end = found->corners_at + found->count * f->corner + f->in.after;
    return true;
}

/* False where it refers to a vertex that is not there. */
static bool find_corner(const struct ply_faces *f, const face *one, uint64_t i, uint64_t *vertex)
{
    *vertex = bits_at(f, one->corners_at + i * f->corner, f->corner);
    return *vertex < f->in.vertices;
}

static double number_at(const struct ply_faces *f, uint64_t vertex, int axis)
{
    const uint64_t bits = bits_at(f, f->in.vertices_at + vertex * f->in.vertex + f->in.axes[axis], f->number);
    return ply_number(bits, f->in.number);
}

/* Cuts a face of more than three corners: its corners become the vertices of a mesh of its own. */
static bool cut(const struct ply_faces *f, const face *one, indexed_mesh *polygon)
{
    polygon->vertices = polygon->triangles = 0;
    if (indexed_mesh_reserve(f->path, one->count, sizeof(double), polygon) ||
        indexed_mesh_reserve_face(f->path, one->count, polygon))
        return false;
    for (uint64_t i = 0; i < one->count; i++) {
        uint64_t vertex;
        if (!find_corner(f, one, i, &vertex))
            return false;
        indexed_mesh_add_vertex((const double[3]){number_at(f, vertex, 0), number_at(f, vertex, 1), number_at(f, vertex, 2)},
                                polygon);
        polygon->face[i] = (uint32_t)i;
    }
    return !indexed_mesh_add_face(f->path, (size_t)one->count, polygon);
}

static bool check_corners(const struct ply_faces *f, const face *one)
{
    uint64_t vertex;
    bool is_sound = true;
    for (uint64_t i = 0; i < one->count; i++)
        is_sound &= find_corner(f, one, i, &vertex);
    return is_sound;
}

/* Looks at all faces once. */
static bool mark_faces(struct ply_faces *f, ply_piece *p)
{
    uint64_t at = f->in.faces_at;
    indexed_mesh polygon = {.positions = NULL};
    bool is_sound = true;
    for (uint64_t n = 0; n < f->in.faces && is_sound; n++) {
        face one;
        if (n % FACES_A_MARK == 0)
            f->marks[n / FACES_A_MARK] = (face_mark){at, p->triangles};
        is_sound = find_face(f, at, &one) && check_corners(f, &one) && (one.count < 4 || cut(f, &one, &polygon));
        p->triangles += is_sound && one.count > 2 ? one.count - 2 : 0;
        at = one.end;
    }
    p->miscut = polygon.miscut;
    indexed_mesh_free(&polygon);
    return is_sound;
}

static bool holds_floats(const struct ply_faces *f)
{
    bool is_float = true;
    for (uint64_t v = 0; v < f->in.vertices && is_float; v++)
        for (int a = 0; a < 3; a++)
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
    const bool is_read = header && !ply_header_read(NULL, &file, header) && header->format != PLY_ASCII &&
                         header->element_count == 2 && ply_layout_of(header, f->map.size, in);
    free(header);
    if (!is_read || !is_corner[in->corner] || (in->number != PLY_FLOAT && in->number != PLY_DOUBLE))
        return false;
    f->number = ply_type_size(in->number);
    f->count = ply_type_size(in->count);
    f->corner = ply_type_size(in->corner);
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
static ply_piece ply_piece_open(const char *path, bool is_wide)
{
    ply_piece p = {.faces = calloc(1, sizeof *p.faces)};
    if (!p.faces)
        return p;
    p.faces->path = path;
    if (file_map_open(&p.faces->map, path) || !lay_out(p.faces) || !mark_faces(p.faces, &p) || !p.triangles) {
        ply_piece_close(&p);
        return p;
    }
    p.is_double = p.faces->number == sizeof(double);
    if (p.is_double && !is_wide && holds_floats(p.faces))
        p.is_double = false;
    return p;
}

/* Where triangles go, without those before the first. */
typedef struct ply_sink {
    const ply_piece *p;
    uint64_t skip;
    size_t left;
    unsigned char *to;
} ply_sink;

static void put_triangle(ply_sink *s, const uint64_t corners[3])
{
    for (int k = 0; k < 9; k++) {
        const double wide = number_at(s->p->faces, corners[k / 3], k % 3);
        const float narrow = (float)wide;
        const size_t bytes = s->p->is_double ? sizeof wide : sizeof narrow;
        memcpy(s->to, s->p->is_double ? (const void *)&wide : (const void *)&narrow, bytes);
        s->to += bytes;
    }
    s->left--;
}

/* Those triangles of a face that are wanted. False where a vertex is missing. */
static bool put_face(ply_sink *s, const face *one, const indexed_mesh *polygon)
{
    const struct ply_faces *const f = s->p->faces;
    for (uint64_t t = 0; t + 2 < one->count && s->left; t++) {
        uint64_t corners[3];
        if (s->skip) {
            s->skip--;
            continue;
        }
        for (uint64_t v = 0; v < 3; v++)
            if (!find_corner(f, one, polygon ? polygon->corners[3 * t + v] : v, &corners[v]))
                return false;
        put_triangle(s, corners);
    }
    return true;
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
static bool ply_piece_read(const ply_piece *p, uint64_t first, size_t count, void *positions)
{
    const struct ply_faces *const f = p->faces;
    const face_mark *const mark = &f->marks[find_mark(f, first)];
    ply_sink s = {.p = p, .skip = first - mark->triangle, .left = count, .to = positions};
    indexed_mesh polygon = {.positions = NULL};
    bool is_sound = true;
    for (uint64_t at = mark->at; s.left && is_sound;) {
        face one;
        is_sound = find_face(f, at, &one);
        if (!is_sound)
            break;
        const bool is_polygon = one.count > 3;
        if (is_polygon && s.skip >= one.count - 2)
            s.skip -= one.count - 2;
        else
            is_sound = (!is_polygon || cut(f, &one, &polygon)) && put_face(&s, &one, is_polygon ? &polygon : NULL);
        at = one.end;
    }
    indexed_mesh_free(&polygon);
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
        p->ply = ply_piece_open(p->path, is_wide);
    if (p->ply.faces) {
        p->triangles = p->ply.triangles;
        p->is_double = p->ply.is_double;
        mesh_warn(p->path, &(mesh){.miscut = (size_t)p->ply.miscut});
        return EXIT_CODE_OK;
    }
    code = mesh_read_over(p->path, format, is_wide, threads, NULL, &p->whole);
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

static bool read_records(const piece_block *b, unsigned char *bytes)
{
    const triangle_layout *const layout = &triangle_layouts[b->from->format];
    const size_t size = b->count * layout->record;
    FILE *const file = named_file_open(b->from->path, "rb");
    if (!file)
        return false;
    setvbuf(file, NULL, _IONBF, 0);
    errno = 0;
    const uint64_t start = layout->start + b->first * layout->record;
    const bool is_read = !fseeko(file, (off_t)start, SEEK_SET) && fread(bytes, 1, size, file) == size;
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
