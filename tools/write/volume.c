/* volume.c - the formats by their endings. */
#include "volume.h"

#include <string.h>

#include "console/decimal.h"
#include "console/message.h"

static const volume_format formats[] = {{".npy", NULL, volume_write_npy, false},
                                        {".raw", NULL, volume_write_raw, false},
                                        {".binvox", volume_check_binvox, volume_write_binvox, true},
                                        {".vox", volume_check_vox, volume_write_vox, false}};

enum { FORMATS = sizeof formats / sizeof formats[0] };

const volume_format *volume_format_named(const char *word)
{
    for (size_t i = 0; i < FORMATS; i++)
        if (!strcmp(word, formats[i].ending + 1))
            return &formats[i];
    message_usage("--out-format: '%s' is none of npy, binvox, vox, raw", word);
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
    message_usage("-o: '%s' does not end in .npy, .binvox, .vox or .raw", path);
    return NULL;
}

void volume_note_shift(const volume_format *format, const char *path, const voxels *v)
{
    char by[3][DECIMAL_MAX];
    if (!format || format->has_place || !voxels_are_shifted(v))
        return;
    for (int a = 0; a < 3; a++)
        decimal_of_double(v->shift[a], by[a]);
    message_say("note: %s does not hold that its cells are shifted by %s,%s,%s", path, by[0], by[1], by[2]);
}
