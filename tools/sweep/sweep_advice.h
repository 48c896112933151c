/* sweep_advice.h - what follows from a sweep: which order and which axes to use. */
#ifndef SWEEP_ADVICE_H
#define SWEEP_ADVICE_H

#include "order_sweep.h"

typedef struct sweep_advice {
    const char *kernel; /* that the advice is for: the default one */
    unsigned order, axes;
    double gain; /* the share of the default's time that it saves; 0 where nothing is faster beyond the spread */
} sweep_advice;

sweep_advice sweep_advise(const sweep *s);

/* The advice as one sentence, without a line end. */
void sweep_advice_text(const sweep_advice *advice, char *text, size_t size);

#endif
