/* as_cl.h - included first, makes clang pretend to be cl.exe, which defines none of these and has no atomics of C11. */
#undef __BMI2__
#undef __BMI__
#undef __FMA__
#undef __POPCNT__
#undef __SIZEOF_INT128__
#undef __SSE2__
#undef __clang__
#define __STDC_NO_ATOMICS__ 1
#define __forceinline inline
