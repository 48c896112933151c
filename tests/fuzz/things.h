/*
 * things.h - the bytes of a fuzzer as choices, numbers and shapes; triangles in any layout, and regions: what is true of them, and
 * the calls that have a form for each.
 *
 * Bytes taken at random as floats are a waste: hardly two numbers would be of one size. So a byte says how the next numbers are
 * written, and most ways lead close to contact or to an end of the range. All numbers are doubles: of floats while not is_wide.
 * Past the last byte all are zero.
 */
#ifndef TRIBOX_TESTS_FUZZ_THINGS_H
#define TRIBOX_TESTS_FUZZ_THINGS_H

#include "common/grid_places.h"
#include "common/mesh_numbers.h"
#include "common/pair_f64.h"
#include "common/soup_or_mesh.h"
#include "common/window_bits.h"
#include "ensure.h"

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

/* Different triangles are few, since the oracle is slow; they are repeated as often as one likes. */
enum { DRAWN_MAX = 16 };

typedef struct things {
    double u[DRAWN_MAX][3][3];
    unsigned drawn;
    size_t count, run; /* triangle i is u[i / run % drawn] */
    bool is_mesh;      /* for CALL */
    tribox_soup soup;
    tribox_mesh mesh;
    unsigned wrong;         /* with the mesh; as bits of 1 << status */
    bool is_bad[DRAWN_MAX]; /* one corner is no vertex */
    size_t bad, first_bad;  /* corners that are no vertices */
} things;

/* Kinds: a soup; a mesh of floats; of doubles that are floats; of any doubles. Vertices may lie about a frame. */
enum { OF_SOUP, OF_FLOATS, OF_NARROW, OF_DOUBLES, KINDS };
void things_draw(input *in, unsigned kind, size_t count, const tribox_oriented_box *frame, things *t);

/* The drawn triangles as nine streams of exact size, `shift` floats off an aligned place. */
void things_lay_soup(things *t, size_t shift);

/* Some of the triangles, in the same memory. */
things things_part(const things *t, size_t first, size_t count);

typedef const double (*corners)[3];
static inline corners things_triangle(const things *t, size_t i) { return (corners)t->u[i / t->run % t->drawn]; }

bool oriented_is_finite(const tribox_oriented_box *box);

tribox_status things_overlap(const things *t, const tribox_region *region, const tribox_options *o, uint64_t *mask,
                             tribox_report *report);

/* A stream of exact size, `shift` floats off an aligned place. */
float *tight_stream(size_t count, size_t shift);

/* The kernels that run here, the scalar one first; NULL after the last. */
const char *const *runnable_kernels(void);

/* At each accuracy, on each kernel. */
typedef void asking(const void *about, const tribox_options *o);
void ask_everywhere(tribox_options o, asking *ask, const void *about);

/* The set bits; those past `count` are claimed to be clear. */
size_t mask_population(const uint64_t *mask, size_t count);

bool is_same_mask(const uint64_t *one, const uint64_t *other, size_t count);

#endif
