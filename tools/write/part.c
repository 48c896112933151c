/* part.c - what a part says of the mesh, and whether parts are those of one whole. */
#include "part.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"

uint64_t part_triangle_checksum(const double u[9])
{
    return triangle_is_finite(u) ? checksum_bytes(CHECKSUM_EMPTY, u, sizeof(double[9])) : 0;
}

mesh_sums mesh_sums_of(const mesh *m)
{
    mesh_sums sums = {0, 0};
    double u[9];
    for (size_t t = 0; t < m->triangles; t++) {
        mesh_triangle(m, t, u);
        mesh_sums_add(&sums, &(mesh_sums){part_triangle_checksum(u), 0}, t);
    }
    return sums;
}

static int by_shard(const void *a, const void *b)
{
    const uint32_t one = ((const part *)a)->header.shard, other = ((const part *)b)->header.shard;
    return (one > other) - (one < other);
}

static int check_alike(const part *a, const part *b)
{
    static const char order[] = "order of the triangles, whose numbers the ids are: run the shards with one file of the mesh, and "
                                "with partitions in one order";
    const part_whole *one = &a->header.whole, *other = &b->header.whole;
    const char *const place = voxels_difference(&one->cells, &other->cells);
    const char *differing = place                                  ? place
                            : a->header.shards != b->header.shards ? "number of shards"
                            : one->position_bytes != other->position_bytes || one->triangles != other->triangles ||
                                    one->sums.coordinates != other->sums.coordinates
                                ? "mesh"
                            : one->accuracy != other->accuracy                     ? "accuracy"
                            : one->axes != other->axes                             ? "choice of axes"
                            : one->has_ids != other->has_ids                       ? "ids: some have none"
                            : one->tile != other->tile                             ? "size of tiles"
                            : one->has_ids && one->sums.order != other->sums.order ? order
                                                                                   : NULL;
    return differing ? message_failure("%s and %s do not fit together: they differ in the %s", a->path, b->path, differing)
                     : EXIT_CODE_OK;
}

/* Lists the shards that are missing among sorted parts, runs as "3-5", as far as the text goes. */
static void list_missing(const part *parts, size_t count, uint32_t shards, char *text, size_t size)
{
    size_t length = 0;
    uint32_t next = 1;
    for (size_t i = 0; i <= count && length + 32 < size; i++) {
        const uint32_t shard = i < count ? parts[i].header.shard : shards + 1;
        if (next + 1 < shard)
            length += (size_t)snprintf(text + length, size - length, "%s%u-%u", length ? "," : "", next, shard - 1);
        else if (next < shard)
            length += (size_t)snprintf(text + length, size - length, "%s%u", length ? "," : "", next);
        next = shard + 1;
    }
    if (next <= shards)
        snprintf(text + length, size - length, ",...");
}

static int check_complete(const part *parts, size_t count)
{
    const uint32_t shards = parts[0].header.shards;
    char missing[256] = "";
    for (size_t i = 1; i < count; i++)
        if (parts[i].header.shard == parts[i - 1].header.shard)
            return message_failure("%s and %s are both shard %u of %u; give each once", parts[i - 1].path, parts[i].path,
                                   parts[i].header.shard, shards);
    if (count == shards)
        return EXIT_CODE_OK;
    list_missing(parts, count, shards, missing, sizeof missing);
    const bool is_one = count + 1 == shards;
    return message_failure("shard%s %s of %u %s missing; run %s, or give %s too", is_one ? "" : "s", missing, shards,
                           is_one ? "is" : "are", is_one ? "it" : "them", is_one ? "its part" : "their parts");
}

/* Parts of other ways to divide the tiles do not meet. */
static int check_borders(const part *parts, size_t count)
{
    const part_whole *const whole = &parts[0].header.whole;
    uint64_t next = 0;
    for (size_t i = 0; i < count; i++) {
        if (parts[i].header.from != next)
            return message_failure("%s begins with tile %llu in place of %llu: it was cut otherwise than the others; run shard %u "
                                   "of %u again",
                                   parts[i].path, (unsigned long long)parts[i].header.from, (unsigned long long)next,
                                   parts[i].header.shard, parts[i].header.shards);
        next = parts[i].header.to;
    }
    return next == tribox_tile_count(whole->cells.grid.size, (uint32_t)whole->tile)
               ? EXIT_CODE_OK
               : message_failure("%s ends before the last tile: it was cut otherwise than the others; run shard %u of %u again",
                                 parts[count - 1].path, parts[0].header.shards, parts[0].header.shards);
}

int part_join(part *parts, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!parts[i].header.shard)
            return message_failure("%s: is no part of a whole; give the files that tribox voxelize --shard wrote, or one that is "
                                   "whole alone",
                                   parts[i].path);
    int code = EXIT_CODE_OK;
    for (size_t i = 1; i < count && !code; i++)
        code = check_alike(&parts[0], &parts[i]);
    if (code)
        return code;
    qsort(parts, count, sizeof *parts, by_shard);
    code = check_complete(parts, count);
    return code ? code : check_borders(parts, count);
}
