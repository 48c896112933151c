/* target_avx2.h - functions from here to the end of a kernel's text are compiled for AVX2 with FMA, whatever the flags say. */
#include "base/targets.h"
#if TRIBOX_AVX2
#define TRIBOX_FMA 1
#define TRIBOX_POPCNT 1
#define TRIBOX_VECTOR_BYTES 32
#if defined(__clang__) /* the system's functions stay as they are, so their headers come first */
#include <float.h>
#include <immintrin.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#if defined(_MSC_VER) /* where immintrin.h has only what flags ask for */
#include <avxintrin.h>
#include <avx2intrin.h>
#include <bmiintrin.h>
#include <bmi2intrin.h>
#include <fmaintrin.h>
#include <popcntintrin.h>
#endif
#define TRIBOX_POP_TARGET 1
#pragma clang attribute push(__attribute__((target("avx2,fma,popcnt,bmi,bmi2"))), apply_to = function)
#elif defined(__GNUC__)
#pragma GCC target("avx2,fma,popcnt,bmi,bmi2")
#endif
#endif
