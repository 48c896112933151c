/* setjmp.h - stands for MSVC's: clang's intrin.h includes it. */
#pragma once
typedef long long jmp_buf[32];
