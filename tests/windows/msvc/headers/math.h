/* math.h - stands for MSVC's: what src/ takes from it. */
#pragma once
#define INFINITY ((float)(1e300 * 1e300))
#define signbit(a) (copysign(1, a) < 0)
double copysign(double a, double sign);
double fabs(double a);
float copysignf(float a, float sign);
float fabsf(float a);
