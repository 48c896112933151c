/* volume.c - the formats by their endings. */
#include "volume.h"

#include <string.h>

#include "brick_writer.h"
#include "console/decimal.h"
#include "console/message.h"

/* Of two with one ending the first is the one that the ending stands for. */
static const volume_format formats[] = {
    {.word = "npz",
     .colours = VOLUME_ANY_COLOURS,
     .ending = ".npz",
     .check_grid = bricks_check_npz,
     .bricks = &bricks_npz,
     .has_place = true,
     .takes_labels = true},
    {.word = "vdb",
     .colours = VOLUME_ANY_COLOURS,
     .ending = ".vdb",
     .begin = bricks_begin_vdb,
     .check_grid = bricks_check_vdb,
     .bricks = &bricks_vdb,
     .has_place = true,
     .takes_labels = true},
    {.word = "npy", .ending = ".npy", .frame = &volume_npy, .takes_labels = true},
    {.word = "cells", .ending = ".npy", .bricks = &bricks_cells},
    {.word = "vti", .ending = ".vti", .frame = &volume_vti, .has_place = true, .takes_labels = true},
    {.word = "nrrd", .ending = ".nrrd", .frame = &volume_nrrd, .has_place = true, .takes_labels = true},
    {.word = "binvox", .ending = ".binvox", .check_grid = volume_check_binvox, .write = volume_write_binvox, .has_place = true},
    {.word = "vox",
     .colours = VOLUME_PALETTE,
     .ending = ".vox",
     .check_grid = volume_check_vox,
     .write = volume_write_vox,
     .takes_labels = true},
    {.word = "ply",
     .colours = VOLUME_ANY_COLOURS,
     .ending = ".ply",
     .check_grid = bricks_check_shell,
     .bricks = &bricks_ply,
     .has_place = true},
    {.word = "obj",
     .colours = VOLUME_ANY_COLOURS,
     .ending = ".obj",
     .check_grid = bricks_check_shell,
     .bricks = &bricks_obj,
     .has_place = true},
    {.word = "glb",
     .colours = VOLUME_ANY_COLOURS,
     .ending = ".glb",
     .check_grid = bricks_check_glb,
     .bricks = &bricks_glb,
     .has_place = true},
    {.word = "raw", .ending = ".raw", .frame = &volume_raw, .takes_labels = true}};

enum { FORMATS = sizeof formats / sizeof formats[0] };

const volume_format *volume_format_named(const char *word)
{
    for (size_t i = 0; i < FORMATS; i++)
        if (!strcmp(word, formats[i].word))
            return &formats[i];
    message_usage("--out-format: '%s' is none of " VOLUME_WORDS, word);
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
    message_usage("-o: '%s' does not end in " VOLUME_ENDINGS, path);
    return NULL;
}

bool volume_takes_ids(const volume_format *format) { return format->frame || (format->bricks && format->takes_labels); }

void volume_note_shift(const volume_format *format, const char *path, const voxels *v)
{
    char by[3][DECIMAL_MAX];
    if (!format || format->has_place || !voxels_are_shifted(v))
        return;
    for (int a = 0; a < 3; a++)
        decimal_of_double(v->shift[a], by[a]);
    message_say("note: %s does not hold that its cells are shifted by %s,%s,%s", path, by[0], by[1], by[2]);
}
