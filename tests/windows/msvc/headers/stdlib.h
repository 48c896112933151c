/* stdlib.h - stands for MSVC's: what the compiler's own headers take from it. */
#pragma once
#include <stddef.h>
