/* triangle_file.c - opens files of triangles, checks their sizes, and turns their bytes into streams. */
#define _POSIX_C_SOURCE 200809L
#include "triangle_file.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <strings.h>

#include "little.h"
#include "console/known_word.h"
#include "console/message.h"
#include "files/files.h"
#include "tribox.h"

enum { NUMBERS = 9, STL_RECORD = 50 };

const triangle_layout triangle_layouts[] = {[TRIANGLES_STL] = {"stl", ".stl", STL_HEADER, STL_RECORD, 12, sizeof(float)},
                                            [TRIANGLES_F32] = {"f32", ".f32", 0, NUMBERS * sizeof(float), 0, sizeof(float)},
                                            [TRIANGLES_F64] = {"f64", ".f64", 0, NUMBERS * sizeof(double), 0, sizeof(double)}};

#define WORD(kind, name, ...) #name " "

int triangle_format_read(const char *text, triangle_format *format)
{
    unsigned n;
    const int code = choice_read("--format", text, strlen(text), MESH_KINDS(WORD) "f32 f64", NULL, &n);
    *format = n >= MESH_OTHER ? TRIANGLES_F32 + (n - MESH_OTHER) : n == MESH_STL_TEXT ? TRIANGLES_STL : TRIANGLES_KINDS + n;
    return code;
}

mesh_kind triangle_format_kind(triangle_format format)
{
    return format < TRIANGLES_KINDS ? MESH_OTHER : (mesh_kind)(format - TRIANGLES_KINDS);
}

static bool is_stdin(const char *path) { return !strcmp(path, "-"); }

int triangle_format_check(const char *path, triangle_format format)
{
    return is_stdin(path) && format == TRIANGLES_OTHER ? message_usage("standard input needs its format: --format " MESH_FORMATS)
                                                       : EXIT_CODE_OK;
}

const char *triangle_file_name(const char *path) { return is_stdin(path) ? "stdin" : path; }

triangle_format triangle_format_of(const char *path)
{
    const char *ending = strrchr(path, '.');
    for (triangle_format f = TRIANGLES_STL; ending && f <= TRIANGLES_F64; f++)
        if (!strcasecmp(ending, triangle_layouts[f].ending))
            return f;
    return TRIANGLES_OTHER;
}

static int open_stream(const char *path, triangle_file *file)
{
    file_about about;
    if (is_stdin(path)) {
        file->stream = stdin;
        return EXIT_CODE_OK;
    }
    if (named_file_about(path, &about) && about.kind == FILE_KIND_FOLDER)
        return message_failure("%s: is a directory; give a mesh file", path);
    file->stream = named_file_open(path, "rb");
    if (!file->stream || !named_file_about_open(file->stream, &about))
        return message_failure("%s: cannot open the mesh file: %s", path, strerror(errno));
    file->is_sized = about.kind == FILE_KIND_REGULAR;
    file->size = file->is_sized ? about.size : UINT64_MAX;
    return EXIT_CODE_OK;
}

/* Text is left to the readers of text, unless --format says that the file is binary. */
static int leave_text(triangle_file *file, bool is_ply, bool is_given)
{
    const char *name = file->name;
    triangle_file_close(file);
    if (!is_given)
        return EXIT_CODE_OK;
    if (is_ply)
        return message_failure("%s: not an STL file: it begins with 'ply'; give --format ply", name);
    return message_failure("%s: is text, and only binary STL can be streamed; give it as a file named .stl, without --format",
                           name);
}

/* Only bytes that occur in UTF-8, and of control characters only white space. */
static bool is_text(const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (bytes[i] < ' ' ? !isspace(bytes[i]) : bytes[i] == 0x7F || bytes[i] >= 0xF8)
            return false;
    return true;
}

/* A binary file may begin with "solid", like text: its size counts for more. */
static int open_stl(triangle_file *file, bool is_given)
{
    unsigned char header[STL_HEADER];
    errno = 0;
    const size_t got = fread(header, 1, sizeof header, file->stream);
    if (ferror(file->stream))
        return message_failure("%s: cannot read the mesh: %s", file->name, strerror(errno));
    if (!got)
        return message_failure("%s: the file is empty", file->name);
    file->promised = got < sizeof header ? 0 : little_get32(header + STL_COUNT_AT);
    const uint64_t due = STL_HEADER + STL_RECORD * file->promised; /* 38 bits at most */
    if (is_text(header, got) && file->size != due)
        return leave_text(file, got >= 3 && !memcmp(header, "ply", 3), is_given);
    if (got < sizeof header)
        return message_failure(
            "%s: truncated, or not an STL file: it has %zu bytes, but the header alone of a binary one has %d; write it again",
            file->name, got, STL_HEADER);
    if (!file->is_sized || file->size == due)
        return EXIT_CODE_OK;
    return message_failure("%s: %s, or not an STL file: it has %" PRIu64 " bytes where a binary STL file of %" PRIu64
                           " triangles, as its header says, has %" PRIu64 "; write it again",
                           file->name, file->size < due ? "truncated" : "has bytes after its last triangle", file->size,
                           file->promised, due);
}

static int open_raw(triangle_file *file)
{
    const size_t record = triangle_layouts[file->format].record;
    const uint64_t whole = file->size / record, rest = file->size % record;
    file->promised = file->is_sized ? whole : UINT64_MAX;
    if (!file->is_sized || !rest)
        return EXIT_CODE_OK;
    return message_failure("%s: truncated, or not raw triangles: after %" PRIu64 " triangles of %zu bytes it has %" PRIu64
                           " bytes more; write it again",
                           file->name, whole, record, rest);
}

int triangle_file_open(const char *path, triangle_format format, triangle_file *file)
{
    const bool is_given = format != TRIANGLES_OTHER;
    *file = (triangle_file){
        .name = triangle_file_name(path), .format = is_given ? format : triangle_format_of(path), .size = UINT64_MAX};
    if (file->format == TRIANGLES_OTHER || file->format >= TRIANGLES_KINDS)
        return EXIT_CODE_OK;
    const int code = open_stream(path, file);
    return code ? code : file->format == TRIANGLES_STL ? open_stl(file, is_given) : open_raw(file);
}

/* Says after how many triangles the file ends too soon. */
static int refuse_end(const triangle_file *file, uint64_t taken, size_t got, int error)
{
    const size_t record = triangle_layouts[file->format].record;
    const uint64_t whole = taken + got / record;
    if (error)
        return message_failure("%s: cannot read the mesh after %" PRIu64 " triangles: %s", file->name, whole, strerror(error));
    char promise[48] = "";
    if (file->promised != UINT64_MAX)
        snprintf(promise, sizeof promise, " of %" PRIu64 " promised", file->promised);
    return message_failure("%s: truncated: %" PRIu64 "%s triangles were read, then it ends with %zu of %zu bytes of the next; "
                           "write it again",
                           file->name, whole, promise, got % record, record);
}

/* Each number ends before the next begins. */
void triangles_unpack(triangle_format format, size_t count, unsigned char *bytes)
{
    const triangle_layout layout = triangle_layouts[format];
    for (size_t i = 0; layout.number_bytes == sizeof(float) && i < count; i++)
        for (size_t k = 0; k < NUMBERS; k++) {
            const uint32_t bits = little_get32(bytes + i * layout.record + layout.numbers_at + 4 * k);
            memcpy(bytes + 4 * (i * NUMBERS + k), &bits, sizeof bits);
        }
    for (size_t k = 0; layout.number_bytes == sizeof(double) && k < NUMBERS * count; k++) {
        const uint64_t bits = little_get64(bytes + 8 * k);
        memcpy(bytes + 8 * k, &bits, sizeof bits);
    }
}

static int check_end(const triangle_file *file)
{
    size_t got = 0;
    unsigned char more;
    if (file->is_sized)
        named_file_read_at(file->stream, file->size, &more, 1, &got);
    if (file->is_sized ? !got : getc(file->stream) == EOF)
        return EXIT_CODE_OK;
    return message_failure("%s: has bytes after the %" PRIu64 " triangles that its header promises; write it again", file->name,
                           file->promised);
}

/* What a stream has next. */
static int read_stream(const triangle_file *file, triangle_block *block)
{
    const size_t record = triangle_layouts[file->format].record, wanted = block->count * record;
    errno = 0;
    const size_t got = fread(block->bytes, 1, wanted, file->stream);
    const int error = ferror(file->stream) ? errno : 0;
    if (error || got % record || (got < wanted && file->promised != UINT64_MAX))
        return refuse_end(file, file->taken, got, error);
    block->count = got / record;
    return EXIT_CODE_OK;
}

int triangle_file_find(triangle_file *file, triangle_block *block)
{
    const uint64_t left = file->promised - file->taken;
    block->first = file->taken;
    block->count = left < TRIANGLE_BLOCK ? (size_t)left : TRIANGLE_BLOCK;
    const int code = !block->count ? check_end(file) : file->is_sized ? EXIT_CODE_OK : read_stream(file, block);
    file->taken += code ? 0 : block->count;
    return code;
}

static int read_at(const triangle_file *file, triangle_block *block)
{
    const triangle_layout *const layout = &triangle_layouts[file->format];
    const size_t bytes = block->count * layout->record;
    size_t got;
    const bool is_read = named_file_read_at(file->stream, layout->start + block->first * layout->record, block->bytes, bytes, &got);
    return is_read && got == bytes ? EXIT_CODE_OK : refuse_end(file, block->first, got, is_read ? 0 : errno);
}

int triangle_file_unpack(const triangle_file *file, triangle_block *block, float *const streams[9], double *positions)
{
    const int code = file->is_sized ? read_at(file, block) : EXIT_CODE_OK;
    if (code)
        return code;
    triangles_unpack(file->format, block->count, block->bytes);
    if (positions) {
        memcpy(positions, block->bytes, block->count * NUMBERS * sizeof *positions);
        return EXIT_CODE_OK;
    }
    const tribox_mesh all = {.positions = block->bytes, .vertices = 3 * block->count, .count = block->count};
    const tribox_status status = tribox_mesh_to_soup(&all, NULL, 0, block->count, NULL, streams, streams + 3, streams + 6);
    return message_status(status);
}

void triangle_file_close(triangle_file *file)
{
    if (file->stream && file->stream != stdin)
        fclose(file->stream);
    file->stream = NULL;
}
