/* result_options.c - the options that voxelize and merge share. */
#include "result_options.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "console/known_word.h"
#include "console/message.h"
#include "console/system.h"

static int read_vdb_grid(const char *word, bool *is_mask)
{
    unsigned n;
    const int code = choice_read("--vdb-grid", word, strlen(word), "bool mask", NULL, &n);
    *is_mask = n;
    return code;
}

int result_take(result_request *r, int which, const char *value)
{
    switch (which) {
    case RESULT_OUT_FORMAT:
        r->format = volume_format_named(value);
        return r->format ? EXIT_CODE_OK : EXIT_CODE_USAGE;
    case RESULT_VDB_GRID:
        return read_vdb_grid(value, &r->options.is_mask);
    case RESULT_UP:
        r->up_source = RESULT_UP_GIVEN;
        return preview_read_up(value, &r->look.up);
    default:
        return preview_read_size(value, &r->look);
    }
}

static bool ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), size = strlen(ending);
    for (size_t n = 0; length > size && n < size; n++)
        if ((path[length - size + n] | 0x20) != (ending[n] | 0x20)) /* letters of either case; the dot stays itself */
            return false;
    return length > size;
}

void result_guess_up(result_request *r, const char *mesh_path)
{
    if (r->up_source == RESULT_UP_GIVEN || !(ends_in(mesh_path, ".gltf") || ends_in(mesh_path, ".glb")))
        return;
    r->up_source = RESULT_UP_OF_GLTF;
    r->look.up = PICTURE_UP_Y;
}

static int check_stdout(const result_request *r)
{
    if (!r->format)
        return message_usage("standard output needs its format, --out-format WORD: one of %s", volume_words(NULL).text);
    if (r->wants_json)
        return message_usage("--json and -o - exclude each other, since both go to standard output");
    if (terminal_is(stdout))
        return message_usage("-o -: standard output is a terminal; send it to a program or a file");
    return EXIT_CODE_OK;
}

static bool is_word(const volume_format *format, const char *word) { return format && !strcmp(format->word, word); }

/* Options that one format alone has. */
static int check_format(const result_request *r, const options_found *found)
{
    if (options_has(found, RESULT_DEFLATE) && !is_word(r->format, "npz"))
        return message_usage("--deflate is for .npz alone");
    if (options_has(found, RESULT_VDB_GRID) && !is_word(r->format, "vdb"))
        return message_usage("--vdb-grid is for .vdb alone");
    return EXIT_CODE_OK;
}

file_out_names result_names(const result_request *r)
{
    return (file_out_names){{"-o", "--preview"}, {r->out_path, r->preview_path}};
}

int result_check(result_request *r, const options_found *found, const char *what, const char *const *read, size_t count)
{
    const bool has_look = options_has(found, RESULT_UP) || options_has(found, RESULT_PICTURE_SIZE);
    if (has_look && !r->preview_path)
        return message_usage("--up and --picture-size need --preview");
    const bool is_stdout = file_out_is_stdout(r->out_path);
    if (is_stdout && check_stdout(r))
        return EXIT_CODE_USAGE;
    r->has_summary = !is_stdout && (r->wants_json || !r->is_quiet);
    if (!r->format)
        r->format = volume_format_of(r->out_path);
    if (!r->format || check_format(r, found))
        return EXIT_CODE_USAGE;
    const file_out_names names = result_names(r);
    const int code = file_out_check(&names, what, read, count);
    return code ? code : preview_check(r->preview_path, "--preview");
}

int result_take_words(const result_request *r, const tribox_grid *grid, const char *instead, const char *no_picture,
                      uint64_t **words)
{
    const size_t count = voxels_layer_words(grid) * grid->size[2];
    int code = EXIT_CODE_OK;
    *words = NULL;
    if (r->format && volume_kind_of(r->format) == VOLUME_DENSE)
        code = voxels_check_words(grid, instead);
    if (code || !r->preview_path)
        return code;
    code = voxels_check_words(grid, no_picture);
    if (!code)
        code = voxels_check_memory(grid, (uint64_t)count * sizeof **words + preview_memory(&r->look), no_picture);
    if (code)
        return code;
    *words = calloc(count, sizeof **words);
    return *words ? EXIT_CODE_OK : message_failure("out of memory for the picture");
}

int result_draw(const result_request *r, const voxels *cells, const uint64_t *words, unsigned threads, file_out *picture)
{
    voxels v = *cells;
    v.words = words;
    return words ? preview_draw(picture, &v, &r->look, threads) : EXIT_CODE_OK;
}
