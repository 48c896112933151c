/* malloc.h - stands for MSVC's: what the compiler's own headers take from it. */
#pragma once
#include <stddef.h>
void *_aligned_malloc(size_t size, size_t alignment);
void _aligned_free(void *memory);
