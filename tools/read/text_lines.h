/* text_lines.h - where the lines of a text begin. */
#ifndef TEXT_LINES_H
#define TEXT_LINES_H

/* Where the line of a word begins, unless that is before `from`; and where the next one does after a line's last character. */
const char *text_line_begin(const char *from, const char *word);
const char *text_line_next(const char *line_end, const char *text_end);

#endif
