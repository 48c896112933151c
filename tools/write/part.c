/* part.c - writes a part of a grid, reads it back, and checks that parts belong together. */
#define _POSIX_C_SOURCE 200809L
#include "part.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console/message.h"
#include "console/numbers.h"

_Static_assert(sizeof(part_header) == 152, "part_header is a file format: it has no padding and does not change");

void part_set_grid(part_whole *whole, const voxels *v)
{
    memcpy(whole->origin, v->grid.origin, sizeof whole->origin);
    memcpy(whole->cell, v->grid.cell, sizeof whole->cell);
    memcpy(whole->size, v->grid.size, sizeof whole->size);
    memcpy(whole->shift, v->shift, sizeof whole->shift);
    whole->plane_bytes = v->is_float ? sizeof(float) : sizeof(double);
}

voxels part_voxels(const part_whole *whole)
{
    voxels v = {.is_float = whole->plane_bytes == sizeof(float)};
    memcpy(v.grid.origin, whole->origin, sizeof whole->origin);
    memcpy(v.grid.cell, whole->cell, sizeof whole->cell);
    memcpy(v.grid.size, whole->size, sizeof whole->size);
    memcpy(v.shift, whole->shift, sizeof whole->shift);
    return v;
}

static size_t layer_words(const part_whole *whole)
{
    const voxels v = part_voxels(whole);
    return voxels_layer_words(&v.grid);
}

void part_layers(const part_whole *whole, uint32_t shard, uint32_t *first, uint32_t *layers)
{
    const uint64_t all = whole->size[2];
    *first = (uint32_t)(all * (shard - 1) / whole->shards);
    *layers = (uint32_t)(all * shard / whole->shards) - *first;
}

/* FNV-1a with words in place of bytes. Each step is a bijection of the sum and of the word. */
static uint64_t add_word(uint64_t sum, uint64_t word)
{
    sum = (sum ^ word) * UINT64_C(0x100000001b3);
    return sum ^ sum >> 32;
}

static const uint64_t empty_sum = UINT64_C(0xcbf29ce484222325);

static uint64_t doubles_checksum(const mesh *m)
{
    uint64_t sum = empty_sum, bits[9];
    double u[9];
    for (size_t t = 0; t < m->triangles; t++) {
        mesh_triangle(m, t, u);
        memcpy(bits, u, sizeof bits);
        for (int k = 0; k < 9; k++)
            sum = add_word(sum, bits[k]);
    }
    return sum;
}

uint64_t part_mesh_checksum(const mesh *m)
{
    const tribox_soup *const soup = &m->soup;
    const float *const *const streams[3] = {soup->x, soup->y, soup->z};
    uint64_t sum = empty_sum;
    if (m->is_double)
        return doubles_checksum(m);
    for (int c = 0; c < 9; c++)
        for (size_t t = 0; t < soup->count; t++) {
            uint32_t bits;
            memcpy(&bits, &streams[c / 3][c % 3][t], sizeof bits);
            sum = add_word(sum, bits);
        }
    return sum;
}

uint64_t part_checksum(const part_header *header, const uint64_t *words, size_t count)
{
    uint64_t head[offsetof(part_header, checksum) / sizeof(uint64_t)], sum = empty_sum;
    memcpy(head, header, sizeof head);
    for (size_t i = 0; i < sizeof head / sizeof head[0]; i++)
        sum = add_word(sum, head[i]);
    for (size_t i = 0; i < count; i++)
        sum = add_word(sum, words[i]);
    return sum;
}

bool part_is_name(const char *path)
{
    const size_t length = strlen(path);
    return length > 5 && !strcmp(path + length - 5, ".part");
}

void part_write(FILE *to, const part_header *header, const uint64_t *bits, progress *bar)
{
    uint32_t first, layers;
    const size_t words = layer_words(&header->whole);
    part_layers(&header->whole, header->shard, &first, &layers);
    part_header complete = *header;
    complete.checksum = part_checksum(header, bits, layers * words);
    fwrite(&complete, sizeof complete, 1, to);
    for (uint32_t k = 0; k < layers && !ferror(to); k++) {
        fwrite(bits + k * words, sizeof *bits, words, to);
        progress_tell(bar, (k + 1.0) / layers);
    }
}

static bool is_size(uint32_t bytes) { return bytes == sizeof(float) || bytes == sizeof(double); }

static bool is_sound(const part_header *header)
{
    const part_whole *whole = &header->whole;
    const tribox_options options = {.accuracy = (tribox_accuracy)whole->accuracy, .axes = whole->axes};
    const voxels v = part_voxels(whole);
    const bool are_floats = numbers_are_floats(whole->origin, 3) && numbers_are_floats(whole->cell, 3);
    return header->shard && header->shard <= whole->shards && whole->axes && is_size(whole->plane_bytes) &&
           is_size(whole->position_bytes) && (are_floats || !v.is_float) && isfinite(v.shift[0] + v.shift[1] + v.shift[2]) &&
           voxels_are_served(&v.grid, v.is_float, &options);
}

static int check_header(const char *path, const part_header *header)
{
    static const char magic[sizeof header->magic] = PART_MAGIC, any_version[] = "tribox part ";
    if (memcmp(header->magic, any_version, sizeof any_version - 1))
        return message_failure("%s: not a part file; give the files that tribox voxelize --shard wrote", path);
    if (memcmp(header->magic, magic, sizeof magic))
        return message_failure("%s: damaged, or written by another version of tribox; run that shard again", path);
    if (header->byte_order != PART_BYTE_ORDER)
        return message_failure("%s: written on a machine of another byte order; merge it on a machine like that one", path);
    return is_sound(header) ? EXIT_CODE_OK : message_failure("%s: damaged: its header makes no sense; run that shard again", path);
}

/* Whether a row has a bit set beyond its last cell. */
static bool has_strays(const part *p, size_t words)
{
    const size_t row_words = tribox_mask_words(p->header.whole.size[0]);
    const uint32_t used = p->header.whole.size[0] % 64;
    const uint64_t *bits = part_bits(p);
    bool is_stray = false;
    for (size_t end = row_words; used && end <= words; end += row_words)
        is_stray |= bits[end - 1] >> used != 0;
    return is_stray;
}

static int check_words(const part *p, size_t words)
{
    if (part_checksum(&p->header, part_bits(p), words) != p->header.checksum)
        return message_failure("%s: damaged: its checksum does not match its content; run shard %u of %u again", p->path,
                               p->header.shard, p->header.whole.shards);
    if (has_strays(p, words))
        return message_failure("%s: damaged: it has cells outside the grid; run shard %u of %u again", p->path, p->header.shard,
                               p->header.whole.shards);
    return EXIT_CODE_OK;
}

static int map(part *p, int file)
{
    struct stat about;
    uint32_t first, layers;
    if (fstat(file, &about))
        return message_failure("%s: cannot read the part: %s", p->path, strerror(errno));
    if (!S_ISREG(about.st_mode))
        return message_failure("%s: not a regular file; give the files that tribox voxelize --shard wrote", p->path);
    if (read(file, &p->header, sizeof p->header) != (ssize_t)sizeof p->header)
        return message_failure("%s: not a part file, or only the beginning of one", p->path);
    const int code = check_header(p->path, &p->header);
    if (code)
        return code;
    part_layers(&p->header.whole, p->header.shard, &first, &layers);
    const size_t words = layers * layer_words(&p->header.whole), needed = sizeof p->header + words * sizeof(uint64_t);
    p->size = (size_t)about.st_size;
    if (p->size != needed)
        return message_failure("%s: damaged: it has %zu bytes, shard %u of %u has %zu; run that shard again", p->path, p->size,
                               p->header.shard, p->header.whole.shards, needed);
    p->mapped = mmap(NULL, p->size, PROT_READ, MAP_PRIVATE, file, 0);
    return p->mapped != MAP_FAILED ? EXIT_CODE_OK : message_failure("%s: cannot map the part: %s", p->path, strerror(errno));
}

int part_open(part *p, const char *path)
{
    *p = (part){.path = path};
    const int file = open(path, O_RDONLY);
    if (file < 0)
        return message_failure("%s: cannot open the part: %s", path, strerror(errno));
    int code = map(p, file);
    close(file);
    if (code)
        return code;
    code = check_words(p, (p->size - sizeof p->header) / sizeof(uint64_t));
    if (code)
        part_close(p);
    return code;
}

void part_close(part *p) { munmap(p->mapped, p->size); }

const uint64_t *part_bits(const part *p) { return (const uint64_t *)((const char *)p->mapped + sizeof p->header); }

static int by_shard(const void *a, const void *b)
{
    const uint32_t one = ((const part *)a)->header.shard, other = ((const part *)b)->header.shard;
    return (one > other) - (one < other);
}

static bool has_other_grid(const part_whole *one, const part_whole *other)
{
    return memcmp(one->origin, other->origin, sizeof one->origin) || memcmp(one->cell, other->cell, sizeof one->cell) ||
           memcmp(one->size, other->size, sizeof one->size) || one->plane_bytes != other->plane_bytes;
}

static int check_alike(const part *a, const part *b)
{
    const part_whole *one = &a->header.whole, *other = &b->header.whole;
    const char *differing = has_other_grid(one, other)                            ? "grid"
                            : memcmp(one->shift, other->shift, sizeof one->shift) ? "shift"
                            : one->shards != other->shards                        ? "number of shards"
                            : one->position_bytes != other->position_bytes || one->triangles != other->triangles ||
                                    one->mesh_checksum != other->mesh_checksum
                                ? "mesh"
                            : one->accuracy != other->accuracy ? "accuracy"
                            : one->axes != other->axes         ? "choice of axes"
                                                               : NULL;
    return differing ? message_failure("%s and %s do not fit together: they differ in the %s", a->path, b->path, differing)
                     : EXIT_CODE_OK;
}

int part_join(part *parts, size_t count)
{
    const uint32_t shards = parts[0].header.whole.shards;
    for (size_t i = 1; i < count; i++) {
        const int code = check_alike(&parts[0], &parts[i]);
        if (code)
            return code;
    }
    qsort(parts, count, sizeof *parts, by_shard);
    for (size_t i = 0; i < count; i++) {
        const uint32_t shard = parts[i].header.shard;
        if (i && shard == parts[i - 1].header.shard)
            return message_failure("%s and %s are both shard %u of %u; give each once", parts[i - 1].path, parts[i].path, shard,
                                   shards);
        if (shard != i + 1)
            return message_failure("shard %zu of %u is missing; give the parts of all shards", i + 1, shards);
    }
    return count == shards ? EXIT_CODE_OK
                           : message_failure("shard %zu of %u is missing; give the parts of all shards", count + 1, shards);
}
