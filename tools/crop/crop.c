/*
 * crop.c - refuses what cannot be written as it was, before a long mesh is read; writes binary STL and raw triangles, record by
 * record, and what scan.h reads, item by item: as they are, but for the numbers of vertices, textures and normals, which are those
 * that are used, and for their counts; and keeps the files when all are done.
 */
#include "crop.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/interrupt.h"
#include "console/message.h"
#include "console/progress.h"
#include "read/little.h"
#include "read/scan.h"
#include "write/voxels.h"

static const char *const options[CROP_SIDES] = {"-o", "--rest"};

static const char *ending_of(const crop_files *f)
{
    return f->format != TRIANGLES_OTHER ? triangle_layouts[f->format].ending : mesh_kind_ending(f->kind);
}

/* Binary STL may have a name of any ending, and a name in .stl be of text. */
static int find_format(triangle_format given, crop_files *f)
{
    triangle_file triangles;
    const int code = triangle_file_open(f->mesh_path, given, &triangles);
    f->format = triangles.stream ? triangles.format : TRIANGLES_OTHER;
    triangle_file_close(&triangles);
    if (code)
        return code;
    f->kind = given >= TRIANGLES_KINDS       ? triangle_format_kind(given)
              : f->format == TRIANGLES_OTHER ? mesh_kind_of(f->mesh_path)
                                             : MESH_OTHER;
    if (f->format != TRIANGLES_OTHER || f->kind != MESH_OTHER)
        return EXIT_CODE_OK;
    return message_failure("%s: -o and --rest write " MESH_ENDINGS
                           ", each from a mesh of the same format; convert it to one of these first",
                           f->mesh_path);
}

static int check_mesh(const char *path, file_about *about)
{
    if (!named_file_about(path, about))
        return message_failure("%s: cannot open the mesh file: %s", path, strerror(errno));
    if (about->kind == FILE_KIND_FOLDER)
        return message_failure("%s: is a directory; give a mesh file", path);
    if (about->kind != FILE_KIND_REGULAR)
        return message_failure("%s: is not a regular file, and -o and --rest read the mesh twice; save it as a file first", path);
    return about->size ? EXIT_CODE_OK : message_failure("%s: the file is empty", path);
}

static int check_paths(const crop_files *f, const char *const paths[CROP_SIDES])
{
    for (crop_side s = CROP_PART; s < CROP_SIDES; s++)
        if (paths[s] && !file_out_is_stdout(paths[s]) && !mesh_kind_has_ending(paths[s], ending_of(f)))
            return message_usage("%s: '%s' does not end in %s, and faces are written in the format of the mesh, as they were; give "
                                 "it that ending, or convert the mesh first",
                                 options[s], paths[s], ending_of(f));
    const file_out_names names = {{options[CROP_PART], options[CROP_REST]}, {paths[CROP_PART], paths[CROP_REST]}};
    return file_out_check(&names, "mesh", &f->mesh_path, 1);
}

int crop_files_open(const char *mesh_path, triangle_format format, const char *const paths[CROP_SIDES], crop_files *f)
{
    *f = (crop_files){.mesh_path = mesh_path, .kind = MESH_OTHER};
    int code = check_mesh(mesh_path, &f->mesh);
    if (!code)
        code = find_format(format, f);
    if (!code)
        code = check_paths(f, paths);
    for (int s = 0; !code && s < CROP_SIDES; s++)
        code = file_out_open(&f->out[s], paths[s]);
    return code;
}

void crop_files_drop(crop_files *f)
{
    for (int s = 0; s < CROP_SIDES; s++)
        file_out_drop(&f->out[s]);
}

/* Numbers of vertices, some of which are kept: those get numbers from 0, in the same order. */
typedef struct kept_numbers {
    struct {
        uint64_t bits, before; /* of 64 numbers those that are kept; and how many are before them */
    } * rows;
    uint64_t count, kept;
} kept_numbers;

/* Of `count` numbers none is kept yet. Returns an exit_code. */
static int kept_numbers_make(const char *path, uint64_t count, kept_numbers *k)
{
    k->count = count;
    k->rows = count <= UINT32_MAX ? calloc((size_t)(count / 64) + 1, sizeof *k->rows) : NULL;
    return k->rows ? EXIT_CODE_OK : message_failure("%s: out of memory for the numbers of %" PRIu64 " vertices", path, count);
}

/* To be called between the last that is added and the first that is asked for. */
static void kept_numbers_count(kept_numbers *k)
{
    for (uint64_t r = 0; r < k->count / 64 + 1; r++) {
        k->rows[r].before = k->kept;
        k->kept += (unsigned)__builtin_popcountll(k->rows[r].bits);
    }
}

/* The new number of one that is kept. */
static uint64_t kept_numbers_new(const kept_numbers *k, uint64_t number)
{
    const uint64_t below = k->rows[number / 64].bits & ((UINT64_C(1) << number % 64) - 1);
    return k->rows[number / 64].before + (unsigned)__builtin_popcountll(below);
}

static void kept_numbers_add(kept_numbers *k, uint64_t number) { k->rows[number / 64].bits |= UINT64_C(1) << number % 64; }

static bool kept_numbers_has(const kept_numbers *k, uint64_t number) { return k->rows[number / 64].bits >> number % 64 & 1; }

/* Lines that wait for a face, in their order in the file, so that no empty groups are written. */
typedef struct states {
    struct {
        const char *begin, *end;
        int which;
    } waiting[SCAN_STATES];
    int count;
} states;

enum { BUFFER = 1 << 16 };

typedef struct crop {
    const crop_files *f;
    crop_choice choice;
    crop_counts counts[CROP_SIDES];
    unsigned char buffer[CROP_SIDES][BUFFER]; /* what is written next */
    size_t filled[CROP_SIDES];
    int failed, reason; /* whether a write failed, its side + 1, and why */
    bool is_changed;    /* the file has not the triangles that it had */

    uint64_t next;    /* triangle, of the face that comes next */
    int pass, passes; /* over all faces */
    uint64_t told;    /* faces */
    progress bar;

    scan s; /* of what is no list of triangles */
    kept_numbers kept[CROP_SIDES][SCAN_NUMBERED];
    states states[CROP_SIDES];
    uint64_t left_out; /* lines of OBJ */
} crop;

/* Whether there is no use in going on. */
static bool is_over(const crop *c) { return c->is_changed || c->failed; }

static void tell(crop *c)
{
    enum { EACH = 4096 };
    if (++c->told % EACH == 0)
        progress_tell(&c->bar, (c->pass - 1 + (double)c->next / (double)c->choice.triangles) / c->passes);
}

/* The side of the next face, of so many corners. Of fewer than three it has no triangle, and goes with the rest. */
static crop_side crop_next(crop *c, uint64_t corners)
{
    const uint64_t triangles = corners > 2 ? corners - 2 : 0;
    if (triangles > c->choice.triangles - c->next) {
        c->is_changed = true;
        return CROP_REST;
    }
    uint64_t set = 0;
    for (const uint64_t end = c->next + triangles; c->next < end; c->next++)
        set += c->choice.bits[c->next / 64] >> c->next % 64 & 1;
    tell(c);
    const crop_side side = set && (!c->choice.needs_all || set == triangles) ? CROP_PART : CROP_REST;
    c->counts[side].faces += c->pass == 1;
    return side;
}

static void write_bytes(crop *c, crop_side side, const void *bytes, size_t size)
{
    if (c->failed || fwrite(bytes, 1, size, c->f->out[side].stream) == size)
        return;
    c->failed = (int)side + 1;
    c->reason = errno;
}

/* Nothing where that side is not wanted. Most of what is put are a few bytes, for which a stream takes long. */
static void crop_put(crop *c, crop_side side, const void *bytes, size_t size)
{
    if (!c->f->out[side].stream)
        return;
    if (size > BUFFER - c->filled[side]) {
        write_bytes(c, side, c->buffer[side], c->filled[side]);
        c->filled[side] = 0;
    }
    if (size > BUFFER) {
        write_bytes(c, side, bytes, size);
        return;
    }
    memcpy(c->buffer[side] + c->filled[side], bytes, size);
    c->filled[side] += size;
}

/* It ends in the number of triangles. */
static void put_stl_header(crop *c, const triangle_file *file)
{
    unsigned char header[STL_HEADER];
    size_t got;
    if (!named_file_read_at(file->stream, 0, header, sizeof header, &got) || got < sizeof header) {
        c->is_changed = true;
        return;
    }
    const uint64_t part = voxels_count(c->choice.bits, tribox_mask_words((size_t)c->choice.triangles)),
                   counts[CROP_SIDES] = {part, c->choice.triangles - part};
    for (int s = 0; s < CROP_SIDES; s++) {
        little_put32(header + STL_COUNT_AT, (uint32_t)counts[s]);
        crop_put(c, (crop_side)s, header, sizeof header);
    }
}

/* Those that follow each other and go to one side are one write. */
static void put_records(crop *c, const unsigned char *records, size_t count, size_t record)
{
    crop_side side = CROP_PART;
    size_t first = 0;
    for (size_t i = 0; i < count; i++) {
        const crop_side own = crop_next(c, 3);
        if (own != side)
            crop_put(c, side, records + first * record, (i - first) * record);
        first = own != side ? i : first;
        side = own;
    }
    crop_put(c, side, records + first * record, (count - first) * record);
}

/* Records of one size, which stay what they are, byte for byte. */
static int write_records(crop *c)
{
    const triangle_layout *const layout = &triangle_layouts[c->f->format];
    const size_t record = layout->record;
    unsigned char *const records = malloc(TRIANGLE_BLOCK * record);
    triangle_file file = {.stream = NULL};
    int code =
        records ? triangle_file_open(c->f->mesh_path, c->f->format, &file) : message_failure("%s: out of memory", c->f->mesh_path);
    c->pass = c->passes = 1;
    c->is_changed = !code && (!file.stream || file.promised != c->choice.triangles);
    if (!code && !is_over(c) && file.format == TRIANGLES_STL)
        put_stl_header(c, &file);
    while (!code && !is_over(c) && c->next < c->choice.triangles) {
        const uint64_t left = c->choice.triangles - c->next, at = layout->start + c->next * record;
        const size_t count = left < TRIANGLE_BLOCK ? (size_t)left : TRIANGLE_BLOCK;
        size_t got;
        if (named_file_read_at(file.stream, at, records, count * record, &got) && got == count * record)
            put_records(c, records, count, record);
        else
            c->is_changed = true;
    }
    triangle_file_close(&file);
    free(records);
    return code;
}

/* Points and lines overlap nothing, as they are not asked about. */
static crop_side side_of(crop *c) { return c->s.item.kind == SCAN_LINE ? CROP_REST : crop_next(c, c->s.item.corners); }

static bool has_side(scan_kind kind) { return kind == SCAN_FACE || kind == SCAN_FACET || kind == SCAN_LINE; }

static void mark(crop *c)
{
    const scan_item *const i = &c->s.item;
    c->left_out += i->kind == SCAN_LEFT_OUT;
    if (!has_side(i->kind))
        return;
    const crop_side side = side_of(c);
    for (size_t n = 0; n < i->count; n++)
        kept_numbers_add(&c->kept[side][i->references[n].which], i->references[n].number);
}

/* The edges are not counted anew: programs take 0 for that. */
static uint64_t number_of(const crop *c, crop_side side, const scan_reference *r)
{
    return r->which == SCAN_VERTICES ? c->counts[side].vertices
           : r->which == SCAN_FACES  ? c->counts[side].faces
           : r->which == SCAN_EDGES  ? 0
                                     : kept_numbers_new(&c->kept[side][r->which], r->number) + (c->s.kind == MESH_OBJ);
}

/* Numbers of a binary face take as many bytes as before. False where it has too many. */
static bool put_binary(crop *c, crop_side side)
{
    enum { SHORT = 256 };
    const scan_item *const i = &c->s.item;
    const size_t size = (size_t)(i->end - i->begin);
    char copy[SHORT];
    if (size > SHORT || !i->count || i->references[0].type == PLY_NONE)
        return false;
    memcpy(copy, i->begin, size);
    for (size_t n = 0; n < i->count; n++)
        scan_spell(&c->s, &i->references[n], number_of(c, side, &i->references[n]), copy + (i->references[n].at - i->begin));
    crop_put(c, side, copy, size);
    return true;
}

static void put_item(crop *c, crop_side side)
{
    const scan_item *const i = &c->s.item;
    if (put_binary(c, side))
        return;
    const char *from = i->begin;
    char number[SCAN_DIGITS];
    for (size_t n = 0; n < i->count; n++) {
        const scan_reference *const r = &i->references[n];
        crop_put(c, side, from, (size_t)(r->at - from));
        crop_put(c, side, number, scan_spell(&c->s, r, number_of(c, side, r), number));
        from = r->at + r->length;
    }
    crop_put(c, side, from, (size_t)(i->end - from));
    crop_put(c, side, i->after, strlen(i->after));
}

/* In place of another of what it says. */
static void set_state(states *s, const scan_item *i)
{
    int kept = 0;
    for (int n = 0; n < s->count; n++)
        if (s->waiting[n].which != i->which)
            s->waiting[kept++] = s->waiting[n];
    s->waiting[kept].begin = i->begin;
    s->waiting[kept].end = i->end;
    s->waiting[kept].which = i->which;
    s->count = kept + 1;
}

static void put_states(crop *c, crop_side side)
{
    states *const s = &c->states[side];
    for (int n = 0; n < s->count; n++)
        crop_put(c, side, s->waiting[n].begin, (size_t)(s->waiting[n].end - s->waiting[n].begin));
    s->count = 0;
}

/* Those of a run that are kept and follow each other are one write. */
static void put_vertices(crop *c, crop_side side)
{
    const scan_item *const i = &c->s.item;
    const kept_numbers *const kept = &c->kept[side][i->which];
    const uint64_t first = c->s.here[i->which] - i->run, each = (uint64_t)(i->end - i->begin) / i->run;
    for (uint64_t n = 0, end; n < i->run; n = end) {
        const bool is_kept = kept_numbers_has(kept, first + n);
        end = n + 1;
        while (end < i->run && kept_numbers_has(kept, first + end) == is_kept)
            end++;
        if (is_kept)
            crop_put(c, side, i->begin + n * each, (size_t)((end - n) * each));
    }
    if (i->run == 1 && kept_numbers_has(kept, first))
        crop_put(c, side, i->after, strlen(i->after));
}

static void put(crop *c)
{
    const scan_item *const i = &c->s.item;
    for (crop_side side = CROP_PART; side < CROP_SIDES; side++)
        crop_put(c, side, i->gap, (size_t)(i->begin - i->gap));
    if (has_side(i->kind)) {
        const crop_side side = side_of(c);
        put_states(c, side);
        put_item(c, side);
        return;
    }
    for (crop_side side = CROP_PART; side < CROP_SIDES && i->kind != SCAN_LEFT_OUT; side++)
        if (i->kind == SCAN_STATE)
            set_state(&c->states[side], i);
        else if (i->kind == SCAN_VERTEX)
            put_vertices(c, side);
        else
            put_item(c, side);
}

static void walk(crop *c, void (*take)(crop *c))
{
    c->next = 0;
    c->pass++;
    scan_again(&c->s);
    do {
        c->is_changed |= scan_next(&c->s) != EXIT_CODE_OK;
        if (!c->is_changed)
            take(c);
    } while (!is_over(c) && c->s.item.kind != SCAN_END);
}

/* What is not written as it was. */
static int check_ply(const crop *c)
{
    for (int e = 0; e < c->s.ply.element_count; e++) {
        const ply_element *const element = &c->s.ply.elements[e];
        if (element->kind == PLY_STRIPS && element->count)
            return message_failure("%s: has strips of triangles, which -o and --rest do not cut; save the mesh with faces",
                                   c->f->mesh_path);
        if (c->s.is_left_out[e] && element->count)
            message_say("note: %s: its %" PRIu64 " of '%.*s' refer to vertices, and are left out of what is written",
                        c->f->mesh_path, element->count, element->name_length, element->name);
    }
    return EXIT_CODE_OK;
}

static int crop_items(crop *c)
{
    int code = c->s.kind == MESH_PLY ? check_ply(c) : EXIT_CODE_OK;
    for (int i = 0; !code && i < CROP_SIDES * SCAN_NUMBERED; i++)
        code = kept_numbers_make(c->f->mesh_path, c->s.all[i % SCAN_NUMBERED], &c->kept[i / SCAN_NUMBERED][i % SCAN_NUMBERED]);
    if (code)
        return code;
    if (c->passes == 2)
        walk(c, mark);
    for (int i = 0; i < CROP_SIDES * SCAN_NUMBERED; i++)
        kept_numbers_count(&c->kept[i / SCAN_NUMBERED][i % SCAN_NUMBERED]);
    for (int s = 0; s < CROP_SIDES; s++)
        c->counts[s].vertices = c->kept[s][SCAN_POSITIONS].kept;
    if (!is_over(c))
        walk(c, put);
    if (c->s.kind == MESH_OBJ && c->left_out)
        message_say("note: %s: %" PRIu64 " lines of curves and surfaces are left out of what is written", c->f->mesh_path,
                    c->left_out);
    return code;
}

/* Its bytes are not copied: the header of a sound file is looked at no further than to its end. */
static bool map_binary(crop *c, file_map *map, whole_file *file)
{
    if (file_map_open(map, c->f->mesh_path) != FILE_MAP_OK)
        return false;
    *file = (whole_file){map->bytes, map->size};
    return file->size && !ply_header_read(NULL, file, &c->s.ply) && c->s.ply.format != PLY_ASCII;
}

static int write_items(crop *c)
{
    const mesh_kind kind = c->f->kind;
    file_map map = {.bytes = NULL};
    whole_file file = {NULL, 0};
    const bool is_mapped = kind == MESH_PLY && map_binary(c, &map, &file);
    int code = is_mapped ? EXIT_CODE_OK : whole_file_read(c->f->mesh_path, kind, &file);
    c->passes = kind == MESH_STL_TEXT ? 1 : 2;
    if (!code) {
        c->is_changed = scan_open(NULL, kind, &file, &c->s) != EXIT_CODE_OK;
        code = c->is_changed ? EXIT_CODE_OK : crop_items(c);
        scan_close(&c->s);
    }
    for (int i = 0; i < CROP_SIDES * SCAN_NUMBERED; i++)
        free(c->kept[i / SCAN_NUMBERED][i % SCAN_NUMBERED].rows);
    if (!is_mapped)
        whole_file_free(&file);
    file_map_close(&map);
    return code;
}

/* Between two readings, too. */
static bool has_changed(const crop_files *f)
{
    file_about now;
    return !named_file_about(f->mesh_path, &now) || now.size != f->mesh.size || now.changed != f->mesh.changed;
}

static int write_all(crop *c)
{
    const crop_files *const f = c->f;
    int code = f->format == TRIANGLES_OTHER ? write_items(c) : write_records(c);
    for (crop_side s = CROP_PART; !code && s < CROP_SIDES; s++) {
        if (!f->out[s].stream)
            continue;
        write_bytes(c, s, c->buffer[s], c->filled[s]);
        if (!c->failed && fflush(f->out[s].stream)) {
            c->failed = (int)s + 1;
            c->reason = errno;
        }
    }
    if (code)
        return code;
    if (c->is_changed || has_changed(f) || (!c->failed && c->next != c->choice.triangles))
        return message_failure("%s: has changed while it was read; nothing was kept", f->mesh_path);
    errno = c->reason;
    return c->failed ? file_out_failure(&f->out[c->failed - 1]) : EXIT_CODE_OK;
}

static void note_empty(const crop_files *f, int side, const crop_counts *counts)
{
    if (f->out[side].stream && !counts->faces)
        message_say("note: %s: has no face, since %s", file_out_is_stdout(f->out[side].path) ? "stdout" : f->out[side].path,
                    side == CROP_PART ? "none is in the box" : "all are in the box");
}

/* Both or neither. */
static int keep(crop_files *f)
{
    interrupt_hold();
    const int code = file_out_keep_both(&f->out[CROP_PART], &f->out[CROP_REST]);
    if (!code)
        interrupt_advise("the faces are written, what is said of them is not");
    interrupt_release();
    return code;
}

int crop_write(crop_files *f, const crop_choice *choice, crop_counts counts[CROP_SIDES])
{
    crop *const c = calloc(1, sizeof *c);
    int code = c ? EXIT_CODE_OK : message_failure("%s: out of memory", f->mesh_path);
    if (c) {
        c->f = f;
        c->choice = *choice;
        c->bar = progress_start("writing");
        code = write_all(c);
        progress_end(&c->bar);
    }
    for (int s = 0; !code && s < CROP_SIDES; s++) {
        counts[s] = c->counts[s];
        counts[s].has_vertices = f->format == TRIANGLES_OTHER && f->kind != MESH_STL_TEXT;
        note_empty(f, s, &counts[s]);
    }
    free(c);
    code = code ? code : keep(f);
    crop_files_drop(f);
    return code;
}
