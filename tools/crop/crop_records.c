/* crop_records.c - binary STL and raw triangles: records of one size, which stay what they are, byte for byte. */
#include <stdlib.h>

#include "console/message.h"
#include "crop_faces.h"
#include "files/named_file.h"
#include "read/little.h"
#include "tribox.h"

enum { STL_HEADER = 84, STL_COUNT_AT = 80 };

/* In parts, since the library counts up to 2^32 bits at once. */
static uint64_t count_part(const crop_choice *choice)
{
    const uint64_t part = UINT64_C(1) << 30;
    uint64_t set = 0;
    for (uint64_t first = 0; first < choice->triangles; first += part) {
        const uint64_t left = choice->triangles - first;
        set += tribox_mask_indices(choice->bits + first / 64, (size_t)(left < part ? left : part), NULL);
    }
    return set;
}

/* It ends in the number of triangles. */
static void put_stl_header(crop *c, const triangle_file *file)
{
    unsigned char header[STL_HEADER];
    size_t got;
    if (!named_file_read_at(file->stream, 0, header, sizeof header, &got) || got < sizeof header) {
        c->is_changed = true;
        return;
    }
    const uint64_t part = count_part(&c->choice), counts[CROP_SIDES] = {part, c->choice.triangles - part};
    for (int s = 0; s < CROP_SIDES; s++) {
        little_put32(header + STL_COUNT_AT, (uint32_t)counts[s]);
        crop_put(c, (crop_side)s, header, sizeof header);
    }
}

/* Those that follow each other and go to one side are one write. */
static void put_records(crop *c, const unsigned char *records, size_t count, size_t record)
{
    crop_side side = CROP_PART;
    size_t first = 0;
    for (size_t i = 0; i < count; i++) {
        const crop_side own = crop_next(c, 3);
        if (own != side)
            crop_put(c, side, records + first * record, (i - first) * record);
        first = own != side ? i : first;
        side = own;
    }
    crop_put(c, side, records + first * record, (count - first) * record);
}

int crop_records(crop *c, triangle_file *file)
{
    const size_t record = triangle_file_record(file);
    unsigned char *const records = malloc(TRIANGLE_BLOCK * record);
    if (!records)
        return message_failure("%s: out of memory", c->path);
    crop_begin(c);
    c->is_changed = file->promised != c->choice.triangles;
    if (!crop_is_over(c) && file->format == TRIANGLES_STL)
        put_stl_header(c, file);
    while (!crop_is_over(c) && c->next < c->choice.triangles) {
        const uint64_t left = c->choice.triangles - c->next, at = file->start + c->next * record;
        const size_t count = left < TRIANGLE_BLOCK ? (size_t)left : TRIANGLE_BLOCK;
        size_t got;
        if (named_file_read_at(file->stream, at, records, count * record, &got) && got == count * record)
            put_records(c, records, count, record);
        else
            c->is_changed = true;
    }
    free(records);
    return EXIT_CODE_OK;
}
