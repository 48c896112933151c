/* volume.c - the formats by their endings; hands bricks to the format, and keeps an eye on the stream. */
#include "volume.h"

#include <stdlib.h>
#include <string.h>

#include "console/known_word.h"
#include "console/message.h"
#include "console/system.h"
#include "console/written_number.h"
#include "read/little.h"

const volume_writer volume_raw = {.write_all = dense_write, .frame = &(const volume_frame){.has_words = true}};

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

volume_kind volume_kind_of(const volume_format *format)
{
    const volume_writer *const w = format->writer;
    return w->shell ? VOLUME_FACES : w->write_all ? VOLUME_DENSE : VOLUME_SPARSE;
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
    char by[3 * DECIMAL_MAX];
    if (!format || volume_holds(format, "place") || !voxels_are_shifted(v))
        return;
    message_say("note: %s does not hold that its cells are shifted by %s", path, decimals_of(v->shift, ',', by));
}

/* ----------------------------------------------------------------------------------------------------------------------- output */

bool volume_put_numbers(FILE *to, const uint32_t *number, size_t count)
{
    uint32_t turned[8];
    memcpy(turned, number, count * sizeof *number);
    little_turn(turned, count, sizeof *turned);
    return fwrite(turned, sizeof *turned, count, to) == count;
}

static bool write_some(void *to, const void *bytes, size_t count) { return fwrite(bytes, 1, count, to) == count; }

/* Cells that a format needs all at once, until all bricks are there: their words, or an id of each. */
typedef struct gathering {
    uint64_t *words, *inside; /* inside: NULL without labels */
    int32_t *ids;
} gathering;

static void gather_drop(brick_out *out)
{
    gathering *const g = out->state;
    free(g->words);
    free(g->inside);
    free(g->ids);
    free(g);
}

static bool gather_make(brick_out *out, size_t cells, size_t words)
{
    gathering *const g = out->state = calloc(1, sizeof *g);
    if (!g)
        return false;
    if (out->options.has_ids) {
        out->cells.ids = g->ids = malloc(cells * sizeof *g->ids);
        for (size_t c = 0; g->ids && c < cells; c++)
            g->ids[c] = -1;
        return g->ids;
    }
    out->cells.words = g->words = calloc(words, sizeof *g->words);
    out->cells.inside = g->inside = out->options.has_labels ? calloc(words, sizeof *g->inside) : NULL;
    return g->words && (g->inside || !out->options.has_labels);
}

static int gather_open(brick_out *out)
{
    char needed[16], there[16];
    const tribox_grid *const grid = &out->cells.grid;
    const uint32_t *const size = grid->size;
    const bool has_ids = out->options.has_ids;
    const uint64_t cells = (uint64_t)size[0] * size[1] * size[2], words = (uint64_t)voxels_layer_words(grid) * size[2];
    const uint64_t count = has_ids ? cells : words, bytes = has_ids ? sizeof(int32_t) : out->options.has_labels ? 16 : 8;
    const uint64_t available = memory_available();
    if (count > available / bytes)
        return message_failure("%s: %s%u x %u x %u cells take %s of memory in this format and %s are available; write .npz or .vdb",
                               out->file->path, has_ids ? "the ids of " : "", size[0], size[1], size[2],
                               memory_text(count * bytes, needed), memory_text(available, there));
    if (gather_make(out, (size_t)cells, (size_t)words))
        return EXIT_CODE_OK;
    if (out->state)
        gather_drop(out);
    return message_failure("%s: out of memory for its cells", out->file->path);
}

static int gather_put(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    const gathering *const g = out->state;
    const uint32_t *const size = out->cells.grid.size, *from = out->ids;
    if (g->words)
        bricks_lay(size, g->words, at, bits);
    if (g->inside)
        bricks_lay(size, g->inside, at, out->inside);
    for (uint32_t k = 0; k < 8 && g->ids; k++)
        for (uint64_t word = bits[k]; word; word &= word - 1) {
            const uint32_t bit = lowest_bit(word);
            const size_t row = (size_t)(8 * at[2] + k) * size[1] + 8 * at[1] + bit / 8;
            g->ids[row * size[0] + 8 * at[0] + bit % 8] = (int32_t)*from++;
        }
    return EXIT_CODE_OK;
}

/* Bricks after which the stream is asked whether it failed, which takes a lock. */
enum { LOOK_EVERY = 256 };

static bool is_spooled(const brick_out *out) { return out->to != out->file->stream; }

static int check_stream(const brick_out *out) { return ferror(out->to) ? file_out_failure(out->file) : EXIT_CODE_OK; }

int brick_out_open(brick_out *out, const volume_format *format, const volume_options *options, file_out *file, const voxels *about)
{
    *out = (brick_out){.format = format, .options = *options, .file = file, .to = file->stream, .cells = *about};
    out->cells.words = out->cells.inside = NULL;
    const volume_writer *const w = format->writer;
    if (w->goes_back && file_out_is_stdout(file->path))
        out->to = spool_open(file);
    if (!out->to)
        return EXIT_CODE_FAILURE;
    const int code = w->write_all ? gather_open(out) : w->open(out);
    if (code && is_spooled(out))
        fclose(out->to);
    if (code)
        out->to = NULL;
    return code;
}

int brick_out_put(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    const volume_writer *const w = out->format->writer;
    const int code = w->write_all ? gather_put(out, at, bits) : w->put(out, at, bits);
    const bool is_looked_at = ++out->bricks % LOOK_EVERY == 0;
    return code || !is_looked_at ? code : check_stream(out);
}

int brick_out_end(brick_out *out, progress *bar)
{
    const volume_writer *const w = out->format->writer;
    int code = w->write_all ? w->write_all(out, bar) : w->end(out, bar);
    if (!code)
        code = check_stream(out);
    if (!code && is_spooled(out))
        code = spool_read(out->to, out->file, write_some, out->file->stream);
    if (!code)
        brick_out_drop(out);
    return code;
}

void brick_out_drop(brick_out *out)
{
    if (!out->to)
        return;
    if (out->format->writer->write_all)
        gather_drop(out);
    else if (out->format->writer->drop)
        out->format->writer->drop(out);
    if (is_spooled(out))
        fclose(out->to);
    out->to = NULL;
}

/* Bricks of voxels. */
typedef struct goal {
    brick_out *out;
    const voxels *v;
} goal;

static int put(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    const goal *const g = data;
    uint64_t inside[8];
    if (g->out->options.has_labels) {
        bricks_inside(g->v, at, inside);
        g->out->inside = inside;
    }
    const int code = brick_out_put(g->out, at, bits);
    g->out->inside = NULL;
    return code;
}

int brick_out_voxels(const volume_format *format, const volume_options *options, file_out *file, const voxels *v, uint32_t tile,
                     unsigned threads, uint64_t *bricks, progress *bar)
{
    brick_out out = {.format = format, .file = file, .to = file->stream, .cells = *v, .threads = threads};
    *bricks = 0;
    int code = format->writer->write_all ? format->writer->write_all(&out, bar) : brick_out_open(&out, format, options, file, v);
    if (code || format->writer->write_all)
        return code ? code : check_stream(&out);
    code = bricks_cut(v, tile, put, &(goal){&out, v}, bar);
    *bricks = out.bricks;
    if (!code)
        code = brick_out_end(&out, bar);
    brick_out_drop(&out);
    return code;
}
