/*
 * ply_piece.c - maps a PLY file, finds every so many faces where they begin, and cuts polygons as the reader of whole files does.
 */
#include "piece.h"

#include <stdlib.h>
#include <string.h>

#include "files/file_map.h"
#include "read/mesh.h"
#include "read/scan.h"

enum { FACES_A_MARK = 4096, HEADER_MOST = 1 << 16, CORNERS_MOST = 1 << 20 };

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

/* The header alone is copied, as its reader looks for the end of a text. */
static bool read_header(struct ply_faces *f, ply_header *header)
{
    static const char begin[] = "ply", end[] = "end_header";
    char *const text = calloc(HEADER_MOST + 1, 1);
    const size_t size = f->map.size < HEADER_MOST ? f->map.size : HEADER_MOST;
    bool is_read = text && size > sizeof begin;
    if (is_read) {
        memcpy(text, f->map.bytes, size);
        is_read = !memcmp(text, begin, sizeof begin - 1) && strstr(text, end) &&
                  !ply_header_read(f->path, &(whole_file){text, size}, header);
    }
    is_read = is_read && header->format != PLY_ASCII && header->element_count == 2;
    free(text);
    return is_read;
}

/* Floats or doubles; negative corners are too large, and those of signed types of few bytes are not sorted out here. */
static bool lay_out(struct ply_faces *f)
{
    static const bool is_corner[PLY_DOUBLE + 1] = {
        [PLY_UINT8] = true, [PLY_UINT16] = true, [PLY_INT32] = true, [PLY_UINT32] = true};
    ply_layout *const in = &f->in;
    ply_header *const header = malloc(sizeof *header);
    const bool is_read = header && read_header(f, header) && ply_layout_of(header, f->map.size, in);
    free(header);
    if (!is_read || !is_corner[in->corner] || (in->number != PLY_FLOAT && in->number != PLY_DOUBLE))
        return false;
    f->number = ply_type_size(in->number);
    f->count = ply_type_size(in->count);
    f->corner = ply_type_size(in->corner);
    f->marks = malloc((size_t)((f->in.faces + FACES_A_MARK - 1) / FACES_A_MARK) * sizeof *f->marks);
    return f->marks;
}

void ply_piece_close(ply_piece *p)
{
    if (p->faces) {
        file_map_close(&p->faces->map);
        free(p->faces->marks);
        free(p->faces);
    }
    *p = (ply_piece){.faces = NULL};
}

ply_piece ply_piece_open(const char *path, bool is_wide)
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

bool ply_piece_read(const ply_piece *p, uint64_t first, size_t count, void *positions)
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
