/*
 * crop_scanned.c - PLY, OFF, OBJ and STL as text: items as they are, but for the numbers of vertices, textures and normals, which
 * are those that are used, and for their counts.
 */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "crop.h"
#include "files/files.h"
#include "read/scan.h"

/* Numbers of vertices, some of which are kept: those get numbers from 0, in the same order. 12 bytes for 64 numbers. */
typedef struct kept_numbers {
    uint64_t *bits;
    uint32_t *before; /* each word of bits: how many are kept */
    uint64_t count, kept;
} kept_numbers;

/* Of `count` numbers none is kept yet. Returns an exit_code; kept_numbers_free may follow in any case. */
static int kept_numbers_make(const char *path, uint64_t count, kept_numbers *k)
{
    const uint64_t rows = count / 64 + 1;
    *k = (kept_numbers){.count = count};
    if (count <= UINT32_MAX) {
        k->bits = calloc((size_t)rows, sizeof *k->bits);
        k->before = calloc((size_t)rows, sizeof *k->before);
    }
    return k->bits && k->before ? EXIT_CODE_OK
                                : message_failure("%s: out of memory for the numbers of %" PRIu64 " vertices", path, count);
}

static void kept_numbers_free(kept_numbers *k)
{
    free(k->bits);
    free(k->before);
    *k = (kept_numbers){.bits = NULL};
}

/* To be called between the last that is added and the first that is asked for. */
static void kept_numbers_count(kept_numbers *k)
{
    k->kept = 0;
    for (uint64_t w = 0; w < k->count / 64 + 1; w++) {
        k->before[w] = (uint32_t)k->kept;
        k->kept += (unsigned)__builtin_popcountll(k->bits[w]);
    }
}

/* The new number of one that is kept. */
static uint64_t kept_numbers_new(const kept_numbers *k, uint64_t number)
{
    const uint64_t below = k->bits[number / 64] & ((UINT64_C(1) << number % 64) - 1);
    return k->before[number / 64] + (unsigned)__builtin_popcountll(below);
}

static void kept_numbers_add(kept_numbers *k, uint64_t number) { k->bits[number / 64] |= UINT64_C(1) << number % 64; }

static bool kept_numbers_has(const kept_numbers *k, uint64_t number) { return k->bits[number / 64] >> number % 64 & 1; }

/* Lines that wait for a face, so that no empty groups are written. */
typedef struct states {
    const char *begin[SCAN_STATES], *end[SCAN_STATES]; /* NULL: none waits */
    int waiting;
} states;

typedef struct cropping {
    crop *c;
    scan s;
    kept_numbers kept[CROP_SIDES][SCAN_NUMBERED];
    states states[CROP_SIDES];
    uint64_t left_out; /* lines of OBJ */
} cropping;

/* Points and lines overlap nothing, as they are not asked about. */
static crop_side side_of(cropping *k) { return k->s.item.kind == SCAN_LINE ? CROP_REST : crop_next(k->c, k->s.item.corners); }

static bool has_side(scan_kind kind) { return kind == SCAN_FACE || kind == SCAN_FACET || kind == SCAN_LINE; }

static void mark(cropping *k)
{
    const scan_item *const i = &k->s.item;
    k->left_out += i->kind == SCAN_LEFT_OUT;
    if (!has_side(i->kind))
        return;
    const crop_side side = side_of(k);
    for (size_t n = 0; n < i->count; n++)
        kept_numbers_add(&k->kept[side][i->references[n].which], i->references[n].number);
}

/* The edges are not counted anew: programs take 0 for that. */
static uint64_t number_of(const cropping *k, crop_side side, const scan_reference *r)
{
    return r->which == SCAN_VERTICES ? k->c->counts[side].vertices
           : r->which == SCAN_FACES  ? k->c->counts[side].faces
           : r->which == SCAN_EDGES  ? 0
                                     : kept_numbers_new(&k->kept[side][r->which], r->number) + (k->s.kind == MESH_OBJ);
}

/* Numbers of a binary face take as many bytes as before. False where it has too many. */
static bool put_binary(cropping *k, crop_side side)
{
    enum { SHORT = 256 };
    const scan_item *const i = &k->s.item;
    const size_t size = (size_t)(i->end - i->begin);
    char copy[SHORT];
    if (size > SHORT || !i->count || i->references[0].type == PLY_NONE)
        return false;
    memcpy(copy, i->begin, size);
    for (size_t n = 0; n < i->count; n++)
        scan_spell(&k->s, &i->references[n], number_of(k, side, &i->references[n]), copy + (i->references[n].at - i->begin));
    crop_put(k->c, side, copy, size);
    return true;
}

static void put_item(cropping *k, crop_side side)
{
    const scan_item *const i = &k->s.item;
    if (put_binary(k, side))
        return;
    const char *from = i->begin;
    char number[SCAN_DIGITS];
    for (size_t n = 0; n < i->count; n++) {
        const scan_reference *const r = &i->references[n];
        crop_put(k->c, side, from, (size_t)(r->at - from));
        crop_put(k->c, side, number, scan_spell(&k->s, r, number_of(k, side, r), number));
        from = r->at + r->length;
    }
    crop_put(k->c, side, from, (size_t)(i->end - from));
    crop_put(k->c, side, i->after, strlen(i->after));
}

static void set_state(states *s, const scan_item *i)
{
    s->waiting += !s->begin[i->which];
    s->begin[i->which] = i->begin;
    s->end[i->which] = i->end;
}

/* In their order in the file. */
static void put_states(cropping *k, crop_side side)
{
    states *const s = &k->states[side];
    for (; s->waiting; s->waiting--) {
        int first = 0;
        while (!s->begin[first])
            first++;
        for (int i = first + 1; i < SCAN_STATES; i++)
            if (s->begin[i] && s->begin[i] < s->begin[first])
                first = i;
        crop_put(k->c, side, s->begin[first], (size_t)(s->end[first] - s->begin[first]));
        s->begin[first] = NULL;
    }
}

/* Those of a run that are kept and follow each other are one write. */
static void put_vertices(cropping *k, crop_side side)
{
    const scan_item *const i = &k->s.item;
    const kept_numbers *const kept = &k->kept[side][i->which];
    const uint64_t first = k->s.here[i->which] - i->run, each = (uint64_t)(i->end - i->begin) / i->run;
    for (uint64_t n = 0, end; n < i->run; n = end) {
        const bool is_kept = kept_numbers_has(kept, first + n);
        end = n + 1;
        while (end < i->run && kept_numbers_has(kept, first + end) == is_kept)
            end++;
        if (is_kept)
            crop_put(k->c, side, i->begin + n * each, (size_t)((end - n) * each));
    }
    if (i->run == 1 && kept_numbers_has(kept, first))
        crop_put(k->c, side, i->after, strlen(i->after));
}

static void put(cropping *k)
{
    const scan_item *const i = &k->s.item;
    crop_put_both(k->c, i->gap, (size_t)(i->begin - i->gap));
    if (has_side(i->kind)) {
        const crop_side side = side_of(k);
        put_states(k, side);
        put_item(k, side);
        return;
    }
    for (crop_side side = CROP_PART; side < CROP_SIDES && i->kind != SCAN_LEFT_OUT; side++)
        if (i->kind == SCAN_STATE)
            set_state(&k->states[side], i);
        else if (i->kind == SCAN_VERTEX)
            put_vertices(k, side);
        else
            put_item(k, side);
}

static void walk(cropping *k, void (*take)(cropping *k))
{
    crop_begin(k->c);
    scan_again(&k->s);
    do {
        k->c->is_changed |= scan_next(&k->s) != EXIT_CODE_OK;
        if (!k->c->is_changed)
            take(k);
    } while (!crop_is_over(k->c) && k->s.item.kind != SCAN_END);
}

/* What is not written as it was. */
static int check_ply(const cropping *k)
{
    for (int e = 0; e < k->s.ply.element_count; e++) {
        const ply_element *const element = &k->s.ply.elements[e];
        if (element->kind == PLY_STRIPS && element->count)
            return message_failure("%s: has strips of triangles, which -o and --rest do not cut; save the mesh with faces",
                                   k->c->path);
        if (k->s.is_left_out[e] && element->count)
            message_say("note: %s: its %" PRIu64 " of '%.*s' refer to vertices, and are left out of what is written", k->c->path,
                        element->count, element->name_length, element->name);
    }
    return EXIT_CODE_OK;
}

static int crop_items(cropping *k)
{
    int code = k->s.kind == MESH_PLY ? check_ply(k) : EXIT_CODE_OK;
    for (int i = 0; !code && i < CROP_SIDES * SCAN_NUMBERED; i++)
        code = kept_numbers_make(k->c->path, k->s.all[i % SCAN_NUMBERED], &k->kept[i / SCAN_NUMBERED][i % SCAN_NUMBERED]);
    if (code)
        return code;
    if (k->c->passes == 2)
        walk(k, mark);
    for (int i = 0; i < CROP_SIDES * SCAN_NUMBERED; i++)
        kept_numbers_count(&k->kept[i / SCAN_NUMBERED][i % SCAN_NUMBERED]);
    for (int s = 0; s < CROP_SIDES; s++)
        k->c->counts[s].vertices = k->kept[s][SCAN_POSITIONS].kept;
    if (!crop_is_over(k->c))
        walk(k, put);
    if (k->s.kind == MESH_OBJ && k->left_out)
        message_say("note: %s: %" PRIu64 " lines of curves and surfaces are left out of what is written", k->c->path, k->left_out);
    return code;
}

/* Its bytes are not copied: the header of a sound file is looked at no further than to its end. */
static bool map_binary(cropping *k, file_map *map, whole_file *file)
{
    if (file_map_open(map, k->c->path) != FILE_MAP_OK)
        return false;
    *file = (whole_file){map->bytes, map->size};
    return file->size && !ply_header_read(NULL, file, &k->s.ply) && k->s.ply.format != PLY_ASCII;
}

int crop_scanned(crop *c, mesh_kind kind)
{
    file_map map = {.bytes = NULL};
    whole_file file = {NULL, 0};
    cropping *const k = calloc(1, sizeof *k);
    if (!k)
        return message_failure("%s: out of memory", c->path);
    k->c = c;
    const bool is_mapped = kind == MESH_PLY && map_binary(k, &map, &file);
    int code = is_mapped ? EXIT_CODE_OK : whole_file_read(c->path, kind, &file);
    if (!code) {
        c->is_changed = scan_open(NULL, kind, &file, &k->s) != EXIT_CODE_OK;
        code = c->is_changed ? EXIT_CODE_OK : crop_items(k);
        scan_close(&k->s);
    }
    for (int i = 0; i < CROP_SIDES * SCAN_NUMBERED; i++)
        kept_numbers_free(&k->kept[i / SCAN_NUMBERED][i % SCAN_NUMBERED]);
    if (!is_mapped)
        whole_file_free(&file);
    file_map_close(&map);
    free(k);
    return code;
}
