#include "read_mesh.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct file {
    const char *path;
    unsigned char *bytes;
    size_t size;
} file;

static bool complain(const char *path, const char *what)
{
    fprintf(stderr, "%s: %s; the mesh tests read binary little-endian PLY of float triangles, and binary STL\n", path, what);
    return false;
}

static bool load(const char *path, file *f)
{
    *f = (file){.path = path};
    FILE *const in = fopen(path, "rb");
    if (!in)
        return complain(path, "cannot be opened");
    size_t capacity = 0, got = 1;
    while (got) {
        if (f->size == capacity) {
            capacity = capacity ? 2 * capacity : 1 << 20;
            unsigned char *const larger = realloc(f->bytes, capacity);
            if (!larger)
                break;
            f->bytes = larger;
        }
        got = fread(f->bytes + f->size, 1, capacity - f->size, in);
        f->size += got;
    }
    const bool is_whole = !got && !ferror(in);
    fclose(in);
    return is_whole || complain(path, "cannot be read to its end");
}

static uint32_t word_at(const unsigned char *p) { return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24; }

static float float_at(const unsigned char *p)
{
    const uint32_t bits = word_at(p);
    float number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static bool make_room(mesh *m, size_t count)
{
    m->count = count;
    bool is_made = true;
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            m->coordinate[j][a] = calloc(count ? count : 1, sizeof(float));
            is_made = is_made && m->coordinate[j][a];
        }
    return is_made;
}

static void set_vertex(mesh *m, size_t triangle, int vertex, const unsigned char *xyz)
{
    for (int a = 0; a < 3; a++)
        m->coordinate[vertex][a][triangle] = float_at(xyz + 4 * a);
}

/* An 80-byte header, the count, and 50 bytes a triangle: a normal, three corners, two bytes of attributes. */
static bool read_stl(const file *f, mesh *m)
{
    enum { HEADER = 84, TRIANGLE = 50, NORMAL = 12, CORNER = 12 };
    const size_t count = f->size >= HEADER ? word_at(f->bytes + 80) : 0;
    if (f->size < HEADER || f->size != HEADER + TRIANGLE * count)
        return complain(f->path, "is not a binary STL file: its size does not fit its count");
    if (!make_room(m, count))
        return complain(f->path, "is too large for the memory");
    for (size_t i = 0; i < count; i++)
        for (int j = 0; j < 3; j++)
            set_vertex(m, i, j, f->bytes + HEADER + TRIANGLE * i + NORMAL + CORNER * j);
    return true;
}

/* The text before the data, which these files have word for word. */
static bool read_ply_header(const file *f, size_t *vertices, size_t *faces, size_t *data)
{
    static const char format[] = "ply format binary_little_endian 1.0 element vertex %zu property float x property float y "
                                 "property float z element face %zu property list uchar int vertex_indices end_header%n";
    char header[512] = "";
    memcpy(header, f->bytes, f->size < sizeof header ? f->size : sizeof header - 1);
    int end = 0;
    if (sscanf(header, format, vertices, faces, &end) != 2 || !end)
        return false;
    *data = (size_t)end + 1;
    return true;
}

static bool read_ply(const file *f, mesh *m)
{
    enum { VERTEX = 12, FACE = 13 };
    size_t vertices, faces, data;
    if (!read_ply_header(f, &vertices, &faces, &data))
        return complain(f->path, "has another PLY header");
    if (vertices > f->size / VERTEX || faces > f->size / FACE || f->size != data + VERTEX * vertices + FACE * faces)
        return complain(f->path, "is no PLY file of triangles: its size does not fit its counts");
    if (!make_room(m, faces))
        return complain(f->path, "is too large for the memory");
    const unsigned char *const vertex = f->bytes + data, *const face = vertex + VERTEX * vertices;
    for (size_t i = 0; i < faces; i++) {
        if (face[FACE * i] != 3)
            return complain(f->path, "has a face that is not a triangle");
        for (int j = 0; j < 3; j++) {
            const size_t index = word_at(face + FACE * i + 1 + 4 * j);
            if (index >= vertices)
                return complain(f->path, "has a vertex index out of range");
            set_vertex(m, i, j, vertex + VERTEX * index);
        }
    }
    return true;
}

bool mesh_read(const char *path, mesh *m)
{
    *m = (mesh){0};
    file f;
    bool is_read = load(path, &f);
    if (is_read)
        is_read = f.size > 4 && !memcmp(f.bytes, "ply\n", 4) ? read_ply(&f, m) : read_stl(&f, m);
    free(f.bytes);
    if (!is_read)
        mesh_free(m);
    return is_read;
}

void mesh_free(mesh *m)
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            free(m->coordinate[j][a]);
    *m = (mesh){0};
}
