/* volume_raw.c - the bits as they lie in memory; labels as bytes. */
#include "volume.h"

const volume_frame volume_raw = {.has_words = true};
