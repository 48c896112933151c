/*
 * crossing_oracle.h - crossings of rays along x by integers, about a point that is moved by so little that less would change
 * nothing: no sign of a coefficient is asked.
 */
#ifndef TRIBOX_TESTS_CROSSING_ORACLE_H
#define TRIBOX_TESTS_CROSSING_ORACLE_H

#include <stdbool.h>
#include <stdint.h>

/* Cells on one axis or planes, cells of a grid, and triangles. */
enum { ORACLE_SIDE = 131, ORACLE_CELLS = 4096, ORACLE_TRIANGLES = 2000 };

/* The middles of cells, and triangles u[t][v][a]. */
typedef struct crossing_case {
    uint32_t size[3];
    double middle[3][ORACLE_SIDE];
    double u[ORACLE_TRIANGLES][3][3];
    int count;
    int bits; /* all numbers are multiples of 2^-bits below 2^bits */
} crossing_case;

/* Whether crossings below the middle of each cell are odd, and all of each row: is_inside[(k * size[1] + j) * size[0] + i]. */
void crossing_oracle(const crossing_case *c, bool *is_inside, bool *is_odd);

#endif
