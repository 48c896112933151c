/* crc32.h - the checksum of .zip files. */
#ifndef CRC32_H
#define CRC32_H

#include <stddef.h>
#include <stdint.h>

/* Tables for crc32_add. */
typedef struct crc32_tables {
    uint32_t of[8][256];
} crc32_tables;

void crc32_make_tables(crc32_tables *tables);

/* The checksum of what had the checksum `crc`, 0 for nothing, followed by these bytes. */
uint32_t crc32_add(const crc32_tables *tables, uint32_t crc, const void *bytes, size_t count);

/* The checksum of what had the first, followed by `count` bytes that have the second. */
uint32_t crc32_join(uint32_t first, uint32_t second, uint64_t count);

#endif
