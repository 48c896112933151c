#include "scalar/vec_scalar.h"
#define KERNEL scalar
#include "kernel/axes.h"
#include "kernel/margin.h"
#include "kernel/ties.h"
#include "kernel/packet.h"
#include "kernel/batch.h"
