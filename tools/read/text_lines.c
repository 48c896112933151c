/* text_lines.c - finds the ends of lines. They end in LF, CR LF or CR. */
#include "text_lines.h"

#include <stdbool.h>

const char *text_line_begin(const char *from, const char *word)
{
    while (word > from && word[-1] != '\n' && word[-1] != '\r')
        word--;
    return word;
}

const char *text_line_next(const char *line_end, const char *text_end)
{
    const bool is_pair = text_end - line_end > 1 && line_end[0] == '\r' && line_end[1] == '\n';
    return line_end + (is_pair ? 2 : line_end < text_end);
}
