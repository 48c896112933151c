/* paper_walk.h - the walks of one compilation of paper_walk.c: orders 123, 132, 213, 231, 312, 321. */
#ifndef PAPER_WALK_H
#define PAPER_WALK_H

#include "paper.h"

enum { PAPER_ORDERS = 6 };

extern paper_walk *const paper_walks_any[PAPER_ORDERS];
extern paper_walk *const paper_walks_avx2[PAPER_ORDERS];
extern paper_walk *const paper_walks_avx512[PAPER_ORDERS];

#endif
