/* ply_header.h - the header of a PLY file: which elements follow it, and which values each of them has. */
#ifndef PLY_HEADER_H
#define PLY_HEADER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "whole_file.h"

enum { PLY_ELEMENTS_MAX = 32, PLY_PROPERTIES_MAX = 1024 };

typedef enum ply_format { PLY_ASCII, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN } ply_format;

typedef enum ply_type {
    PLY_NONE,
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_FLOAT,
    PLY_DOUBLE
} ply_type;

/* What a value is for. PLY_CORNERS: the list of a face's vertices. Colours, of vertices and faces: the first of each name. */
typedef enum ply_role { PLY_X, PLY_Y, PLY_Z, PLY_CORNERS, PLY_RED, PLY_GREEN, PLY_BLUE, PLY_SKIPPED } ply_role;

typedef struct ply_property {
    ply_type count; /* of the number of values in a list; PLY_NONE: a single value */
    ply_type type;
    ply_role role;
    const char *name; /* not terminated: name_length bytes of the file */
    size_t name_length;
} ply_property;

typedef enum ply_kind { PLY_VERTICES, PLY_FACES, PLY_STRIPS, PLY_OTHER } ply_kind;

typedef struct ply_element {
    const char *name; /* not terminated: name_length bytes of the file */
    int name_length;
    ply_kind kind;
    uint64_t count;
    const ply_property *properties;
    int property_count;
    bool has_colour; /* all three */
} ply_element;

typedef struct ply_header {
    ply_format format;
    ply_element elements[PLY_ELEMENTS_MAX];
    int element_count;
    ply_property properties[PLY_PROPERTIES_MAX];
    int property_count;
    size_t size; /* bytes up to the first value */
} ply_header;

/* Reads and checks the header. path: NULL to say nothing of what is wrong. The file has to outlive it. Returns an exit_code. */
int ply_header_read(const char *path, const whole_file *file, ply_header *header);

size_t ply_type_size(ply_type type);

/* The bits of a value of a binary file, and what they stand for. */
static inline uint64_t ply_bits(const void *from, size_t size, bool is_big)
{
    const unsigned char *const bytes = from;
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++)
        bits = bits << 8 | bytes[is_big ? i : size - 1 - i];
    return bits;
}

double ply_number(uint64_t bits, ply_type type);

/* Where vertices and faces lie in a binary file: vertices of one size, faces of one list among values of one size. */
typedef struct ply_layout {
    bool is_big;
    uint64_t vertices, vertices_at, faces, faces_at;
    size_t vertex, axes[3];         /* bytes of a vertex, and where in it its coordinates are */
    size_t before, after;           /* bytes of a face before its list and after it */
    ply_type number, count, corner; /* of a coordinate, of the list's length, of a corner */
} ply_layout;

/* False where the first two elements are others, or of none, or a file of `size` bytes ends before them if all lists are empty. */
bool ply_layout_of(const ply_header *header, uint64_t size, ply_layout *layout);

#endif
