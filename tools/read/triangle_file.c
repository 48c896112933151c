/* triangle_file.c - opens files of triangles with a look at their sizes, and turns their bytes into streams. */
#define _POSIX_C_SOURCE 200809L
#include "triangle_file.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "little.h"
#include "console/message.h"
#include "tribox.h"

enum { FLOATS = 9, STL_HEADER = 84, STL_COUNT_AT = 80, RECORD_MOST = 50 };

/* The bytes of a triangle, and where in them its floats begin. */
static const struct {
    const char *word, *ending;
    size_t record, floats_at;
} formats[] = {[TRIANGLES_STL] = {"stl", ".stl", RECORD_MOST, 12}, [TRIANGLES_F32] = {"f32", ".f32", 4 * FLOATS, 0}};

int triangle_format_read(const char *text, triangle_format *format)
{
    for (*format = TRIANGLES_STL; *format <= TRIANGLES_F32; ++*format)
        if (!strcmp(text, formats[*format].word))
            return EXIT_CODE_OK;
    return message_usage("--format: '%s' is none of stl, f32", text);
}

static triangle_format format_of_name(const char *path)
{
    const char *ending = strrchr(path, '.');
    for (triangle_format f = TRIANGLES_STL; ending && f <= TRIANGLES_F32; f++)
        if (!strcasecmp(ending, formats[f].ending))
            return f;
    return TRIANGLES_OTHER;
}

static int open_stream(const char *path, triangle_file *file)
{
    struct stat about;
    if (!strcmp(path, "-")) {
        file->name = "stdin";
        file->stream = stdin;
        return EXIT_CODE_OK;
    }
    file->stream = fopen(path, "rb");
    if (!file->stream || fstat(fileno(file->stream), &about))
        return message_failure("%s: cannot open the mesh file: %s", path, strerror(errno));
    if (S_ISDIR(about.st_mode))
        return message_failure("%s: is a directory; give a mesh file", path);
    file->is_sized = S_ISREG(about.st_mode);
    file->size = file->is_sized ? (uint64_t)about.st_size : UINT64_MAX;
    return file->size ? EXIT_CODE_OK : message_failure("%s: the file is empty", path);
}

static int refuse_stl_size(const triangle_file *file, uint64_t due)
{
    const char *what = file->size < due ? "truncated" : "has bytes behind its last triangle";
    return message_failure("%s: %s, or no STL file: it has %" PRIu64 " bytes where a binary STL file of %" PRIu64
                           " triangles, as its header says, has %" PRIu64 "; write it anew",
                           file->name, what, file->size, file->promised, due);
}

/* What is text is left to others where nobody has said that the file is binary. */
static int leave_text(triangle_file *file, bool is_asked)
{
    const char *name = file->name;
    triangle_file_close(file);
    if (!is_asked)
        return EXIT_CODE_OK;
    return message_failure("%s: is text, and only binary STL can be streamed; give it as a file named .stl, without --format",
                           name);
}

/* Nothing that UTF-8 has not, and no control characters but white space. */
static bool is_text(const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (bytes[i] < ' ' ? !isspace(bytes[i]) : bytes[i] == 0x7F || bytes[i] >= 0xF8)
            return false;
    return true;
}

/* A binary file may begin like text, with "solid": its size tells first. */
static int open_stl(triangle_file *file, bool is_asked)
{
    unsigned char header[STL_HEADER];
    errno = 0;
    const size_t got = fread(header, 1, sizeof header, file->stream);
    if (ferror(file->stream))
        return message_failure("%s: cannot read the mesh: %s", file->name, strerror(errno));
    if (!got)
        return message_failure("%s: the file is empty", file->name);
    file->promised = got < sizeof header ? 0 : little_get32(header + STL_COUNT_AT);
    const uint64_t due = STL_HEADER + RECORD_MOST * file->promised; /* 38 bits at most */
    if (is_text(header, got) && file->size != due)
        return leave_text(file, is_asked);
    if (got < sizeof header)
        return message_failure("%s: truncated, or no STL file: it has %zu bytes, the header alone of a binary STL file has %d",
                               file->name, got, STL_HEADER);
    return file->is_sized && file->size != due ? refuse_stl_size(file, due) : EXIT_CODE_OK;
}

static int open_f32(triangle_file *file)
{
    const uint64_t whole = file->size / formats[TRIANGLES_F32].record, rest = file->size % formats[TRIANGLES_F32].record;
    file->promised = file->is_sized ? whole : UINT64_MAX;
    if (!file->is_sized || !rest)
        return EXIT_CODE_OK;
    return message_failure("%s: truncated, or no raw triangles: behind %" PRIu64 " triangles of 36 bytes it has %" PRIu64
                           " bytes more; write it anew",
                           file->name, whole, rest);
}

int triangle_file_open(const char *path, triangle_format format, triangle_file *file)
{
    const bool is_asked = format != TRIANGLES_OTHER;
    *file = (triangle_file){.name = path, .format = is_asked ? format : format_of_name(path), .size = UINT64_MAX};
    if (file->format == TRIANGLES_OTHER)
        return EXIT_CODE_OK;
    int code = open_stream(path, file);
    if (!code)
        code = file->format == TRIANGLES_STL ? open_stl(file, is_asked) : open_f32(file);
    if (code || !file->stream)
        return code;
    file->bytes = malloc(TRIANGLE_BLOCK * RECORD_MOST);
    return file->bytes ? EXIT_CODE_OK : message_failure("%s: out of memory", path);
}

/* Says how far a file came that ends too soon, in place of going on with less. */
static int refuse_end(const triangle_file *file, size_t got, int error)
{
    const size_t record = formats[file->format].record;
    const uint64_t whole = file->taken + got / record;
    if (error)
        return message_failure("%s: cannot read the mesh behind %" PRIu64 " triangles: %s", file->name, whole, strerror(error));
    char promise[48] = "";
    if (file->promised != UINT64_MAX)
        snprintf(promise, sizeof promise, " of %" PRIu64 " promised", file->promised);
    return message_failure("%s: truncated: %" PRIu64 "%s triangles were read, then it ends with %zu of %zu bytes of the next; "
                           "write it anew",
                           file->name, whole, promise, got % record, record);
}

/* From the bytes of records to floats of this machine, one triangle behind the other, in the same place. */
static void unpack(triangle_file *file, size_t count)
{
    const size_t record = formats[file->format].record, at = formats[file->format].floats_at;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < FLOATS; k++) {
            const uint32_t bits = little_get32(file->bytes + i * record + at + 4 * k);
            memcpy(file->bytes + 4 * (i * FLOATS + k), &bits, sizeof bits);
        }
}

static int check_end(const triangle_file *file)
{
    if (getc(file->stream) == EOF)
        return EXIT_CODE_OK;
    return message_failure("%s: has bytes behind the %" PRIu64 " triangles that are promised; write it anew", file->name,
                           file->promised);
}

int triangle_file_next(triangle_file *file, float *const streams[9], size_t *count)
{
    const size_t record = formats[file->format].record;
    const uint64_t left = file->promised - file->taken;
    const size_t asked = left < TRIANGLE_BLOCK ? (size_t)left : TRIANGLE_BLOCK;
    *count = 0;
    if (!asked)
        return check_end(file);
    errno = 0;
    const size_t got = fread(file->bytes, 1, asked * record, file->stream);
    const int error = ferror(file->stream) ? errno : 0;
    if (error || got % record || (got < asked * record && file->promised != UINT64_MAX))
        return refuse_end(file, got, error);
    *count = got / record;
    file->taken += *count;
    unpack(file, *count);
    const tribox_mesh block = {.positions = file->bytes, .vertices = 3 * *count, .count = *count};
    const tribox_status status = tribox_mesh_to_streams(&block, 0, *count, NULL, streams, streams + 3, streams + 6);
    return status ? message_failure("%s", tribox_status_text(status)) : EXIT_CODE_OK;
}

void triangle_file_close(triangle_file *file)
{
    if (file->stream && file->stream != stdin)
        fclose(file->stream);
    free(file->bytes);
    file->stream = NULL;
    file->bytes = NULL;
}
