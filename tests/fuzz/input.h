/*
 * input.h - the bytes of a fuzzer as choices, numbers and shapes. Past the last byte all are zero.
 *
 * Bytes taken at random as floats are a waste: hardly two numbers would be of one size. So a byte says how the next numbers are
 * written, and most ways lead close to contact or to an end of the range. All numbers are doubles: of floats while not is_wide.
 */
#ifndef TRIBOX_TESTS_FUZZ_INPUT_H
#define TRIBOX_TESTS_FUZZ_INPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "tribox.h"

enum { INPUT_KNOWN = 18 };

typedef struct input {
    const uint8_t *at, *end;
    unsigned unit;             /* of lattices: which power of two */
    double known[INPUT_KNOWN]; /* numbers drawn before, which others may lie close to */
    unsigned knowns;
    bool is_wide;    /* doubles are drawn, not floats */
    bool is_lattice; /* so far all numbers are few units, and float computes with them without rounding */
} input;

/* The first byte chooses the unit. */
input input_of(const uint8_t *data, size_t size);

bool input_is_over(const input *in);
unsigned input_byte(input *in);

/* 0 .. count - 1, of one byte. */
unsigned input_below(input *in, unsigned count);

/* How many: few, as many as a word or two have, and rarely COUNT_MAX, which is more than a block. */
enum { COUNT_MAX = 600 };
size_t input_count(input *in);

/* Numbers that are all written in one way, which the first byte chooses. They become known. */
void input_numbers(input *in, double *numbers, int count);

/* Moves numbers so many doubles up, but those that are not finite. */
void move_up(double *numbers, int count, unsigned steps);

void input_remember(input *in, double number);

/* Degenerate ones, and such with NaN and infinity, among them. Their numbers become known. */
void input_triangle(input *in, double u[3][3]);

/* Mostly lo <= hi; flat ones, empty ones and such with NaN and infinity among them. Its bounds become known. */
tribox_box input_box(input *in);

/* Rotated, sheared or flat; rarely empty. */
tribox_oriented_box input_oriented(input *in);

/* Which axes, and in which order. */
tribox_options input_options(input *in);

#endif
