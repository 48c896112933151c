/* wide_text.c - UTF-8 to UTF-16 and back, by Windows itself. */
#include "wide_text.h"

#include <stdlib.h>
#include <windows.h>

wchar_t *wide_of_utf8(const char *text)
{
    const int count = MultiByteToWideChar(CP_UTF8, 0, text, -1, NULL, 0);
    wchar_t *const wide = malloc((size_t)count * sizeof *wide);
    if (wide)
        MultiByteToWideChar(CP_UTF8, 0, text, -1, wide, count);
    return wide;
}

char *utf8_of_wide(const wchar_t *text)
{
    const int count = WideCharToMultiByte(CP_UTF8, 0, text, -1, NULL, 0, NULL, NULL);
    char *const narrow = malloc((size_t)count);
    if (narrow)
        WideCharToMultiByte(CP_UTF8, 0, text, -1, narrow, count, NULL, NULL);
    return narrow;
}
