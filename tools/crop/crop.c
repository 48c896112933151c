/*
 * crop.c - refuses what cannot be written as it was, before a long mesh is read; writes, binary STL and raw triangles by itself;
 * and keeps the files when all are done.
 */
#include "crop.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "console/interrupt.h"
#include "console/message.h"
#include "files/files.h"
#include "read/little.h"
#include "tribox.h"

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

static int check_path(const crop_files *f, crop_side side, const char *path)
{
    const char *const ending = ending_of(f);
    if (!path || file_out_is_stdout(path))
        return EXIT_CODE_OK;
    if (!mesh_kind_has_ending(path, ending))
        return message_usage("%s: '%s' does not end in %s, and faces are written in the format of the mesh, as they were; give it "
                             "that ending, or convert the mesh first",
                             options[side], path, ending);
    return EXIT_CODE_OK;
}

static int check_paths(const crop_files *f, const char *const paths[CROP_SIDES])
{
    for (crop_side s = CROP_PART; s < CROP_SIDES; s++) {
        const int code = check_path(f, s, paths[s]);
        if (code)
            return code;
    }
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

void crop_begin(crop *c)
{
    c->next = 0;
    c->pass++;
}

static void tell(crop *c)
{
    enum { EACH = 4096 };
    if (++c->told % EACH == 0)
        progress_tell(c->bar, (c->pass - 1 + (double)c->next / (double)c->choice.triangles) / c->passes);
}

static bool is_set(const crop *c, uint64_t triangle) { return c->choice.bits[triangle / 64] >> triangle % 64 & 1; }

crop_side crop_next(crop *c, uint64_t corners)
{
    const uint64_t triangles = corners > 2 ? corners - 2 : 0;
    if (triangles > c->choice.triangles - c->next) {
        c->is_changed = true;
        return CROP_REST;
    }
    uint64_t set = 0;
    for (uint64_t t = 0; t < triangles; t++)
        set += is_set(c, c->next + t);
    c->next += triangles;
    tell(c);
    const crop_side side = set && (!c->choice.needs_all || set == triangles) ? CROP_PART : CROP_REST;
    c->counts[side].faces += c->pass == 1;
    return side;
}

static void fail(crop *c, crop_side side)
{
    c->failed = (int)side + 1;
    c->reason = errno;
}

static void write_buffer(crop *c, crop_side side)
{
    if (c->filled[side] && !c->failed && fwrite(c->buffer[side], 1, c->filled[side], c->to[side]) != c->filled[side])
        fail(c, side);
    c->filled[side] = 0;
}

/* Most of what is put are a few bytes, for which a stream takes long. */
void crop_put(crop *c, crop_side side, const void *bytes, size_t size)
{
    if (!c->to[side] || c->failed)
        return;
    if (size > CROP_BUFFER - c->filled[side])
        write_buffer(c, side);
    if (size > CROP_BUFFER) {
        if (!c->failed && fwrite(bytes, 1, size, c->to[side]) != size)
            fail(c, side);
        return;
    }
    memcpy(c->buffer[side] + c->filled[side], bytes, size);
    c->filled[side] += size;
}

void crop_put_both(crop *c, const void *bytes, size_t size)
{
    for (crop_side s = CROP_PART; s < CROP_SIDES; s++)
        crop_put(c, s, bytes, size);
}

enum { STL_HEADER = 84, STL_COUNT_AT = 80 };

/* In parts, since the library counts up to 2^32 bits at once. */
static uint64_t count_part(const crop_choice *choice)
{
    const uint64_t part = UINT64_C(1) << 30;
    uint64_t set = 0;
    for (uint64_t first = 0; first < choice->triangles; first += part) {
        const uint64_t left = choice->triangles - first;
        set += tribox_mask_indices(choice->bits + first / 64, (size_t)(left < part ? left : part), NULL);
    }
    return set;
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
    const uint64_t part = count_part(&c->choice), counts[CROP_SIDES] = {part, c->choice.triangles - part};
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
static int crop_records(crop *c, triangle_file *file)
{
    const triangle_layout *const layout = &triangle_layouts[file->format];
    const size_t record = layout->record;
    unsigned char *const records = malloc(TRIANGLE_BLOCK * record);
    if (!records)
        return message_failure("%s: out of memory", c->path);
    crop_begin(c);
    c->is_changed = file->promised != c->choice.triangles;
    if (!crop_is_over(c) && file->format == TRIANGLES_STL)
        put_stl_header(c, file);
    while (!crop_is_over(c) && c->next < c->choice.triangles) {
        const uint64_t left = c->choice.triangles - c->next, at = layout->start + c->next * record;
        const size_t count = left < TRIANGLE_BLOCK ? (size_t)left : TRIANGLE_BLOCK;
        size_t got;
        if (named_file_read_at(file->stream, at, records, count * record, &got) && got == count * record)
            put_records(c, records, count, record);
        else
            c->is_changed = true;
    }
    free(records);
    return EXIT_CODE_OK;
}

static int write_records(crop *c, const crop_files *f)
{
    triangle_file file;
    c->passes = 1;
    int code = triangle_file_open(f->mesh_path, f->format, &file);
    if (!code && !file.stream)
        c->is_changed = true;
    else if (!code)
        code = crop_records(c, &file);
    triangle_file_close(&file);
    return code;
}

static int write_faces(crop *c, const crop_files *f)
{
    c->passes = f->kind == MESH_STL_TEXT ? 1 : 2;
    return crop_scanned(c, f->kind);
}

/* Between two readings, too. */
static bool has_changed(const crop_files *f)
{
    file_about now;
    return !named_file_about(f->mesh_path, &now) || now.size != f->mesh.size || now.changed != f->mesh.changed;
}

static int write_all(crop *c, const crop_files *f)
{
    int code = f->format == TRIANGLES_OTHER ? write_faces(c, f) : write_records(c, f);
    for (int s = 0; !code && s < CROP_SIDES; s++) {
        write_buffer(c, (crop_side)s);
        if (!c->failed && c->to[s] && fflush(c->to[s]))
            fail(c, (crop_side)s);
    }
    if (code)
        return code;
    if (c->is_changed || has_changed(f) || (!c->failed && c->next != c->choice.triangles))
        return message_failure("%s: has changed while it was read; nothing was kept", c->path);
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
    progress bar = progress_start("writing");
    crop c = {.path = f->mesh_path, .choice = *choice, .bar = &bar, .to = {f->out[CROP_PART].stream, f->out[CROP_REST].stream}};
    for (int s = 0; s < CROP_SIDES; s++)
        c.buffer[s] = malloc(CROP_BUFFER);
    int code = c.buffer[CROP_PART] && c.buffer[CROP_REST] ? write_all(&c, f) : message_failure("%s: out of memory", c.path);
    progress_end(&bar);
    for (int s = 0; s < CROP_SIDES; s++) {
        free(c.buffer[s]);
        counts[s] = c.counts[s];
        counts[s].has_vertices = f->format == TRIANGLES_OTHER && f->kind != MESH_STL_TEXT;
        if (!code)
            note_empty(f, s, &counts[s]);
    }
    code = code ? code : keep(f);
    crop_files_drop(f);
    return code;
}
