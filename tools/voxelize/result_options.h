/* result_options.h - the options that voxelize and merge share, where the cells go, and what is printed of them. */
#ifndef RESULT_OPTIONS_H
#define RESULT_OPTIONS_H

#include <stdbool.h>

#include "console/json.h"
#include "console/option_reader.h"
#include "picture/preview.h"
#include "write/volume.h"
#include "write/voxels.h"

/* They come first in the tables of both commands, whose requests have a `result` and whose own options start at RESULT_END. */
enum {
    RESULT_OUT,
    RESULT_OUT_FORMAT,
    RESULT_DEFLATE,
    RESULT_VDB_GRID,
    RESULT_PREVIEW,
    RESULT_UP,
    RESULT_PICTURE_SIZE,
    RESULT_JSON,
    RESULT_QUIET,
    RESULT_END
};

#define RESULT_ENTRIES(request) \
    [RESULT_OUT] = {"out", 'o', OPTION_NAMES(request, result.out_path)}, [RESULT_OUT_FORMAT] = {"out-format", 0, true}, \
    [RESULT_DEFLATE] = {"deflate", 0, OPTION_SETS(request, result.options.is_deflated)}, \
    [RESULT_VDB_GRID] = {"vdb-grid", 0, true}, [RESULT_PREVIEW] = {"preview", 'p', OPTION_NAMES(request, result.preview_path)}, \
    [RESULT_UP] = {"up", 0, true}, [RESULT_PICTURE_SIZE] = {"picture-size", 0, true}, \
    [RESULT_JSON] = {"json", 'j', OPTION_SETS(request, result.wants_json)}, \
    [RESULT_QUIET] = {"quiet", 'q', OPTION_SETS(request, result.is_quiet)}

#define RESULT_HELP \
    "  -o, --out FILE          - is standard output. By the ending of FILE, with what it holds:" VOLUME_HELP \
    "      --out-format WORD   such an ending without its dot, or cells: for other names, and for -o -\n" \
    "      --deflate           compress the .npz, which takes longer\n" \
    "      --vdb-grid WORD     .vdb: bool (default), or mask: smaller, but not every program reads it\n" \
    "  -p, --preview FILE.png  draw a picture of the cells\n" \
    "      --up AXIS           which axis is up: x, y, z, -x, -y or -z; default: y of glTF, else z\n" \
    "      --picture-size WxH  pixels of the picture; default: 1280x960\n" \
    "  -j, --json              print the summary as a JSON object\n" \
    "  -q, --quiet             print no summary and no progress\n"

/* Why an axis is up in the picture: nothing says so, the command line does, or the format of the mesh. */
typedef enum result_up_source { RESULT_UP_DEFAULT, RESULT_UP_GIVEN, RESULT_UP_OF_GLTF } result_up_source;

typedef struct result_request {
    const char *out_path, *preview_path; /* preview_path: NULL for none */
    const volume_format *format;         /* NULL for a part */
    volume_options options;
    picture_look look;
    result_up_source up_source;
    bool wants_json, is_quiet;
    bool has_summary; /* not with --quiet, nor where the file itself goes to standard output */
} result_request;

/* Takes an option before RESULT_END that the table does not. Returns an exit_code. */
int result_take(result_request *r, int which, const char *value);

/* Takes y for up where the mesh is glTF by its name, whose specification has it so, and --up is not given. */
void result_guess_up(result_request *r, const char *mesh_path);

/*
 * Refuses a dense format of too many cells, and takes the words of all cells for a picture, zeros; NULL without one. instead,
 * no_picture: what to do. Returns an exit_code.
 */
int result_take_words(const result_request *r, const tribox_grid *grid, const char *instead, const char *no_picture,
                      uint64_t **words);

/* Draws them, in the grid of `cells`, and keeps the file; nothing without words. Returns an exit_code. */
int result_draw(const result_request *r, const voxels *cells, const uint64_t *words, unsigned threads, file_out *picture);

/* The names of its files. */
file_out_names result_names(const result_request *r);

/*
 * Checks that the options fit together and that no file is one of those that are read, and finds the format. what: the
 * word for what is read. Returns an exit_code.
 */
int result_check(result_request *r, const options_found *found, const char *what, const char *const *read, size_t count);

/* As lines of a summary, and as members of a JSON object. */
void voxelize_print_grid(const voxels *v, bool is_shifted);
void voxelize_json_grid(json *j, const voxels *v, bool is_shifted);

/* The names of its files, likewise. */
void result_print(const result_request *r);
void result_json(json *j, const result_request *r);

#endif
