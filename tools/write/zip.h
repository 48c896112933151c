/* zip.h - .zip files, written and read, whose members are arrays of NumPy: they start with a header that is known when they end. */
#ifndef ZIP_H
#define ZIP_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { NPY_HEADER = 128 }; /* whatever the array */

typedef struct npy_array {
    const char *name, *type; /* "at.npy", "<u4" */
    unsigned columns;        /* of a row; 0: a number each */
    unsigned row_bytes;
} npy_array;

/* What stands before so many rows. */
void npy_header(unsigned char header[NPY_HEADER], const npy_array *array, uint64_t rows);

enum { ZIP_MEMBERS_MAX = 10, ZIP_NAME_MAX = 15 };

typedef struct zip_member {
    char name[ZIP_NAME_MAX + 1];
    uint64_t start;         /* where in the file */
    uint64_t bytes, stored; /* as they are, and as they are written */
    uint32_t crc;
    bool is_deflated; /* set where it is read */
} zip_member;

typedef struct zip_out {
    FILE *to;
    uint64_t written;
    zip_member members[ZIP_MEMBERS_MAX];
    unsigned count;              /* the last one of them is open until its end */
    const npy_array *array;      /* of this last one */
    struct zip_stream *deflater; /* NULL: members are stored as they are */
} zip_out;

/* The stream is at its first byte. False where there is no memory; zip_free is due in any case, and takes zeros, too. */
bool zip_begin(zip_out *zip, FILE *to, bool is_deflated);
void zip_free(zip_out *zip);

/* A member: an array, its bytes, and then how many rows these are. */
void zip_begin_member(zip_out *zip, const npy_array *array);
void zip_add(zip_out *zip, const void *bytes, size_t count);
void zip_end_member(zip_out *zip, uint64_t rows);

/* All of it at once. */
void zip_add_array(zip_out *zip, const npy_array *array, size_t rows, const void *bytes);

/* The checksum with more bytes. */
uint32_t zip_crc(uint32_t crc, const void *bytes, size_t count);

/* The list of the members. */
void zip_end(zip_out *zip);

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
    struct zip_stream *inflater; /* NULL: they are stored as they are */
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
