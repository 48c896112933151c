/* partition_write.c - writes tile after tile, then what the index says of them. */
#define _POSIX_C_SOURCE 200809L
#include "partition_write.h"

#include <stdlib.h>
#include <string.h>

#include "write/checksum.h"

/* An even number of triangles of floats is a whole number of words, as the checksum takes them. */
enum { BLOCK = 1024, NUMBERS = 9 };

/* Returns the bytes of one. */
static size_t put_triangle(const mesh *m, size_t t, void *to)
{
    double wide[NUMBERS];
    float narrow[NUMBERS];
    mesh_triangle(m, t, wide);
    if (m->is_double) {
        memcpy(to, wide, sizeof wide);
        return sizeof wide;
    }
    for (int k = 0; k < NUMBERS; k++)
        narrow[k] = (float)wide[k];
    memcpy(to, narrow, sizeof narrow);
    return sizeof narrow;
}

/* Returns their checksum. */
static uint64_t write_tile(FILE *to, const mesh *m, const uint32_t *list, size_t count, unsigned char *block)
{
    uint64_t sum = CHECKSUM_EMPTY;
    for (size_t i = 0; i < count;) {
        size_t size = 0;
        for (const size_t end = count - i < BLOCK ? count : i + BLOCK; i < end; i++)
            size += put_triangle(m, list[i], block + size);
        sum = checksum_bytes(sum, block, size);
        fwrite(block, 1, size, to);
    }
    return sum;
}

bool partition_write(folder_out *out, const mesh *m, tile_set *set, partition_header *header, progress *bar)
{
    FILE *const index = out->file[0], *const triangles = out->file[1];
    unsigned char *const block = malloc(BLOCK * NUMBERS * sizeof(double));
    if (!block)
        return false;
    for (size_t r = 0; r < set->count && !ferror(triangles); r++) {
        partition_tile *const tile = &set->own_records[r];
        tile->checksum = write_tile(triangles, m, set->list + tile->first, tile_set_triangles(set, r), block);
        progress_tell(bar, (double)tile->first / (double)set->places);
    }
    free(block);
    header->records = set->count;
    header->places = set->places;
    header->checksum = checksum_bytes(CHECKSUM_EMPTY, header, offsetof(partition_header, checksum));
    header->checksum = checksum_bytes(header->checksum, set->own_records, set->count * sizeof *set->own_records);
    fwrite(header, sizeof *header, 1, index);
    fwrite(set->own_records, sizeof *set->own_records, set->count, index);
    return true;
}
