/* cells.h - the texts about cells of a grid in float, in order. After: a vocabulary of float, and KERNEL, the kernel's name. */
#include "voxels.h"
#include "axes.h"
#include "reach.h"
#include "writes.h"
#include "shadow.h"
#include "bricks.h"
#include "flats.h"
#include "sorted.h"
