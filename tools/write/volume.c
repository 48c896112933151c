/* volume.c - the formats by their endings. */
#include "volume.h"

#include <string.h>

#include "console/message.h"

static const volume_format formats[] = {{".npy", NULL, volume_write_npy},
                                        {".raw", NULL, volume_write_raw},
                                        {".binvox", volume_check_binvox, volume_write_binvox},
                                        {".vox", volume_check_vox, volume_write_vox}};

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
