/* string.h - stands for MSVC's: what src/ takes from it. */
#pragma once
#include <stddef.h>
int memcmp(const void *a, const void *b, size_t size);
int strcmp(const char *a, const char *b);
void *memcpy(void *to, const void *from, size_t size);
void *memmove(void *to, const void *from, size_t size);
void *memset(void *to, int byte, size_t size);
