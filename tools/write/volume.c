/* volume.c - the formats by their endings. */
#include "volume.h"

#include <string.h>

#include "brick_out.h"
#include "console/decimal.h"
#include "console/message.h"

const volume_frame volume_raw = {.has_words = true};

#define FORMAT(name, end, about, next, ...) {.word = name, .ending = end, __VA_ARGS__},
static const volume_format formats[] = {VOLUME_FORMATS(FORMAT)};

enum { FORMATS = sizeof formats / sizeof formats[0] };

/* Each ending once. */
static bool is_first_of_ending(const volume_format *format)
{
    return format == formats || strcmp(format->ending, format[-1].ending);
}

static volume_list list_formats(bool (*takes)(const volume_format *format), bool are_endings)
{
    const char *found[FORMATS];
    size_t count = 0;
    volume_list list = {.text = ""};
    for (const volume_format *f = formats; f < formats + FORMATS; f++)
        if ((!takes || takes(f)) && (!are_endings || is_first_of_ending(f)))
            found[count++] = are_endings ? f->ending : f->word;
    for (size_t i = 0, at = 0; i < count && at < sizeof list.text; i++) {
        const char *const before = !i ? "" : i + 1 < count ? ", " : " or ";
        at += (size_t)snprintf(list.text + at, sizeof list.text - at, "%s%s", before, found[i]);
    }
    return list;
}

volume_list volume_words(bool (*takes)(const volume_format *format)) { return list_formats(takes, false); }

volume_list volume_endings(bool (*takes)(const volume_format *format)) { return list_formats(takes, true); }

const volume_format *volume_format_named(const char *word)
{
    for (size_t i = 0; i < FORMATS; i++)
        if (!strcmp(word, formats[i].word))
            return &formats[i];
    message_usage("--out-format: '%s' is none of %s", word, volume_words(NULL).text);
    return NULL;
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

bool volume_takes_ids(const volume_format *format) { return format->frame || (format->bricks && format->takes_labels); }

bool volume_takes_labels(const volume_format *format) { return format->takes_labels; }

bool volume_takes_colours(const volume_format *format) { return format->colours != VOLUME_NO_COLOURS; }

void volume_note_shift(const volume_format *format, const char *path, const voxels *v)
{
    char by[3][DECIMAL_MAX];
    if (!format || format->has_place || !voxels_are_shifted(v))
        return;
    for (int a = 0; a < 3; a++)
        decimal_of_double(v->shift[a], by[a]);
    message_say("note: %s does not hold that its cells are shifted by %s,%s,%s", path, by[0], by[1], by[2]);
}
