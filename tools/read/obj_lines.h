/* obj_lines.h - the lines of an OBJ file, and what a face refers to. */
#ifndef OBJ_LINES_H
#define OBJ_LINES_H

#include "read/words.h"

/* What has numbers of its own, in the order in which a corner names them: 5/3/1. */
enum { OBJ_POSITIONS, OBJ_TEXTURE, OBJ_NORMALS, OBJ_NUMBERED };

typedef enum obj_kind {
    OBJ_VERTEX, /* v, vt, vn */
    OBJ_FACE,
    OBJ_ELEMENT, /* l, p: lines and points */
    OBJ_STATE,   /* of the faces after it: a group, a material */
    OBJ_CURVED,  /* of curves and surfaces, which refer to vertices in ways of their own */
    OBJ_OTHER
} obj_kind;

enum { OBJ_STATES = 12 };

typedef struct obj_line {
    obj_kind kind;
    int which;               /* of OBJ_NUMBERED, or of OBJ_STATES */
    const char *begin, *end; /* with the end of the line */
    words words;             /* after the first one */
} obj_line;

/* The next line that is neither empty nor a comment; false at the end. from: what follows the line before it. */
bool obj_line_next(words *w, const char *from, obj_line *line);

/* What follows the first word, without the blanks around it: a name, which may have blanks within. */
const char *obj_line_rest(const obj_line *line, size_t *length);

/* Numbers in the order of OBJ_NUMBERED: of all, and of those before a line, from which negative ones count. */
typedef struct obj_numbers {
    uint64_t all[OBJ_NUMBERED], here[OBJ_NUMBERED];
} obj_numbers;

/* One of the numbers of a corner: where it stands, and what it refers to, counted from 0. */
typedef struct obj_reference {
    const char *text;
    size_t length;
    int which;
    uint64_t number;
} obj_reference;

/*
 * The references of the words of a line, one after another, from after its first word on. Those to what is not there are passed
 * over: only the numbers of vertices have been checked by the reader. False at the end.
 */
typedef struct obj_corners {
    words words;
    const char *at;
    int which;
} obj_corners;

obj_corners obj_corners_of(const obj_line *line);
bool obj_corners_next(obj_corners *corners, const obj_numbers *numbers, obj_reference *reference);

#endif
