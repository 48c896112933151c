/* zip_in.h - the members of a .zip file, stored or deflated, read with their checksums. */
#ifndef ZIP_IN_H
#define ZIP_IN_H

#include "zip_out.h"

/*
 * Lists the members of a file of so many bytes; their start is then where their own bytes begin. Returns how many there are; 0
 * where it is no .zip file, only the beginning of one, or one that zip_out does not write: of more members, or longer names.
 */
unsigned zip_in_list(FILE *from, uint64_t size, zip_member members[ZIP_MEMBERS_MAX]);

/* A member that is being read; others may be read from the same file by turns. */
typedef struct zip_reader {
    FILE *from;
    const zip_member *of;
    uint64_t at, stored; /* the next byte in the file, and how many of the member are left from there */
    uint64_t left;       /* of its bytes as they are */
    uint32_t crc;
    struct inflater *inflater; /* NULL: they are stored as they are */
} zip_reader;

/* False where there is no memory. The member stays as long as the reader. */
bool zip_reader_open(zip_reader *r, FILE *from, const zip_member *of);

/* Less than 4 GB at once. False where it has no more, or is damaged. */
bool zip_reader_read(zip_reader *r, void *to, size_t bytes);

/* Whether all has been read, and is what was written. */
bool zip_reader_is_whole(const zip_reader *r);

/* Takes one that did not open, or zeros, too. */
void zip_reader_close(zip_reader *r);

#endif
