/* boxes.c - reads boxes from the command line and from files, strictly and independent of the locale. */
#include "boxes.h"

#include <errno.h>
#include <string.h>

#include "console/written_number.h"
#include "console/message.h"
#include "console/numbers.h"
#include "files/files.h"

/* Most bytes of a line without its comment, and of a file's name in messages. */
enum { LINE_MAX_BYTES = 1024, NAME_SHOWN = 1000 };

static const char form[] = "LX,LY,LZ,HX,HY,HZ";

static void note_if_empty(const tribox_box *box, const char *where)
{
    char lo[DECIMAL_MAX], hi[DECIMAL_MAX];
    for (int a = 0; a < 3; a++)
        if (box->lo[a] > box->hi[a]) {
            message_say("note: %s: the lower bound %s exceeds the upper bound %s on the %c axis: an empty box, nothing overlaps it",
                        where, decimal_of_double(box->lo[a], lo), decimal_of_double(box->hi[a], hi), "xyz"[a]);
            return;
        }
}

bool box_read(const char *text, const char *where, written_box *box)
{
    double bounds[6];
    if (!numbers_read(text, where, form, 6, bounds, &box->decimals))
        return false;
    memcpy(box->bounds.lo, bounds, sizeof box->bounds.lo);
    memcpy(box->bounds.hi, bounds + 3, sizeof box->bounds.hi);
    note_if_empty(&box->bounds, where);
    return true;
}

tribox_box box_for_mesh(const written_box *box, bool is_double)
{
    tribox_box bounds = box->bounds;
    if (!is_double) {
        numbers_round(bounds.lo, 3, box->decimals);
        numbers_round(bounds.hi, 3, box->decimals >> 3);
    }
    return bounds;
}

bool box_is_float(const tribox_box *box) { return numbers_are_floats(box->lo, 3) && numbers_are_floats(box->hi, 3); }

int box_file_open(box_file *boxes, const char *path)
{
    const bool is_stdin = !strcmp(path, "-");
    boxes->file = is_stdin ? stdin : named_file_open(path, "rb");
    boxes->name = is_stdin ? "stdin" : path;
    boxes->line = 0;
    if (!boxes->file)
        return message_failure("%s: cannot open the boxes file: %s", path, strerror(errno));
    return EXIT_CODE_OK;
}

/* Reads a line without its comment. Returns false at the end of the file, or after a message, which sets *code. */
static bool read_line(box_file *boxes, char *text, size_t size, int *code)
{
    size_t length = 0;
    bool is_comment = false;
    int c = getc(boxes->file);
    if (c == EOF)
        return false;
    boxes->line++;
    for (; c != EOF && c != '\n'; c = getc(boxes->file)) {
        is_comment |= c == '#';
        if (is_comment)
            continue;
        if (c == '\0' || length + 1 == size) {
            *code = message_failure("%s:%zu: %s; give a box per line: LX,LY,LZ,HX,HY,HZ", boxes->name, boxes->line,
                                    c ? "the line is too long" : "a NUL byte, so this is not a text file");
            return false;
        }
        text[length++] = (char)c;
    }
    text[length] = '\0';
    return true;
}

int box_file_next(box_file *boxes, written_box *box, bool *end)
{
    char text[LINE_MAX_BYTES], where[NAME_SHOWN + 32];
    int code = EXIT_CODE_OK;
    do {
        errno = 0;
        *end = !read_line(boxes, text, sizeof text, &code);
        if (*end && !code && ferror(boxes->file))
            code = message_failure("%s: cannot read the boxes: %s", boxes->name, strerror(errno));
        if (*end)
            return code;
    } while (!text[strspn(text, NUMBERS_BLANKS)]);
    snprintf(where, sizeof where, "%.*s:%zu", NAME_SHOWN, boxes->name, boxes->line);
    return box_read(text, where, box) ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
}

void box_file_close(box_file *boxes)
{
    if (boxes->file != stdin)
        fclose(boxes->file);
}
