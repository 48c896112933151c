#include "sse/vec_sse2.h"
#define KERNEL sse2
#include "kernel/axes.h"
#include "kernel/margin.h"
#include "kernel/ties.h"
#include "kernel/packet.h"
#include "kernel/batch.h"
