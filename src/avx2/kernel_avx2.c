#include "avx2/vec_avx2.h"
#define KERNEL avx2
#include "kernel/axes.h"
#include "kernel/margin.h"
#include "kernel/ties.h"
#include "kernel/packet.h"
#include "kernel/batch.h"
