/* crop_ply_binary.c - maps a binary PLY file, and writes its records as they are, but for the numbers of vertices. */
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "crop_ply.h"
#include "files/file_map.h"

typedef unsigned char byte;

typedef struct ply_map {
    crop_ply_file *f;
    const byte *at, *end; /* what comes next of the file */
    byte *copy;           /* room for a face */
    size_t longest;       /* face, in bytes */
} ply_map;

/* One vertex, face or whatever it is, which begins where the map is. */
typedef struct record {
    const byte *corners, *end;
    uint64_t count; /* of the corners */
} record;

static uint64_t load(const byte *from, size_t size, bool is_big)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++)
        bits = bits << 8 | from[is_big ? i : size - 1 - i];
    return bits;
}

static void store(byte *to, size_t size, bool is_big, uint64_t bits)
{
    for (size_t i = 0; i < size; i++)
        to[is_big ? size - 1 - i : i] = (byte)(bits >> 8 * i);
}

static bool is_whole(ply_type type) { return type != PLY_FLOAT && type != PLY_DOUBLE; }

/* Negative whole numbers are too large for a vertex, since the reader has refused them. */
static bool corner_of(const ply_map *m, ply_type type, const byte *from, uint64_t *vertex)
{
    const size_t size = ply_type_size(type);
    const uint64_t bits = load(from, size, m->f->header.format == PLY_BIG_ENDIAN);
    const uint32_t low = (uint32_t)bits;
    float narrow;
    double wide;
    memcpy(&narrow, &low, sizeof narrow);
    memcpy(&wide, &bits, sizeof wide);
    if (!is_whole(type))
        return crop_ply_vertex(m->f, type == PLY_FLOAT ? (double)narrow : wide, vertex);
    *vertex = bits;
    return bits < m->f->vertices;
}

/* A new number is no larger than the old one, so that it fits the same type. */
static void put_corner(const ply_map *m, ply_type type, byte *to, uint64_t vertex)
{
    const float narrow = (float)vertex;
    const double wide = (double)vertex;
    uint64_t bits = vertex;
    uint32_t low;
    memcpy(&low, &narrow, sizeof low);
    if (type == PLY_FLOAT)
        bits = low;
    else if (type == PLY_DOUBLE)
        memcpy(&bits, &wide, sizeof bits);
    store(to, ply_type_size(type), m->f->header.format == PLY_BIG_ENDIAN, bits);
}

static ply_type corner_type(const ply_element *e)
{
    int i = 0;
    while (e->properties[i].role != PLY_CORNERS)
        i++;
    return e->properties[i].type;
}

/* False, and the file has changed, where it ends in the record. */
static bool find_record(const ply_map *m, const ply_element *e, record *r)
{
    const byte *at = m->at;
    *r = (record){.corners = at};
    for (int i = 0; i < e->property_count; i++) {
        const ply_property *const p = &e->properties[i];
        const size_t each = ply_type_size(p->type), size = ply_type_size(p->count), left = (size_t)(m->end - at);
        uint64_t count = 1;
        if (left < size)
            return false;
        if (p->count)
            count = load(at, size, m->f->header.format == PLY_BIG_ENDIAN);
        at += size;
        if (count > (left - size) / each)
            return false;
        if (p->role == PLY_CORNERS) {
            r->corners = at;
            r->count = count;
        }
        at += count * each;
    }
    r->end = at;
    return true;
}

static void mark_face(ply_map *m, const ply_element *e, const record *r)
{
    const ply_type type = corner_type(e);
    const crop_side side = crop_next(m->f->c, r->count);
    bool is_sound = true;
    for (uint64_t i = 0; i < r->count; i++) {
        uint64_t vertex;
        if (corner_of(m, type, r->corners + i * ply_type_size(type), &vertex))
            kept_numbers_add(&m->f->kept[side], vertex);
        else
            is_sound = false;
    }
    m->f->c->is_changed |= !is_sound;
    m->f->c->counts[side].faces++;
    const size_t size = (size_t)(r->end - m->at);
    m->longest = size > m->longest ? size : m->longest;
}

static void put_face(ply_map *m, const ply_element *e, const record *r)
{
    const ply_type type = corner_type(e);
    const crop_side side = crop_next(m->f->c, r->count);
    const size_t size = (size_t)(r->end - m->at), first = (size_t)(r->corners - m->at), each = ply_type_size(type);
    m->f->c->is_changed |= size > m->longest;
    if (m->f->c->is_changed)
        return;
    memcpy(m->copy, m->at, size);
    for (uint64_t i = 0; i < r->count; i++) {
        uint64_t vertex;
        if (corner_of(m, type, r->corners + i * each, &vertex))
            put_corner(m, type, m->copy + first + i * each, kept_numbers_new(&m->f->kept[side], vertex));
    }
    crop_put(m->f->c, side, m->copy, size);
}

static void put_vertex(ply_map *m, uint64_t number, const record *r)
{
    for (int s = 0; s < CROP_SIDES; s++)
        if (kept_numbers_has(&m->f->kept[s], number))
            crop_put(m->f->c, (crop_side)s, m->at, (size_t)(r->end - m->at));
}

static void walk_element(ply_map *m, const ply_element *e, bool is_writing)
{
    const bool is_left_out = m->f->is_left_out[e - m->f->header.elements];
    for (uint64_t n = 0; n < e->count && !crop_is_over(m->f->c); n++) {
        record r;
        if (!find_record(m, e, &r)) {
            m->f->c->is_changed = true;
            return;
        }
        if (e->kind == PLY_FACES && is_writing)
            put_face(m, e, &r);
        else if (e->kind == PLY_FACES)
            mark_face(m, e, &r);
        else if (is_writing && e->kind == PLY_VERTICES)
            put_vertex(m, n, &r);
        else if (is_writing && !is_left_out)
            crop_put_both(m->f->c, m->at, (size_t)(r.end - m->at));
        m->at = r.end;
    }
}

static void walk(ply_map *m, const file_map *map, bool is_writing)
{
    crop_begin(m->f->c);
    m->at = (const byte *)map->bytes + m->f->header.size;
    m->end = (const byte *)map->bytes + map->size;
    for (int e = 0; e < m->f->header.element_count; e++)
        walk_element(m, &m->f->header.elements[e], is_writing);
}

int crop_ply_binary(crop_ply_file *f)
{
    file_map map;
    ply_map m = {.f = f};
    if (file_map_open(&map, f->c->path))
        return message_failure("%s: cannot map the file to read it again", f->c->path);
    f->c->is_changed = map.size < f->header.size;
    if (!f->c->is_changed)
        walk(&m, &map, false);
    m.copy = malloc(m.longest + 1);
    crop_ply_count(f);
    if (m.copy && !f->c->is_changed) {
        crop_ply_heads(f);
        walk(&m, &map, true);
    }
    file_map_close(&map);
    const int code = m.copy ? EXIT_CODE_OK : message_failure("%s: out of memory", f->c->path);
    free(m.copy);
    return code;
}
