/* volume.c - the formats by their endings. */
#include "volume.h"

#include <string.h>

#include "console/message.h"

static const volume_format formats[] = {{".npy", NULL, volume_write_npy},
                                        {".raw", NULL, volume_write_raw},
                                        {".binvox", volume_check_binvox, volume_write_binvox},
                                        {".vox", volume_check_vox, volume_write_vox}};

const volume_format *volume_format_of(const char *path)
{
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        const size_t size = strlen(formats[i].ending);
        if (length > size && !strcmp(path + length - size, formats[i].ending))
            return &formats[i];
    }
    message_usage("-o: '%s' does not end in .npy, .binvox, .vox or .raw", path);
    return NULL;
}
