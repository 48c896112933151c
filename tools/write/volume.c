/* volume.c - the formats by their endings. */
#include "volume.h"

#include <string.h>

#include "brick_out.h"
#include "console/known_word.h"
#include "console/message.h"
#include "console/written_number.h"

const volume_writer volume_raw = {.frame = &(const volume_frame){.has_words = true}};

#define FORMAT(word, ...) {#word, __VA_ARGS__, &volume_##word},
static const volume_format formats[] = {VOLUME_FORMATS(FORMAT)};

#define WORD(word, ...) #word " "

enum { FORMATS = sizeof formats / sizeof formats[0] };

/* Each ending once. */
static bool is_first_of_ending(const volume_format *format)
{
    return format == formats || strcmp(format->ending, format[-1].ending);
}

static volume_list list_formats(const char *holds, bool are_endings)
{
    const char *found[FORMATS];
    size_t count = 0;
    volume_list list = {.text = ""};
    for (const volume_format *f = formats; f < formats + FORMATS; f++)
        if ((!holds || volume_holds(f, holds)) && (!are_endings || is_first_of_ending(f)))
            found[count++] = are_endings ? f->ending : f->word;
    for (size_t i = 0, at = 0; i < count && at < sizeof list.text; i++) {
        const char *const before = !i ? "" : i + 1 < count ? ", " : " or ";
        at += (size_t)snprintf(list.text + at, sizeof list.text - at, "%s%s", before, found[i]);
    }
    return list;
}

volume_list volume_words(const char *holds) { return list_formats(holds, false); }

volume_list volume_endings(const char *holds) { return list_formats(holds, true); }

const volume_format *volume_format_at(size_t n) { return n < FORMATS ? &formats[n] : NULL; }

bool volume_holds(const volume_format *format, const char *what) { return strstr(format->holds, what); }

const char *volume_kind(const volume_format *format)
{
    const brick_writer *const bricks = format->writer->bricks;
    return !bricks ? "dense" : bricks->shell ? "faces" : "sparse";
}

const volume_format *volume_format_named(const char *word)
{
    unsigned n;
    return choice_read("--out-format", word, strlen(word), VOLUME_FORMATS(WORD), NULL, &n) ? NULL : &formats[n];
}

const volume_format *volume_format_of(const char *path)
{
    const size_t length = strlen(path);
    for (size_t i = 0; i < FORMATS; i++) {
        const size_t size = strlen(formats[i].ending);
        if (length > size && !strcmp(path + length - size, formats[i].ending))
            return &formats[i];
    }
    message_usage("-o: '%s' does not end in %s", path, volume_endings(NULL).text);
    return NULL;
}

void volume_note_shift(const volume_format *format, const char *path, const voxels *v)
{
    char by[3][DECIMAL_MAX];
    if (!format || volume_holds(format, "place") || !voxels_are_shifted(v))
        return;
    for (int a = 0; a < 3; a++)
        decimal_of_double(v->shift[a], by[a]);
    message_say("note: %s does not hold that its cells are shifted by %s,%s,%s", path, by[0], by[1], by[2]);
}
