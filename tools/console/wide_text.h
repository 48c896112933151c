/* wide_text.h - Windows names everything in UTF-16, the program in UTF-8. */
#ifndef WIDE_TEXT_H
#define WIDE_TEXT_H

#include <wchar.h>

/* Both return memory to be freed, NULL without any. A half of a pair that stands alone becomes a replacement character. */
wchar_t *wide_of_utf8(const char *text);
char *utf8_of_wide(const wchar_t *text);

#endif
