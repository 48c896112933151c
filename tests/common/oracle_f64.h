/* oracle_f64.h - the true answer for a triangle and a box of doubles, from the oracles in integers. */
#ifndef TRIBOX_TESTS_ORACLE_F64_H
#define TRIBOX_TESTS_ORACLE_F64_H

#include <stdbool.h>
#include <stdio.h>

#include "oracle.h"
#include "pair_f64.h"

/* What the thirteen axes say of a pair of finite numbers with lo <= hi. */
oracle_axes oracle_separating_f64(const pair_f64 *pair);

/* Whether the pair overlaps by the axes of these groups: nothing that is not finite does, nor the empty box. */
bool oracle_overlaps_f64(const pair_f64 *pair, oracle_axes truth, unsigned groups);

/* Of any pair: with all that the two above say. */
bool oracle_answer_f64(const pair_f64 *pair, unsigned groups);

/*
 * Whether CONSERVATIVE and FAST may report a pair that does not overlap: each axis of the groups that separates does so by less
 * than 2^-47 (F_a m_b + F_b m_a), of the plane 2^-47 (F_x F_y m_z + F_y F_z m_x + F_z F_x m_y), and no box normal does.
 */
bool oracle_is_near_f64(const pair_f64 *pair, oracle_axes truth, unsigned groups);

/* The pair in hexadecimal floats, and what each axis says. */
void oracle_explain_f64(FILE *out, const pair_f64 *pair);

#endif
