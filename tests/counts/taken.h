/* taken.h - what the float kernels take for underflow, in the unit of claims: 2^-150, half the least float. */
#ifndef TRIBOX_TESTS_TAKEN_H
#define TRIBOX_TESTS_TAKEN_H

double taken_eta(void); /* of a slack */
double taken_tau(void); /* of the plane's, for each m_i */

#endif
