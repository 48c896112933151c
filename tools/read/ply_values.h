/* ply_values.h - the values that follow the header of a PLY file, taken one after another. */
#ifndef PLY_VALUES_H
#define PLY_VALUES_H

#include "ply_header.h"
#include "words.h"

typedef struct ply_values {
    const char *path;
    ply_format format;
    const unsigned char *at, *end; /* of binary values */
    words words;                   /* of values as text */
    const ply_element *element;    /* the one that is being read */
    uint64_t number;               /* which of them, counted from 0 */
} ply_values;

ply_values ply_values_of(const char *path, const whole_file *file, const ply_header *header);

/* Begins with an element. Refuses more of it than the bytes that are left can hold. Returns an exit_code. */
int ply_values_begin(ply_values *v, const ply_element *element);

/* Each takes what comes next, and returns an exit_code: failure where the file ends, or a word is not a number. */
int ply_values_take(ply_values *v, ply_type type, double *number);
int ply_values_take_coordinate(ply_values *v, ply_type type, double *number, float_fit *fit); /* fit: as for words_number */
int ply_values_take_float(ply_values *v, float *number);                                      /* of a binary file, bit for bit */
int ply_values_skip(ply_values *v, const ply_property *property);

/* Takes the number of values in a list; the bytes that are left can hold as many. */
int ply_values_take_count(ply_values *v, const ply_property *list, uint64_t *count);

#endif
