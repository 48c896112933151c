/* pair_f32.h - one triangle and one box, in float. */
#ifndef TRIBOX_TESTS_PAIR_F32_H
#define TRIBOX_TESTS_PAIR_F32_H

#include "tribox.h"

typedef struct pair_f32 {
    float u[3][3]; /* u[j][a]: axis a of vertex j */
    tribox_box box;
} pair_f32;

#endif
