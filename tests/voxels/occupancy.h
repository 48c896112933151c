/* occupancy.h - which cells a soup overlaps: what the oracle says of every one, and what the library sets. */
#ifndef TRIBOX_TESTS_OCCUPANCY_H
#define TRIBOX_TESTS_OCCUPANCY_H

#include "common/ask.h"

#include "triangle_list.h"
#include "common/grid_planes.h"

/* Zeros; fails the test if there is no memory. */
uint64_t *occupancy_make(size_t words);

size_t occupancy_count(const uint64_t *occupied, size_t words);

/*
 * Asks the oracle about every cell that the triangle's bounding box touches and one more on each side, or about every cell of the
 * grid where the axes leave the box normals out. Returns how many it asked about.
 */
size_t occupancy_add(const grid_planes *l, const float u[3][3], unsigned axes, uint64_t *occupied);

/* How many cells that would be. */
size_t occupancy_cost(const grid_planes *l, const float u[3][3], unsigned axes);

/* What is asked, for the message of a failure. */
typedef struct request {
    const char *scene; /* or the name of the test */
    uint64_t seed;
    const grid_planes *at;
    const triangle_list *triangles;
    tribox_options options;
} request;

/*
 * Voxelizes triangles first .. first + count - 1 into words that are cleared before. What holds for every call is checked on the
 * way: the status, the bits past the end of rows and the numbers in the report.
 */
void request_ask(const request *q, size_t first, size_t count, uint64_t *occupied);

/* Fails with the cell, the grid and a triangle to blame if a word differs. */
void request_check_exact(const request *q, size_t first, size_t count, const uint64_t *expected, const uint64_t *occupied);

typedef struct tally {
    size_t asked;  /* cells that EXACT sets */
    size_t missed; /* of these not set */
    size_t extra;  /* set without being overlapped */
} tally;

/*
 * Fails on a cell missed by CONSERVATIVE, and on any error outside of the band of cell_oracle.h: on each axis 2^-7 of the cell,
 * four times the spacing of floats at the farthest plane, as planes are rounded, and 2^-40 of the distance from the cell to the
 * farthest vertex.
 */
void request_check_band(const request *q, const uint64_t *exact, const uint64_t *occupied, tally *count);

#endif
