/* fill_kinds.h - the ways of filling, and which of the cells then go on. */
#ifndef FILL_KINDS_H
#define FILL_KINDS_H

/* FILL_MIDDLES: parity of the middles alone, without the cells of the surface. */
typedef enum voxelize_fill { FILL_NONE, FILL_OUTSIDE, FILL_PARITY, FILL_MIDDLES } voxelize_fill;

/* The surface and its inside, as one or told apart; or the inside alone. */
typedef enum fill_cells { FILL_CELLS_ALL, FILL_CELLS_LABELLED, FILL_CELLS_INSIDE } fill_cells;

#endif
