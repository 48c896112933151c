#include "avx512/vec_avx512.h"
#define KERNEL avx512
#include "kernel/axes.h"
#include "kernel/margin.h"
#include "kernel/ties.h"
#include "kernel/packet.h"
#include "kernel/batch.h"
