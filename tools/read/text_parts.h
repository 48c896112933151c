/* text_parts.h - the lines of a file in parts, which threads take in turn. */
#ifndef TEXT_PARTS_H
#define TEXT_PARTS_H

#include "console/digits.h"
#include "plain.h"

/*
 * The lines that begin between two places of the file: part 0 begins where the text does. After the file's last line, which a line
 * end is put to, come zeros: TEXT_AHEAD bytes may be looked at from anywhere before `end`.
 */
typedef struct text_part {
    size_t number;
    const char *begin, *limit; /* of the lines; begin == limit where none begins here */
    const char *end;           /* of what is there of the next parts' lines */
    bool is_last;              /* the file ends at `end` */
    uint64_t offset;           /* of begin in the file */
    uint64_t first_line;       /* counted from 0, where they are counted */
    struct text_run *run;
    bool is_passed;
} text_part;

enum { TEXT_AHEAD = 64, TEXT_OVERLAP = 8192 /* bytes of the parts after it that a part has, so that no line may be longer */ };

typedef bool text_work(void *data, unsigned thread, text_part *part);

size_t text_parts_count(const plain_file *file, uint64_t from);

/*
 * What parts do in the order in which they are in the file: nothing, so that no thread waits for another; or their lines are
 * counted before the work; or the work passes them on, each by text_part_await and text_part_pass.
 */
typedef enum text_order { TEXT_ANY_ORDER, TEXT_COUNTED, TEXT_IN_ORDER } text_order;

/*
 * Calls work for each part of the text that begins at `from`. Returns false where a part could not be read, a line is too long, or
 * work returned false.
 */
bool text_parts_run(const plain_file *file, uint64_t from, text_order order, text_work *work, void *data);

/* Waits until all parts before this one are passed. False: one has failed. Then, one thread at a time, until text_part_pass. */
bool text_part_await(text_part *part);
void text_part_pass(text_part *part);

static inline bool text_is_blank(char c) { return c == ' ' || c == '\t'; }

static inline bool text_ends_word(char c) { return text_is_blank(c) || c == '\r' || c == '\n'; }

static inline const char *text_skip_blanks(const char *c)
{
    while (text_is_blank(*c))
        c++;
    return c;
}

/* What follows a line's last word: its end, which a '\r' may precede; NULL where there is something else. */
static inline const char *text_end_line(const char *c)
{
    c = text_skip_blanks(c);
    c += *c == '\r';
    return *c == '\n' ? c + 1 : NULL;
}

#endif
