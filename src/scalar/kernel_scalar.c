#include "scalar/vec_scalar.h"
#define KERNEL scalar
#include "kernel/axes.h"
#include "kernel/bounds.h"
#include "kernel/packet.h"
#include "kernel/batch.h"
