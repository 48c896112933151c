/* zip_out.h - a .zip file whose members start with a header that is known when they end. */
#ifndef ZIP_OUT_H
#define ZIP_OUT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "deflate.h"
#include "npy_header.h"

enum { ZIP_MEMBERS_MAX = 10, ZIP_NAME_MAX = 15 };

typedef struct zip_member {
    char name[ZIP_NAME_MAX + 1];
    uint64_t start;         /* where in the file */
    uint64_t bytes, stored; /* as they are, and as they are written */
    uint32_t crc;
    bool is_deflated; /* set by zip_in.h */
} zip_member;

typedef struct zip_out {
    FILE *to;
    uint64_t written;
    zip_member members[ZIP_MEMBERS_MAX];
    unsigned count;     /* the last one of them is open until its end */
    deflater *deflater; /* NULL: members are stored as they are */
} zip_out;

/* Members are deflated if a deflater is given, which stays the caller's. The stream is at its first byte. */
void zip_begin(zip_out *zip, FILE *to, deflater *by);

/* A member: its name, its bytes, and then the NPY_HEADER bytes that stand before these. */
void zip_begin_member(zip_out *zip, const char *name);
void zip_add(zip_out *zip, const void *bytes, size_t count);
/* Bytes of a member that stands as it is, which are written to their place otherwise; the stream goes on after them. */
void zip_skip(zip_out *zip, uint64_t bytes);
void zip_end_member(zip_out *zip, const unsigned char header[NPY_HEADER]);

/* The checksum of what was skipped of member `number`, which has ended; header as there. */
void zip_set_crc(zip_out *zip, unsigned number, const unsigned char header[NPY_HEADER], uint32_t crc, uint64_t bytes);

/* The checksum with more bytes, and that of two runs of bytes from that of each, and the length of the second. */
uint32_t zip_crc(uint32_t crc, const void *bytes, size_t count);
uint32_t zip_crc_of_both(uint32_t first, uint32_t second, uint64_t bytes);

/* The list of the members. */
void zip_end(zip_out *zip);

#endif
